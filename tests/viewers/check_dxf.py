#!/usr/bin/env python3
"""Opens drawings of `perfora draw` with ezdxf and compares the areas of the holes with closed forms.

usage: check_dxf.py PERFORA FOLDER

A drawing with one radius changed must be found out. Exit code 77 (CTest: skipped) where ezdxf is missing.
"""
import importlib.util
import math
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
# Name, keys of [layout], number of holes and the area of each in mm2.
DESIGNS = [
    ("circles", 'family = "square"\nrows = 2\ncolumns = 3\ndiameter = "12 mm"', 6, math.pi * 36),
    ("slots", 'family = "square"\nrows = 2\ncolumns = 2\nshape = "slot"\ndiameter = "20 mm"\nbreadth = "8 mm"\nangle = "30 deg"', 4,
     math.pi * 16 + 12 * 8),
    ("ellipses", 'family = "square"\nrows = 2\ncolumns = 2\nshape = "ellipse"\ndiameter = "20 mm"\naspect = 2.0', 4, math.pi * 50),
    ("diamonds", 'family = "square"\nrows = 1\ncolumns = 2\nshape = "diamond"\ndiameter = "20 mm"\nbreadth = "10 mm"', 2, 100.0),
]


def require(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


def area_of(entity):
    """mm2 inside a circle or a closed polyline with bulges: the shoelace and the segments of its arcs."""
    if entity.dxftype() == "CIRCLE":
        return math.pi * entity.dxf.radius ** 2
    require(entity.is_closed, "an open polyline")
    corners = [(vertex.dxf.location.x, vertex.dxf.location.y, vertex.dxf.get("bulge", 0.0)) for vertex in entity.vertices]
    area = 0.0
    for (x, y, bulge), (next_x, next_y, _) in zip(corners, corners[1:] + corners[:1]):
        area += 0.5 * (x * next_y - next_x * y)
        if bulge:
            angle, chord = 4 * math.atan(bulge), math.hypot(next_x - x, next_y - y)
            radius = chord / (2 * math.sin(angle / 2))
            area += 0.5 * radius ** 2 * (angle - math.sin(angle))
    return abs(area)


def check(file, holes, area):
    import ezdxf

    document = ezdxf.readfile(file)
    errors = document.audit().errors
    require(not errors, f"{file.name}: {[error.message for error in errors]}")
    space = document.modelspace()
    found = [area_of(entity) for entity in space.query('CIRCLE POLYLINE[layer=="HOLES"]')]
    require(len(found) == holes, f"{file.name}: {len(found)} holes, not {holes}")
    for one in found:
        require(abs(one - area) < 1e-3 * area, f"{file.name}: a hole of {one} mm2, not {area}")
    block = space.query('POLYLINE[layer=="BLOCK"]')
    require(len(block) == 1 and abs(area_of(block[0]) - 75 * 60) < 1e-6, f"{file.name}: no block of 75 x 60 mm")
    texts = [entity.dxf.text for entity in space.query("TEXT")]
    for wanted in ("75", "60", "direction of loading"):
        require(wanted in texts, f"{file.name}: does not say {wanted}: {texts}")


def main():
    if importlib.util.find_spec("ezdxf") is None:
        print("SKIPPED: not installed: ezdxf")
        sys.exit(SKIPPED)
    perfora, folder = sys.argv[1], Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, layout, holes, area in DESIGNS:
        (folder / f"{name}.toml").write_text(f'[cell]\nwidth = "75 mm"\nheight = "60 mm"\n[layout]\n{layout}\n')
        subprocess.run([perfora, "draw", f"{name}.toml", "-o", f"{name}.dxf", "--quiet"], cwd=folder, check=True, timeout=60)
        check(folder / f"{name}.dxf", holes, area)
    good = folder / "circles.dxf"
    text = good.read_text()
    bad = text.replace(" 40\n6\n", " 40\n6.1\n", 1)
    require(bad != text, "nothing was changed")
    good.write_text(bad)
    try:
        check(good, *DESIGNS[0][2:])
    except SystemExit:
        good.write_text(text)
        print(f"passed: {len(DESIGNS)} drawings")
        return
    sys.exit("FAILED: a wrong drawing passed")


if __name__ == "__main__":
    main()
