"""The TOML file that defines what to do with every study of a cohort."""

from __future__ import annotations

import difflib
import hashlib
import json
import os
import tomllib
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lumencut.base.paths import checked_path
from lumencut.errors import FileError, FormatError

if TYPE_CHECKING:
    from lumencut.reformations.planar_reformation import Mode

_EXPECTED = "a recipe, as shown in docs/cohorts.md"
_LARGEST = 1 << 20


@dataclass(frozen=True)
class Reading:
    """How irregular DICOM series are read; as for :func:`lumencut.read_volume`.

    Attributes
    ----------
    fill_gaps : bool
        Whether to interpolate missing slices.
    resample_slices : bool
        Whether to resample slices of uneven spacing to a regular grid.
    """

    fill_gaps: bool = False
    resample_slices: bool = False


@dataclass(frozen=True)
class Centerlines:
    """How vessels are found or traced if a study has no centerlines.

    Attributes
    ----------
    smallest_radius : float or None
        As for :func:`lumencut.find_vessels` (mm).
    doubtful : bool
        Whether to keep uncertain vessels.
    all_parts : bool
        Whether to keep all parts, not only the most important one.
    shortest_branch : float
        As for :func:`lumencut.trace_mask` (radii).
    bridge : bool
        As for :func:`lumencut.trace`.
    """

    smallest_radius: float | None = None
    doubtful: bool = False
    all_parts: bool = False
    shortest_branch: float = 2.0
    bridge: bool = False


@dataclass(frozen=True)
class Pictures:
    """The pictures: each view with each look.

    Attributes
    ----------
    views : tuple of str
        Names of views, see :data:`lumencut.VIEWS`; empty for no pictures.
    looks : tuple of str
        Names of looks, see ``Settings.look``.
    size : tuple of 2 int
        Width and height (pixels).
    reformations : tuple of str
        Modes of :func:`lumencut.cpr`; each makes a picture of all vessels side by side.
    annotate : bool
        Whether pictures have labels.
    """

    views: tuple[str, ...] = ("anterior",)
    looks: tuple[str, ...] = ("focus",)
    size: tuple[int, int] = (768, 768)
    reformations: tuple[Mode, ...] = ()
    annotate: bool = True


@dataclass(frozen=True)
class Measure:
    """How lumina are measured.

    Attributes
    ----------
    vessels : bool
        Whether to measure vessels.
    step : float
        The largest distance between sections (mm).
    fwhm : float or None
        As for :func:`lumencut.measure` (mm); a column ``fwhm`` of the manifest takes precedence.
    wall : tuple of 2 float, "off" or None
        As for :func:`lumencut.measure`.
    """

    vessels: bool = True
    step: float = 0.5
    fwhm: float | None = None
    wall: tuple[float, float] | Literal["off"] | None = None


@dataclass(frozen=True)
class Outputs:
    """Outputs in addition to pictures and tables.

    Attributes
    ----------
    centerlines : bool
        The centerlines of each study (``.vtp``).
    report : bool
        A report of each study's measures (``.html``).
    """

    centerlines: bool = True
    report: bool = False


@dataclass(frozen=True)
class CohortRecipe:
    """The work on every study; by default the tree, one view of the look *focus*, and measures."""

    reading: Reading = field(default_factory=Reading)
    centerlines: Centerlines = field(default_factory=Centerlines)
    pictures: Pictures = field(default_factory=Pictures)
    measure: Measure = field(default_factory=Measure)
    outputs: Outputs = field(default_factory=Outputs)

    @property
    def digest(self) -> str:
        """Return the beginning of the SHA-256 of all values: sixteen letters that identify the recipe."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()[:16]


_PARTS: dict[str, Any] = {
    "reading": Reading,
    "centerlines": Centerlines,
    "pictures": Pictures,
    "measure": Measure,
    "outputs": Outputs,
}


def read_cohort_recipe(path: str | os.PathLike[str] | None) -> CohortRecipe:
    """Read the recipe for every study.

    Parameters
    ----------
    path : str or path, optional
        A TOML file with the tables ``reading``, ``centerlines``, ``pictures``, ``measure`` and ``outputs``,
        whose keys are the fields of the classes in this module; missing keys have their defaults.

    Returns
    -------
    CohortRecipe
        The checked recipe, so that no study fails because of a mistake in it.

    Raises
    ------
    FormatError
        For a file that is not TOML, an unknown key (similar ones are named), and values of another kind.
    FileError
        For a file that is missing or unreadable.
    """
    if path is None:
        return CohortRecipe()
    place = checked_path(path, _EXPECTED)
    parsed = _parsed(place)
    for name in parsed:
        if name not in _PARTS:
            raise _unknown(place, name, list(_PARTS))
    return CohortRecipe(**{name: _part(place, name, value) for name, value in parsed.items()})


def _parsed(path: Path) -> dict[str, Any]:
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise FileError(str(path), error.strerror or str(error), _EXPECTED) from error
    try:
        return tomllib.loads(content[:_LARGEST].decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise FormatError(str(path), f"invalid TOML ({error})", _EXPECTED) from error


def _part(path: Path, name: str, value: Any) -> Any:
    """Return one table of the recipe as an object of its class."""
    if not isinstance(value, dict):
        raise FormatError(f"{name} of {path}", f"{value!r:.80}", f"a table [{name}]")
    known = [one.name for one in fields(_PARTS[name])]
    for key in value:
        if key not in known:
            raise _unknown(path, key, known, f"[{name}]")
    made = {key: _checked(f"{name}.{key} of {path}", key, given) for key, given in value.items()}
    return _PARTS[name](**made)


def _unknown(path: Path, key: str, known: list[str], where: str = "the recipe") -> FormatError:
    near = difflib.get_close_matches(key.lower().replace("-", "_"), known, 3, 0.6)
    mend = f"perhaps {' or '.join(near)} is meant" if near else ""
    return FormatError(str(path), f"the key {key[:80]!r} in {where}", f"one of {', '.join(known)}", mend)


_FLAGS = {
    *("fill_gaps", "resample_slices", "doubtful", "all_parts", "bridge", "annotate", "vessels"),
    *("centerlines", "report"),
}
_RANGES = {
    "smallest_radius": (0.0, 100.0),
    "shortest_branch": (0.0, 1000.0),
    "step": (0.01, 100.0),
    "fwhm": (0.01, 20.0),
}
_SIZES = (16, 8192)


def _checked(subject: str, key: str, value: Any) -> Any:
    """Return the checked value of a key in the type of its field."""
    if key in _FLAGS:
        if not isinstance(value, bool):
            raise FormatError(subject, f"{value!r:.80}", "true or false")
        return value
    if key in _RANGES:
        low, high = _RANGES[key]
        if not _is_number(value) or not low <= value <= high:
            raise FormatError(subject, f"{value!r:.80}", f"a number from {low:g} to {high:g}")
        return float(value)
    if key == "wall":
        return _wall(subject, value)
    if key == "size":
        is_pair = isinstance(value, list) and len(value) == 2 and all(type(side) is int for side in value)
        if not is_pair or not all(_SIZES[0] <= side <= _SIZES[1] for side in value):
            expected = f"width and height in pixels, {_SIZES[0]} to {_SIZES[1]}, such as [768, 768]"
            raise FormatError(subject, f"{value!r:.80}", expected)
        return tuple(value)
    return _names(subject, value, _choices(key))


def _choices(key: str) -> tuple[str, ...]:
    from lumencut._lumencut import LOOKS
    from lumencut.reformations.planar_reformation import MODES
    from lumencut.scene.camera import VIEWS

    return {"views": tuple(VIEWS), "looks": tuple(LOOKS), "reformations": MODES}[key]


def _names(subject: str, value: Any, choices: tuple[str, ...]) -> tuple[str, ...]:
    names = [value] if isinstance(value, str) else value
    if not isinstance(names, list) or not all(name in choices for name in names):
        raise FormatError(subject, f"{value!r:.80}", f"a list of names from: {', '.join(choices)}")
    if len(set(names)) < len(names):
        raise FormatError(subject, f"{value!r:.80}", "each name once")
    return tuple(names)


def _wall(subject: str, value: Any) -> tuple[float, float] | Literal["off"] | None:
    if value in ("auto", "off"):
        return None if value == "auto" else "off"
    if isinstance(value, list) and len(value) == 2 and all(map(_is_number, value)) and value[1] > 0:
        return float(value[0]), float(value[1])
    raise FormatError(subject, f"{value!r:.80}", '"auto", "off", or level and deviation such as [45, 25]')


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
