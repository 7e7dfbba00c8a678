#!/usr/bin/env python3
"""What loading rate, time step and mass scaling do to the answer and to its cost.

Runs Table 1's pattern to 60 % strain in several ways and with several seeds: periodic cells of 2 x 2 and 1 x 1 holes at
full resolution (2x2-peak and 1x1-peak: the same up to 2 % strain), and 2 x 2 holes with discs twice as large (quick). Appends one line a run to
loading-rate.csv; lines that are there are not run again, so it can be stopped and gone on with at any time.

    docs/data/loading_rate.py run [--program build/release/perfora] [--seeds 1-5] [--jobs 2] [--ways default,half_rate]
                                  [--cells 2x2,1x1]
    docs/data/loading_rate.py table

`table` prints the means with their standard errors and, below each way, the paired difference to `default` (same
packings) with its standard error, both in per cent of the default's mean.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import threading

HERE = pathlib.Path(__file__).resolve().parent
CSV = HERE / "loading-rate.csv"
DESIGNS = HERE.parent.parent / "designs"
CELLS = {
    "quick": ["quick.toml"],
    "2x2": ["table1.toml", "cell.width=50 mm", "cell.height=50 mm", "layout.rows=2", "layout.columns=2"],
    "1x1": ["table1.toml", "cell.width=25 mm", "cell.height=25 mm", "layout.rows=1", "layout.columns=1"],
}
for name in ("2x2", "1x1"):  # only the first peak: a thirtieth of the time
    CELLS[name + "-peak"] = CELLS[name] + ["loading.until=0.02"]
WAYS = {
    "default": [],
    "constant": ["loading.control=constant"],
    "half_rate": ["loading.transits=50"],
    # Contacts limit the default step to 0.58 of the critical one: this is half of that.
    "half_step": ["dynamics.step_factor=0.29"],
    "physical_mass": ["dynamics.mass=physical"],
    "constant_half_rate": ["loading.control=constant", "loading.transits=50"],
}
MEASURES = ["first_peak_stress", "first_peak_strain", "plateau_stress", "energy_absorbed", "broken_bonds",
            "densification_strain"]
OTHERS = ["transits_before_peak", "kinetic_ratio_at_peak", "cundall_share", "max_overlap_in_run", "energy_residual",
          "time_step", "rate", "smallest_rate", "largest_rate", "steps"]
COLUMNS = ["cell", "way", "seed", "status"] + MEASURES + OTHERS + ["cpu_seconds", "wall_seconds", "git_revision"]
lock = threading.Lock()


def rows():
    if not CSV.exists():
        return []
    with CSV.open() as file:
        return list(csv.DictReader(file))


def run_one(program, cell, way, seed):
    design, *settings = CELLS[cell]
    settings += WAYS[way] + [f"seeds.seed={seed}", "output.frames=none"]
    command = [program, "evaluate", str(DESIGNS / design), "-o", f"/tmp/loading-rate-{os.getpid()}-{cell}-{way}-{seed}.h5",
               "--threads", "1", "--quiet", "--json", "--force"]
    for setting in settings:
        command += ["--set", setting]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    record = json.loads(process.stdout.read())
    _, _, usage = os.wait4(process.pid, 0)
    summary = record["summary"] if "summary" in record else record
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.split()
    line = {"cell": cell, "way": way, "seed": seed, "status": record["status"],
            "cpu_seconds": round(usage.ru_utime + usage.ru_stime, 1),
            "wall_seconds": round(record["performance"]["seconds"], 1), "git_revision": version[-1].strip("()")}
    line.update({name: summary[name] for name in MEASURES + OTHERS})
    with lock:
        fresh = not CSV.exists()
        with CSV.open("a", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            if fresh:
                writer.writeheader()
            writer.writerow(line)
    print(cell, way, seed, line["steps"], line["cpu_seconds"], flush=True)


def run(arguments):
    first, _, last = arguments.seeds.partition("-")
    done = {(r["cell"], r["way"], int(r["seed"])) for r in rows()}
    wanted = [(cell, way, seed) for seed in range(int(first), int(last or first) + 1)
              for cell in arguments.cells.split(",") for way in arguments.ways.split(",")]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for future in [pool.submit(run_one, arguments.program, *case) for case in wanted if case not in done]:
            future.result()


def mean_and_error(values):
    if not values:
        return math.nan, math.nan
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def table(_):
    data = rows()
    for cell in CELLS:
        for way in WAYS:
            here = {int(r["seed"]): r for r in data if r["cell"] == cell and r["way"] == way}
            there = {int(r["seed"]): r for r in data if r["cell"] == cell and r["way"] == "default"}
            if not here:
                continue
            print(f"{cell} {way}, {len(here)} seeds")
            for name in MEASURES + ["energy_residual", "max_overlap_in_run", "transits_before_peak", "steps",
                                    "cpu_seconds"]:
                numbers = {seed: float(r[name]) for seed, r in here.items() if r[name]}
                mean, error = mean_and_error(list(numbers.values()))
                text = f"  {name:22s} {mean:12.5g} +- {error:.2g}"
                base = {seed: float(there[seed][name]) for seed in numbers if seed in there and there[seed][name]}
                if way != "default" and base:
                    scale = 100.0 / statistics.fmean(base.values())
                    change, spread = mean_and_error([scale * (numbers[seed] - base[seed]) for seed in base])
                    text += f"   change {change:+.1f} % +- {spread:.1f} %"
                print(text)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
commands = parser.add_subparsers(required=True)
runner = commands.add_parser("run")
runner.add_argument("--program", default=str(HERE.parent.parent / "build/release/perfora"))
runner.add_argument("--seeds", default="1-5")
runner.add_argument("--jobs", type=int, default=1)
runner.add_argument("--cells", default=",".join(CELLS))
runner.add_argument("--ways", default=",".join(WAYS))
runner.set_defaults(do=run)
commands.add_parser("table").set_defaults(do=table)
chosen = parser.parse_args()
chosen.do(chosen)
