"""Whether vessels are shown as wide as they are."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.amounts import Amounts, Columns
from lumencut.evaluation.centerline import Stations, elsewhere
from lumencut.evaluation.ragged import parts
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import EXACT, Truth

#: The projected unit tangent of a station is at least this long: the vessel rises by less than 60 degrees.
_FORESHORTENED = 0.5
#: More than what 32-bit floats round positions by (mm).
_ROUNDING = 1e-3
#: Beyond three radii, how far along the vessel its centerline counts for the width of a station (mm).
_REACH = 5.0
#: How far the width in a picture of the truth may be off where a vessel counts as a tube (pixels).
_BEND = 1.5


def width_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Return the errors of the widths (mm) at all stations that can be judged in this view."""
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
    # In a sharp bend even the truth is not as wide as the vessel.
    errors = found[np.abs(true) <= _BEND * side]
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
    """The stations at which the vessel does not run along the view, their places, and across the vessel."""
    tangent = (truth.stations.tangent @ truth.seen.axes)[:, :2]
    length = np.linalg.norm(tangent, axis=1)
    lying = length >= _FORESHORTENED
    tangent = tangent[lying] / length[lying, None]
    stations = truth.stations.chosen(lying)
    across = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
    return stations, truth.seen.view(stations.points)[:, :2], across


def _steps(stations: Stations, side: float) -> npt.NDArray[np.float64]:
    """The steps of the walks to both sides (pixels), well beyond the widest vessel."""
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
    """Tell at which stations all of the vessel is in the picture and no lumen of elsewhere lies before it."""
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
    """Tell which positions (n, walk, 3) lie in the lumen of each station's vessel, near the station."""
    line, reach = truth.seen.centerline, 3 * stations.radius + _REACH
    first = line.indices(stations.vessel, stations.arc - reach)
    last = np.maximum(line.indices(stations.vessel, stations.arc + reach), first + 1)
    # The centerline goes on to the next point, unless the vessel ends.
    last = np.minimum(last + 1, line.indices(stations.vessel, line.lengths[stations.vessel]))
    count = last - first
    inside = np.zeros(position.shape[:2], bool)
    for part in parts(np.full(len(stations), position.shape[1]) * count):
        # Where a vessel has fewer segments than the longest one here, its last one is asked again.
        segment = first[part, None] + np.minimum(np.arange(count[part].max()), count[part, None] - 1)
        # Counted from the station, squares of distances keep their digits.
        middle = stations.points[part, None]
        start, place = line.points[segment] - middle, position[part] - middle
        edge = line.points[segment + 1] - line.points[segment]
        square, along = _squares(edge), place @ edge.swapaxes(1, 2) - (start * edge).sum(axis=2)[:, None]
        t = np.clip(along / square[:, None], 0, 1)
        from_start = _squares(place)[:, :, None] - 2 * place @ start.swapaxes(1, 2) + _squares(start)[:, None]
        start_radius = line.radius[segment][:, None]
        radius = start_radius + t * (line.radius[segment + 1][:, None] - start_radius)
        gap = from_start + t * (t * square[:, None] - 2 * along)
        inside[part] = (gap <= (radius + _ROUNDING) ** 2).any(axis=2)
    return inside


def _squares(vectors: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Squares of the lengths of vectors (n, m, 3)."""
    return np.asarray((vectors**2).sum(axis=2))


def _run(inside: npt.NDArray[np.bool_]) -> npt.NDArray[np.float64]:
    """How many pixels around the middle of each walk (n, walk) are inside without a gap."""
    middle = inside.shape[1] // 2
    right = np.logical_and.accumulate(inside[:, middle:], axis=1).sum(axis=1)
    left = np.logical_and.accumulate(inside[:, middle::-1], axis=1).sum(axis=1)
    return np.asarray(np.maximum(right + left - 1, 0), np.float64)
