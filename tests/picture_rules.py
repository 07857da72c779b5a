#!/usr/bin/env python3
"""Pictures of every operator, shape, mask and form of roof for docs/rules.md, and of every style.

Usage: picture_rules.py VICUS FOLDER
Writes operators-walls.jpg, operators-volumes.jpg and styles-street.jpg. Needs oiiotool. Each small picture is a house of
its own rules, which are below: they serve as examples, too.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

BOX = "plain plaster\neaves planks\nHouse => Extrude(house.height, Comp(side: Wall, roof: Roof(flat, 0, 0.25, limewash, Wall)))\n"
PANE = "Pane => SplitX((Rel, 1, Nothing()), (Abs, 0.9, SplitY((Rel, 1, Nothing()), (Abs, 1.4, AttachScope(opening, -0.2, 40, 60, \"window-casement\", ashlar)), (Rel, 1, Nothing()))), (Rel, 1, Nothing()))\n"
TWO = "A => SampleTexture(brick, Rep, (0, 0, 0, 0))\nB => SampleTexture(ashlar, Rep, (0, 0, 0, 0))\nC => SampleTexture(limewash, Rep, (0, 0, 0, 0))\n"


def shape(name, depth, width=1.6, height=2.2, textures="ashlar", foot=1.2):
    return (BOX + f"Wall => Layer(SampleTexture(plaster, Rep, (0, 0, 0, 0), (1, 0.9, 0.75)), SplitX((Rel, 1, Nothing()), (Abs, {width}, "
            f"SplitY((Abs, {foot}, Nothing()), (Abs, {height}, AttachScope({name}, {depth}, 40, 60, {textures})), (Rel, 1, Nothing()))), (Rel, 1, Nothing())))\n")


def mask(text):
    return BOX + TWO + "Wall => Layer(B, RepeatY(0.5, RepeatX(0.5, Leaf)), SkipMask(" + text + "))\nLeaf => AttachScope(block, 0.08, 40, 60, oak)\n"


WALLS = {
    "SplitX": BOX + TWO + "Wall => SplitX((Abs, 1, A), (Flt, 2, B), (Rel, 1, C), (Abs, 1, A))\n",
    "SplitY": BOX + TWO + "Wall => SplitY((Abs, 1, A), (Rel, 2, B), (Rel, 1, C))\n",
    "RepeatX": BOX + TWO + PANE + "Wall => Layer(C, RepeatX(2, Pane))\n",
    "RepeatY": BOX + TWO + PANE + "Wall => Layer(C, RepeatY(2, Pane))\n",
    "Layer": BOX + TWO + PANE + "Wall => Layer(A, SplitY((Rel, 1, B), (Rel, 1, Nothing())), RepeatX(2.5, Pane))\n",
    "SampleTexture Rep": BOX + "Wall => SampleTexture(brick, Rep, (0, 0, 4, 4))\n",
    "SampleTexture Fit": BOX + "Wall => RepeatX(2, SampleTexture(\"window-framed\", Fit, (0, 0, 1, 1)))\n",
    "SetColor": BOX + "Wall => RepeatX(2, Stripe)\nStripe : index == 1 => SetColor(0.5, 0.12, 0.08)\nStripe => SetColor(0.7, 0.6, 0.4)\n",
    "AttachTexture leaf": BOX + TWO + "Wall => Layer(B, SplitY((Abs, 2.6, AttachTexture(leaf, Rep, (0, 0, 1.2, 1.2), 40, 60, leaves)), (Rel, 1, Nothing())))\n",
    "SkipMask noise": mask("noise, Rep, (0, 0, 4, 4), 0.5, 1"),
    "SkipMask foot": mask("foot, Fit, (0, 0, 1, 1), 0.5, 1"),
    "SkipMask eaves": mask("eaves, Fit, (0, 0, 1, 1), 0.6, 1"),
    "SkipMask checker": mask("checker, Rep, (0, 0, 1, 1), 0.5, 1"),
    "Nothing": BOX + TWO + "Wall => Layer(A, SplitX((Rel, 1, Nothing()), (Rel, 1, B), (Rel, 1, Nothing())))\n",
    "a condition": BOX + TWO + PANE + "Wall : width < 5 => A\nWall => Layer(C, RepeatX(2, Pane))\n",
    "weights": BOX + TWO + "Wall => RepeatY(0.8, RepeatX(0.8, Some))\nSome @ 3 => A\nSome @ 1 => B\n",
    "panel": shape("panel", 0.03, textures='"window-framed"'),
    "block": shape("block", 0.3),
    "opening": shape("opening", -0.35, textures='"window-casement", ashlar'),
    "cornice": shape("cornice", 0.5, 5, 0.8, "limewash", 3),
    "pediment": shape("pediment", 0.3, 2.4, 1, "limewash", 2.4),
    "pilaster": shape("pilaster", 0.25, 0.7, 3.6, "limewash", 0.1),
    "brace": shape("brace", 0.1, 1.8, 2.4, "oak"),
    "brace_back": shape("brace_back", 0.1, 1.8, 2.4, "oak"),
    "awning": shape("awning", 1.2, 3, 0.7, "planks", 2.4),
    "balcony": shape("balcony", 0.9, 2.6, 1.1, "ashlar, iron", 1.8),
    "buttress": shape("buttress", 0.9, 0.8, 3.8, "ashlar", 0),
    "battlement": BOX.replace("0.25", "0") + "Wall => Layer(SampleTexture(rubble, Rep, (0, 0, 0, 0)), SplitY((Rel, 1, Nothing()), (Abs, 0.5, AttachScope(battlement, 0.2, 40, 60, rubble))))\n",
}

HOUSE = ("plain plaster\neaves planks\nWall => SampleTexture(plaster, Rep, (0, 0, 0, 0), (1, 0.92, 0.78))\n"
         "Facade => Layer(Wall, RepeatY(2.8, RepeatX(2.4, Pane)))\n" + PANE)


def roof(form, pitch="38 deg", overhang="0.4"):
    return HOUSE + f"House => Extrude(house.height, Comp(front: Facade, side: Wall, roof: Roof({form}, {pitch}, {overhang}, tile, Wall)))\n"


def gable(name):
    return (HOUSE + "House => Extrude(house.height, Comp(front: Facade, side: Wall, roof: Roof(gable_front, 50 deg, 0.1, tile, Gable)))\n"
            f"Gable => Layer(Wall, AttachScope({name}, 0.1, 80, 100, brick))\n")


VOLUMES = {
    "Extrude": HOUSE + "House => Extrude(4, Comp(front: Facade, side: Wall))\n",
    "SplitZ": HOUSE + "House => Extrude(house.height, SplitZ((Abs, 2.6, Comp(side: Low)), (Rel, 1, Comp(front: Facade, side: Wall))))\nLow => SampleTexture(brick, Rep, (0, 0, 0, 0))\n",
    "Comp": HOUSE + "House => Extrude(house.height, Comp(front: Facade, side: Low, back: Wall, roof: Roof(flat, 0, 0.4, lead, Wall)))\nLow => SampleTexture(brick, Rep, (0, 0, 0, 0))\n",
    "Offset": HOUSE + "House => Extrude(house.height, SplitZ((Rel, 1, Comp(side: Wall)), (Rel, 1, Offset(-1.2, Comp(front: Facade, side: Wall)))))\n",
    "Jetty": HOUSE + "House => Extrude(house.height, SplitZ((Rel, 1, Comp(side: Wall)), (Rel, 1, Jetty(0.7, Comp(front: Facade, side: Wall, roof: Roof(gable_front, 50 deg, 0.3, tile, Wall))))))\n",
    "LeanTo": HOUSE + "House => Extrude(house.height, SplitZ((Rel, 1, Comp(side: Wall)), (Rel, 1.3, LeanTo(1.8, 1.2, lead, Comp(front: Wall, side: Wall, roof: Roof(gable, 45 deg, 0.2, tile, Wall))))))\n",
    "Tower": HOUSE + "House => Layer(Extrude(house.height, Comp(front: Facade, side: Wall, roof: Roof(gable, 45 deg, 0.3, tile, Wall))), Tower(3.4, 10, Comp(side: Wall, roof: Roof(pyramid, 66 deg, 0.2, slate, Wall))))\n",
    "Turrets": HOUSE + "House => Layer(Extrude(house.height, Comp(front: Facade, side: Wall)), Turrets(2, 7.4, Comp(side: Wall, roof: Roof(pyramid, 60 deg, 0.2, slate, Wall))))\n",
    "Chimney": HOUSE + "House => Extrude(house.height, Comp(front: Facade, side: Wall, roof: Layer(Roof(gable, 38 deg, 0.4, tile, Wall), Chimney(1, 0.7, 1.4, brick))))\n",
    "Dormer": HOUSE + "House => Extrude(house.height, Comp(front: Facade, side: Wall, roof: Layer(Roof(gable, 45 deg, 0.4, tile, Wall), Dormer(1.2, 1.4, 2.8, slate, Face))))\nFace => Layer(Wall, AttachScope(panel, 0.02, 40, 60, \"window-casement\"))\n",
    "Roof gable": roof("gable"), "Roof gable_front": roof("gable_front"), "Roof hip": roof("hip"), "Roof half_hip": roof("half_hip", "45 deg"),
    "Roof gambrel": roof("gambrel", "30 deg"), "Roof mansard": roof("mansard", "25 deg"), "Roof shed": roof("shed", "24 deg"),
    "Roof pyramid": roof("pyramid"), "Roof flat": roof("flat", "0", "0.9"), "Roof dome": roof("dome", "40 deg", "0"),
    "steps": gable("steps"), "bell": gable("bell"),
}

STREET = ["timber frame", "Dutch brick", "plaster of the 19th century", "limestone", "medieval stone", "Levantine stone",
          "church", "town wall", "keep"]


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(a) for a in arguments[:2])}: {(done.stderr + done.stdout)[:600]}")
    if "error" in done.stderr:
        sys.exit(done.stderr[-600:])


def without_metadata(jpeg: bytes) -> bytes:
    """The same picture without APPn and COM segments but JFIF's own."""
    out, at = bytearray(jpeg[:2]), 2
    while jpeg[at + 1] != 0xDA:
        length = 2 + int.from_bytes(jpeg[at + 2:at + 4], "big")
        if not (0xE1 <= jpeg[at + 1] <= 0xEF or jpeg[at + 1] == 0xFE):
            out += jpeg[at:at + length]
        at += length
    return bytes(out + jpeg[at:])


def font() -> str:
    """DejaVu Sans, which the window's words are written in, too."""
    for folder in ("/usr/share/fonts", "/usr/local/share/fonts"):
        for file in pathlib.Path(folder).rglob("DejaVuSans.ttf"):
            return str(file)
    sys.exit("DejaVuSans.ttf is missing (fonts-dejavu-core)")


def sheet(pictures, columns, width, target):
    """Lays (file, label) beside each other; `width` pixels each."""
    rows = -(-len(pictures) // columns)
    labelled = []
    for file, label in pictures:
        out = file.with_name("l-" + file.name)
        run("oiiotool", file, "--resize", f"{width}x0", "--fill:color=0.1,0.1,0.11", f"{width}x22+0+0",
            f"--text:x=6:y=16:size=14:font={font()}:color=0.95,0.93,0.88", label, "-d", "uint8", "-o", out)
        labelled.append(out)
    joined = labelled[0].with_name("sheet.jpg")
    run("oiiotool", *labelled, "--mosaic:pad=3", f"{columns}x{rows}", "--quality", "80", "-o", joined)
    target.write_bytes(without_metadata(joined.read_bytes()))


def houses(vicus, folder, rules, height, views, name):
    """One house for each text of rules, drawn from `views(k, x)`; gives (file, label)."""
    features, styles, wanted = [], [], []
    for k, (label, text) in enumerate(rules.items()):
        x = 60.0 * k
        depth = 5.0 if height < 5 else 8.0
        ring = [[x, 0], [x + 6.2, 0], [x + 6.2, depth], [x, depth], [x, 0]] if height < 5 else \
            [[x, 0], [x + 9, 0], [x + 9, 7], [x, 7], [x, 0]]
        features.append({"type": "Feature", "properties": {"height": height, "k": f"k{k}"},
                         "geometry": {"type": "Polygon", "coordinates": [ring]}})
        (folder / f"k{k}.rules").write_text(text)
        styles.append(f'\n[[styles]]\nwhere = [{{ attribute = "k", equals = "k{k}" }}]\nrules = "k{k}.rules"\n')
        wanted.append(views(x))
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2154"}}
    (folder / f"{name}.geojson").write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    scene = f'[[sources]]\nfile = "{name}.geojson"\nheight_column = "height"\n' + "".join(styles)
    for k, (dx, dy, z, heading, pitch) in enumerate(wanted):
        scene += f'\n[[views]]\nname = "v{k}"\nposition = [{dx}, {dy}]\nabove_ground = {z}\nheading = {heading}\npitch = {pitch}\n'
    # All views in one tour that jumps, so that the town is opened once.
    keys = "".join(f"[[tours.keys]]\ntime = {k}\nposition = [{v[0]}, {v[1]}]\nabove_ground = {v[2]}\nheading = {v[3]}\npitch = {v[4]}\n"
                   for k, v in enumerate(wanted))
    scene += f'\n[[tours]]\nname = "all"\njumps = true\n{keys}\n[environment]\nsun_azimuth = 215.0\nsun_elevation = 40.0\n'
    (folder / f"{name}.toml").write_text(scene)
    out = folder / name
    run(vicus, "walk", folder / f"{name}.toml", "--headless", "--no-cache", "--tour", "all", "--frames", len(wanted), "--every", 1, "--size", "400x300",
        "--set", "viewer.fov=40", "--out", out)
    files = sorted(out.glob("frame_*.png"))
    if len(files) != len(wanted):
        sys.exit(f"{name}: {len(files)} pictures, not {len(wanted)}")
    return list(zip(files, rules))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    vicus, target = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    root = pathlib.Path(__file__).resolve().parent.parent
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        walls = houses(vicus, folder, WALLS, 4.2, lambda x: (x + 0.2, -10.5, 2.9, 74, 1), "walls")
        sheet(walls, 7, 220, target / "operators-walls.jpg")
        volumes = houses(vicus, folder, VOLUMES, 5.4, lambda x: (x - 11, -19, 8.5, 56, -6), "volumes")
        sheet(volumes, 6, 256, target / "operators-volumes.jpg")
        street = []
        for view in STREET:
            out = folder / view.replace(" ", "-")
            run(vicus, "walk", root / "examples/styles.toml", "--headless", "--tour", view, "--frames", 1, "--size", "960x600", "--out", out)
            street.append((out / "frame_00000.png", view))
        sheet(street, 3, 520, target / "styles-street.jpg")


if __name__ == "__main__":
    main()
