#!/usr/bin/env python3
"""Runs every command of README.md and docs/user as a reader would: files that a page tells to save are saved, its
commands are run one after another in one folder, and each must end well.

usage: check_commands.py PERFORA SOURCE FOLDER [--whole]

Without --whole, work that takes minutes is made small by flags (SHORTER); with it (label docs-slow) everything is run as
written. A command that has a test of its own is named below with that test (ELSEWHERE); one that this script does not
know how to treat fails it.
"""
import argparse
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

# In this order: later pages use what earlier ones made.
PAGES = ["README.md", "docs/user/tutorial.md", "docs/user/tutorial-mortar.md", "docs/user/report.md", "docs/user/exports.md",
         "docs/user/python.md", "docs/user/dakota.md", "docs/user/choices.md", "docs/user/many-hosts.md"]

# Beginnings of commands that are tried elsewhere.
ELSEWHERE = {
    "./run quick": "the example study: examples of tests/optimize/search and this script's optimize",
    "./run test": "it is how tests are run",
    "./run build": "it is how the program is built",
    "xvfb-run ": "viewers.paraview",
    "python3 -m venv": "python.test_install",
    "my-environment/bin/pip": "python.test_install",
    "PYTHONPATH=build/release/python python3": "python.test_examples",
    # with the constant rate of FAST the grade is no mere factor
    "perfora optimize lining-study.toml --map out/lining": "tests/optimize/search/test_study_grade.cpp",
    "perfora optimize designs/study-quick.toml -o out/study-shared": "tests/app/test_shared_commands.cpp",
    "mpirun -n 4 perfora-mpi ": "tests/app/test_mpi.cpp",
    "perfora work ": "tests/app/test_shared_commands.cpp",
    "perfora ask ": "tests/app/test_shared_commands.cpp",
    "perfora worker ": "tests/app/test_shared_commands.cpp",
    "perfora tell ": "tests/app/test_shared_commands.cpp",
    "perfora evaluate designs/quick.toml --dakota": "tests/app/test_dakota.cpp, which writes the parameters",
}

FAST = " --set loading.rate=60"
COARSE = " --set packing.mean_diameter=1mm --set packing.maximum_diameter=2mm"
# A pattern of a command and what is added to it.
SHORTER = [
    (r"perfora optimize ", " --set study.maxeval=1 --set study.replicates=1 --set study.final_replicates=1" + FAST),
    (r"perfora map ", " --set map.designs=2" + FAST),
    (r"perfora sweep ", " --set sweep.replicates=1" + FAST),
    (r"perfora tolerance ", " --set tolerance.replicates=1" + FAST),
    (r"perfora calibrate ", " --set calibrate.chart=false --set calibrate.maxeval=4 --set calibrate.tolerance=0.5 --set calibrate.replicates=1"
     " --set material_test.size=7mm"),
    (r"perfora tolerance ", " --set tolerance.replicates=2" + FAST),
    (r"perfora evaluate (?!.*--elastic)", FAST),
    (r"perfora pack designs/table1", COARSE),
    (r"perfora test ", " --set material_test.size=7mm"),
]


def parts(page):
    """What a page tells to do, in order: ("save", name, text) and ("run", command)."""
    lines, k, words, done = page.split("\n"), 0, "", []
    while k < len(lines):
        opened = re.fullmatch(r"```(\w*)", lines[k])
        if not opened:
            words = "" if not lines[k].strip() and not words.endswith(":") else (words + " " + lines[k]).strip()
            k += 1
            continue
        end = lines.index("```", k + 1)
        body = lines[k + 1:end]
        if opened[1] in ("toml", "csv"):
            named = re.search(r"[Ss]ave [^`]*`([\w./-]+)`", words)
            if named:
                done.append(("save", named[1], "\n".join(body) + "\n"))
        elif opened[1] == "sh":
            text = "\n".join(body).replace("\\\n", " ")
            done += [("run", command) for command in text.split("\n") if command.strip()]
        words, k = "", end + 1
    return done


def shortened(command):
    body, hash_, comment = command.partition(" #")
    for pattern, flags in SHORTER:
        if re.search(pattern, body):
            return body.rstrip() + flags
    return body


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("perfora", type=Path)
    parser.add_argument("source", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--whole", action="store_true")
    arguments = parser.parse_args()
    source, folder = arguments.source.resolve(), arguments.folder.resolve()
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "build/release").mkdir(parents=True)
    (folder / "out").mkdir()
    (folder / "build/release/perfora").symlink_to(arguments.perfora.resolve())
    for name in ("designs", "docs"):
        (folder / name).symlink_to(source / name)
    failed, count = [], 0
    for page in sorted((source / "docs/user").glob("*.md")):
        name = str(page.relative_to(source))
        if name not in PAGES and any(what == "run" for what, *rest in parts(page.read_text())):
            failed.append(name)
            print(f"FAILED: {name} has commands and is not among the pages of this script")
    for name in PAGES:
        for what, *rest in parts((source / name).read_text()):
            if what == "save":
                (folder / rest[0]).write_text(rest[1])
                continue
            command = rest[0]
            if any(command.startswith(start) for start in ELSEWHERE) or command.startswith(("alias ", "export ", "mkdir ")):
                continue
            count += 1
            tried = command if arguments.whole else shortened(command)
            tried = re.sub(r"(^|\s)perfora ", r"\1build/release/perfora ", tried)
            begun = time.monotonic()
            ended = subprocess.run(["bash", "-c", tried], cwd=folder, capture_output=True, text=True)
            print(f"{time.monotonic() - begun:7.1f} s  {name}: {tried}", flush=True)
            if ended.returncode != 0:
                failed.append(command)
                print(f"FAILED with exit code {ended.returncode}\n{ended.stdout[-2000:]}{ended.stderr[-2000:]}")
    print(f"{len(failed)} failed of {count} commands" if failed else f"{count} commands of {len(PAGES)} pages run")
    return 1 if failed or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
