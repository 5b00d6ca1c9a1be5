"""Errors of the shown width of vessels."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.amounts import Amounts, Columns
from lumencut.evaluation.centerline import Stations, elsewhere
from lumencut.evaluation.ragged import parts
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import EXACT, Truth

#: A station needs a projected unit tangent of at least this length: less than 60° out of the view plane.
_MIN_TANGENT = 0.5
#: More than the rounding error of positions in 32-bit floats (mm).
_ROUNDING_MM = 1e-3
#: The width at a station covers the centerline up to three radii and this length away (mm).
_EXTRA_LENGTH_MM = 5.0
#: The truth itself may have at most this width error in its pixels; sharp bends have more.
_MAX_TRUE_ERROR_PIXELS = 1.5


def width_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Return the width errors (mm) at all stations where a width is defined in this view."""
    stations, place, across = lying(truth)
    side = truth.seen.grid.side
    steps = _steps(stations, side)
    pixel, within = truth.seen.grid.pixels(place[:, None] + (steps * side)[:, None] * across[:, None])
    clear = clear_stations(truth, stations, np.abs(steps) * side, pixel, within)
    stations, pixel, within = stations.chosen(clear), pixel[clear], within[clear]
    true, found = (
        _run(within & inside_vessel(truth, stations, position.reshape(-1, 3)[pixel])) * side
        - 2 * stations.radius
        for position in (truth.seen.world(truth.nearest.depth), shown.position)
    )
    errors = found[np.abs(true) <= _MAX_TRUE_ERROR_PIXELS * side]
    return {"errors": errors, "left out": len(truth.stations) - len(errors) + truth.stations_left_out}


def width_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    errors = amounts["errors"]
    sizes = np.abs(errors)
    found = len(errors) > 0
    return {
        "width_error_mean_mm": float(sizes.mean()) if found else None,
        "width_error_95_percent_mm": float(np.percentile(sizes, 95)) if found else None,
        "width_error_max_mm": float(sizes.max()) if found else None,
        "width_bias_mm": float(errors.mean()) if found else None,
        "width_stations": len(errors),
        "width_stations_left_out": amounts["left out"],
    }


def lying(truth: Truth) -> tuple[Stations, npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return stations of vessels not along the view, their positions, and directions across the vessel."""
    tangent = (truth.stations.tangent @ truth.seen.axes)[:, :2]
    length = np.linalg.norm(tangent, axis=1)
    lying = length >= _MIN_TANGENT
    tangent = tangent[lying] / length[lying, None]
    stations = truth.stations.chosen(lying)
    across = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    return stations, truth.seen.view(stations.points)[:, :2], across


def _steps(stations: Stations, side: float) -> npt.NDArray[np.float64]:
    """Return the steps to both sides (pixels), far enough for the widest vessel."""
    widest = stations.radius.max() if len(stations) else 0.0
    most = int(np.ceil(1.5 * widest / side)) + 2
    return np.arange(-most, most + 1).astype(float)


def clear_stations(
    truth: Truth,
    stations: Stations,
    distance: npt.NDArray[np.float64],
    pixel: npt.NDArray[np.intp],
    within: npt.NDArray[np.bool_],
) -> npt.NDArray[np.bool_]:
    """Return at which stations the vessel is completely in the picture and no other lumen covers it."""
    side, nearest = truth.seen.grid.side, truth.nearest
    needed = distance <= stations.radius[:, None] + side
    depth = truth.seen.view(stations.points)[:, 2]
    before = nearest.depth.ravel()[pixel] < depth[:, None] - EXACT
    foreign = elsewhere(
        nearest.vessel.ravel()[pixel],
        nearest.arc.ravel()[pixel],
        stations.vessel[:, None],
        stations.arc[:, None],
        2 * (stations.radius[:, None] + side),
    )
    return np.asarray(~(needed & (~within | (before & foreign))).any(axis=1))


def inside_vessel(
    truth: Truth, stations: Stations, position: npt.NDArray[np.float64]
) -> npt.NDArray[np.bool_]:
    """Return which positions (n, walk, 3) lie in the lumen of the station's vessel, near the station."""
    line, reach = truth.seen.centerline, 3 * stations.radius + _EXTRA_LENGTH_MM
    first = line.indices(stations.vessel, stations.arc - reach)
    last = np.maximum(line.indices(stations.vessel, stations.arc + reach), first + 1)
    last = np.minimum(last + 1, line.indices(stations.vessel, line.lengths[stations.vessel]))
    count = last - first
    inside = np.zeros(position.shape[:2], bool)
    for part in parts(np.full(len(stations), position.shape[1]) * count):
        segment = first[part, None] + np.minimum(np.arange(count[part].max()), count[part, None] - 1)
        # Coordinates relative to the station, so that squared distances keep their digits.
        middle = stations.points[part, None]
        start, place = line.points[segment] - middle, position[part] - middle
        edge = line.points[segment + 1] - line.points[segment]
        square, along = _squares(edge), place @ edge.swapaxes(1, 2) - (start * edge).sum(axis=2)[:, None]
        t = np.clip(along / square[:, None], 0, 1)
        from_start = _squares(place)[:, :, None] - 2 * place @ start.swapaxes(1, 2) + _squares(start)[:, None]
        start_radius = line.radius[segment][:, None]
        radius = start_radius + t * (line.radius[segment + 1][:, None] - start_radius)
        gap = from_start + t * (t * square[:, None] - 2 * along)
        inside[part] = (gap <= (radius + _ROUNDING_MM) ** 2).any(axis=2)
    return inside


def _squares(vectors: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the squared lengths of vectors (n, m, 3)."""
    return np.asarray((vectors**2).sum(axis=2))


def _run(inside: npt.NDArray[np.bool_]) -> npt.NDArray[np.float64]:
    """Return how many pixels around the middle of each walk (n, walk) are inside without a gap."""
    middle = inside.shape[1] // 2
    right = np.logical_and.accumulate(inside[:, middle:], axis=1).sum(axis=1)
    left = np.logical_and.accumulate(inside[:, middle::-1], axis=1).sum(axis=1)
    return np.asarray(np.maximum(right + left - 1, 0), np.float64)
