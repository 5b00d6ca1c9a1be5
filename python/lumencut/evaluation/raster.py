"""Finds the pixels inside many small convex regions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.projection import Grid
from lumencut.evaluation.ragged import parts, ragged


@dataclass(frozen=True, eq=False)
class Regions:
    """Regions of the view plane, each the intersection of a disc and half-planes (mm).

    Parameters
    ----------
    center, reach : numpy.ndarray, shapes (n, 2) and (n,)
        Centres and radii of the discs.
    normal, limit : numpy.ndarray, shapes (n, k, 2) and (n, k)
        The half-planes: all points q with normal · q ≤ limit.
    """

    center: npt.NDArray[np.float64]
    reach: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    limit: npt.NDArray[np.float64]

    def widened(self, by: float) -> Regions:
        """Return the regions with all borders moved outwards by ``by`` mm."""
        steepness = np.linalg.norm(self.normal, axis=2)
        return Regions(self.center, self.reach + by, self.normal, self.limit + by * steepness)


def pixels_within(
    regions: Regions, grid: Grid
) -> Iterator[tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]]:
    """Yield pairs of a region and a pixel whose centre lies in the region, a part of all pairs at a time."""
    region, row = _rows(regions, grid)
    first, count = _columns(regions, grid, region, row)
    met = count > 0
    region, row, first, count = region[met], row[met], first[met], count[met]
    for part in parts(count):
        run, column = ragged(first[part], count[part])
        yield region[part][run], row[part][run] * grid.width + column


def _rows(regions: Regions, grid: Grid) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Return pairs of a region and a row of pixels that the region's disc meets."""
    middle = grid.height / 2 - 0.5 - regions.center[:, 1] / grid.side
    half = regions.reach / grid.side
    top = np.clip(np.ceil(middle - half), 0, grid.height).astype(int)
    bottom = np.clip(np.floor(middle + half), -1, grid.height - 1).astype(int)
    return ragged(top, np.maximum(bottom - top + 1, 0))


def _columns(
    regions: Regions, grid: Grid, region: npt.NDArray[np.intp], row: npt.NDArray[np.intp]
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Return the first column and the number of columns of each region in each row."""
    y = grid.y(row)
    half = np.sqrt(np.maximum(regions.reach[region] ** 2 - (y - regions.center[region, 1]) ** 2, 0.0))
    low, high = regions.center[region, 0] - half, regions.center[region, 0] + half
    for k in range(regions.limit.shape[1]):
        slope, rest = regions.normal[region, k, 0], regions.limit[region, k]
        rest = rest - regions.normal[region, k, 1] * y
        border = np.divide(rest, slope, out=np.zeros_like(rest), where=slope != 0)
        high = np.where(slope > 0, np.minimum(high, border), high)
        low = np.where(slope < 0, np.maximum(low, border), low)
        # A half-plane whose border is parallel to the rows contains either the entire row or nothing.
        high = np.where((slope == 0) & (rest < 0), -np.inf, high)
    left, right = (np.clip(x / grid.side + grid.width / 2 - 0.5, -2, grid.width + 1) for x in (low, high))
    first = np.maximum(np.ceil(left).astype(int), 0)
    last = np.minimum(np.floor(right).astype(int), grid.width - 1)
    return first, np.maximum(last - first + 1, 0)
