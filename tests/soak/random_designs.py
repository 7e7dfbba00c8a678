#!/usr/bin/env python3
# What is here: random designs through one worker for a given time: how each ends, by reason, and how the worker's memory
# grows. What is not: fixed bad input (tests/app/bad_input), files damaged on disk.
"""random_designs.py PERFORA [--minutes 60] [--seed 1] [--report FILE]

Keys, kinds and ranges are those that `perfora reference` prints, so a new key is tried as soon as it exists. Every design
is small: some hundred discs pressed fast. Exit code 1 when a worker died, hung, or gave a finished run that breaks a law
(negative dissipation, an energy residual beyond 5 %, a number that is none).
"""

import argparse
import collections
import json
import math
import random
import re
import select
import subprocess
import sys
import tempfile
import time

LIMIT = 60.0  # s an evaluation may take before it is given up
EXPECTED = 5.0  # s: one that `check` expects to take less and that passes the limit hangs
SPANS = {  # by unit, where a range is open
    "m": (1e-4, 3e-2), "N/m": (1e4, 1e9), "Pa": (1e3, 1e10), "kg/m3": (100.0, 1e4), "1/s": (0.1, 1e3), "s": (1e-6, 1e3)}
SHAPING = ("layout.family", "layout.shape", "layout.rows", "layout.columns", "layout.diameter")
# Keys that every design has, so that it is over soon.
ALWAYS = {"cell.width": (6e-3, 2.5e-2), "cell.height": (6e-3, 2.5e-2), "packing.mean_diameter": (3e-4, 9e-4)}
LEFT_OUT = {"packing.file", "layout.file", "layout.outline", "material.from", "output.curve", "target.curve", "cell.scale",
            "cell.width", "cell.height", "packing.mean_diameter", "packing.maximum_diameter", "loading.until", "loading.rate",
            "loading.transits", "dynamics.step_factor", "output.frames", "output.frame_strains"}


def keys_of(program):
    """Rows of the tables: (section.key, kind, unit, allowed)."""
    keys, section = [], None
    text = subprocess.run([program, "reference"], capture_output=True, text=True, check=True).stdout
    for line in text.split("# Keys of a study")[0].splitlines():
        if found := re.match(r"## \[([\w.]+)\]", line):
            section = found[1]
        elif section and line.startswith("| `"):
            cells = [cell.strip() for cell in line.split("|")[1:-1]]
            kind, _, unit = cells[1].partition(",")
            keys.append((f"{section}.{cells[0].strip('`')}", kind.strip(), unit.strip(), cells[3]))
    return [key for key in keys if key[0] not in LEFT_OUT and not key[0].startswith(("target.", "material_test."))]


def span(unit, allowed):
    """Smallest and largest number to try."""
    low, high = SPANS.get(unit, (0.01, 20.0))
    numbers = [float(text) for text in re.findall(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?", allowed)]
    if " to " in allowed and len(numbers) == 2:
        low, high = numbers
    elif "at most" in allowed or "less than" in allowed:
        high = numbers[-1]
        low = numbers[0] if len(numbers) > 1 else min(low, high / 100)
    elif "at least 0" in allowed and random.random() < 0.3:
        return 0.0, 0.0
    return low, high


def number(unit, allowed):
    low, high = span(unit, allowed)
    if low > 0 and high / low > 100:
        return math.exp(random.uniform(math.log(low), math.log(high)))
    return random.uniform(low, high)


def value(key, kind, unit, allowed):
    """A value as TOML, or None where nothing is tried."""
    if kind == "choice":
        return random.choice(re.findall(r"`(\w+)`", allowed)).join('""')
    if kind == "true or false":
        return random.choice(["true", "false"])
    if kind == "whole number":
        low, high = span(unit, allowed)
        if "spac" not in key and key.startswith("layout."):
            low, high = max(low, -4), min(high, 4)
        return str(random.randint(math.ceil(low), max(math.ceil(low), math.floor(min(high, 1e6)))))
    if kind == "list of numbers":
        return "[" + ", ".join(repr(number(unit, allowed)) for _ in range(random.randint(0, 4))) + "]"
    if kind in ("number", "ratio"):
        return repr(number(unit, allowed))
    return None


def design(keys):
    chosen = {}
    for key, kind, unit, allowed in keys:
        often = 0.9 if key in SHAPING else 0.06
        if random.random() < often:
            text = value(key, kind, unit, allowed)
            if text is not None:
                chosen[key] = text
    if "layout.diameter" in chosen and random.random() < 0.9:
        chosen["layout.diameter"] = repr(random.uniform(1e-3, 8e-3))
    for key, (low, high) in ALWAYS.items():
        chosen[key] = repr(random.uniform(low, high))
    mean = float(chosen["packing.mean_diameter"])
    chosen["packing.maximum_diameter"] = repr(mean * random.uniform(1.2, 2.2))
    # Waves are faster in a stiffer material: the same steps for every grade.
    faster = math.sqrt(float(chosen.get("material.grade", 1.0)))
    chosen["loading.rate"] = repr(faster * math.exp(random.uniform(math.log(20.0), math.log(500.0))))
    chosen["loading.until"] = repr(random.uniform(0.02, 0.5))
    chosen["dynamics.step_factor"] = repr(random.uniform(0.2, 0.95))
    chosen["seeds.seed"] = str(random.randint(1, 10**6))
    sections = collections.defaultdict(list)
    for key, text in chosen.items():
        section, _, name = key.partition(".")
        sections[section].append(f"{name} = {text}")
    return "".join(f"[{section}]\n" + "\n".join(lines) + "\n" for section, lines in sections.items())


SLOW = "over the limit of time"


def expected_seconds(program, text):
    """What `perfora check` expects; infinite where it says nothing."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(text)
        file.flush()
        check = subprocess.run([program, "check", file.name, "--json", "--quiet", "--threads", "1"], capture_output=True,
                               text=True, check=False)
    return json.loads(check.stdout)["seconds"] if check.returncode == 0 else math.inf


class Worker:
    def __init__(self, program):
        self.process = subprocess.Popen([program, "worker", "--quiet", "--threads", "1"], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.buffer = b""

    def ask(self, request):
        """The evaluation; a text where the worker died or hung."""
        self.process.stdin.write((json.dumps(request) + "\n").encode())
        self.process.stdin.flush()
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            line, found, rest = self.buffer.partition(b"\n")
            if found:
                self.buffer = rest
                answer = json.loads(line)
                if "status" in answer or "trouble" in answer:
                    return answer
                continue  # a sign of life
            if not select.select([self.process.stdout], [], [], 1.0)[0]:
                continue
            read = self.process.stdout.read1(1 << 20)
            if not read:
                return f"died with {self.process.wait()}: {self.process.stderr.read().decode(errors='replace')[-300:]}"
            self.buffer += read
        return SLOW

    def memory(self):
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as status:
            for line in status:
                if line.startswith("VmRSS"):
                    return int(line.split()[1]) * 1024
        return 0

    def end(self):
        self.process.kill()
        self.process.wait()


def broken_law(answer):
    """What a finished run does that no run may; empty: nothing."""
    if answer["status"] != "completed":
        return ""
    residual = answer.get("energy_residual")
    if residual is not None and abs(residual) > 0.05:
        return f"energy residual {residual:.3g}"
    for key in ("damage_stress", "friction_stress", "viscous_stress"):
        if (answer.get(key) or 0.0) < -1e-6 * abs(answer.get("plateau_stress") or 1.0):
            return f"{key} {answer[key]:.3g}"
    curve = answer.get("curve", {})
    if any(text is None for text in curve.get("stress_yy", [])):
        return "a stress that is no number"
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--report")
    options = parser.parse_args()
    random.seed(options.seed)
    keys = keys_of(options.program)
    begun, worker = time.monotonic(), Worker(options.program)
    ends, bad, memory = collections.Counter(), [], []
    while time.monotonic() - begun < 60.0 * options.minutes:
        text = design(keys)
        answer = worker.ask({"design": text, "replicate": 0, "until": 0.0})
        if isinstance(answer, str):
            ends["WORKER LOST: " + answer] += 1
            if answer != SLOW or expected_seconds(options.program, text) < EXPECTED:
                bad.append({"what": answer, "design": text})
            worker.end()
            worker = Worker(options.program)
            continue
        reason = re.sub(r"[-+]?\d[\d.,e+-]*", "N", answer.get("reason", answer.get("trouble", "")))
        ends[answer.get("status", "trouble") + ": " + reason[:110]] += 1
        if law := broken_law(answer):
            bad.append({"what": law, "design": text})
        if sum(ends.values()) % 50 == 0:
            memory.append(worker.memory())
    worker.end()
    report = {"designs": sum(ends.values()), "minutes": (time.monotonic() - begun) / 60.0, "seed": options.seed,
              "ends": dict(ends.most_common()), "bad": bad, "resident_memory": memory}
    if options.report:
        with open(options.report, "w", encoding="utf-8") as file:
            json.dump(report, file, indent=1)
    for end, count in ends.most_common(40):
        print(f"{count:6d}  {end}")
    print(f"{report['designs']} designs, {len(bad)} bad; resident memory {memory[:1]} to {memory[-1:]} B")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
