"""Largest, smallest and mean values along rays, computed again in numpy with 64-bit floats.

Between two planes through voxel centres, the trilinear field along a ray is a cubic. Four samples
define it, so its extremes and its integral are exact except for rounding. Pixels are rows of arrays,
the crossings of their rays are columns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass
class Extremes:
    """The values of each ray, (P,); NaN if the ray meets no value."""

    smallest: np.ndarray
    largest: np.ndarray
    mean: np.ndarray


def crossings(foot, toward, near, far, size):
    """Depths (P, N), rising from `near` to `far`, of all crossings with planes through voxel centres."""
    ends = (near[:, None], far[:, None])
    met = (
        (np.arange(size[axis]) - foot[:, axis, None]) / toward[axis]
        for axis in range(3)
        if abs(toward[axis]) >= 1e-12
    )
    return np.sort(np.clip(np.concatenate([*ends, *met], axis=1), *ends), axis=1)


class Cells:
    """The cells of eight voxels [k, j, i] at continuous indices (..., 3); border values continue outside."""

    def __init__(self, array, middle):
        self.last = np.array(array.shape[::-1]) - 1
        inside = np.clip(middle, 0, self.last)
        self.low = np.minimum(np.floor(inside).astype(int), np.maximum(self.last - 1, 0))
        high = np.minimum(self.low + 1, self.last)
        ends = [(self.low[..., a], high[..., a]) for a in range(3)]
        self.corners = {
            (u, v, w): array[ends[2][w], ends[1][v], ends[0][u]]
            for u in (0, 1)
            for v in (0, 1)
            for w in (0, 1)
        }
        self.whole = ~np.any([np.isnan(corner) for corner in self.corners.values()], axis=0)

    def at(self, index):
        """Return the field of each cell at one index (..., 3) per cell."""
        share = np.clip(index, 0, self.last) - self.low
        weights = [(1 - share[..., a], share[..., a]) for a in range(3)]
        return sum(
            weights[0][u] * weights[1][v] * weights[2][w] * corner
            for (u, v, w), corner in self.corners.items()
        )


def turns(samples):
    """Return where (0 to 1) cubics through four equidistant samples have extremes; 0 if they have none."""
    f0, f1, f2, f3 = samples
    cubic = 4.5 * (f3 - 3 * f2 + 3 * f1 - f0)
    square = 9 * f0 - 22.5 * f1 + 18 * f2 - 4.5 * f3
    slope = -5.5 * f0 + 9 * f1 - 4.5 * f2 + f3
    # This form of the roots keeps its digits if the cubic is almost a parabola or a line.
    with np.errstate(divide="ignore", invalid="ignore"):
        root = -(square + np.copysign(np.sqrt(square**2 - 3 * cubic * slope), square))
        places = (root / (3 * cubic), slope / root)
    return [np.where((u > 0) & (u < 1), u, 0) for u in places]


def along(array, foot, toward, near, far):
    """Return the extremes of rays between the depths `near` and `far`.

    A ray has the continuous indices `foot` + depth · `toward`, (P, 3) and (3,).
    """
    hits = far > near
    near, far = np.where(hits, near, 0), np.where(hits, far, 0)
    depth = crossings(foot, toward, near, far, array.shape[::-1])
    length = np.diff(depth, axis=1)

    def index(share):
        return foot[:, None] + (depth[:, :-1] + share * length)[..., None] * toward

    cells = Cells(array, index(0.5))
    counts = cells.whole & (length > 0)
    thirds = [cells.at(index(n / 3)) for n in range(4)]
    values = np.stack([thirds[0], thirds[3], *(cells.at(index(u)) for u in turns(thirds))])
    total = np.where(counts, length, 0).sum(axis=1)
    some = hits & counts.any(axis=1)
    integral = (thirds[0] + 3 * thirds[1] + 3 * thirds[2] + thirds[3]) / 8 * length
    return Extremes(
        np.where(some, np.where(counts, values, np.inf).min(axis=(0, 2)), np.nan),
        np.where(some, np.where(counts, values, -np.inf).max(axis=(0, 2)), np.nan),
        np.where(some, np.where(counts, integral, 0).sum(axis=1) / np.where(some, total, 1), np.nan),
    )
