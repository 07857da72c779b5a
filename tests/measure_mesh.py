#!/usr/bin/env python3
"""Seconds of the processor, and peak memory, to read one mesh of many triangles: a scanned statue.

Usage: measure_mesh.py VICUS [MILLIONS]; makes a ball with bumps of that many million triangles (5) as binary PLY and
glTF in a temporary folder, opens a scene description with each of them as a monument, without a cache, and prints a
Markdown table. Fails where the scene does not hold all triangles.
"""
import array
import json
import math
import os
import subprocess
import sys
import tempfile


def ball(millions):
    """Positions (x, y, z in turn) and indices of a ball of 2 m with bumps; rows × columns × 2 triangles."""
    rows = int(math.sqrt(millions * 1e6 / 4))
    columns = 2 * rows
    positions, indices = array.array("f"), array.array("I")
    around = [(math.cos(2 * math.pi * c / columns), math.sin(2 * math.pi * c / columns)) for c in range(columns + 1)]
    for r in range(rows + 1):
        polar = math.pi * r / rows
        for c, (x, y) in enumerate(around):
            radius = 1 + 0.02 * math.sin(40 * polar) * math.sin(c * 80 * math.pi / columns)
            flat = radius * math.sin(polar)
            positions.extend((flat * x, flat * y, radius * math.cos(polar)))
    for r in range(rows):
        for c in range(columns):
            a = r * (columns + 1) + c
            b = a + columns + 1
            indices.extend((a, b, a + 1, a + 1, b, b + 1))
    return positions, indices


def write_ply(path, positions, indices):
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions) // 3}\nproperty float x\n"
                    f"property float y\nproperty float z\nelement face {len(indices) // 3}\n"
                    "property list uchar uint vertex_indices\nend_header\n").encode())
        file.write(positions.tobytes())
        raw, out = indices.tobytes(), bytearray()
        for i in range(0, len(raw), 12):
            out += b"\x03" + raw[i:i + 12]
        file.write(out)


def write_glb(path, positions, indices):
    where, which = positions.tobytes(), indices.tobytes()
    low = [min(positions[k::3]) for k in range(3)]
    high = [max(positions[k::3]) for k in range(3)]
    gltf = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(where) + len(which)}],
        "bufferViews": [{"buffer": 0, "byteLength": len(where)},
                        {"buffer": 0, "byteOffset": len(where), "byteLength": len(which)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions) // 3, "type": "VEC3", "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}]}
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        total = 12 + 8 + len(text) + 8 + len(where) + len(which)
        for number in (0x46546C67, 2, total, len(text), 0x4E4F534A):
            file.write(number.to_bytes(4, "little"))
        file.write(text)
        for number in (len(where) + len(which), 0x004E4942):
            file.write(number.to_bytes(4, "little"))
        file.write(where)
        file.write(which)


def main():
    vicus = os.path.abspath(sys.argv[1])
    positions, indices = ball(float(sys.argv[2]) if len(sys.argv) > 2 else 5)
    triangles = len(indices) // 3
    print("| file | triangles | size, MB | seconds | peak memory, MB |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, write in (("ball.ply", write_ply), ("ball.glb", write_glb)):
            mesh = os.path.join(folder, name)
            write(mesh, positions, indices)
            scene = os.path.join(folder, name + ".toml")
            with open(scene, "w", encoding="utf-8") as file:
                file.write(f'crs = "EPSG:2154"\n[[monuments]]\nname = "ball"\nfile = "{name}"\n'
                           "position = [600000.0, 6500000.0]\nheight = 2.0\n")
            # A process between, so that what is asked of its children is of this run alone.
            code = ("import resource,subprocess,sys; r=subprocess.run(sys.argv[1:],stdout=subprocess.PIPE,check=True); "
                    "u=resource.getrusage(resource.RUSAGE_CHILDREN); "
                    "sys.stderr.write(f'{u.ru_maxrss} {u.ru_utime+u.ru_stime}'); sys.stdout.buffer.write(r.stdout)")
            result = subprocess.run([sys.executable, "-c", code, vicus, "info", "--no-cache", "--json", scene],
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True)
            peak, seconds = (float(word) for word in result.stderr.split()[-2:])
            held = json.loads(result.stdout)
            print(f"| {name} | {triangles} | {os.path.getsize(mesh) / 1e6:.0f} | {seconds:.1f} | {peak / 1024:.0f} |")
            if held["building_polygons"] != triangles:
                sys.exit(f"{name}: {held['building_polygons']} of {triangles} triangles were read")


if __name__ == "__main__":
    main()
