#!/usr/bin/env python3
"""Frame times of a scene with techniques off and on, as ratios of runs that take turns, beside counts.

Usage: measure_techniques.py VICUS SCENE [WIDTHxHEIGHT [TOUR]] ; prints a Markdown table. The first row, all off, is the
one that the ratios refer to: the median over rounds of the ratio within each round.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

ROUNDS = 5
FRAMES = 24
TECHNIQUES = ["frustum_culling", "cull_map", "roam", "state_ordering", "house_lod"]
CONFIGURATIONS = {
    "all off": [],
    "frustum culling only": ["frustum_culling"],
    "state ordering only": ["state_ordering"],
    "state ordering, house LOD": ["state_ordering", "house_lod"],
    "frustum culling, state ordering": ["frustum_culling", "state_ordering"],
    "frustum culling, cull map": ["frustum_culling", "cull_map"],
    "all on": TECHNIQUES,
}
COUNTS = ["instances_drawn", "triangles", "draw_calls", "texture_binds"]


def known_knobs(vicus):
    text = subprocess.run([vicus, "knobs", "--json"], check=True, capture_output=True, text=True).stdout
    return {knob["name"] for knob in json.loads(text)}


def run(vicus, scene, size, tour, techniques, on):
    with tempfile.TemporaryDirectory() as out:
        figures = os.path.join(out, "figures.json")
        command = [vicus, "walk", scene, "--headless", "--tour", tour, "--frames", str(FRAMES), "--every", "1000",
                   "--size", size, "--out", out, "--json", figures]
        for technique in techniques:
            command += ["--set", f"{technique}={1 if technique in on else 0}"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(figures, encoding="utf-8") as file:
            return json.load(file)


def main():
    vicus, scene = sys.argv[1], sys.argv[2]
    size = sys.argv[3] if len(sys.argv) > 3 else "1280x720"
    tour = sys.argv[4] if len(sys.argv) > 4 else "street"
    techniques = [t for t in TECHNIQUES if t in known_knobs(vicus)]
    milliseconds = {name: [] for name in CONFIGURATIONS}
    counts = {}
    for _ in range(ROUNDS):
        for name, on in CONFIGURATIONS.items():
            result = run(vicus, scene, size, tour, techniques, on)
            milliseconds[name].append(result["run_time_ms"]["frame"]["median"])
            counts[name] = result["counts"]
    print(f"{os.path.basename(scene)}, {tour}, {size}: {FRAMES} frames, {ROUNDS} rounds\n")
    print("| techniques | ms | all off ÷ this | houses drawn | triangles | draw calls | texture binds |\n|---|---|---|---|---|---|---|")
    base = milliseconds["all off"]
    for name, values in milliseconds.items():
        ratio = statistics.median(a / b for a, b in zip(base, values))
        cells = [f"{counts[name][c]['mean']:.0f}" for c in COUNTS]
        print(f"| {name} | {statistics.median(values):.1f} | {ratio:.2f} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
