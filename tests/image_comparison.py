"""Compares arrays pixel by pixel: the largest difference, and the number of pixels that differ."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Comparison:
    """How two images differ: the largest difference of any channel, and how many pixels differ."""

    largest: float
    count: int


def compare(found: np.ndarray, expected: np.ndarray, tolerance: float = 0.0) -> Comparison:
    """Count the pixels (of RGBA images: in any channel) that differ by more than ``tolerance``."""
    assert found.shape == expected.shape, f"shape {found.shape}, expected {expected.shape}"
    assert found.dtype == expected.dtype, f"dtype {found.dtype}, expected {expected.dtype}"
    a, b = found.astype(np.float64), expected.astype(np.float64)
    gap = np.where(np.isnan(a) & np.isnan(b), 0.0, np.abs(a - b))
    gap = np.where(np.isnan(gap), np.inf, gap)
    if gap.ndim == 3:
        gap = gap.max(axis=2)
    return Comparison(float(gap.max(initial=0.0)), int((gap > tolerance).sum()))
