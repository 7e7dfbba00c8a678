# What is here: a design as an objective for Optuna: family and diameter for a wanted plateau, with the reason of runs
# that failed. What is not: a search that keeps a journal and knows scatter (perfora optimize).
# Usage: optuna_objective.py DESIGN.toml STRESS_IN_PA EVALUATIONS
import math
import sys

import optuna
import perfora


def main() -> None:
    design, wanted, evaluations = perfora.Design(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
    largest = design["cell.width"] / design["layout.columns"]

    def distance(trial: optuna.Trial) -> float:
        changes = {
            "layout.family": trial.suggest_categorical("layout.family", ["square", "oblique"]),
            "layout.diameter": trial.suggest_float("layout.diameter", 0.3 * largest, 0.6 * largest),
        }
        try:
            evaluation = perfora.evaluate(design.with_changes(changes))
        except perfora.InputError as error:  # walls that are too thin, ...
            raise optuna.TrialPruned(str(error))
        plateau = evaluation["plateau_stress"]
        trial.set_user_attr("plateau_stress", plateau)
        return math.log(plateau / wanted) ** 2 if plateau > 0.0 else 100.0

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1))
    study.optimize(distance, n_trials=evaluations)
    print(f"best: {study.best_params}, plateau {study.best_trial.user_attrs['plateau_stress'] / 1e3:.4g} kPa")


if __name__ == "__main__":
    main()
