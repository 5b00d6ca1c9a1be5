"""Measures of visibility: centerlines, lumens and the order at crossings."""

from __future__ import annotations

import numpy as np

from lumencut.evaluation.amounts import Amounts, Columns, counted, percent
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import EXACT, Truth
from lumencut.evaluation.width import inside_vessel

TOLERANCES_MM = (0.05, 0.5, 2.0)
#: The depth shown at a crossing may differ from the vessel's by its radius and this (mm).
_CROSSING_MARGIN_MM = 0.5


def centerline_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Count the centerline points without a nearer lumen in front, and how many of them are shown."""
    pixel, within = truth.seen.grid.pixels(truth.seen.place)
    nearest = truth.nearest.depth.ravel()[pixel]
    lumen = np.isfinite(nearest)
    judged = within & ~truth.hidden & lumen
    exact = np.abs(shown.depth.ravel()[pixel] - nearest) <= EXACT
    return {
        "points": counted(judged),
        "visible": counted(judged & exact),
        "hidden": counted(within & truth.hidden),
        "without lumen": counted(within & ~truth.hidden & ~lumen),
        "outside": counted(~within),
    }


def centerline_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {
        "visible_centerline_percent": percent(amounts["visible"], amounts["points"]),
        "centerline_points": amounts["points"],
        "hidden_centerline_points": amounts["hidden"],
        "centerline_points_off_lumen": amounts["without lumen"],
        "centerline_points_outside": amounts["outside"],
    }


def lumen_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Count the pixels whose centre lies in a lumen, and those that show the nearest lumen accurately."""
    lumen = np.isfinite(truth.nearest.depth)
    error = np.abs(shown.depth[lumen] - truth.nearest.depth[lumen])
    within = {f"within {bound:g}": counted(error <= bound) for bound in TOLERANCES_MM}
    return {"pixels": len(error), **within}


def lumen_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    shares: Columns = {
        f"lumen_within_{bound:g}_mm_percent": percent(amounts[f"within {bound:g}"], amounts["pixels"])
        for bound in TOLERANCES_MM
    }
    return {**shares, "lumen_pixels": amounts["pixels"]}


def shown_lumen_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Count the pixels whose centre lies in a lumen, and those that show any point of that lumen."""
    lumen = np.isfinite(truth.nearest.depth)
    stations = truth.seen.centerline.at(truth.nearest.vessel[lumen], truth.nearest.arc[lumen])
    within = inside_vessel(truth, stations, shown.position[lumen][:, None])
    return {"pixels": len(stations), "within": counted(within)}


def shown_lumen_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {"lumen_shown_percent": percent(amounts["within"], amounts["pixels"])}


def crossing_amounts(truth: Truth, shown: Shown) -> Amounts:
    """Count the crossings in the picture, and how many of them show the nearer vessel.

    Crossings are excluded if even the truth shows something else there: the nearer vessel may not cover the
    centre of the pixel.
    """
    crossings = truth.crossings
    pixel, within = truth.seen.grid.pixels(crossings.place)
    true, found = (
        within & (np.abs(depth.ravel()[pixel] - crossings.depth) <= crossings.radius + _CROSSING_MARGIN_MM)
        for depth in (truth.nearest.depth, shown.depth)
    )
    return {
        "crossings": counted(true),
        "right": counted(true & found),
        "left out": counted(within & ~true),
    }


def crossing_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {
        "crossings_in_order_percent": percent(amounts["right"], amounts["crossings"]),
        "crossings": amounts["crossings"],
        "crossings_left_out": amounts["left out"],
    }
