# What is here: the crushing curve of a design in five lines. What is not: pictures of the program (perfora plot).
# Usage: curve.py DESIGN.toml CURVE.png
import sys, perfora, matplotlib.pyplot as plt
evaluation = perfora.evaluate(sys.argv[1])
plt.plot(100 * evaluation.strain, evaluation.stress / 1e3)
plt.gca().set(xlabel="strain [%]", ylabel="stress [kPa]", title=f"plateau {evaluation['plateau_stress'] / 1e3:.4g} kPa")
plt.savefig(sys.argv[2])
