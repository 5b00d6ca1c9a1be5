"""What plots and reports show of a profile: names of flags, and marked places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.measuring.profile_numbers import ProfileNumbers


@dataclass(frozen=True)
class Mark:
    """A place on a vessel to check.

    Attributes
    ----------
    name : str
        Its kind: the place of a stenosis, a reference, the narrowest place, or a noted diameter.
    arc_length, diameter : float
        Its place, and the diameter of a circle of the same area there (mm), or NaN at a throat.
    is_suggestion : bool
        Whether Lumencut suggested it; otherwise a reader marked it.
    words : str
        The diameter in words, or its limit.
    """

    name: str
    arc_length: float
    diameter: float
    is_suggestion: bool
    words: str

    @property
    def is_reference(self) -> bool:
        """Return whether it is a reference of a stenosis."""
        return self.name == "reference"

    @property
    def is_noted(self) -> bool:
        """Whether a reader only noted the diameter, regardless of grading."""
        return self.name == "noted diameter"

    @property
    def title(self) -> str:
        """Return its name, and whether it is only a suggestion."""
        return f"{self.name} (suggestion)" if self.is_suggestion else self.name

    def __str__(self) -> str:
        """Return the place in words, with its diameter."""
        return f"{self.title}: {self.words} at {self.arc_length:.1f} mm"


def counts(sections: ProfileNumbers) -> npt.NDArray[np.bool_]:
    """Return which sections count for extrema, suggestions and references, shape (n,)."""
    return sections._core.counts


def flag_words(flags: int) -> list[str]:
    """Return the names of flags as words, such as ``no clear wall``."""
    return _lumencut.flag_words(flags)


def nearest(sections: ProfileNumbers, at: float) -> int:
    """Return the number of the section that is nearest to an arc length (mm), the first of two."""
    return sections._core.nearest(at)


def marks(sections: ProfileNumbers, at: float | None = None, references: Sequence[float] = ()) -> list[Mark]:
    """Return the places to check: those that a reader marked, and suggestions for the others.

    Raises
    ------
    MeasuringError
        For a place beyond the vessel or where nothing was measured.
    """
    found = _lumencut.profile_marks(sections._core, at, list(references))
    return [Mark(*parts) for parts in found]
