"""Measures of the whole picture: blends, surroundings, and changes when the camera turns."""

from __future__ import annotations

import numpy as np

from lumencut.evaluation.amounts import Amounts, Columns, counted, percent, ratio
from lumencut.evaluation.centerline import SEPARATE_ARC_MM
from lumencut.evaluation.shown import JUMP_MM, Shown
from lumencut.evaluation.truth import Truth


def blend_amounts(_: Truth, shown: Shown) -> Amounts:
    """Count the pixels that blend separate parts of a vessel."""
    gap = shown.sheet_gap
    return {
        "pixels": shown.depth.size,
        "blending": None if gap is None else counted(np.abs(gap) > SEPARATE_ARC_MM),
    }


def blend_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {"blended_sheets_percent": percent(amounts["blending"], amounts["pixels"])}


def surroundings_amounts(_: Truth, shown: Shown) -> Amounts:
    """Count the pixels whose position has a value of the volume."""
    value = shown.value
    return {"pixels": shown.depth.size, "tissue": None if value is None else counted(~np.isnan(value))}


def surroundings_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {"tissue_percent": percent(amounts["tissue"], amounts["pixels"])}


def steadiness_amounts(_: Truth, shown: Shown) -> Amounts:
    """Sum up the changes when the camera turns by one degree; changes of depth if both depths exist."""
    change = np.abs(shown.turned_depth.astype(float) - shown.depth)
    return {
        "pixels": change.size,
        "with depth": counted(~np.isnan(change)),
        "change": float(np.nansum(change)),
        "jumps": counted(change > JUMP_MM),
        "zones": counted(shown.turned_vessel != shown.vessel),
        "slides": counted(shown.slides),
        "slides of views": np.array([100.0 * shown.slides.mean()]),
    }


def steadiness_columns(amounts: Amounts) -> Columns:
    """Return the numbers of the table."""
    return {
        "depth_change_per_degree_mm": ratio(amounts["change"], amounts["with depth"]),
        "jumps_per_degree_percent": percent(amounts["jumps"], amounts["with depth"]),
        "zone_changes_per_degree_percent": percent(amounts["zones"], amounts["pixels"]),
        "slides_per_degree_percent": percent(amounts["slides"], amounts["pixels"]),
        "slides_per_degree_max_percent": float(amounts["slides of views"].max()),
    }
