#!/usr/bin/env python3
"""Fails every call that a full disk or a lack of memory can fail, one run a call, and looks at what is left.

usage: try_faults.py PERFORA FAIL_CALL.so [--kind disk|memory] [--every N] [--first K] [--stays] [--only COMMAND]

Each command works on a design that takes a fraction of a second. It runs once undisturbed, which also counts its calls.
Then one run fails call 1, the next call 2 and so on (with --every N each Nth of them). Of each such run is wanted:
- exit code 3 or 75, or 0 where the failure was got over: then its results are those of the undisturbed run;
- one error on standard error, which names a file or the memory;
- no temporary file, and no HDF5, JSON or journal file that is not whole;
- with room again, the same command with --resume (or --force where there is none) gives the results of the undisturbed
  run to the last bit, and leaves nothing else behind.
--stays keeps failing all calls from there on, as on a disk that stays full.

Exit code 77 (CTest: skipped) where the library cannot be preloaded, as under the address sanitizer.
"""
import argparse
import collections
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from tiny_work import is_whole, make_inputs, results

# name: (arguments, how it is done again)
COMMANDS = {
    "evaluate": ("evaluate d.toml -o out/r.h5 --threads 1 --set output.checkpoint_interval=0.001", "--resume"),
    "pack": ("pack d.toml -o out/p.h5 --threads 1", "--force"),
    "elastic": ("evaluate d.toml --elastic -o out/e.h5 --threads 1", "--force"),
    "test": ("test d.toml -o out/t.h5 --threads 1", "--force"),
    "replicates": ("evaluate d.toml --replicates 2 -o out/ensemble --threads 1", "--resume"),
    "sweep": ("sweep sweep.toml -o out/sweep --workers 1", "--resume"),
    "optimize": ("optimize study.toml -o out/study --workers 1", "--resume"),
    "calibrate": ("calibrate calibrate.toml -o out/calibrate --workers 1", "--resume"),
    "plot": ("plot input/r.h5 -o out/r.png", "--force"),
}

class Trial:
    def __init__(self, arguments):
        self.program, self.shim = Path(arguments.program).resolve(), Path(arguments.shim).resolve()
        self.options = arguments
        self.work = Path(tempfile.mkdtemp(prefix="perfora-faults-"))
        self.count = self.work / "count"
        self.faults, self.got_over, self.kinds = [], collections.Counter(), collections.Counter()

    def run(self, folder, arguments, at=0, shim=True):
        environment = dict(os.environ, OMP_NUM_THREADS="1", ASAN_OPTIONS="exitcode=99", UBSAN_OPTIONS="exitcode=99")
        self.count.write_bytes(bytes(8))
        log = self.work / "log"
        log.unlink(missing_ok=True)
        if shim:
            environment.update(LD_PRELOAD=str(self.shim), FAULT_COUNT=str(self.count), FAULT_AT=str(at),
                               FAULT_KIND=self.options.kind, FAULT_STAYS="1" if self.options.stays else "0",
                               FAULT_LOG=str(log), FAULT_BYTES=str(self.options.bytes))
        try:
            done = subprocess.run([self.program, *arguments, "--quiet"], cwd=folder, env=environment, timeout=120,
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True)
            code, error = done.returncode, done.stderr
        except subprocess.TimeoutExpired:
            code, error = "hangs", ""
        calls = struct.unpack("<Q", self.count.read_bytes())[0]
        return code, error, calls, log.read_text() if log.exists() else ""

    def fresh(self, name):
        folder = self.work / name
        shutil.rmtree(folder, ignore_errors=True)
        make_inputs(folder)
        if (self.work / "input").exists():
            (folder / "input").symlink_to(self.work / "input")
        return folder

    def fault(self, where, what):
        self.faults.append(f"{where}: {what}")
        print(f"FAULT {where}: {what}", flush=True)

    def look(self, where, folder, code, error):
        """What must hold after a run that met a failure."""
        if code == "hangs" or code < 0 or code > 128:
            self.fault(where, f"ended by {code}; {error.strip()[-200:]}")
        elif code not in (0, 3, 75):
            self.fault(where, f"exit {code}; {error.strip()[-200:]}")
        errors = [line for line in error.splitlines() if "error" in line]
        if code == 3 and len(errors) != 1:
            self.fault(where, f"{len(errors)} sentences: {errors}")
        wanted = r"out/|out\b|memory|output" if self.options.kind == "disk" else r"memory"
        if code == 3 and not re.search(wanted, " ".join(errors)):
            self.fault(where, f"the sentence names nothing: {errors}")
        for path in (folder / "out").rglob("*"):
            if ".tmp-" in path.name:
                self.fault(where, f"{path.name} is left behind")
            elif path.is_file() and not is_whole(path):
                self.fault(where, f"{path.relative_to(folder)} is not whole")

    def command(self, name):
        text, again = COMMANDS[name]
        arguments = text.split()
        folder = self.fresh(name)
        code, error, calls, _ = self.run(folder, arguments)
        if code != 0:
            self.fault(name, f"undisturbed: exit {code}: {error.strip()}")
            return
        wanted = results(folder / "out")
        tried = 0
        for at in range(self.options.first, calls + 1, self.options.every):
            where = f"{name} call {at} of {calls}"
            folder = self.fresh(name)
            code, error, _, log = self.run(folder, arguments, at)
            if not log:
                continue  # the order of calls of several processes may end a few calls earlier
            where += f" ({log.splitlines()[0].strip()})"
            tried += 1
            self.kinds[log.split()[0]] += 1
            self.look(where, folder, code, error)
            if code == 0:
                self.got_over[name] += 1
                if results(folder / "out") != wanted:
                    self.fault(where, "exit 0 and other results")
                continue
            code, error, _, _ = self.run(folder, [*arguments, again], shim=False)
            if code != 0:
                self.fault(where, f"{again}: exit {code}: {error.strip()[-300:]}")
                continue
            found = results(folder / "out")
            different = [key for key in sorted(set(found) | set(wanted)) if found.get(key) != wanted.get(key)]
            if different:
                self.fault(where, f"{again}: other results in {different}")
        print(f"{name}: {calls} calls, {tried} failed in turn, {self.got_over[name]} got over", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("shim")
    parser.add_argument("--kind", choices=["disk", "memory"], default="disk")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--bytes", type=int, default=1 << 20, help="smallest allocation that fails")
    parser.add_argument("--stays", action="store_true")
    parser.add_argument("--only", action="append", choices=sorted(COMMANDS))
    trial = Trial(parser.parse_args())
    try:
        folder = trial.fresh("input-of-plot")
        code, error, calls, _ = trial.run(folder, COMMANDS["evaluate"][0].split())
        if "does not come first" in error or (code == 0 and calls == 0 and trial.options.kind == "disk"):
            print("the library is not preloaded here")
            return 77
        (folder / "out").rename(trial.work / "input")
        for name in trial.options.only or COMMANDS:
            trial.command(name)
    finally:
        shutil.rmtree(trial.work, ignore_errors=True)
    print(f"{sum(trial.kinds.values())} calls failed ({dict(trial.kinds)}), {sum(trial.got_over.values())} got over, "
          f"{len(trial.faults)} faults")
    return 1 if trial.faults else 0


if __name__ == "__main__":
    sys.exit(main())
