#!/usr/bin/env python3
"""Seconds until the city is loaded and from the start of the program to the end of its first frame of 1280 x 720, and peak
memory, cold (neither Vicus nor the driver has anything in its cache) and cached.

Usage: measure_loading.py VICUS [--rounds N] SCENE… ; prints a Markdown table, medians of three rounds in which the scenes
take turns.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

ROUNDS = 3


def run(vicus, scene, cache):
    with tempfile.TemporaryDirectory() as out:
        figures = os.path.join(out, "figures.json")
        command = [vicus, "walk", scene, "--headless", "--frames", "1", "--size", "1280x720", "--out", out, "--json", figures]
        environment = dict(os.environ, XDG_CACHE_HOME=cache)
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        with open(figures, encoding="utf-8") as file:
            result = json.load(file)
        return result["loading_s"]["city"], result["loading_s"]["first_frame"], result["memory_mb"]["peak_resident"]


def main():
    vicus, scenes, rounds = sys.argv[1], sys.argv[2:], ROUNDS
    if scenes[:1] == ["--rounds"]:
        rounds, scenes = int(scenes[1]), scenes[2:]
    cold = {scene: [] for scene in scenes}
    cached = {scene: [] for scene in scenes}
    for _ in range(rounds):
        for scene in scenes:
            with tempfile.TemporaryDirectory() as cache:
                cold[scene].append(run(vicus, scene, cache))
                cached[scene].append(run(vicus, scene, cache))
    print("| scene | city cold, s | first frame cold, s | city cached, s | first frame cached, s | peak memory cold, MB | cached, MB |")
    print("|---|---|---|---|---|---|---|")
    for scene in scenes:
        median = lambda runs, k: statistics.median(r[k] for r in runs)
        c, w = cold[scene], cached[scene]
        print(f"| {os.path.basename(scene)} | {median(c, 0):.2f} | {median(c, 1):.2f} | {median(w, 0):.2f} | {median(w, 1):.2f} "
              f"| {median(c, 2):.0f} | {median(w, 2):.0f} |")


if __name__ == "__main__":
    main()
