#!/usr/bin/env python3
"""All benchmarks of docs/developer/performance.md, one JSON file.

    tests/benchmarks/run_all.py [--build build/release] [--output benchmarks.json] [--only parts,packing,stages,runs] [--long]

parts:   each part of a step alone, medians of five (bench_solver)
packing: packings of several sizes (bench_packing)
stages:  a fast crushing, timed at four stages (bench_stages)
runs:    runs as users make them (perfora evaluate); --long adds those of many minutes

Results are written after each part, so a run that is cut off keeps what it has; what an existing file holds is kept
unless it is measured again. About fifteen minutes on two cores; --long takes two hours more.
"""
import argparse
import json
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CELL_2X2 = ["cell.width=50 mm", "cell.height=50 mm", "layout.rows=2", "layout.columns=2"]
FOUR_TIMES = ["cell.width=300 mm", "cell.height=300 mm", "layout.rows=12", "layout.columns=12"]

# name: design, settings, strain, repetitions, long
RUNS = {
    "quick": ("quick.toml", [], 0.60, 3, False),
    "2x2 to 5 %": ("table1.toml", CELL_2X2, 0.05, 3, False),
    "2x2 to 60 %": ("table1.toml", CELL_2X2, 0.60, 1, True),
    "Table 1 to 0.5 %": ("table1.toml", [], 0.005, 1, False),
    "Table 1 to 5 %": ("table1.toml", [], 0.05, 1, True),
    "Table 1 to 60 %": ("table1.toml", [], 0.60, 1, True),
    "Table 1 with noise to 5 %": ("table1-perlin.toml", [], 0.05, 1, True),
    "Table 1 with noise to 60 %": ("table1-perlin.toml", [], 0.60, 1, True),
    "four times the area to 0.1 %": ("table1.toml", FOUR_TIMES, 0.001, 1, False),
    "Table 1, H = 1.5, to 0.2 %": ("table1.toml", ["material.horizon=1.5"], 0.002, 1, False),
    "Table 1, H = 2, to 0.2 %": ("table1.toml", ["material.horizon=2"], 0.002, 1, False),
}


def environment():
    environ = dict(os.environ)
    environ.setdefault("GOMP_SPINCOUNT", "2000")  # as the program sets it for itself
    return environ


def cpu_model():
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text()
        return re.search(r"model name\s*:\s*(.*)", text).group(1)
    except (OSError, AttributeError):
        return platform.processor() or platform.machine()


def google_benchmark(program, *options):
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([program, f"--benchmark_out={out.name}", "--benchmark_out_format=json", *options], check=True,
                       stdout=sys.stderr, env=environment())
        return json.load(open(out.name))["benchmarks"]


def find(record, key):
    """The first value of `key` anywhere in nested objects."""
    if isinstance(record, dict):
        if key in record:
            return record[key]
        for value in record.values():
            found = find(value, key)
            if found is not None:
                return found
    return None


def evaluate(build, design, settings, until, threads):
    with tempfile.TemporaryDirectory() as folder:
        command = [str(build / "perfora"), "evaluate", str(ROOT / "designs" / design), "--until", str(until), "--json",
                   "--quiet", "--threads", str(threads), "-o", f"{folder}/run.h5"]
        for setting in settings + ["output.frames=none"]:
            command += ["--set", setting]
        start, before = time.time(), os.times()
        record = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        after = os.times()
    keys = ["discs", "bonds_per_disc", "steps", "seconds", "steps_per_second", "ns_per_bond_step", "simd", "peak_memory",
            "first_peak_stress", "plateau_stress", "energy_residual"]
    row = {key: find(record, key) for key in keys}
    row["threads"] = threads
    row["wall_seconds_with_packing"] = time.time() - start
    row["cpu_seconds_with_packing"] = (after.children_user + after.children_system - before.children_user -
                                       before.children_system)
    return row


def whole_runs(build, long):
    results = {}
    for name, (design, settings, until, repetitions, is_long) in RUNS.items():
        if is_long and not long:
            continue
        for threads in ((1,) if name == "quick" else (1, 2)) if not is_long else (2,):
            rows = [evaluate(build, design, settings, until, threads) for _ in range(repetitions)]
            row = dict(rows[0], repetitions=repetitions)
            for key in ["seconds", "steps_per_second", "ns_per_bond_step", "wall_seconds_with_packing",
                        "cpu_seconds_with_packing"]:
                row[key] = statistics.median(r[key] for r in rows)
            results[f"{name}, {threads} thread" + ("s" if threads > 1 else "")] = row
            print(name, threads, json.dumps(row), file=sys.stderr)
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("benchmarks.json"))
    parser.add_argument("--only", default="parts,packing,stages,runs")
    parser.add_argument("--long", action="store_true")
    arguments = parser.parse_args()
    bench = arguments.build / "tests" / "benchmarks"
    parts = {
        "parts": lambda: google_benchmark(bench / "bench_solver", "--benchmark_repetitions=5",
                                          "--benchmark_report_aggregates_only=true", "--benchmark_min_time=0.3"),
        "packing": lambda: google_benchmark(bench / "bench_packing", "--benchmark_filter=:(10000|30000|90000)/"),
        "stages": lambda: [json.loads(subprocess.run([bench / "bench_stages", "2", str(threads)], check=True,
                                                     capture_output=True, text=True, env=environment()).stdout)
                           for threads in (1, 2)],
        "runs": lambda: whole_runs(arguments.build, arguments.long),
    }
    result = json.loads(arguments.output.read_text()) if arguments.output.exists() else {}
    result["machine"] = {"cpu": cpu_model(), "cores": os.cpu_count(),
                         "load_at_the_start": os.getloadavg()[0] if hasattr(os, "getloadavg") else None}
    for name in arguments.only.split(","):
        measured = parts[name]()
        if name == "runs":
            measured = {**result.get("runs", {}), **measured}
        result[name] = measured
        arguments.output.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
