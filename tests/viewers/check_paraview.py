#!/usr/bin/env python3
"""Opens an R.xdmf and an R.pvd in ParaView and compares what it shows with R.h5 as h5py reads it; draws discs by their
radii with the recipe of the documentation and compares the coloured area with that of the discs.

usage: check_paraview.py WRITE_SYNTHETIC FOLDER    writes R.h5, R.xdmf and R.pvd into FOLDER first; also checks that files
                                                   which say something else are found out
       check_paraview.py R.xdmf|R.pvd              checks a file that exists, R.h5 beside it

Exit code 77 (CTest: skipped) where pvbatch or h5py is missing.
"""
import importlib.util
import json
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def look():
    """Runs inside pvbatch: prints, for each reader, what it sees, as one JSON line."""
    from paraview import servermanager
    from paraview.simple import OpenDataFile, XDMFReader
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

    def leaves(data, name=None):
        if not data.IsA("vtkMultiBlockDataSet") and not data.IsA("vtkMultiPieceDataSet"):
            return [(name, data)]
        found = []
        pieces = data.IsA("vtkMultiPieceDataSet")
        for k in range(data.GetNumberOfPieces() if pieces else data.GetNumberOfBlocks()):
            block = data.GetPieceAsDataObject(k) if pieces else data.GetBlock(k)
            label = data.GetMetaData(k).Get(vtkCompositeDataSet.NAME()) if data.HasMetaData(k) else None
            if block is not None:
                found += leaves(block, label)
        return found

    def arrays(fields):
        ranges = {}
        for k in range(fields.GetNumberOfArrays()):
            ranges[fields.GetArrayName(k)] = list(fields.GetArray(k).GetRange())
        return ranges

    def report(reader):
        reader.UpdatePipeline()
        steps = []
        for time in list(reader.TimestepValues):
            reader.UpdatePipeline(time)
            grids = []
            for name, grid in leaves(servermanager.Fetch(reader)):
                grids.append({"name": name, "points": grid.GetNumberOfPoints(), "cells": grid.GetNumberOfCells(),
                              "bounds": list(grid.GetBounds()), "point_arrays": arrays(grid.GetPointData()),
                              "cell_arrays": arrays(grid.GetCellData())})
            steps.append({"time": time, "grids": grids})
        return steps

    path = sys.argv[-1]
    seen = {"default": report(OpenDataFile(path))}
    if path.endswith(".xdmf"):
        seen["XDMFReader"] = report(XDMFReader(FileNames=[path]))
    print("LOOK " + json.dumps(seen))


def expected(run_file):
    """The same numbers from R.h5 itself, bonds across the periodic boundary left out."""
    import h5py
    import numpy

    steps = []
    with h5py.File(run_file, "r") as file:
        radius = file["clipped/radius"][:]
        for name in sorted(file["frames"]):
            frame = file["frames"][name]
            position, pairs = frame["discs/position"][:], frame["bonds/pairs"][:].reshape(-1, 2)
            cell = numpy.array([frame.attrs["h_xx"], frame.attrs["h_yy"]])
            inside = (numpy.abs(position[pairs[:, 0]] - position[pairs[:, 1]]) < cell / 2).all(axis=1)
            steps.append({"time": frame.attrs["time"], "discs": len(radius), "bonds": int(inside.sum()),
                          "bounds": [*position.min(axis=0), *position.max(axis=0)], "strain": frame.attrs["strain"],
                          "radius": [radius.min(), radius.max()],
                          "fragment": [frame["discs/fragment"][:].min(), frame["discs/fragment"][:].max()],
                          "damage": [frame["discs/damage"][:].min(), frame["discs/damage"][:].max()],
                          "angle": [frame["discs/angle"][:].min(), frame["discs/angle"][:].max()],
                          "cell": [0.0, cell[0], 0.0, cell[1]]})
    return sorted(steps, key=lambda step: step["strain"])


def require(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


def close(a, b):
    return all(abs(x - y) <= 1e-9 * max(1.0, abs(y)) for x, y in zip(a, b))


def compare(reader, seen, wanted):
    require(len(seen) == len(wanted), f"{reader}: {len(seen)} time steps, not {len(wanted)}")
    for step, want in zip(seen, wanted):
        where = f"{reader}, time {want['time']}"
        require(close([step["time"]], [want["time"]]), f"{where}: time {step['time']}")
        if want["bonds"] == 0 and len(step["grids"]) == 2:  # a reader may leave a grid without cells out
            step["grids"].insert(1, {"name": "bonds", "points": 0, "cells": 0, "cell_arrays": {}})
        require(len(step["grids"]) == 3, f"{where}: {len(step['grids'])} grids, not 3")
        discs, bonds, cell = step["grids"]
        if reader == "XDMFReader":
            names = [grid["name"] for grid in step["grids"]]
            require(names == ["discs", "bonds", "cell"], f"{where}: blocks {names}")
        require(discs["points"] == discs["cells"] == want["discs"], f"{where}: {discs['cells']} discs, not {want['discs']}")
        require(bonds["cells"] == want["bonds"], f"{where}: {bonds['cells']} bonds, not {want['bonds']}")
        x_low, x_high, y_low, y_high = discs["bounds"][:4]
        require(close([x_low, y_low, x_high, y_high], want["bounds"]), f"{where}: discs within {discs['bounds']}")
        require(close(cell["bounds"][:4], want["cell"]), f"{where}: cell {cell['bounds']}")
        for name in ("radius", "angle", "fragment", "damage"):
            require(close(discs["point_arrays"].get(name, [1e99] * 2), want[name]), f"{where}: array {name} of the discs")
        require(want["bonds"] == 0 or "damage" in bonds["cell_arrays"], f"{where}: array damage of the bonds")
        require(close(cell["cell_arrays"]["strain"], [want["strain"]] * 2), f"{where}: strain")


def look_at(file):
    """What each reader of pvbatch shows of a file."""
    run = subprocess.run(["pvbatch", "--force-offscreen-rendering", __file__, "--look", str(file.resolve())],
                         capture_output=True, text=True, timeout=240)
    lines = [line for line in run.stdout.splitlines() if line.startswith("LOOK ")]
    require(lines, f"pvbatch printed no result (exit code {run.returncode}):\n{run.stdout}\n{run.stderr}")
    return json.loads(lines[0][5:])


def check(file, wanted):
    for reader, seen in look_at(file).items():
        compare(f"{file.name}: {reader}", seen, wanted)


def require_found_out(file, wanted, change):
    """A file that says something else must not pass."""
    good = file.read_bytes()
    bad = change(good)
    require(bad != good, f"{file.name}: nothing was changed")
    file.write_bytes(bad)
    try:
        check(file, wanted)
    except SystemExit:
        return
    finally:
        file.write_bytes(good)
    sys.exit(f"FAILED: {file.name}: a wrong file passed")


def check_discs_drawn(pvd, run_file):
    """The recipe of docs/user/exports.md: coloured area of the picture over that of the block against that of the discs."""
    import h5py
    import numpy
    from PIL import Image

    recipe = Path(__file__).resolve().parents[2] / "docs/user/paraview-discs.py"
    picture = pvd.with_suffix(".png")
    # Debian's ParaView draws into a window only.
    # On a busy machine its X server may not be there in time: that is no fault of the file, so it is tried again.
    for attempt in range(3):
        drawn = subprocess.run(["xvfb-run", "-a", "pvbatch", str(recipe), str(pvd.resolve()), str(picture.resolve())],
                               timeout=240, capture_output=True, text=True)
        if drawn.returncode == 0:
            break
        print(f"attempt {attempt + 1}: exit code {drawn.returncode}: {drawn.stderr[-500:]}")
    require(drawn.returncode == 0, "pvbatch did not draw the recipe")
    pixels = numpy.asarray(Image.open(picture).convert("RGB")).astype(int)
    drawn = (abs(pixels - 255).max(axis=2) > 20)
    with h5py.File(run_file, "r") as file:
        radius, first = file["clipped/radius"][:], file["frames/00000"]
        block, positions = (first.attrs["h_xx"], first.attrs["h_yy"]), first["discs/position"][:]
    rows, columns = numpy.nonzero(drawn)
    box = (columns.max() - columns.min() + 1) * (rows.max() - rows.min() + 1)
    spans = [(positions[:, k] + radius).max() - (positions[:, k] - radius).min() for k in range(2)]
    share, wanted = drawn.sum() / box, numpy.pi * (radius ** 2).sum() / (spans[0] * spans[1])
    # A pixel at a rim counts whole, which adds some per cent; a diameter taken for a radius would add 300 %.
    require(abs(share - wanted) < 0.1 * wanted, f"discs cover {share:.4f} of their box in the picture, not {wanted:.4f}")
    return share


def main():
    missing = [name for name in ("h5py", "PIL") if importlib.util.find_spec(name) is None]
    missing += [f"{name} ({package})" for name, package in (("pvbatch", "python3-paraview"), ("xvfb-run", "xvfb"))
                if shutil.which(name) is None]
    if missing:
        print("SKIPPED: not installed: " + ", ".join(missing))
        sys.exit(SKIPPED)
    if len(sys.argv) == 2:
        file = Path(sys.argv[1])
        check(file, expected(file.with_suffix(".h5")))
        print("passed")
        return
    folder = Path(sys.argv[2])
    subprocess.run([sys.argv[1], sys.argv[2]], check=True)
    wanted = expected(folder / "R.h5")
    for name in ("R.xdmf", "R.pvd"):
        check(folder / name, wanted)
    require_found_out(folder / "R.xdmf", wanted, lambda text: text.replace(b'<Time Value="0"/>', b'<Time Value="0.25"/>'))
    require_found_out(folder / "R.pvd", wanted, lambda text: text.replace(b'00000-discs.vtp', b'00001-discs.vtp', 1))
    share = check_discs_drawn(folder / "R.pvd", folder / "R.h5")
    print(f"passed: {len(wanted)} time steps, {wanted[0]['discs']} discs, {wanted[0]['bonds']} bonds in the first, "
          f"three readers; discs drawn cover {100 * share:.1f} % of their box")


if __name__ == "__main__":
    look() if "--look" in sys.argv else main()
