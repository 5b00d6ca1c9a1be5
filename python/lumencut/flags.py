"""What there is to know of a measured section beside its numbers."""

from __future__ import annotations

from enum import IntFlag
from typing import Any

from lumencut._pickles import restored


class Flag(IntFlag):
    """What there is to know of a section; sections keep their numbers whatever is set.

    Sections with `BRANCH`, `OUTSIDE`, `NO_EDGE`, `RECENTERED` or `RESTLESS_LINE` are left out of what is
    narrowest, widest or suggested, and of references.
    """

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Return what is pickled: the name of the class and the bits."""
        return restored(), ("Flag", int(self))

    #: The diameter is below 1.5 times the width (FWHM) of the point spread.
    AT_LIMIT = 1
    #: The section lies within a junction, or lumen goes on sideways.
    BRANCH = 2
    #: Something in the wall is brighter than lumen; it is no lumen, and what it touches is not fitted.
    CALCIUM = 4
    #: Something brighter than lumen goes all around it, or is far brighter: a stent, or metal.
    METAL = 8
    #: Another lumen or bone is beside the wall.
    NEIGHBOR = 16
    #: The section reaches beyond the volume.
    OUTSIDE = 32
    #: No wall was found, or what it encloses is no lumen; numbers are NaN, or not to be used.
    NO_EDGE = 64
    #: The vessel's point lies outside of the lumen, whose middle was found beside it.
    RECENTERED = 128
    #: The wall is far from an ellipse.
    IRREGULAR = 256
    #: The centerline turns by more than 75° within one diameter, as no vessel does.
    RESTLESS_LINE = 512
