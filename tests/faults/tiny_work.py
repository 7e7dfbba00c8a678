"""What is here: the design of a fraction of a second that the trials of failures and of damaged files work on, and what
its files say, times aside. What is not: what is done to them (try_faults.py, try_mutations.py)."""
import json
import re
import struct
import zlib

try:
    import h5py
except ImportError:
    h5py = None

DESIGN = """title = "tiny"
[cell]
width = "11 mm"
height = "11 mm"
[layout]
family = "square"
diameter = "3 mm"
rows = 1
columns = 1
[packing]
mean_diameter = "1.0 mm"
maximum_diameter = "1.9825 mm"
size_ratio = 3.0
solid_fraction = 0.719
[material]
horizon = 2.0
[loading]
until = "0.1 %"
transits = 3
[test]
size = "11 mm"
"""
SWEEP = """[sweep]
design = "d.toml"
replicates = 1
[each]
material.horizon = [2.0, 2.2]
"""
STUDY = """[study]
design = "d.toml"
algorithm = "GN_DIRECT_L"
maxeval = 3
replicates = 1
final_replicates = 1
[target]
plateau_stress = "0.2 MPa"
window = [0.0003, 0.0009]
[variables]
"layout.diameter" = ["2 mm", "4 mm"]
"""
CALIBRATE = """[calibrate]
design = "d.toml"
young_modulus = "1 GPa"
poisson_ratio = 0.2
tensile_strength = "0.5 MPa"
compressive_strength = "2 MPa"
maxeval = 3
replicates = 1
chart = false
tolerance = 0.5
"""
INPUTS = {"d.toml": DESIGN, "sweep.toml": SWEEP, "study.toml": STUDY, "calibrate.toml": CALIBRATE}

# What differs between two runs of the same work: times, and how the work was asked for.
TIMES = re.compile(
    r"seconds|performance|command|attempts|retries|peak_memory|steps_per|ns_per|date|written|host|pid|threads|workers")
MARK = b"\x89PFCRC1\n"


def make_inputs(folder):
    """Writes the designs and an empty folder `out`."""
    (folder / "out").mkdir(parents=True)
    for file, text in INPUTS.items():
        (folder / file).write_text(text)


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if not TIMES.search(key)}
    if isinstance(value, list):
        return [without_times(item) for item in value]
    return value


def is_whole(path):
    """Whether a file that proves itself does: HDF5 by its trailer, JSON by its brackets, HTML by its end, a journal by
    its lines."""
    content = path.read_bytes()
    if path.suffix == ".h5":
        if len(content) < 24 or content[-24:-16] != MARK:
            return False
        length, crc = struct.unpack("<QI", content[-16:-4])
        return length == len(content) - 24 and zlib.crc32(content[:-24]) == crc
    if path.suffix == ".html":
        return content.rstrip().endswith(b"</html>")
    if path.suffix == ".json":
        try:
            json.loads(content)
        except ValueError:
            return False
        return True
    if path.suffix == ".jsonl":  # a torn last line is allowed: it is cut off on opening
        return all(line[:8] == b"%08x" % zlib.crc32(line[9:]) for line in content.split(b"\n")[:-1])
    if path.suffix == ".png":
        return content[-8:] == b"IEND\xaeB`\x82"
    return True


def hdf5_content(path):
    if h5py is None:
        return "there"
    content = {}
    with h5py.File(path, "r") as file:
        def look(name, item):
            if isinstance(item, h5py.Dataset):
                content[name] = item[()].tobytes() if item.dtype.kind != "O" else None
            if name == "summary":
                content[name] = without_times(json.loads(item[()]))
        file.visititems(look)
    return content


def results(folder, left_out=()):
    """What the files of a folder say, times aside, by their names; those in `left_out` are not looked at."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or path.name.endswith(".lock") or name in left_out:
            continue
        if path.suffix == ".json":
            found[name] = without_times(json.loads(path.read_text()))
        elif path.suffix == ".csv":
            rows = [line.split(",") for line in path.read_text().splitlines()]
            keep = [k for k, cell in enumerate(rows[0] if rows else []) if not TIMES.search(cell)]
            found[name] = [[row[k] for k in keep if k < len(row)] for row in rows]
        elif path.suffix == ".jsonl":
            events = [without_times(json.loads(line[9:])) for line in path.read_text().splitlines()]
            found[name] = sorted(json.dumps(e, sort_keys=True) for e in events if e.get("event") == "evaluation")
        elif path.suffix == ".h5":
            found[name] = hdf5_content(path)
        elif path.suffix == ".html":  # a report holds times; what it shows is in the other files
            found[name] = is_whole(path)
        else:
            found[name] = path.read_bytes()
    return found
