#!/usr/bin/env python3
# What is here: the comparison of search methods on emulators made from recorded evaluations: one command, resumable.
# What is not: the searches of the program, which emulated_search carries out. Needs python3-sklearn and python3-optuna.
"""Compares searches at equal numbers of emulated runs and prints a table of regrets with standard errors.

Example (a study and the folders whose journals hold evaluations of its kind of block):

    cmake --build build/release --target emulated_search
    tests/benchmarks/search/run.py --program build/release/tests/benchmarks/emulated_search \\
        --study designs/study-slots.toml --window 0.08 0.23 --until 0.25 --output out/benchmark \\
        docs/data/slots-map

Runs that are in OUTPUT/trials.csv are not made again; the table is OUTPUT/table.csv and OUTPUT/table.txt.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import zlib

import numpy as np
from sklearn.ensemble import RandomForestRegressor
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

STRAIN_STEP = 0.005
ENOUGH_RUNS = 200  # real evaluations, for a claim
TRUTH_RUNS = 64  # blocks of which the mean is a design's true score
REFERENCE_POINTS = 256  # Sobol points among which the best true score is looked for, beside all recommended designs
GLOBAL = "GN_DIRECT GN_DIRECT_L GN_DIRECT_L_RAND GN_DIRECT_NOSCAL GN_DIRECT_L_NOSCAL GN_DIRECT_L_RAND_NOSCAL " \
         "GN_ORIG_DIRECT GN_ORIG_DIRECT_L GN_CRS2_LM GN_MLSL GN_MLSL_LDS GN_ISRES GN_AGS GN_ESCH".split()
LOCAL = "LN_PRAXIS LN_COBYLA LN_NEWUOA_BOUND LN_NELDERMEAD LN_SBPLX LN_BOBYQA".split()


class Program:
    """emulated_search on one study; an emulator answers what it asks."""

    def __init__(self, program, study):
        self.process = subprocess.Popen([program, study], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.emulator = None

    def do(self, what, **keys):
        self.write({"do": what, **keys})
        while True:
            line = self.process.stdout.readline()
            if not line:
                sys.exit(f"emulated_search ended at {what} {keys}")
            answer = json.loads(line)
            if "result" in answer:
                return answer["result"]
            ask = answer["ask"]
            self.write({"curves": [self.emulator.run(ask["descriptors"], ask["family"], ask["seed"], r)
                                   for r in ask["replicates"]]})

    def write(self, line):
        self.process.stdin.write(json.dumps(line) + "\n")
        self.process.stdin.flush()


class Recorded:
    """Recorded runs on one grid of strain: inputs and mean curves of designs, residuals of single blocks."""

    def __init__(self, runs, until):
        good = [r for r in runs if r["completed"] and r["strain"] and r["strain"][-1] >= until - STRAIN_STEP
                and r["first_peak_stress"]]
        self.count, self.left_out = len(good), len(runs) - len(good)
        self.strain = np.arange(0.0, until + 0.5 * STRAIN_STEP, STRAIN_STEP)
        designs = {}
        for r in good:
            designs.setdefault((r["family"], tuple(np.round(r["descriptors"], 9))), []).append(r)
        stress = [np.interp(self.strain, r["strain"], r["stress"]) for r in good]
        self.floor = 0.01 * float(np.mean(stress)) if stress else 1.0
        self.families = sorted({family for family, _ in designs})
        self.inputs, self.means, self.residuals, pairs = [], [], [], []
        for (family, descriptors), replicates in designs.items():
            rows = np.array([self.row(r) for r in replicates])
            self.inputs.append(self.input_of(descriptors, family))
            self.means.append(rows.mean(axis=0))
            if len(rows) > 1:
                self.residuals += list((rows - rows.mean(axis=0)) * math.sqrt(len(rows) / (len(rows) - 1)))
                in_order = sorted(replicates, key=lambda r: r["replicate"])
                pairs.append(self.row(in_order[0]) - self.row(in_order[1]))
        self.share_in_common = self.common_share(np.array(pairs))
        self.inputs, self.means = np.array(self.inputs), np.array(self.means)

    def row(self, r):
        stress = np.interp(self.strain, r["strain"], r["stress"])
        return np.concatenate([np.log(np.maximum(stress, 0.0) + self.floor),
                               [math.log(r["first_peak_stress"]), r["first_peak_strain"]]])

    @staticmethod
    def common_share(pairs):
        """Part of the variance of a seed's effect that all designs have in common, from the differences between their
        first and second seeds (rows): the median over strains, stress of the first peak."""
        if len(pairs) < 8:
            return float("nan"), float("nan")
        each = pairs.var(axis=0, ddof=1)
        common = pairs.mean(axis=0) ** 2 - each / len(pairs)
        share = common / np.where(each > 0.0, common + each, 1.0)
        return float(np.median(share[:-2])), float(share[-2])

    def input_of(self, descriptors, family):
        return np.concatenate([descriptors, [1.0 if family == f else 0.0 for f in self.families]])


class Emulator:
    """Mean curve by a regression of principal components; blocks by resampled residuals."""

    def __init__(self, recorded, kind):
        self.recorded = recorded
        self.middle = recorded.means.mean(axis=0)
        u, s, v = np.linalg.svd(recorded.means - self.middle, full_matrices=False)
        count = min(8, len(recorded.means) - 1)
        scores, self.components = (u * s)[:, :count], v[:count]
        low, high = recorded.inputs.min(axis=0), recorded.inputs.max(axis=0)
        self.low, self.range = low, np.where(high > low, high - low, 1.0)
        x = (recorded.inputs - self.low) / self.range
        if kind == "forest":
            self.model = RandomForestRegressor(n_estimators=200, min_samples_leaf=2, oob_score=True, random_state=1)
            self.model.fit(x, scores)
            self.quality = self.model.oob_score_
        else:
            kernel = ConstantKernel(1.0) * RBF(3.0, (0.3, 30.0)) + WhiteKernel(0.1, (1e-3, 10.0))
            self.scale = scores.std(axis=0) + 1e-12
            self.model = GaussianProcessRegressor(kernel, normalize_y=True, n_restarts_optimizer=2, random_state=1)
            self.model.fit(x, scores / self.scale)
            self.quality = float("nan")
        self.kind = kind
        bank = recorded.residuals
        self.residuals_are = "of replicates"
        if len(bank) < 8:  # no replicates: what the regression does not explain
            fitted = np.array([self.mean_of(i) for i in recorded.inputs])
            bank = list(recorded.means - fitted)
            self.residuals_are = "of the regression (too few replicates are recorded)"
        self.bank = bank
        self.known = {}

    def mean_of(self, row):
        x = np.clip((row - self.low) / self.range, -0.25, 1.25).reshape(1, -1)
        scores = self.model.predict(x)[0] * (1.0 if self.kind == "forest" else self.scale)
        return self.middle + scores @ self.components

    def run(self, descriptors, family, seed, replicate):
        key = (family, tuple(descriptors))
        if key not in self.known:
            self.known[key] = self.mean_of(self.recorded.input_of(descriptors, family))
        if seed == 0:  # of the truth: all in turn
            residual = self.bank[replicate % len(self.bank)]
        else:
            # Of every design its own: recorded designs with the same packing seed have no part of their scatter in
            # common (share_in_common). A residual by the seed alone would lift all designs at once.
            place = np.round(100.0 * (self.recorded.input_of(descriptors, family) - self.low) / self.range)
            design = zlib.crc32(place.astype(np.int32).tobytes())
            residual = self.bank[np.random.default_rng([seed, replicate, design]).integers(len(self.bank))]
        row = self.known[key] + residual
        stress = np.maximum(np.exp(row[:-2]) - self.recorded.floor, 0.0)
        return {"stress": stress.tolist(), "first_peak_stress": float(math.exp(row[-2])),
                "first_peak_strain": float(min(max(row[-1], 1e-3), self.recorded.strain[-1]))}


def by_optuna(program, name, shape, keys, runs):
    """The best that Optuna's sampler saw; points that break a wall cost no run."""
    import optuna
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    sampler = (optuna.samplers.TPESampler(seed=keys["seed"]) if name == "tpe"
               else optuna.samplers.CmaEsSampler(seed=keys["seed"], restart_strategy="ipop"))
    study = optuna.create_study(sampler=sampler)
    spent, best, fresh = 0, None, True
    for _ in range(20 * runs):
        if spent + keys["replicates"] > runs:
            break
        trial = study.ask()
        arm = trial.suggest_int("arm", 0, shape["arms"] - 1) if shape["arms"] > 1 else 0
        point = [trial.suggest_float(f"x{k}", 0.0, 1.0) for k in range(shape["variables"])]
        answer = program.do("score", arm=arm, point=point, first=0, count=keys["replicates"], fresh=fresh, **keys)
        fresh = False
        study.tell(trial, answer["score"])
        if answer["kept"]:
            spent += keys["replicates"]
            if best is None or answer["score"] < best[0]:
                best = (answer["score"], arm, point)
    return {"arm": best[1], "point": best[2], "runs": spent, "note": ""} if best else {"runs": spent, "note": "none"}


def variant_name(name, replicates, mapped):
    return f"{name}:{replicates}" + (":map" if mapped else "")


def methods(shape, only):
    """Name, replicates, whether it begins with the map. `only`: names, or names of variants ("LN_SBPLX:3:map")."""
    names = [("model", 1, True), ("model", 2, True)]
    for name in GLOBAL + LOCAL + ["random", "sobol", "optuna tpe", "optuna cmaes"]:
        if name == "LN_NEWUOA_BOUND" and shape["variables"] < 2 or name == "GN_AGS" and shape["variables"] > 10:
            continue
        for replicates in (1, 3):
            names.append((name, replicates, False))
            if name in GLOBAL + LOCAL:
                names.append((name, replicates, True))
    return [m for m in names if not only or m[0] in only or variant_name(*m) in only]


def truth_of(program, target, result, first=True):
    return program.do("score", arm=result["arm"], point=result["point"], first=0, count=TRUTH_RUNS, seed=0,
                      target=target, fresh=first)["score"]


def targets_of(program, recorded, window, count=3):
    """Stresses that a quarter, half and three quarters of the recorded designs lie below, over the window."""
    inside = (recorded.strain >= window[0]) & (recorded.strain <= window[1])
    level = np.mean(np.exp(recorded.means[:, :-2][:, inside]) - recorded.floor, axis=1)
    return [float(np.round(q, -2)) for q in np.quantile(level, [(k + 1) / (count + 1) for k in range(count)])]


def table_of(trials, best):
    rows = []
    groups = {}
    for t in trials:
        if t["score"]:
            regret = float(t["score"]) - best[(t["emulator"], t["target"])]
            groups.setdefault((t["method"], t["replicates"], t["map"]), []).append(regret)
    for (method, replicates, mapped), regrets in groups.items():
        n = len(regrets)
        error = np.std(regrets, ddof=1) / math.sqrt(n) if n > 1 else float("nan")
        rows.append([method, replicates, mapped, n, float(np.mean(regrets)), float(error), float(np.median(regrets))])
    return sorted(rows, key=lambda row: row[4])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", help="folders of sweeps or studies with journal.jsonl")
    parser.add_argument("--program", required=True, help="emulated_search")
    parser.add_argument("--study", required=True, help="study file: space, window, limits, weights")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--window", nargs=2, type=float, default=[0.2, 0.4], help="of the plateau, for the targets")
    parser.add_argument("--until", type=float, default=0.4, help="strain that recorded runs must reach")
    parser.add_argument("--runs", type=int, default=120, help="emulated runs a search may spend, its map included")
    parser.add_argument("--map", type=int, default=32, help="designs of the map")
    parser.add_argument("--repeats", type=int, default=30)
    parser.add_argument("--targets", type=int, default=3)
    parser.add_argument("--emulators", nargs="+", default=["forest", "process"])
    parser.add_argument("--methods", nargs="*", default=[], help="these alone; NAME:REPLICATES or NAME:REPLICATES:map: one variant alone")
    args = parser.parse_args()
    program = Program(args.program, args.study)
    runs, names = [], []
    for folder in args.folders:
        described = program.do("describe", journal=str(pathlib.Path(folder) / "journal.jsonl"))
        runs += described["runs"]
        if described["unread"]:
            print(f"{folder}: {described['unread']} evaluations are of designs that this program cannot read")
    recorded = Recorded(runs, args.until)
    if len(recorded.means) < 8:
        sys.exit(f"{len(recorded.means)} designs with a run to strain {args.until:g}: no emulator can be made of them")
    print(f"{recorded.count} recorded runs of {len(recorded.means)} designs, {recorded.left_out} left out")
    print("of a seed's effect all designs have in common: %.3f of the stress (median over strains), %.3f of the first peak"
          % recorded.share_in_common)
    if recorded.count < ENOUGH_RUNS:
        print(f"too few for a claim, which needs {ENOUGH_RUNS}: read the table as a trial of the method alone")
    args.output.mkdir(parents=True, exist_ok=True)
    file = args.output / "trials.csv"
    head = ["emulator", "target", "method", "replicates", "map", "repeat", "score", "runs", "arm", "point", "note"]
    known = list(csv.DictReader(file.open())) if file.exists() else []
    done = {tuple(t[k] for k in head[:6]) for t in known}
    writer = file.open("a", newline="")
    lines = csv.DictWriter(writer, head)
    if not known:
        lines.writeheader()
    shape = program.do("begin", strain=recorded.strain.tolist())
    best = {}
    for kind in args.emulators:
        program.emulator = emulator = Emulator(recorded, kind)
        print(f"{kind}: {len(emulator.bank)} residuals {emulator.residuals_are}; explained {emulator.quality:.2f}")
        for target in targets_of(program, recorded, args.window, args.targets):
            scores = []
            reference = np.random.default_rng(7)
            for k in range(REFERENCE_POINTS):
                point = {"arm": int(k % shape["arms"]), "point": reference.random(shape["variables"]).tolist()}
                scores.append(truth_of(program, target, point, k == 0))
            least = min(scores)
            for repeat in range(args.repeats):
                for method, replicates, mapped in methods(shape, args.methods):
                    key = (kind, str(target), method, str(replicates), str(int(mapped)), str(repeat))
                    if key in done:
                        continue
                    keys = {"seed": repeat + 1, "replicates": replicates, "target": target}
                    if method.startswith("optuna"):
                        result = by_optuna(program, method.split()[1], shape, keys, args.runs)
                    else:
                        result = program.do("search", algorithm=method, runs=args.runs, map_replicates=1,
                                            map=args.map if mapped else 0, **keys)
                    score = truth_of(program, target, result) if "point" in result else ""
                    trial = dict(zip(head, [*key, score, result["runs"], result.get("arm", ""),
                                            " ".join(f"{x:.6f}" for x in result.get("point", [])), result["note"]]))
                    lines.writerow(trial)
                    writer.flush()
                    known.append(trial)
            here = [float(t["score"]) for t in known if t["emulator"] == kind and t["target"] == str(target) and t["score"]]
            best[(kind, str(target))] = min([least, *here])
    rows = table_of([t for t in known if (t["emulator"], t["target"]) in best], best)
    with (args.output / "table.csv").open("w", newline="") as out:
        csv.writer(out).writerows([["method", "replicates", "map", "trials", "mean_regret", "standard_error", "median"], *rows])
    text = f"{recorded.count} recorded runs of {len(recorded.means)} designs; {args.runs} emulated runs a search\n"
    text += f"{'method':26} {'replicates':>10} {'map':>4} {'trials':>6} {'mean regret':>12} {'+-':>9} {'median':>9}\n"
    for method, replicates, mapped, n, mean, error, median in rows:
        text += f"{method:26} {replicates:>10} {'yes' if mapped == '1' else 'no':>4} {n:>6} {mean:12.4g} {error:9.2g} {median:9.4g}\n"
    (args.output / "table.txt").write_text(text)
    print(text)
    program.write({"do": "end"})


if __name__ == "__main__":
    main()
