"""What files, plots and reports of a profile are made of: its columns, words of its flags, marked places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.flags import Flag

Floats = npt.NDArray[np.float64]


class Sections(Protocol):
    """The measured sections of a vessel: what :class:`lumencut.Profile` has of numbers."""

    def __len__(self) -> int: ...

    @property
    def arc_length(self) -> Floats:
        """Arc length (mm), shape (n,)."""

    @property
    def diameter_min(self) -> Floats:
        """The shortest diameter (mm), shape (n,)."""

    @property
    def diameter_max(self) -> Floats:
        """The longest diameter (mm), shape (n,)."""

    @property
    def diameter_mean(self) -> Floats:
        """The mean of both (mm), shape (n,)."""

    @property
    def diameter_equivalent(self) -> Floats:
        """The diameter of a circle of the same area (mm), shape (n,)."""

    @property
    def area(self) -> Floats:
        """The area (mm²), shape (n,)."""

    @property
    def uncertainty(self) -> Floats:
        """The standard deviation of the diameter (mm), shape (n,)."""

    @property
    def inscribed_radius(self) -> Floats:
        """The radius of the largest ball within (mm), shape (n,)."""

    @property
    def center(self) -> Floats:
        """The middle (mm, LPS), shape (n, 3)."""

    @property
    def normal(self) -> Floats:
        """The unit vector along the vessel, shape (n, 3)."""

    @property
    def levels(self) -> Floats:
        """The levels of lumen and background, shape (n, 2)."""

    @property
    def flags(self) -> npt.NDArray[np.uint32]:
        """Bits of :class:`lumencut.Flag`, shape (n,)."""

    @property
    def noise(self) -> float:
        """The standard deviation of a voxel."""

    @property
    def fwhm(self) -> float:
        """The width of the point spread (mm)."""

    @property
    def fwhm_source(self) -> str:
        """How that was found."""

    def narrowest(self) -> tuple[float, float] | None:
        """Return the narrowest place and its diameter (mm)."""

    def widest(self) -> tuple[float, float] | None:
        """Return the widest place and its longest diameter (mm)."""

    def suggested_references(
        self, at: float
    ) -> tuple[tuple[float, float] | None, tuple[float, float] | None]:
        """Return places before and after another one and their diameters (mm)."""

    def diameter_at(self, at: float) -> tuple[float, float]:
        """Return the diameter at a place and its standard deviation (mm)."""


@dataclass(frozen=True)
class Mark:
    """A place on a vessel that somebody should look at.

    Attributes
    ----------
    name : str
        What it is: the place of a stenosis, a reference, or the narrowest place.
    arc_length, diameter : float
        Where it is, and the diameter of a circle of the same area there (mm).
    is_suggestion : bool
        Whether Lumencut offers it; a reader named it otherwise.
    """

    name: str
    arc_length: float
    diameter: float
    is_suggestion: bool

    @property
    def title(self) -> str:
        """What it is, and whether it is but a suggestion."""
        return f"{self.name} (suggestion)" if self.is_suggestion else self.name

    def __str__(self) -> str:
        """The place in words, with its diameter."""
        return f"{self.title}: {self.diameter:.2f} mm at {self.arc_length:.1f} mm"


def counts(sections: Sections) -> npt.NDArray[np.bool_]:
    """Return which sections count for extrema, suggestions and references, shape (n,)."""
    is_kept: npt.NDArray[np.bool_] = (sections.flags & _lumencut.MEASURING_LEFT_OUT) == 0
    return is_kept & np.isfinite(sections.area)


def flag_words(flags: int) -> list[str]:
    """Return the names of flags as words, such as ``no edge``."""
    return [word_of(flag) for flag in Flag if flags & flag]


def word_of(flag: Flag) -> str:
    """Return the name of a flag as words."""
    return str(flag.name).lower().replace("_", " ")


def nearest(sections: Sections, at: float) -> int:
    """Return the number of the section that is nearest to an arc length (mm), the first of two."""
    return int(np.argmin(np.abs(sections.arc_length - at)))


def columns(sections: Sections) -> dict[str, Floats]:
    """Return the numbers of sections by their names with units, each of shape (n,)."""
    found = {
        "arc_length_mm": sections.arc_length,
        "diameter_equivalent_mm": sections.diameter_equivalent,
        "uncertainty_mm": sections.uncertainty,
        "diameter_min_mm": sections.diameter_min,
        "diameter_max_mm": sections.diameter_max,
        "diameter_mean_mm": sections.diameter_mean,
        "area_mm2": sections.area,
        "inscribed_radius_mm": sections.inscribed_radius,
    }
    for n, axis in enumerate("xyz"):
        found[f"center_{axis}_lps_mm"] = sections.center[:, n]
    for n, axis in enumerate("xyz"):
        found[f"normal_{axis}_lps"] = sections.normal[:, n]
    return found | {"lumen_level": sections.levels[:, 0], "background_level": sections.levels[:, 1]}


def marks(sections: Sections, at: float | None = None, references: Sequence[float] = ()) -> list[Mark]:
    """Return the places to look at: those that a reader named, and suggestions for what was not named.

    Raises
    ------
    MeasuringError
        For a place beyond the vessel or where nothing was measured.
    """
    found = []
    if at is not None:
        found.append(Mark("marked place", at, sections.diameter_at(at)[0], is_suggestion=False))
    elif (narrowest := sections.narrowest()) is not None:
        place = narrowest[0]
        found.append(Mark("narrowest place", place, sections.diameter_at(place)[0], is_suggestion=True))
    found += [
        Mark("reference", place, sections.diameter_at(place)[0], is_suggestion=False) for place in references
    ]
    if found and not references:
        spots = [spot for spot in sections.suggested_references(found[0].arc_length) if spot is not None]
        # The diameter there, as of the others; references of a stenosis are medians around their place.
        found += [
            Mark("reference", place, sections.diameter_at(place)[0], is_suggestion=True) for place, _ in spots
        ]
    return found
