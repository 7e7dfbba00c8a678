# What is here: replicates of a design evaluated side by side by Dask, in processes of this machine; with a
# dask.distributed client, on a cluster. What is not: an ensemble with its run files (perfora evaluate --replicates).
# Usage: dask_seeds.py DESIGN.toml REPLICATES
import sys

import dask
import numpy as np
import perfora
from scipy.stats import t


def main() -> None:
    design, replicates = perfora.Design(sys.argv[1]), int(sys.argv[2])
    evaluate = dask.delayed(perfora.evaluate)
    # One thread each: side by side is faster than one after another on many.
    tasks = [evaluate(design, replicate=k, threads=1) for k in range(replicates)]
    evaluations = dask.compute(*tasks, scheduler="processes", num_workers=2)
    plateaus = np.array([evaluation["plateau_stress"] for evaluation in evaluations])
    half = t.ppf(0.975, replicates - 1) * plateaus.std(ddof=1) / np.sqrt(replicates)
    print(f"plateau {plateaus.mean() / 1e3:.4g} +- {half / 1e3:.4g} kPa (95 %, {replicates} packings)")


if __name__ == "__main__":
    main()
