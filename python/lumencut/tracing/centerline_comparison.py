"""Comparison of traced centerlines with a reference, by the measures of the Rotterdam coronary evaluation.

Schaap et al., "Standardized evaluation methodology and reference database for evaluating coronary artery
centerline extraction algorithms", Medical Image Analysis 13(5), 2009, doi:10.1016/j.media.2009.06.003.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import number
from lumencut.base.pickles import by_name
from lumencut.errors import SettingsError, VesselTreeError
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.tracing.centerline_paths import CenterlinePaths

#: Errors within this distance from the start of the reference (mm) do not count as the first error.
_FREE_START = 5.0

#: The part of a reference up to its last point with at least this radius (mm) is clinically relevant.
_RELEVANT_RADIUS = 0.75

#: Radius of the disc at the start of the reference, as a multiple of the radius of the vessel there.
_DISC = 2.0

_Points = npt.NDArray[np.float64]


@by_name
@dataclass(frozen=True)
class CenterlineComparison:
    """Result of :func:`lumencut.compare_centerlines`; shares are from 0 to 1, NaN if nothing counts.

    Attributes
    ----------
    ov : float
        Overlap: the share of points of both lines that are connected to a point of the other line closer
        than the radius of the reference at that point.
    of : float
        Overlap until the first error: the share of the reference before its first unmatched point; points
        in the first 5 mm do not count.
    ot : float
        Overlap of the clinically relevant part: as ``ov``, for the reference up to its last point with a
        radius of at least 0.75 mm, and for the points connected to that part.
    ai : float
        Accuracy inside: the mean length of the connections that are shorter than the radius (mm).
    length : float
        Length of the reference (mm).
    first_error : float or None
        Position of the first error along the reference (mm); None if there is no error, and for trees.
    false_length : float
        Length of the traced vessels outside the lumen of the reference (mm): each point of the reference is
        farther away than its own radius.
    vessels : tuple of CenterlineComparison
        For a tree, the comparison of each vessel of the reference, in order.
    """

    ov: float
    of: float
    ot: float
    ai: float
    length: float
    first_error: float | None
    false_length: float
    vessels: tuple[CenterlineComparison, ...] = ()


def compare_centerlines(
    traced: Vessel | VesselTree, reference: Vessel | VesselTree, *, sampling: float = 0.03
) -> CenterlineComparison:
    """Compare traced centerlines with a reference, as the Rotterdam coronary evaluation does.

    Both lines are sampled at equal distances. The part of the traced line before it first crosses the disc at
    the start of the reference is left out; the disc is perpendicular to the reference and twice as wide as
    the vessel. Connections join points of both lines, from both starts to both ends: from each connection to
    the next, one of the lines advances by a point, and the total length is minimal. A connection counts if it
    is shorter than the radius of the reference at its point. Even identical lines have connections of one
    sampling distance, so ``ai`` is at least half of it.

    Two vessels are compared as they are; the traced one is reversed if its ends fit better then. In a tree
    each vessel of the reference is compared with the shortest path through the traced tree: within the
    connected piece nearest to most of the reference, from the point nearest to its start to the point nearest
    to its end. So it does not matter where vessels are split. ``ov``, ``ot`` and ``ai`` then cover all points
    and connections together, and ``of`` is the mean over the length of the reference. Only ``false_length``
    covers the rest of the traced tree.

    Parameters
    ----------
    traced : Vessel or VesselTree
        The centerlines to evaluate (mm, LPS).
    reference : Vessel or VesselTree
        The true centerlines, with radii.
    sampling : float, default 0.03
        Distance between the sampled points (mm), as in the paper. Time and memory grow with the square of the
        number of points: one bit for each pair.

    Returns
    -------
    CenterlineComparison

    Raises
    ------
    VesselTreeError
        For anything but vessels and trees, a reference without radii, or lines too long for the sampling.
    SettingsError
        For a sampling that is not above 0.
    KeyboardInterrupt
        After Ctrl-C.
    """
    step = number(SettingsError, "sampling", sampling)
    if not 0 < step < float("inf"):
        raise SettingsError("sampling", f"{step:g}", "a distance above 0 (mm)")
    for what, given in (("traced centerlines", traced), ("reference", reference)):
        if not isinstance(given, (Vessel, VesselTree)):
            raise VesselTreeError(what, type(given).__name__, "a Vessel or a VesselTree")
    references = (reference,) if isinstance(reference, Vessel) else tuple(reference)
    for index, vessel in enumerate(references):
        if vessel.radius is None:
            raise VesselTreeError(f"vessel {index} of the reference", "no radius", "a radius at each point")
    false_length = _false_length(traced, references)
    if isinstance(traced, Vessel) and isinstance(reference, Vessel):
        return _summary([_counted(_like(traced.points, reference.points), reference, step)], false_length)
    paths = CenterlinePaths((traced,) if isinstance(traced, Vessel) else tuple(traced))
    counts = [_counted(paths.along(vessel.points), vessel, step) for vessel in references]
    return _summary(counts, false_length, tuple(_summary([one], float("nan")) for one in counts))


@dataclass(frozen=True)
class _Counts:
    """Counts for one vessel of the reference: correct points, all points, connections in the lumen."""

    right: int
    all: int
    relevant_right: int
    relevant: int
    before_error: int
    reference: int
    inside: int
    inside_sum: float
    length: float


def _summary(
    counts: Sequence[_Counts], false_length: float, vessels: tuple[CenterlineComparison, ...] = ()
) -> CenterlineComparison:
    def share(part: str, whole: str) -> float:
        total = sum(getattr(one, whole) for one in counts)
        return float(sum(getattr(one, part) for one in counts) / total) if total else float("nan")

    length = sum(one.length for one in counts)
    first = counts[0]
    has_error = not vessels and first.before_error < first.reference
    first_error = length * first.before_error / (first.reference - 1) if has_error else None
    return CenterlineComparison(
        ov=share("right", "all"),
        of=sum(one.length * one.before_error / one.reference for one in counts) / length,
        ot=share("relevant_right", "relevant"),
        ai=share("inside_sum", "inside"),
        length=length,
        first_error=first_error,
        false_length=false_length,
        vessels=vessels,
    )


def _counted(traced: _Points | None, reference: Vessel, step: float) -> _Counts:
    """Count correct points along a vessel of the reference; without a match ``traced`` is None."""
    points, radius = _sampled(reference.points, step, reference.radius)
    length, count = reference.length, len(points)
    relevant = np.flatnonzero(radius >= _RELEVANT_RADIUS)
    part = int(relevant[-1]) + 1 if len(relevant) else 0
    if traced is None:
        free = min(count, int(np.ceil(_FREE_START / max(length, 1e-12) * (count - 1))))
        return _Counts(0, count, 0, part, free, count, 0, 0.0, length)
    line = _clipped(_sampled(traced, step)[0], points, _DISC * radius[0])
    pairs = _lumencut.correspondence(line, points)
    distance = np.linalg.norm(line[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    inside = distance < radius[pairs[:, 1]]
    right = np.bincount(pairs[inside, 1], minlength=count) > 0
    right_traced = np.bincount(pairs[inside, 0], minlength=len(line)) > 0
    in_part = np.bincount(pairs[pairs[:, 1] < part, 0], minlength=len(line)) > 0
    way = np.linspace(0.0, length, count)
    errors = np.flatnonzero(~right & (way >= _FREE_START))
    return _Counts(
        right=int(right.sum() + right_traced.sum()),
        all=count + len(line),
        relevant_right=int(right[:part].sum() + (right_traced & in_part).sum()),
        relevant=part + int(in_part.sum()),
        before_error=int(errors[0]) if len(errors) else count,
        reference=count,
        inside=int(inside.sum()),
        inside_sum=float(distance[inside].sum()),
        length=length,
    )


def _sampled(
    points: _Points, step: float, values: npt.NDArray[np.float64] | None = None
) -> tuple[_Points, npt.NDArray[np.float64]]:
    """Return points about ``step`` apart along a line, including both ends, and the values there."""
    ways = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    count = max(2, round(float(ways[-1]) / step) + 1)
    wanted = np.linspace(0.0, ways[-1], count)
    made = np.stack([np.interp(wanted, ways, points[:, axis]) for axis in range(3)], axis=1)
    return made, np.interp(wanted, ways, np.zeros(len(ways)) if values is None else values)


def _clipped(line: _Points, reference: _Points, width: float) -> _Points:
    """Leave out the part of a line before it first crosses the disc at the start of the reference."""
    normal = reference[1] - reference[0]
    height = (line - reference[0]) @ normal
    crosses = np.flatnonzero(height[:-1] * height[1:] <= 0)
    for n in crosses:
        fall = height[n] - height[n + 1]
        share = height[n] / fall if fall else 0.0
        place = line[n] + share * (line[n + 1] - line[n])
        if np.linalg.norm(place - reference[0]) <= width:
            first = int(n) if share == 0 else int(n) + 1
            return line[min(first, len(line) - 1) :]
    return line


def _like(points: _Points, reference: _Points) -> _Points:
    """Return the points, reversed if their ends then fit those of the reference better."""
    ends = reference[[0, -1]]
    kept = np.linalg.norm(points[[0, -1]] - ends, axis=1).sum()
    turned = np.linalg.norm(points[[-1, 0]] - ends, axis=1).sum()
    return points if kept <= turned else points[::-1]


def _false_length(traced: Vessel | VesselTree, references: Sequence[Any], step: float = 0.5) -> float:
    """Return the length of the traced vessels outside all lumens of the reference (mm)."""
    known = [_sampled(vessel.points, step, vessel.radius) for vessel in references]
    points = np.concatenate([points for points, _ in known])
    radius = np.concatenate([radius for _, radius in known])
    wrong = 0.0
    for vessel in (traced,) if isinstance(traced, Vessel) else traced:
        line, _ = _sampled(vessel.points, step)
        outside = [
            (np.linalg.norm(points - point, axis=1) >= radius).all() for point in (line[:-1] + line[1:]) / 2
        ]
        wrong += vessel.length * float(np.mean(outside))
    return wrong
