"""Gaps between the pieces of a vessel tree."""

from __future__ import annotations

from dataclasses import dataclass

from lumencut.base.pickles import by_name


@by_name
@dataclass(frozen=True)
class Gap:
    """A place where lumen is missing between two pieces of a mask.

    Attributes
    ----------
    width : float
        Distance of the two pieces there (mm): from the end of one centerline to the end of the other, or to
        the wall of the other vessel if its nearest point is not an end.
    vessels : tuple of 2 int
        The ids of the vessels on both sides.
    points : tuple of 2 tuples of 3 float
        The points of their centerlines there (mm, LPS).
    bridged : bool
        Whether a vessel of the tree bridges it, because a bridge was requested.
    """

    width: float
    vessels: tuple[int, int]
    points: tuple[tuple[float, float, float], tuple[float, float, float]]
    bridged: bool
