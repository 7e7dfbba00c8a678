# What is here: the functions of the package, as Python functions: with signatures that help() and editors show, and
# that pickles (Dask, multiprocessing) name. What is not: what they do (_core).
from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, Optional, Union

from perfora import _core
from perfora._core import (
    Campaign,
    Design,
    ElasticResponse,
    Evaluation,
    InputError,
    Key,
    MaterialTests,
    Packing,
    Progress,
    Run,
    Table,
)

PathLike = Union[str, "os.PathLike[str]"]
Changes = Mapping[str, Any]
OnProgress = Optional[Callable[[Progress], Optional[bool]]]


def keys() -> list[Key]:
    """All keys of a design, in the order of the reference (docs/user/design-files.md)."""
    return _core.keys()


def pack(
    design: Union[Design, Changes, PathLike],
    *,
    replicate: int = 0,
    threads: int = 0,
    file: Optional[PathLike] = None,
    force: bool = False,
    progress: OnProgress = None,
) -> Packing:
    """Makes the packing of a design (a Design, a mapping or a file), what `perfora pack` does.

    threads: 0: one a processor; the packing does not depend on it. file: packing file to write. force: replace it.
    progress: called with a Progress now and then; False stops.
    """
    return _core.pack(design, replicate=replicate, threads=threads, file=file, force=force, progress=progress)


def evaluate(
    design: Union[Design, Changes, PathLike],
    *,
    replicate: int = 0,
    threads: int = 0,
    run_file: Optional[PathLike] = None,
    packing_file: Optional[PathLike] = None,
    resume: bool = False,
    force: bool = False,
    wall_time: float = 0.0,
    memory: float = 0.0,
    progress: OnProgress = None,
) -> Evaluation:
    """Packs a design (a Design, a mapping or a file), compresses it and measures the curve: `perfora evaluate`.

    replicate: another packing and strength field of the design. threads: 0: one a processor; the result does not
    depend on it. run_file: R.h5 to write; a run that is stopped (wall_time in s, progress that says False, Ctrl-C)
    goes on from it with resume. packing_file: the packing to start from. memory: bytes that it may take by its
    estimate; 0: what this process may. progress: called with a Progress every 0.05 % of strain or so. Numerical trouble is no exception but the status "failed".
    """
    return _core.evaluate(
        design,
        replicate=replicate,
        threads=threads,
        run_file=run_file,
        packing_file=packing_file,
        resume=resume,
        force=force,
        wall_time=wall_time,
        memory=memory,
        progress=progress,
    )


def score(design: Union[Design, Changes, PathLike], replicates: Union[Evaluation, Run, Iterable[Union[Evaluation, Run]]]) -> float:
    """What a search minimises (docs/user/theory.md, "Score"): how far evaluations of one design lie from what `design`
    wishes in [target]. Of two designs that keep all wishes the flatter one has less: the distance to a wished stress
    and, unless target.weight.cap_ratio is 0, the cap ratio count as well. Curves are measured anew for this target:
    one run answers any wish.

    replicates: an evaluation, or several of other packings. One that failed or stopped makes the score 750, worse than
    any that was simulated. Raises InputError where nothing is wished and where a curve ends before the window does.
    """
    if isinstance(replicates, (str, os.PathLike)):
        raise TypeError(f"{replicates!r} is a path; read it first: perfora.read(path)")
    several = [replicates] if isinstance(replicates, (Evaluation, Run)) else list(replicates)
    return _core.score(design, [one.evaluation if isinstance(one, Run) else one for one in several])


def run_campaign(
    file: PathLike,
    folder: PathLike,
    *,
    changes: Optional[Changes] = None,
    workers: int = 0,
    threads: int = 0,
    resume: bool = False,
    force: bool = False,
    program: Optional[PathLike] = None,
    best_run_file: bool = True,
    progress: OnProgress = None,
) -> Campaign:
    """Runs the study, sweep or calibration of a file in a folder: `perfora optimize`, `sweep`, `calibrate`, but for
    pictures.

    changes: keys of the file or its design, set beforehand. workers: evaluations at once; 0: as the file says, or one
    a processor. program: path of the program perfora, whose worker processes evaluate; None: threads of this process.
    best_run_file: of a study: evaluate the best design once more into best.h5. A stop (progress that says False,
    Ctrl-C) keeps what is finished; the same call with resume goes on.
    """
    return _core.run_campaign(
        file,
        folder,
        changes=changes,
        workers=workers,
        threads=threads,
        resume=resume,
        force=force,
        program=program,
        best_run_file=best_run_file,
        progress=progress,
    )


def run_ensemble(
    design: Union[Design, Changes, PathLike],
    replicates: int,
    folder: PathLike,
    *,
    threads: int = 0,
    resume: bool = False,
    force: bool = False,
    progress: OnProgress = None,
) -> Campaign:
    """Evaluates replicates 0 to replicates - 1 of a design one after another, each with its run file in the folder:
    `perfora evaluate --replicates`."""
    return _core.run_ensemble(
        design, replicates, folder, threads=threads, resume=resume, force=force, progress=progress
    )


def read_run(file: PathLike) -> Run:
    """Reads a run file R.h5. Do not hold it open with h5py meanwhile: HDF5 refuses to open it twice."""
    return _core.read_run(file)


def read_packing(file: PathLike) -> Packing:
    """Reads a packing file."""
    return _core.read_packing(file)


def read_elastic(file: PathLike) -> ElasticResponse:
    """Reads the file of an elastic response (`perfora evaluate --elastic`)."""
    return _core.read_elastic(file)


def read_material_tests(file: PathLike) -> MaterialTests:
    """Reads the file of material tests (`perfora test`)."""
    return _core.read_material_tests(file)


def read_table(file: PathLike) -> Table:
    """Reads a CSV file of the program: histories, cases, runs, candidates of a study."""
    return _core.read_table(file)


def read_campaign(folder: PathLike) -> Campaign:
    """Reads the folder of a campaign, finished or not."""
    return _core.read_campaign(folder)


def kind_of(path: PathLike) -> str:
    """What a file or folder holds: "run", "packing", "material tests", "elastic response", "checkpoint", "table",
    "study", "sweep", "ensemble", "calibration", "study file", "sweep file", "calibration file", "design" or ""."""
    return _core.kind_of(path)


def stored_record(path: PathLike) -> Optional[dict[str, Any]]:
    """The record that a result file or a finished folder holds, as dicts and lists; None: none."""
    return _core.stored_record(path)


_Result = Union[Run, Packing, ElasticResponse, MaterialTests, Table, Campaign, Design]

_readers: dict[str, Callable[[Path], _Result]] = {
    "run": read_run,
    "packing": read_packing,
    "elastic response": read_elastic,
    "material tests": read_material_tests,
    "table": read_table,
    "study": read_campaign,
    "sweep": read_campaign,
    "ensemble": read_campaign,
    "calibration": read_campaign,
    "design": Design,
}


def read(path: PathLike) -> _Result:
    """Reads any file or folder of the program, as what it is (kind_of). Raises InputError for anything else."""
    kind = kind_of(path)
    if kind not in _readers:
        raise InputError(
            f"{os.fspath(path)}: {'is a ' + kind if kind else 'is nothing that the program wrote'};"
            f" what can be read: {', '.join(_readers)}"
        )
    return _readers[kind](Path(path))
