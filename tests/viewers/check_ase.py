#!/usr/bin/env python3
"""Opens an exported LAMMPS dump and an extended XYZ file with ase and compares them with R.h5 as h5py reads it.

usage: check_ase.py WRITE_SYNTHETIC FOLDER   writes R.h5, R.dump and R.xyz into FOLDER first

A file in which one place, one radius or one edge of the cell is another, or in which a frame is missing, must be found
out. Exit code 77 (CTest: skipped) where ase or h5py is missing.
"""
import importlib.util
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def require(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


def expected(run_file):
    import h5py

    frames = []
    with h5py.File(run_file, "r") as file:
        radius = file["clipped/radius"][:]
        for name in sorted(file["frames"]):
            frame = file["frames"][name]
            frames.append({"position": frame["discs/position"][:], "cell": (frame.attrs["h_xx"], frame.attrs["h_yy"]),
                           "strain": frame.attrs["strain"], "radius": radius, "fragment": frame["discs/fragment"][:],
                           "damage": frame["discs/damage"][:]})
    return sorted(frames, key=lambda frame: frame["strain"])


def check(file, frames, kind):
    import ase.io
    import numpy

    images = ase.io.read(file, index=":", format=kind)
    require(len(images) == len(frames), f"{file.name}: {len(images)} frames, not {len(frames)}")
    for image, frame in zip(images, frames):
        where = f"{file.name}, strain {frame['strain']}"
        require(len(image) == len(frame["radius"]), f"{where}: {len(image)} atoms, not {len(frame['radius'])}")
        cell = image.get_cell()
        require(numpy.allclose([cell[0][0], cell[1][1], cell[1][0]], [*frame["cell"], 0.0], rtol=1e-9, atol=0),
                f"{where}: cell {cell}")
        require(list(image.pbc[:2]) == [True, True], f"{where}: periodic {image.pbc}")
        require(numpy.allclose(image.positions[:, :2], frame["position"], rtol=0, atol=1e-12), f"{where}: places")
        if kind == "extxyz":
            require(abs(image.info["strain"] - frame["strain"]) < 1e-12, f"{where}: strain {image.info['strain']}")
            for name in ("radius", "damage", "fragment"):
                require(numpy.allclose(image.arrays[name], frame[name], rtol=1e-9, atol=1e-15), f"{where}: {name}")


def require_found_out(file, frames, kind, change):
    good = file.read_text()
    bad = change(good)
    require(bad != good, f"{file.name}: nothing was changed")
    file.write_text(bad)
    try:
        check(file, frames, kind)
    except (SystemExit, ValueError, KeyError, IndexError):
        return
    finally:
        file.write_text(good)
    sys.exit(f"FAILED: {file.name}: a wrong file passed")


def other_word(line, word):
    """Adds one per mille to a number of line `line` (from 0)."""
    def change(text):
        lines = text.split("\n")
        words = lines[line].split(" ")
        words[word] = repr(float(words[word]) * 1.001 + 1e-6)
        lines[line] = " ".join(words)
        return "\n".join(lines)
    return change


def main():
    missing = [name for name in ("ase", "h5py") if importlib.util.find_spec(name) is None]
    if missing:
        print("SKIPPED: not installed: " + ", ".join(missing))
        sys.exit(SKIPPED)
    folder = Path(sys.argv[2])
    subprocess.run([sys.argv[1], str(folder)], check=True)
    frames = expected(folder / "R.h5")
    dump, xyz = folder / "R.dump", folder / "R.xyz"
    check(dump, frames, "lammps-dump-text")
    check(xyz, frames, "extxyz")
    atoms = 13  # of the first frame, behind UNITS, TIME, TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS
    require_found_out(dump, frames, "lammps-dump-text", other_word(atoms + 4, 2))
    require_found_out(dump, frames, "lammps-dump-text", other_word(9, 1))
    require_found_out(dump, frames, "lammps-dump-text", lambda text: text[:text.rindex("ITEM: TIME\n")])
    require_found_out(xyz, frames, "extxyz", other_word(6, 1))
    require_found_out(xyz, frames, "extxyz", other_word(6, 4))
    print(f"passed: {len(frames)} frames of {len(frames[0]['radius'])} discs, in a dump and in XYZ")


if __name__ == "__main__":
    main()
