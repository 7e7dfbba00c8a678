# What is here: a design as an objective for SciPy: the diameter whose plateau is a wanted stress. What is not: a search
# that keeps a journal, knows scatter and says what it is sure of (perfora optimize).
# Usage: scipy_objective.py DESIGN.toml STRESS_IN_PA EVALUATIONS
import math
import sys

import perfora
from scipy.optimize import minimize_scalar


def main() -> None:
    design, wanted, evaluations = perfora.Design(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
    largest = design["cell.width"] / design["layout.columns"]

    def distance(diameter: float) -> float:
        """Squared distance of the plateau to the wanted stress, in logarithms."""
        # Seed 0 for every diameter, so that they are compared on equal terms.
        plateau = perfora.evaluate(design.with_changes({"layout.diameter": diameter}))["plateau_stress"]
        print(f"diameter {1e3 * diameter:.4g} mm: plateau {plateau / 1e3:.4g} kPa", flush=True)
        return math.log(plateau / wanted) ** 2 if plateau > 0.0 else 100.0  # a run that failed, too

    found = minimize_scalar(
        distance, bounds=(0.3 * largest, 0.8 * largest), method="bounded", options={"maxiter": evaluations}
    )
    print(f"best: {1e3 * found.x:.4g} mm")


if __name__ == "__main__":
    main()
