"""Flags of measured sections."""

from __future__ import annotations

from enum import IntFlag
from typing import Any

from lumencut.base.pickles import restored


class Flag(IntFlag):
    """Flags of a section; a flagged section keeps its numbers, except in a dim throat.

    Sections with `BRANCH`, `OUTSIDE`, `NO_EDGE`, `RECENTERED` or `RESTLESS_LINE` are excluded from extrema,
    suggestions and references.
    """

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Return the pickle: the name of the class and the bits."""
        return restored(), ("Flag", int(self))

    #: The diameter is below 1.5 times the FWHM, or twice the spacing of thick slices, or unsure by 7 %.
    AT_LIMIT = 1
    #: The section lies in a junction, or the lumen continues sideways.
    BRANCH = 2
    #: Something brighter than lumen lies in the wall; it is not lumen, and the fit leaves it out.
    CALCIUM = 4
    #: Something brighter than lumen surrounds it, is much brighter, or repeats along it: a stent.
    METAL = 8
    #: Another lumen or bone is next to the wall.
    NEIGHBOR = 16
    OUTSIDE = 32
    #: No wall was found, or it does not enclose a lumen; numbers are NaN, or unreliable.
    NO_EDGE = 64
    #: The centerline lies outside the lumen; the middle of the lumen was found elsewhere.
    RECENTERED = 128
    #: The wall differs much from an ellipse.
    IRREGULAR = 256
    #: The centerline turns by more than 75° within one diameter, which no vessel does.
    RESTLESS_LINE = 512
    #: Plaque nearly as bright as the lumen lies beside it; the uncertainty includes it.
    PLAQUE = 1024
    #: A reader drew the contour in the viewer.
    BY_HAND = 2048
    #: A reader moved the centerline in the viewer.
    LINE_BY_HAND = 4096
