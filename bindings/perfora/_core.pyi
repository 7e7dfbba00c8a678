# What is here: types of the compiled part of the package, for editors and mypy. What is not: what the functions do
# (their docstrings).
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import Any, Callable, Iterator, Literal, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

_Path = Union[str, PathLike[str]]
_Floats = NDArray[np.float64]
_Integers = NDArray[np.int32]
_Status = Literal["completed", "stopped", "failed"]
_Changes = Mapping[str, Any]
_DesignSource = Union[Design, _Changes, _Path]
_OnProgress = Optional[Callable[[Progress], Optional[bool]]]

__version__: str
interface_version: int

class InputError(ValueError):
    """Something that was given is wrong: a key, a value, a file. One sentence: what is wrong, what to do."""
class SurroundingsError(OSError):
    """The surroundings failed (a full disk, a lost worker), not what was given; the same call may succeed later."""

class Key:
    """One key that a design may set."""
    @property
    def name(self) -> str:
        """With its section: "layout.diameter"."""
    @property
    def type(self) -> str:
        """"real", "integer", "boolean", "text", "choice", "path", "real list" or "real rows"."""
    @property
    def dimension(self) -> str:
        """"length", "stress", ...; empty: a plain number or no number."""
    @property
    def unit(self) -> str:
        """SI unit of plain numbers; empty: none."""
    @property
    def default(self) -> str:
        """The default, in TOML syntax."""
    @property
    def range(self) -> str:
        """The numbers allowed, for people."""
    @property
    def choices(self) -> list[str]:
        """What a choice allows."""
    @property
    def help(self) -> str:
        """One clause."""

def keys() -> list[Key]: ...

class Design:
    """Every option of one block and its simulation; numbers are SI. source: nothing (the block of the paper's Table 1),
    the path of a design file, a mapping of keys (nested or flat: {"layout.diameter": "7 mm"}) or another design.
    changes: keys set afterwards."""
    __hash__: None  # type: ignore[assignment]
    def __init__(self, source: Optional[_DesignSource] = ..., changes: Optional[_Changes] = ...) -> None: ...
    @staticmethod
    def from_toml(text: str, name: str = ...) -> Design:
        """A design from the text of a design file; name stands for the file in messages."""
    def __getitem__(self, key: str) -> Any: ...
    def __setitem__(self, key: str, value: Any) -> None: ...
    def __contains__(self, key: str) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> Design: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Design: ...
    def keys(self) -> list[str]:
        """Names of all keys."""
    def set(self, changes: _Changes) -> None:
        """Sets all keys of a mapping (nested or flat), or none where one is wrong."""
    def with_changes(self, changes: _Changes) -> Design:
        """A copy with other values."""
    def check(self) -> list[str]:
        """Checks what can be checked without placing discs. Returns warnings; raises InputError for a design that
        cannot be evaluated."""
    def to_toml(self) -> str:
        """The complete design as TOML, in SI, with all digits."""

class Measure:
    """One number that a packing or a run is summed up by; float() gives its value."""
    @property
    def key(self) -> str:
        """"plateau_stress"."""
    @property
    def value(self) -> float:
        """SI; NaN where it was not reached."""
    @property
    def unit(self) -> str:
        """SI unit: "Pa"; empty: none."""
    @property
    def dimension(self) -> str:
        """"stress", "ratio", ...; empty: a plain number."""
    @property
    def label(self) -> str:
        """For people: "plateau stress"."""
    @property
    def help(self) -> str:
        """One clause."""
    def __float__(self) -> float: ...

class Table:
    def __getitem__(self, name: str) -> _Floats: ...
    def __contains__(self, name: str) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> list[str]:
        """Names of the columns, in the order of the file."""
    def texts(self, name: str) -> list[str]:
        """The fields of a column as written; empty but for tables of CSV files."""
    def unit(self, name: str) -> str:
        """SI unit of a column; empty: none, or not known."""
    @property
    def rows(self) -> int:
        """Number of rows."""

class Verdict:
    """Whether the wishes of a design are met."""
    @property
    def outcome(self) -> str:
        """"met", "missed", "not shown", "out of reach"; empty: nothing was wished."""
    @property
    def text(self) -> str:
        """One line: the outcome and the wishes that decide it."""
    @property
    def note(self) -> str:
        """What the numbers are worth beyond their scatter."""

class Evaluation:
    """What one evaluation of a design gave."""
    @property
    def status(self) -> _Status:
        """"completed", "stopped" or "failed"."""
    @property
    def reason(self) -> str:
        """In words."""
    @property
    def replicate(self) -> int:
        """Which packing and strength field: 0, 1, ..."""
    @property
    def measures(self) -> dict[str, Measure]:
        """Measures by their keys, each with its value and unit."""
    def __getitem__(self, key: str) -> float: ...
    @property
    def curve(self) -> Table:
        """The history, a column a quantity."""
    @property
    def strain(self) -> _Floats:
        """Engineering strain of the curve, compression positive."""
    @property
    def stress(self) -> _Floats:
        """Stress of the curve, Pa, compression positive."""
    @property
    def warnings(self) -> list[str]:
        """What speaks against its numbers, a sentence each."""
    @property
    def verdict(self) -> Verdict:
        """On this one block, which shows little."""
    @property
    def seconds(self) -> float:
        """Wall time of the compression, s."""
    @property
    def record(self) -> dict[str, Any]:
        """The record perfora.evaluate/1, what `perfora evaluate --json` prints."""
    def to_json(self, with_curve: bool = ...) -> str:
        """The record as text; with the curve from_json() gives the same evaluation back."""
    @staticmethod
    def from_json(text: str) -> Evaluation:
        """An evaluation from its record."""

class Discs:
    """Discs, m; the origin is the lower left corner."""
    @property
    def x(self) -> _Floats:
        """Of the centres, m."""
    @property
    def y(self) -> _Floats:
        """Of the centres, m."""
    @property
    def radius(self) -> _Floats:
        """Of the discs, m."""
    def __len__(self) -> int: ...

class Outline:
    """Rim of an opening, a closed polygon, anticlockwise."""
    @property
    def x(self) -> _Floats:
        """Of the corners, m."""
    @property
    def y(self) -> _Floats:
        """Of the corners, m."""
    def __len__(self) -> int: ...

class Packing:
    """The discs that a block consists of."""
    @property
    def status(self) -> _Status:
        """"completed", "stopped" or "failed" (the wanted density was not reached)."""
    @property
    def reason(self) -> str:
        """In words."""
    @property
    def width(self) -> float:
        """Of the block, m."""
    @property
    def height(self) -> float:
        """Of the block, m."""
    @property
    def discs(self) -> Discs:
        """Those left between the openings."""
    @property
    def periodic(self) -> Discs:
        """All, before the openings were cut out."""
    @property
    def openings(self) -> list[Outline]:
        """In the order of the layout."""
    @property
    def measures(self) -> dict[str, Measure]:
        """Measures by their keys, each with its value and unit."""
    def __getitem__(self, key: str) -> float: ...

class Frame:
    """n discs and the m bonds that are intact, at one strain."""
    @property
    def strain(self) -> float:
        """Engineering, compression positive."""
    @property
    def time(self) -> float:
        """s."""
    @property
    def width(self) -> float:
        """Of the block at that strain, m."""
    @property
    def height(self) -> float:
        """Of the block at that strain, m."""
    @property
    def shear(self) -> float:
        """By which the upper edge is displaced, m."""
    @property
    def position(self) -> _Floats:
        """(n,2), m, from the lower left corner."""
    @property
    def angle(self) -> _Floats:
        """(n), rad."""
    @property
    def fragment(self) -> _Integers:
        """(n), the fragment a disc is of; 0: the largest."""
    @property
    def damage(self) -> _Floats:
        """(n), share of the original bonds lost."""
    @property
    def bonds(self) -> _Integers:
        """(m,2), discs."""
    @property
    def bond_damage(self) -> _Floats:
        """(m), damage of each bond, 0 to 1."""
    @property
    def velocity(self) -> _Floats:
        """(n,2), m/s, beyond the affine motion of the block; empty unless output.frame_data is "all", as all below."""
    @property
    def spin(self) -> _Floats:
        """(n), rad/s."""
    @property
    def stress(self) -> _Floats:
        """(n,3), xx, yy, xy over the disc's area, Pa, compression positive."""
    @property
    def bond_normal_force(self) -> _Floats:
        """(m), N/m, tension positive."""
    @property
    def bond_shear_force(self) -> _Floats:
        """(m), N/m."""
    @property
    def contacts(self) -> _Integers:
        """(c,2), discs that touch."""
    @property
    def contact_normal_force(self) -> _Floats:
        """(c), N/m, compression positive."""
    @property
    def contact_shear_force(self) -> _Floats:
        """(c), N/m."""

class Bonds:
    """All bonds that a run began with, m of them."""
    @property
    def discs(self) -> _Integers:
        """(m,2), the smaller number first."""
    @property
    def reference_length(self) -> _Floats:
        """(m), m."""
    @property
    def strength_factor(self) -> _Floats:
        """(m), strength over that of the material."""
    def __len__(self) -> int: ...

class Run:
    """A run file R.h5, all of it."""
    @property
    def evaluation(self) -> Evaluation:
        """Its result."""
    @property
    def design(self) -> Design:
        """The design that was run."""
    @property
    def program_version(self) -> str:
        """That wrote it."""
    @property
    def frame_strains(self) -> _Floats:
        """Engineering strain of each frame, rising."""
    def frame(self, index: int) -> Frame:
        """Reads a frame from the file; -1: the last one."""
    @property
    def discs(self) -> Discs:
        """The discs before the compression."""
    @property
    def openings(self) -> list[Outline]:
        """Openings before the compression."""
    @property
    def bonds(self) -> Bonds:
        """The bonds before the compression."""
    @property
    def events(self) -> Table:
        """Broken bonds, a row each: time (s), strain, bond, i, j, x, y (m), mode (0 tension, 1 shear), energy (J/m)."""

class ElasticResponse:
    """The linear response of a block of n discs."""
    @property
    def stiffness(self) -> _Floats:
        """(3,3) of xx, yy, xy with engineering shear, Pa."""
    @property
    def affine_stiffness(self) -> _Floats:
        """The same without relaxation, Pa."""
    @property
    def discs(self) -> Discs:
        """Of the block."""
    @property
    def openings(self) -> list[Outline]:
        """Of the block."""
    @property
    def displacement(self) -> list[_Floats]:
        """Three arrays (n,3), for unit strain xx, yy, xy: x and y in m, rotation in rad."""
    @property
    def disc_strain(self) -> _Floats:
        """(n), strain at which the first bond of a disc yields; infinite: none does."""
    @property
    def first_bonds(self) -> Table:
        """Bonds that yield first."""
    @property
    def design(self) -> Design:
        """The design."""
    @property
    def record(self) -> dict[str, Any]:
        """The file's record."""

class MaterialTest:
    """One test of a solid sample."""
    @property
    def name(self) -> str:
        """"tension", "compression", "shear", "oedometric"."""
    @property
    def replicate(self) -> int:
        """0, 1, ..."""
    @property
    def curve(self) -> Table:
        """strain, stress (Pa), lateral_strain, lateral_stress (Pa), damage, work, cundall (J/m), broken_bonds."""

class MaterialTests:
    """The tests of one material."""
    @property
    def tests(self) -> list[MaterialTest]:
        """By name, then by replicate."""
    @property
    def sample(self) -> Discs:
        """Discs of the sample."""
    @property
    def design(self) -> Design:
        """The design."""
    @property
    def record(self) -> dict[str, Any]:
        """The file's record."""

def read_run(file: _Path) -> Run: ...
def read_packing(file: _Path) -> Packing: ...
def read_elastic(file: _Path) -> ElasticResponse: ...
def read_material_tests(file: _Path) -> MaterialTests: ...
def read_table(file: _Path) -> Table: ...
def kind_of(path: _Path) -> str: ...
def stored_record(path: _Path) -> Optional[dict[str, Any]]: ...

class Progress:
    """How far work has come."""
    @property
    def fraction(self) -> float:
        """Done, 0 to 1; a smaller one than before is of the next part."""
    @property
    def text(self) -> str:
        """For people."""
    @property
    def strain(self) -> float:
        """Of a compression; NaN of other work."""
    @property
    def stress(self) -> float:
        """Of a compression, Pa; NaN of other work."""
    @property
    def finished(self) -> int:
        """Evaluations of a campaign."""
    @property
    def remaining(self) -> int:
        """Evaluations of a campaign that may still come, at most."""
    @property
    def seconds(self) -> float:
        """Wall time so far, s."""
    @property
    def seconds_left(self) -> float:
        """Expected, s; NaN while it is not known."""

def pack(
    design: _DesignSource,
    *,
    replicate: int = ...,
    threads: int = ...,
    file: Optional[_Path] = ...,
    force: bool = ...,
    progress: _OnProgress = ...,
) -> Packing: ...
def evaluate(
    design: _DesignSource,
    *,
    replicate: int = ...,
    threads: int = ...,
    run_file: Optional[_Path] = ...,
    packing_file: Optional[_Path] = ...,
    resume: bool = ...,
    force: bool = ...,
    wall_time: float = ...,
    memory: float = ...,
    progress: _OnProgress = ...,
) -> Evaluation: ...
def score(design: _DesignSource, replicates: Sequence[Evaluation]) -> float: ...

class Campaign:
    """What is in the folder of a campaign."""
    @property
    def kind(self) -> Literal["study", "sweep", "ensemble", "calibration"]:
        """"study", "sweep", "ensemble" or "calibration"."""
    @property
    def folder(self) -> Path:
        """Where it lies."""
    @property
    def status(self) -> _Status:
        """"completed", "stopped" (also while it is under way) or "failed"."""
    @property
    def reason(self) -> str:
        """In words."""
    @property
    def rows(self) -> Table:
        """A row a candidate of a study, a case of a sweep, a replicate of an ensemble, a point of a calibration."""
    @property
    def best(self) -> Optional[Design]:
        """The best design of a study, the design with calibrated parameters; None."""
    @property
    def verdict(self) -> Verdict:
        """Of a study (on fresh seeds) or an ensemble."""
    @property
    def record(self) -> Optional[dict[str, Any]]:
        """The record of the result; None before there is one."""

def run_campaign(
    file: _Path,
    folder: _Path,
    *,
    changes: Optional[_Changes] = ...,
    workers: int = ...,
    threads: int = ...,
    resume: bool = ...,
    force: bool = ...,
    program: Optional[_Path] = ...,
    best_run_file: bool = ...,
    progress: _OnProgress = ...,
) -> Campaign: ...
def run_ensemble(
    design: _DesignSource,
    replicates: int,
    folder: _Path,
    *,
    threads: int = ...,
    resume: bool = ...,
    force: bool = ...,
    progress: _OnProgress = ...,
) -> Campaign: ...
def read_campaign(folder: _Path) -> Campaign: ...

class Trial:
    """One evaluation that a study wants; may be pickled and evaluated anywhere."""
    @property
    def key(self) -> str:
        """Its name within the study."""
    @property
    def label(self) -> str:
        """Of its candidate, for people."""
    @property
    def replicate(self) -> int:
        """Which packing and strength field: 0, 1, ..."""
    @property
    def request(self) -> str:
        """All of it as JSON."""
    @property
    def design(self) -> Design:
        """The design as it is to be run."""
    def evaluate(self, *, threads: int = ..., run_file: Optional[_Path] = ...) -> Evaluation:
        """Evaluates it; needs nothing of the study. run_file: R.h5 to write, or to go on from. A design that cannot be
        evaluated is the status "failed", which the study is told, too."""

class Study:
    """The search of a study file, in a folder that it alone may use until it is closed. What it asks depends on what it
    was told only, not on the order or on who evaluated. `with` closes it. changes: keys of the file or its design.
    resume: go on with what the folder has. force: remove an earlier study first."""
    def __init__(
        self,
        file: _Path,
        folder: _Path,
        *,
        changes: Optional[_Changes] = ...,
        resume: bool = ...,
        force: bool = ...,
    ) -> None: ...
    def ask(self, most: int = ..., *, again: bool = ...) -> list[Trial]:
        """Trials that can be evaluated now, at most `most` (0: all), none that was given before unless `again`. Empty
        where everything waits for those given before, and once the study is finished."""
    def tell(self, trial: Trial, evaluation: Evaluation) -> None:
        """Writes the evaluation of a trial into the journal; then ask() has what follows from it. A trial that was told
        before is left alone."""
    @property
    def finished(self) -> bool:
        """Whether nothing is left to ask."""
    def close(self) -> Campaign:
        """Writes the results into the folder, gives it free and reads it back. One that is not finished goes on with
        resume."""
    def __enter__(self) -> Study: ...
    def __exit__(
        self,
        kind: Optional[type[BaseException]],
        error: Optional[BaseException],
        traceback: Optional[TracebackType],
    ) -> None: ...
