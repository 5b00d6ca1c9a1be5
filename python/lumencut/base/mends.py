"""Remedies of errors: names for programs, and texts that each host writes with its own options."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, TypeAlias

from lumencut.base.pickles import by_name

MendName: TypeAlias = Literal[
    "bridge", "every_second", "cpu", "windows", "threshold", "fewer_pixels", "doubtful", "smaller_radius",
    "other_patient", "coordinates", "unit", "place", "reading", "reorder",
    "series", "phase", "fill_gaps", "resample_slices", "resample_and_fill",
]  # fmt: skip


class Option(NamedTuple):
    """An argument in Python, and the same option on the command line.

    Attributes
    ----------
    name : str
        The argument.
    value : str, bool or None
        Its value; None if the user chooses it.
    form : "whole", "again", "quoted" or "plain"
        Written as ``name=value``, as only the value after the same argument, or as only the name, quoted or
        plain.
    """

    name: str
    value: str | bool | None
    form: Literal["whole", "again", "quoted", "plain"] = "whole"


Write: TypeAlias = Callable[[Option], str]

_Parts: TypeAlias = tuple[str | Option, ...]


def as_argument(option: Option) -> str:
    """Return the option as an argument in Python."""
    value = f'"{option.value}"' if isinstance(option.value, str) else option.value
    return {
        "whole": f"{option.name}={'' if value is None else value}",
        "again": f"{value}",
        "quoted": f"`{option.name}`",
        "plain": option.name,
    }[option.form]


#: Placeholders for values of options, as in the help of the command line.
_VALUES = {"series": "NUMBER|UID", "phase": "VALUE"}


def as_option(option: Option) -> str:
    """Return the option as on the command line."""
    name = f"--{option.name.replace('_', '-')}"
    if option.form == "quoted":
        return f"{name} {_VALUES[option.name]}"
    return f"{name} {option.value}" if isinstance(option.value, str) else name


@by_name
@dataclass(frozen=True)
class Mend:
    """A remedy of an error; its text is worded for Python.

    Attributes
    ----------
    name : str
        The same on every host: "bridge", "every_second", "cpu", "windows", "threshold", "fewer_pixels",
        "doubtful" and "smaller_radius" of tracing, devices and volumes; "other_patient" of comparing;
        "coordinates", "unit", "place", "reading" and "reorder" of centerlines; "series", "phase",
        "fill_gaps", "resample_slices" and "resample_and_fill" of DICOM.
    values : tuple of str
        The choices, such as units or phases; empty if there are none.
    """

    name: MendName
    values: tuple[str, ...] = ()

    def __str__(self) -> str:
        return self.written(as_argument)

    def written(self, write: Write) -> str:
        """Return the text; the host writes the options in it."""
        return _written(WORDS[self.name](self.values), write)


def _one_of(name: str, values: Sequence[str]) -> _Parts:
    parts: list[str | Option] = ["give "]
    for value in values:
        parts += [Option(name, value), " or "]
    return tuple(parts[:-1])


def _place(_: Sequence[str]) -> _Parts:
    either = Option("coordinates", "lps"), " or ", Option("coordinates", "ras", form="again")
    return ("give ", *either, " and the unit if the file belongs to this volume")


def _reading(values: Sequence[str]) -> _Parts:
    """Return the options for space and unit of each possible reading, such as ``lps in cm``."""
    parts: list[str | Option] = []
    for value in values:
        space, unit = value.split(" in ")
        parts += [", or " if parts else "give ", Option("coordinates", space), " and ", Option("unit", unit)]
    return tuple(parts or ["give the space and the unit"])


def _resampled(_: Sequence[str]) -> _Parts:
    return (Option("resample_slices", value=True), " puts them on a regular grid")


def _fewer_pixels(_: Sequence[str]) -> _Parts:
    spacing, width = (Option(name, None, "plain") for name in ("pixel_spacing", "width"))
    return ("a larger ", spacing, " or a smaller ", width, " makes fewer")


def _windows(_: Sequence[str]) -> _Parts:
    both = Option("window", None), " and ", Option("context_window", None)
    return ("give ", *both, " where they stand for nothing")


_THRESHOLD = "compare the values with a threshold first, as --threshold of the command line does"

WORDS: dict[MendName, Callable[[Sequence[str]], _Parts]] = {
    "bridge": lambda _: ("ask for a bridge where it is occluded",),
    "every_second": lambda _: ("take every second voxel along each axis, an eighth of all",),
    "cpu": lambda _: ("compute with the device 'cpu'",),
    "windows": _windows,
    "threshold": lambda _: (_THRESHOLD,),
    "fewer_pixels": _fewer_pixels,
    "doubtful": lambda _: ("look at the doubtful ones in the viewer",),
    "smaller_radius": lambda _: ("ask for a smaller radius",),
    "other_patient": lambda _: ("insist with ", Option("other_patient", value=True)),
    "coordinates": lambda values: _one_of("coordinates", values),
    "unit": lambda values: _one_of("unit", values),
    "place": _place,
    "reading": _reading,
    "reorder": lambda _: (Option("reorder", value=True), " puts the points of the file in order"),
    "series": lambda _: ("its number or UID as ", Option("series", None, "quoted")),
    "phase": lambda _: ("give the value of the one to read as ", Option("phase", None, "quoted")),
    "fill_gaps": lambda _: ("have them interpolated with ", Option("fill_gaps", value=True)),
    "resample_slices": _resampled,
    "resample_and_fill": lambda values: (
        *_resampled(values), " together with ", Option("fill_gaps", value=True),
    ),
}  # fmt: skip


class Told(str):
    """A text with options, which each host writes in its own form.

    Attributes
    ----------
    advice : str
        The words that name no options.
    mends : tuple of Mend
        The remedies of the error; empty for a text without an error.
    """

    advice: str
    mends: tuple[Mend, ...]
    _parts: _Parts

    def __new__(cls, *parts: str | Option, advice: str = "", mends: tuple[Mend, ...] = ()) -> Told:
        """Create a text from strings and options."""
        made = super().__new__(cls, _written(parts, as_argument))
        made.advice, made.mends, made._parts = advice, mends, parts
        return made

    def __reduce__(self) -> Any:
        return _remade, (self._parts, self.advice, self.mends)

    def written(self, write: Write) -> str:
        """Return the text; the host writes the options in it."""
        return _written(self._parts, write)

    def after(self, words: str) -> Told:
        """Return a new text: `words`, then this one."""
        return Told(words, *self._parts, advice=self.advice, mends=self.mends)


def _remade(parts: _Parts, advice: str, mends: tuple[Mend, ...]) -> Told:
    return Told(*parts, advice=advice, mends=mends)


def advised(advice: str, mends: Sequence[tuple[MendName, Sequence[str]]]) -> Told:
    """Return advice and remedies as one text; remedies are given by name and values."""
    typed = tuple(Mend(name, tuple(values)) for name, values in mends)
    parts: list[str | Option] = [advice] if advice else []
    for mend in typed:
        parts += [", or " if parts else "", *WORDS[mend.name](mend.values)]
    return Told(*parts, advice=advice, mends=typed)


def written(text: object, write: Write) -> str:
    """Return a text, an error or a warning; the host writes the options in it."""
    own = getattr(text, "written", None)
    return str(text) if own is None else str(own(write))


def _written(parts: Sequence[str | Option], write: Write) -> str:
    return "".join(write(part) if isinstance(part, Option) else part for part in parts)
