# What is here: a study whose evaluations a pool of processes makes: what a batch system or a cluster takes the place of.
# What is not: the same by the program itself (perfora optimize STUDY.toml --workers N).
# Usage: ask_tell.py STUDY.toml FOLDER
import multiprocessing
import sys
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from pathlib import Path

import perfora


def main() -> None:
    file, folder = Path(sys.argv[1]), Path(sys.argv[2])
    # A folder that is there goes on: what its journal knows is not evaluated again.
    study = perfora.Study(file, folder, resume=folder.exists())
    processes = ProcessPoolExecutor(2, multiprocessing.get_context("spawn"))
    with study, processes:
        running = {}
        while not study.finished:
            for trial in study.ask(2 - len(running)) if len(running) < 2 else []:
                running[processes.submit(trial.evaluate)] = trial
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                trial, evaluation = running.pop(done), done.result()
                study.tell(trial, evaluation)
                print(f"{trial.label}, replicate {trial.replicate}: {evaluation['plateau_stress'] / 1e3:.4g} kPa", flush=True)
        found = study.close()
    print(found.verdict.text or found.reason)


if __name__ == "__main__":
    main()
