#!/usr/bin/env python3
"""Runs an exported LAMMPS data file in Debian's LAMMPS and compares stiffness and displacements with perfora's.

usage: check_lammps.py PERFORA DESIGN FOLDER

The network of the design, with a tangential stiffness of a twenty millionth of the normal one, is strained by 1e-6 along
x, along y and in shear, both ways, and minimised with harmonic bonds. Every modulus and contraction must agree with
`perfora evaluate --elastic` within 0.1 %, every entry of the stiffness within 0.1 % of the largest, displacements of every disc within 0.1 % of the farthest. A data file with one
bond less, or with all bonds twice as stiff, must be found out. Exit code 77 (CTest: skipped) where lmp or h5py is missing.
"""
import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
STRAIN = 1e-6
WITHIN = 1e-3

# special_bonds 1 1 1: no list of second and third neighbours, which would be far too long. pair_style zero only sets how
# far LAMMPS looks for the other ends of bonds.
SCRIPT = """
units si
dimension 2
boundary p p p
atom_style hybrid bond sphere
atom_modify map array
special_bonds lj/coul 1 1 1
pair_style zero {reach} nocoeff
bond_style harmonic
read_data {data}
pair_coeff * *
comm_modify cutoff {reach}
neighbor {skin} bin
change_box all triclinic
compute virial all pressure NULL virial
thermo_style custom step c_virial[1] c_virial[2] c_virial[4]
variable sxx equal c_virial[1]
variable syy equal c_virial[2]
variable sxy equal c_virial[4]
fix plane all enforce2d
change_box all {change} remap units box
min_style fire
timestep 1e-8
min_modify dmax 1e-5 tmax 4
minimize 0.0 {force} 20000 40000
run 0 post no
print "STRESS $(v_sxx:%20.15e) $(v_syy:%20.15e) $(v_sxy:%20.15e)"
write_dump all custom {dump} id x y modify sort id format float %20.15e
"""


def require(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


def strained(folder, data, change, name):
    """Stress (tension positive, Pa) and places of all discs in equilibrium."""
    import numpy

    text = data.read_text()
    reach = 1.5 * max(float(line.split()[2]) for line in re.search(r"Bond Coeffs.*?\n\n(.*?)\n\n", text, re.S).group(1).splitlines())
    dump = folder / f"{name}.dump"
    script = folder / f"{name}.in"
    script.write_text(SCRIPT.format(data=data.name, change=change, dump=dump.name, reach=reach, skin=0.1 * reach, force=1e-6))
    run = subprocess.run(["lmp", "-in", script.name, "-log", f"{name}.log"], cwd=folder, capture_output=True, text=True, timeout=280)
    stress = re.findall(r"^STRESS (\S+) (\S+) (\S+)$", run.stdout, re.M)
    require(len(stress) == 1, f"lmp gave no stress (exit code {run.returncode}):\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
    places = numpy.loadtxt(dump, skiprows=9)[:, 1:3]
    return -numpy.array([float(value) for value in stress[0]]), places


def response(folder, data, width, height):
    """Stiffness (3,3) and displacements beyond the affine ones (3, discs, 2) per unit strain, by central differences."""
    import numpy

    cases = {"xx": lambda e: f"x final 0 {width * (1 + e):.17g}", "yy": lambda e: f"y final 0 {height * (1 + e):.17g}",
             "xy": lambda e: f"xy final {height * e:.17g}"}
    stiffness, displacement = numpy.zeros((3, 3)), []
    for column, (name, change) in enumerate(cases.items()):
        ends = []
        for sign in (1, -1):
            stress, places = strained(folder, data, change(sign * STRAIN), f"{name}{'+' if sign > 0 else '-'}")
            # Back to the undeformed cell: what is left is the displacement beyond the affine one.
            strain = sign * STRAIN
            if name == "xx":
                places[:, 0] /= 1 + strain
            elif name == "yy":
                places[:, 1] /= 1 + strain
            else:
                places[:, 0] -= strain * places[:, 1]
            ends.append((stress, places))
        stiffness[:, column] = (ends[0][0] - ends[1][0]) / (2 * STRAIN)
        moved = ends[0][1] - ends[1][1]
        cell = numpy.array([width, height])
        moved -= cell * numpy.round(moved / cell)
        moved /= 2 * STRAIN
        # Shear is applied as u_x = strain y, perfora's as half of it in both directions: the same but for a turn of the
        # whole, which strains nothing.
        if name == "xy":  # a disc may have left by the top, one tilt of the cell to the side: whole tilts are no motion
            moved[:, 0] -= height * numpy.round((moved[:, 0] - numpy.median(moved[:, 0])) / height)
        displacement.append(moved - moved.mean(axis=0))
    return stiffness, displacement


def moduli(stiffness):
    """E_x, E_y, shear modulus and both contractions."""
    import numpy

    compliance = numpy.linalg.inv(stiffness)
    return numpy.array([1 / compliance[0, 0], 1 / compliance[1, 1], 1 / compliance[2, 2],
                        -compliance[1, 0] / compliance[0, 0], -compliance[0, 1] / compliance[1, 1]])


def check(folder, data, elastic):
    import h5py
    import numpy

    with h5py.File(elastic, "r") as file:
        wanted = file["stiffness"][:].reshape(3, 3)
        width, height = file["clipped"].attrs["width"], file["clipped"].attrs["height"]
        places = numpy.stack([file["clipped/x"][:], file["clipped/y"][:]], axis=1)
        moved = [file[f"displacement/{name}"][:].reshape(-1, 3)[:, :2] for name in ("xx", "yy", "xy")]
    stiffness, displacement = response(folder, data, width, height)
    off = max(abs(moduli(stiffness) / moduli(wanted) - 1))
    off = max(off, abs(stiffness - wanted).max() / abs(wanted).max())
    require(off < WITHIN, f"stiffness\n{stiffness}\nin LAMMPS\n{wanted}\nin perfora: {100 * off:.3g} % apart")
    farthest = 0.0
    for name, found, own in zip(("xx", "yy", "xy"), displacement, moved):
        own = own - own.mean(axis=0)
        require(len(found) == len(places), f"{len(found)} discs in LAMMPS, not {len(places)}")
        apart = abs(found - own).max() / abs(own).max()
        farthest = max(farthest, apart)
        require(apart < WITHIN, f"strain {name}: displacements are {100 * apart:.3g} % apart")
    return off, farthest


def require_found_out(folder, data, elastic, name, change):
    bad = folder / f"{name}.data"
    text = data.read_text()
    changed = change(text)
    require(changed != text, f"{name}: nothing was changed")
    bad.write_text(changed)
    try:
        check(folder, bad, elastic)
    except SystemExit:
        return
    sys.exit(f"FAILED: {name}: a wrong data file passed")


def twice_as_stiff(text):
    head, coefficients, rest = re.split(r"(Bond Coeffs.*?\n\n.*?\n\n)", text, maxsplit=1, flags=re.S)
    return head + re.sub(r"^(\d+) (\S+) ", lambda m: f"{m[1]} {2 * float(m[2]):.17g} ", coefficients, flags=re.M) + rest


def one_end_elsewhere(text):
    """Ten bonds end at another disc."""
    head, bonds = text.split("\nBonds\n\n")
    lines = bonds.splitlines()
    for k in range(10):
        number, kind, i, j = lines[k].split()
        lines[k] = f"{number} {kind} {i} {int(j) + 1}"
    return head + "\nBonds\n\n" + "\n".join(lines) + "\n"


def main():
    missing = [name for name in ("h5py", "numpy") if importlib.util.find_spec(name) is None]
    if shutil.which("lmp") is None:
        missing.append("lmp (lammps)")
    if missing:
        print("SKIPPED: not installed: " + ", ".join(missing))
        sys.exit(SKIPPED)
    perfora, design, folder = sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    central = ["--set", "material.tangential_stiffness=1", "--quiet", "--threads", "1"]
    for command in (["pack", design, "-o", "P.h5", *central],
                    ["evaluate", design, "--packing", "P.h5", "--until", "1e-4", "-o", "R.h5", *central],
                    ["evaluate", design, "--packing", "P.h5", "--elastic", "-o", "E.h5", *central],
                    ["export", "R.h5", "--lammps-data", "-o", "R", "--quiet"]):
        subprocess.run([perfora, *map(str, command)], cwd=folder, check=True, stdout=subprocess.DEVNULL, timeout=200)
    off, farthest = check(folder, folder / "R.data", folder / "E.h5")
    require_found_out(folder, folder / "R.data", folder / "E.h5", "stiff", twice_as_stiff)
    require_found_out(folder, folder / "R.data", folder / "E.h5", "ends", one_end_elsewhere)
    print(f"passed: stiffness within {100 * off:.2g} %, displacements within {100 * farthest:.2g} % of the farthest")


if __name__ == "__main__":
    main()
