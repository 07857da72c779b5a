#!/usr/bin/env python3
"""Checks the floors: what each object file was really compiled from, by the compiler's own dependency records.

A folder includes only from floors below it, never from beside or above. Floors 0, 1 and plan/ reach neither OpenSceneGraph, GL, GDAL nor
OpenImageIO. Usage: dependencies.py BUILD_FOLDER SOURCE_FOLDER; or --self-test.
"""
import os
import subprocess
import sys

FLOORS = {
    "city": 0,
    "culling": 1, "terrain": 1, "houselod": 1, "facade": 1, "blockmap": 1, "avatars": 1, "streaming": 1, "walking": 1,
    "light": 1,
    "plan": 2, "assets": 2,
    "scenegraph": 3,
    "viewer": 4,
    "report": 5,
    "app": 6,
}
# What the pure folders must not reach, as parts of a system header's path.
FORBIDDEN = ("/osg", "/GL/", "/EGL/", "/GLFW/", "/gdal", "/OpenImageIO/", "/assimp/", "/sqlite3", "/nlohmann/")
PURE = {folder for folder, floor in FLOORS.items() if floor <= 1} | {"plan"}


def violations(folder, source, dependencies):
    """Messages for one object of `folder`; `dependencies` are absolute, or relative to the source tree."""
    found = []
    for path in dependencies:
        if os.path.isabs(path):
            if folder in PURE and any(part in path for part in FORBIDDEN):
                found.append(f"{source}: floor {FLOORS[folder]} reaches {path}")
            continue
        other = path.split("/", 1)[0]
        if other in FLOORS and other != folder and FLOORS[other] >= FLOORS[folder]:
            found.append(f"{source}: {folder}/ (floor {FLOORS[folder]}) includes {path} (floor {FLOORS[other]})")
    return found


def dependency_records(build):
    """Yields (object, [dependencies]) from ninja's log of the compiler's dependency files."""
    text = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, capture_output=True, text=True).stdout
    target, paths = None, []
    for line in text.splitlines():
        if line.startswith("    "):
            paths.append(line.strip())
        elif line and ": #deps" in line:
            target, paths = line.split(": #deps", 1)[0], []
        elif not line and target:
            yield target, paths
            target = None
    if target:
        yield target, paths


def check(build, source_root):
    root = os.path.realpath(source_root) + "/"
    seen, found = set(), []
    for target, paths in dependency_records(build):
        folder = target.split("/", 1)[0]
        if folder not in FLOORS:
            continue
        seen.add(folder)
        absolute = [os.path.normpath(os.path.join(build, p)) for p in paths]
        relative = [p[len(root):] if p.startswith(root) else p for p in absolute]
        # Generated files lie in the build folder, under the name of the folder that makes them.
        built = os.path.realpath(build) + "/"
        relative = [p[len(built):] if p.startswith(built) else os.path.relpath(p, root) if p.startswith(root) else p
                    for p in relative]
        found += violations(folder, target, relative)
    present = {f for f in FLOORS if os.path.isdir(os.path.join(root, f))}
    for missing in sorted(present - seen):
        found.append(f"{missing}/: no compiled object has a dependency record, so nothing was checked")
    return found, len(seen)


def self_test():
    """The instrument is tested before it is trusted: planted violations are found, honest includes are not."""
    planted = [
        ("city", ["/usr/include/osg/Node"]),
        ("culling", ["/usr/include/gdal/ogr_api.h"]),
        ("plan", ["/usr/include/OpenImageIO/imageio.h"]),
        ("plan", ["assets/load_city.hpp"]),
        ("culling", ["plan/planner.hpp"]),
        ("scenegraph", ["viewer/renderer.hpp"]),
    ]
    for folder, paths in planted:
        assert violations(folder, "planted", paths), f"not found: {folder} including {paths}"
    honest = [
        ("city", ["city/aabb.hpp", "/usr/include/glm/glm.hpp"]),
        ("plan", ["culling/frustum.hpp", "city/city.hpp"]),
        ("scenegraph", ["/usr/include/osg/Node", "plan/planner.hpp"]),
    ]
    for folder, paths in honest:
        assert not violations(folder, "honest", paths), f"wrongly found: {folder} including {paths}"


if __name__ == "__main__":
    self_test()
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(0)
    messages, folders = check(sys.argv[1], sys.argv[2])
    print("\n".join(messages) if messages else f"{folders} folders keep to their floors")
    sys.exit(1 if messages else 0)
