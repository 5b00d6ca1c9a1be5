"""Whether silhouettes lie exactly where the cut surface jumps in depth."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.amounts import Amounts, Columns, counted, percent, ratio
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import Truth

_MIN_LINE_STRENGTH = 0.25
_MIN_RIM_STRENGTH = 0.1
#: Smallest difference of depth that counts as a jump, for vessels with less than half this radius.
_MIN_LEAP_MM = 2.0


def silhouette_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Count the jumps in depth and those with a line, and add up the length of lines elsewhere (mm)."""
    if shown.strength is None or shown.plain_depth is None:
        return dict.fromkeys(("leaps", "drawn", "rimmed", "marked", "stray", "area"))
    side = truth.seen.grid.side
    across, down = leaps(shown.plain_depth, leap_bounds(truth, shown))
    line = shown.strength > _MIN_LINE_STRENGTH
    rim = np.zeros_like(line) if shown.rim is None else shown.rim > _MIN_RIM_STRENGTH
    drawn, rimmed, marked = (_leaps_near(mark, across, down) for mark in (line, rim, line | rim))
    at_leap = np.zeros(line.shape, bool)
    for first, second, leap in ((at_leap[:, :-1], at_leap[:, 1:], across), (at_leap[:-1], at_leap[1:], down)):
        first |= leap
        second |= leap
    # A line may also cover the pixels next to a jump.
    elsewhere = ~_grown(at_leap)
    return {
        "leaps": counted(across) + counted(down),
        "drawn": drawn,
        "rimmed": rimmed,
        "marked": marked,
        "stray": counted(line & elsewhere) * side,
        "area": counted(elsewhere) * side**2,
    }


def silhouette_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {
        "leaps_with_line_percent": percent(amounts["drawn"], amounts["leaps"]),
        "leaps_with_rim_percent": percent(amounts["rimmed"], amounts["leaps"]),
        "leaps_with_either_percent": percent(amounts["marked"], amounts["leaps"]),
        "lines_elsewhere_mm_per_mm2": ratio(amounts["stray"], amounts["area"]),
        "leaps": amounts["leaps"],
    }


def leap_bounds(truth: Truth, shown: Shown) -> npt.NDArray[np.float64]:
    """Return the smallest jump at each pixel (mm), (H, W): the diameter of the vessel, at least 2 mm.

    The radius is that of the nearest lumen at the pixel; outside all lumens it is the median radius of the
    vessel of the pixel's zone.
    """
    line = truth.seen.centerline
    starts = np.flatnonzero(np.diff(line.vessel)) + 1
    usual = np.array([np.median(radii) for radii in np.split(line.radius, starts)])
    of_zone = np.where(shown.vessel >= 0, usual[shown.vessel], np.inf)
    radius = np.where(np.isnan(truth.nearest.radius), of_zone, truth.nearest.radius)
    bounds: npt.NDArray[np.float64] = np.maximum(2 * radius, _MIN_LEAP_MM)
    return bounds


def leaps(
    depth: npt.NDArray[np.floating], bound: npt.NDArray[np.float64]
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Return between which neighbouring pixels the depth jumps.

    It jumps if each depth differs from the linear extrapolation of the other side by more than the larger
    bound of both. Pairs at the border of the picture have no slope, so they never jump.

    Returns
    -------
    across, down : numpy.ndarray, shapes (H, W - 1) and (H - 1, W)
        For each pixel and its right neighbour; for each pixel and the pixel below.
    """
    return leaps_along(depth, bound), leaps_along(depth.T, bound.T).T


def leaps_along(depth: npt.NDArray[np.floating], bound: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
    """Return between which neighbours in a row the depth jumps, (H, W - 1); see :func:`leaps`."""
    height, width = depth.shape
    leap = np.zeros((height, max(width - 1, 0)), bool)
    if width >= 4:
        before, left, right, after = (depth[:, i : width - 3 + i].astype(float) for i in range(4))
        least = np.maximum(bound[:, 1:-2], bound[:, 2:-1])
        leap[:, 1:-1] = np.abs(right - (2 * left - before)) > least
        leap[:, 1:-1] &= np.abs(left - (2 * right - after)) > least
    return leap


def _leaps_near(
    mark: npt.NDArray[np.bool_], across: npt.NDArray[np.bool_], down: npt.NDArray[np.bool_]
) -> int:
    """Count the jumps with a mark within a pixel."""
    near = _grown(mark)
    return counted(across & (near[:, :-1] | near[:, 1:])) + counted(down & (near[:-1] | near[1:]))


def _grown(pixels: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return the pixels of a mask and their eight neighbours."""
    padded = np.pad(pixels, 1)
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, (3, 3)).any(axis=(2, 3)))
