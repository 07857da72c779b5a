#!/usr/bin/env python3
"""Do two reports of one scene agree? Compares every speed-up of two report.json within their confidence intervals and
prints those that have no value in common. Usage: compare_reports.py A/report.json B/report.json"""
import json
import sys


def speedups(path):
    with open(path, encoding="utf-8") as file:
        found = json.load(file)["speedups"]
    return {(s["path"], s["run"], s["over"]): s["ratio"] for s in found if s["run"] != s["over"]}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    one, other = map(speedups, sys.argv[1:])
    both = [key for key in one if key in other]
    agreeing = 0
    for key in both:
        a, b = one[key], other[key]
        if a["low"] <= b["high"] and b["low"] <= a["high"]:
            agreeing += 1
        else:
            print("{1} over {2} on {0}: {a[low]:.2f} to {a[high]:.2f} and {b[low]:.2f} to {b[high]:.2f}".format(*key, a=a, b=b))
    print(f"{agreeing} of {len(both)} ratios agree within their 95 % intervals")


if __name__ == "__main__":
    main()
