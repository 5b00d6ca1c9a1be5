"""Flags of measured sections."""

from __future__ import annotations

from enum import IntFlag
from typing import Any

from lumencut._pickles import restored


class Flag(IntFlag):
    """Flags of a section; sections keep their numbers with any flag.

    Sections with `BRANCH`, `OUTSIDE`, `NO_EDGE`, `RECENTERED` or `RESTLESS_LINE` are excluded from extrema,
    suggestions and references.
    """

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Return the pickle: the name of the class and the bits."""
        return restored(), ("Flag", int(self))

    #: The diameter is below 1.5 times the width (FWHM) of the point spread.
    AT_LIMIT = 1
    #: The section lies within a junction, or the lumen continues sideways.
    BRANCH = 2
    #: Something in the wall is brighter than lumen; it is not lumen, and what it touches is not fitted.
    CALCIUM = 4
    #: Something brighter than lumen goes all around it, or is far brighter: a stent, or metal.
    METAL = 8
    #: Another lumen or bone is next to the wall.
    NEIGHBOR = 16
    OUTSIDE = 32
    #: No wall was found, or it does not enclose a lumen; numbers are NaN, or unreliable.
    NO_EDGE = 64
    #: The vessel's point lies outside of the lumen, whose middle was found elsewhere.
    RECENTERED = 128
    #: The wall is far from an ellipse.
    IRREGULAR = 256
    #: The centerline turns by more than 75° within one diameter, as no vessel does.
    RESTLESS_LINE = 512
