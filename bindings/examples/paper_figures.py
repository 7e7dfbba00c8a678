# %% What is here: the two curves of the paper drawn from stored histories, cell by cell as in a notebook. What is not:
# running them (docs/studies/paper.md has the commands, half an hour each).
# Usage: paper_figures.py FOLDER_OF_DATA FIGURES.png
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import perfora

data, picture = Path(sys.argv[1]), Path(sys.argv[2])

# %% The histories: three packings without heterogeneity (Figure 4), three with Perlin noise on the thresholds (Figure 5).
figures = {
    "Figure 4: no heterogeneity": ["table1", "table1-seed2", "table1-seed3"],
    "Figure 5: Perlin noise on the thresholds": ["table1-perlin", "table1-perlin-seed2", "table1-perlin-seed3"],
}
curves = {
    title: [perfora.read_table(data / f"{name}-to-60-percent.csv") for name in names] for title, names in figures.items()
}

# %% Their first peaks: the largest stress before it falls to half of what it was.
for title, tables in curves.items():
    for seed, table in enumerate(tables, 1):
        strain, stress = table["strain_yy"], table["stress_yy"]
        fallen = np.argmax(stress < 0.5 * np.maximum.accumulate(stress))
        peak = np.argmax(stress[:fallen])
        print(f"{title}, seed {seed}: first peak {stress[peak] / 1e3:.4g} kPa at {100 * strain[peak]:.3g} %")

# %% Both figures on the same axes as in the paper: the whole curve, and its beginning.
figure, axes = plt.subplots(2, 2, figsize=(10, 7), layout="constrained")
for row, (title, tables) in zip(axes, curves.items()):
    for seed, table in enumerate(tables, 1):
        for axis in row:
            axis.plot(100 * table["strain_yy"], table["stress_yy"] / 1e3, linewidth=0.8, label=f"packing {seed}")
    row[0].set(title=title, xlabel="strain [%]", ylabel="stress [kPa]", xlim=(0, 60), ylim=(0, 600))
    row[1].set(title="the first 5 %", xlabel="strain [%]", xlim=(0, 5), ylim=(0, 600))
    row[0].legend()
figure.savefig(picture, dpi=150)
