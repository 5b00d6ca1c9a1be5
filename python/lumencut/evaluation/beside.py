"""How far the cut shows connected surroundings next to the walls of vessels."""

from __future__ import annotations

import numpy as np

from lumencut.evaluation.amounts import Amounts, Columns, counted, percent
from lumencut.evaluation.centerline import elsewhere
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.silhouettes import leap_bounds, leaps_along
from lumencut.evaluation.truth import Truth
from lumencut.evaluation.width import clear_stations, lying

MAX_DISTANCE_MM = 20.0


def beside_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Count the pixels next to vessels, up to 20 mm from the wall, and those that the cut reaches unbroken.

    From each width station, pixels are followed straight across the vessel to both sides, up to the border of
    the picture or the lumen of another vessel. The unbroken part ends at the first jump in depth or the first
    pixel that shows nothing; it is empty if the pixel at the station does not show the vessel.
    """
    amounts = {"possible": 0, "unbroken": 0}
    for side in (1, -1):
        for name, count in _along(truth, shown, side).items():
            amounts[name] += count
    return amounts


def beside_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {"unbroken_surroundings_percent": percent(amounts["unbroken"], amounts["possible"])}


def _along(truth: Truth, shown: Shown, direction: int) -> dict[str, int]:
    """Return the counts on one side of all stations."""
    stations, place, across = lying(truth)
    grid, nearest = truth.seen.grid, truth.nearest
    widest = stations.radius.max() if len(stations) else 0.0
    distance = np.asarray(np.arange(int((widest + MAX_DISTANCE_MM) / grid.side) + 2) * grid.side, np.float64)
    walk = place[:, None] + direction * distance[:, None] * across[:, None]
    pixel, within = grid.pixels(walk)
    clear = clear_stations(truth, stations, distance, pixel, within)
    stations, pixel, within = stations.chosen(clear), pixel[clear], within[clear]
    middle = truth.seen.view(stations.points)[:, 2:]
    judged = (distance > stations.radius[:, None]) & (distance <= stations.radius[:, None] + MAX_DISTANCE_MM)
    foreign = (nearest.vessel.ravel()[pixel] >= 0) & elsewhere(
        nearest.vessel.ravel()[pixel],
        nearest.arc.ravel()[pixel],
        stations.vessel[:, None],
        stations.arc[:, None],
        2 * (stations.radius[:, None] + grid.side),
    )
    possible = np.logical_and.accumulate(within & ~(foreign & (distance > stations.radius[:, None])), axis=1)
    depth = (shown.depth if shown.plain_depth is None else shown.plain_depth).ravel()[pixel]
    starts = np.abs(depth[:, :1] - middle) <= stations.radius[:, None]
    broken = np.isnan(depth)
    broken[:, 1:] |= leaps_along(depth, leap_bounds(truth, shown).ravel()[pixel])
    unbroken = possible & starts & np.logical_and.accumulate(~broken, axis=1)
    return {"possible": counted(possible & judged), "unbroken": counted(unbroken & judged)}
