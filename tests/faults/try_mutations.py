#!/usr/bin/env python3
"""Damages files and gives them to the program: flipped bits, cut ends, zeroed blocks, exchanged blocks.

usage: try_mutations.py PERFORA [--count N] [--seed S] [--only FORMAT]

A damaged file is refused (exit code 1, one sentence that names a file) or gives the result of the undamaged one to the
last bit. Never a crash, a hang or another result. Texts that people write (TOML, CSV, WKT) have no checksum: a changed
number there is another input; of these, crashes and hangs alone are looked for, as of result.json.
"""
import argparse
import collections
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tiny_work import make_inputs, results

CSV = "x,y,diameter\n0.003,0.003,0.004\n0.009,0.009,0.003\n"
WKT = "POLYGON ((-2 -1, 2 -1, 2 1, -2 1, -2 -1))\n"
LISTED = """[cell]
width = "12 mm"
height = "12 mm"
[layout]
family = "list"
file = "holes.csv"
"""
SHAPED = """[cell]
width = "12 mm"
height = "12 mm"
[layout]
rows = 1
columns = 1
diameter = "6 mm"
shape = "polygon"
outline = "hole.wkt"
"""

MADE = [
    "evaluate d.toml -o out/r.h5 --threads 1",
    "pack d.toml -o out/p.h5 --threads 1",
    "evaluate d.toml --elastic -o out/e.h5 --threads 1",
    "test d.toml -o out/t.h5 --threads 1",
    "sweep sweep.toml -o out/sweep --workers 1",
    "evaluate d.toml -o out/u.h5 --threads 1 --until 0.005 --set output.checkpoint_interval=0.001 --wall-time 0.0001",
]
# format: (files that are damaged, what is done with them, whether other results count; or the only ones that do)
FORMATS = {
    "run": ("out/r.h5", ["show out/r.h5 --json", "plot out/r.h5 -o out/x.svg --force"], True),
    "packing": ("out/p.h5", ["evaluate d.toml --packing out/p.h5 -o out/x.h5 --threads 1 --force"], True),
    "elastic": ("out/e.h5", ["plot out/e.h5 -o out/x.svg --force"], True),
    "material test": ("out/t.h5", ["plot out/t.h5 -o out/x.svg --force"], True),
    "checkpoint": ("out/u.part/checkpoint*.h5", ["evaluate d.toml -o out/u.h5 --threads 1 --until 0.005 --set output.checkpoint_interval=0.001 --resume"], True),
    "frame": ("out/u.part/frames/*.h5", ["evaluate d.toml -o out/u.h5 --threads 1 --until 0.005 --set output.checkpoint_interval=0.001 --resume"],
              ["u.csv"]),  # a frame that cannot be taken again is left out with a warning; nothing else may change
    "history": ("out/sweep/histories/*.h5", ["sweep sweep.toml -o out/sweep --workers 1 --resume"], True),
    "journal": ("out/sweep/journal.jsonl", ["sweep sweep.toml -o out/sweep --workers 1 --resume"], True),
    "design": ("d.toml", ["check d.toml"], False),
    "sweep file": ("sweep.toml", ["check sweep.toml"], False),
    "study file": ("study.toml", ["check study.toml"], False),
    "CSV": ("holes.csv", ["check listed.toml"], False),
    "WKT": ("hole.wkt", ["check shaped.toml"], False),
    "result": ("out/sweep/result.json", ["show out/sweep", "plot out/sweep -o out/x.svg --force"], False),
}


def damaged(content, dice):
    data, kind = bytearray(content), dice.choice(["flip", "flip", "cut", "zero", "swap", "double", "drop"])
    at = dice.randrange(len(data))
    if kind == "flip":
        for _ in range(dice.choice([1, 1, 1, 8])):
            data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
    elif kind == "cut":
        del data[at:]
    elif kind == "zero":
        end = min(len(data), at + dice.choice([1, 64, 4096]))
        data[at:end] = bytes(end - at)
    elif kind == "swap":
        size = max(1, min(dice.choice([1, 16, 512]), len(data) // 2))
        a, b = dice.randrange(len(data) - size + 1), dice.randrange(len(data) - size + 1)
        data[a:a + size], data[b:b + size] = data[b:b + size], data[a:a + size]
    elif kind == "double":
        data[at:at] = data[at:at + dice.choice([1, 24, 300])]
    else:
        del data[at:at + dice.choice([1, 24, 300])]
    return kind, bytes(data)


class Trial:
    def __init__(self, program):
        self.program = Path(program).resolve()
        self.work = Path(tempfile.mkdtemp(prefix="perfora-mutations-"))
        self.environment = dict(os.environ, ASAN_OPTIONS="exitcode=99", UBSAN_OPTIONS="exitcode=99")
        self.faults, self.counts = [], collections.defaultdict(collections.Counter)

    def run(self, folder, command):
        try:
            done = subprocess.run([self.program, *command.split(), "--quiet"], cwd=folder, timeout=40, env=self.environment,
                                  stdin=subprocess.DEVNULL, capture_output=True)
            return done.returncode, done.stdout, done.stderr.decode(errors="replace")
        except subprocess.TimeoutExpired:
            return "hangs", b"", ""

    def make(self):
        whole = self.work / "whole"
        make_inputs(whole)
        for name, text in {"holes.csv": CSV, "hole.wkt": WKT, "listed.toml": LISTED, "shaped.toml": SHAPED}.items():
            (whole / name).write_text(text)
        for command in MADE:
            code, _, error = self.run(whole, command)
            if code not in (0, 75):
                raise SystemExit(f"{command}: exit {code}: {error}")
        return whole

    def outcome(self, folder, commands, left_out):
        """Exit codes, what was printed (by `show`: others print times), and the files that came out, times aside."""
        codes, printed = [], []
        for command in commands:
            code, output, error = self.run(folder, command)
            codes.append(code)
            printed.append(output if command.startswith("show") else None)
            if code == 1 and len([line for line in error.splitlines() if "error" in line]) != 1:
                return [f"says {error!r}"], None
            if code != 0:
                return codes, None
        return codes, (printed, results(folder / "out", left_out))

    def format(self, name, count, dice):
        pattern, commands, exact = FORMATS[name]
        whole = self.work / "whole"
        targets = sorted(str(path.relative_to(whole)) for path in whole.glob(pattern))
        if not targets:
            raise SystemExit(f"{name}: no file {pattern}")
        # what was there before is no result; what the damaged file is part of may be written anew
        names = [str(path.relative_to(whole / "out")) for path in (whole / "out").rglob("*")]
        kept = {k for k in names if not k.startswith(("sweep/", "u."))} | {t.removeprefix("out/") for t in targets}
        folder = self.work / "try"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(whole, folder)
        codes, wanted = self.outcome(folder, commands, kept)
        if wanted is None:
            self.faults.append(f"{name}: undamaged: {codes}")
            print("FAULT", self.faults[-1])
            return
        for number in range(count):
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(whole, folder)
            target = dice.choice(targets)
            kind, content = damaged((whole / target).read_bytes(), dice)
            (folder / target).write_bytes(content)
            codes, found = self.outcome(folder, commands, kept)
            verdict = "refused" if codes[-1] == 1 else "same" if codes[-1] == 0 else "fault"
            if codes[-1] == 0 and exact:
                different = [k for k in set(wanted[1]) | set(found[1])
                             if (exact is True or k in exact) and wanted[1].get(k) != found[1].get(k)]
                if different or (exact is True and found != wanted):
                    codes, verdict = [f"other results in {different or 'what is printed'}"], "fault"
            elif codes[-1] == 0:
                verdict = "accepted"
            self.counts[name][verdict] += 1
            if verdict == "fault":
                keep = Path(tempfile.gettempdir()) / f"perfora-mutation-{name.replace(' ', '-')}-{number}"
                keep.write_bytes(content)
                self.faults.append(f"{name} {number} ({kind} of {target}, kept as {keep}): {codes}")
                print("FAULT", self.faults[-1], flush=True)
        print(f"{name}: {count} damaged files: {dict(self.counts[name])}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=150, help="of damaged files, over all formats together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", choices=sorted(FORMATS))
    options = parser.parse_args()
    trial = Trial(options.program)
    try:
        trial.make()
        names = options.only or list(FORMATS)
        for k, name in enumerate(names):
            each = options.count * (k + 1) // len(names) - options.count * k // len(names)
            trial.format(name, each, random.Random(f"{options.seed} {name}"))
    finally:
        shutil.rmtree(trial.work, ignore_errors=True)
    total = sum((counts for counts in trial.counts.values()), collections.Counter())
    print(f"{sum(total.values())} damaged files: {dict(total)}, {len(trial.faults)} faults")
    return 1 if trial.faults else 0


if __name__ == "__main__":
    sys.exit(main())
