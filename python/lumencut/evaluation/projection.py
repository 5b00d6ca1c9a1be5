"""The projection of a centerline into a view, and the pixels of the view, in 64-bit floats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.centerline import Centerline

if TYPE_CHECKING:
    from lumencut.scene.camera import Camera


@dataclass(frozen=True)
class Grid:
    """The pixels of a picture: width and height (pixels), and the side of a pixel (mm)."""

    width: int
    height: int
    side: float

    def x(self, column: npt.NDArray[np.intp]) -> npt.NDArray[np.float64]:
        """Return x in the view of the centres of these columns (mm)."""
        return np.asarray((column + 0.5 - self.width / 2) * self.side, np.float64)

    def y(self, row: npt.NDArray[np.intp]) -> npt.NDArray[np.float64]:
        """Return y in the view of the centres of these rows (mm)."""
        return np.asarray((self.height / 2 - row - 0.5) * self.side, np.float64)

    def centers(self, pixel: npt.NDArray[np.intp]) -> npt.NDArray[np.float64]:
        """Return the centres of all pixels, row by row, shape (n, 2), mm."""
        row, column = np.divmod(pixel, self.width)
        return np.stack([self.x(column), self.y(row)], axis=1)

    def pixels(self, place: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.bool_]]:
        """Return the pixels at positions (..., 2), pixel 0 outside the picture, and which are inside."""
        column = np.floor(place[..., 0] / self.side + self.width / 2).astype(int)
        row = np.floor(self.height / 2 - place[..., 1] / self.side).astype(int)
        within = (column >= 0) & (column < self.width) & (row >= 0) & (row < self.height)
        return np.where(within, row * self.width + column, 0), within


@dataclass(frozen=True, eq=False)
class Projection:
    """A centerline in view space: positions (n, 2) and depths (n,) of its points (mm)."""

    centerline: Centerline
    grid: Grid
    axes: npt.NDArray[np.float64]
    center: npt.NDArray[np.float64]
    place: npt.NDArray[np.float64]
    depth: npt.NDArray[np.float64]

    def view(self, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """View coordinates of world points (n, 3): x right, y up, z away from the viewer (mm)."""
        return np.asarray((points - self.center) @ self.axes, np.float64)

    def world(self, depth: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Return the world points of a depth image (mm), (H, W, 3); NaN if a depth is not finite."""
        x, y = np.meshgrid(self.grid.x(np.arange(self.grid.width)), self.grid.y(np.arange(self.grid.height)))
        view = np.stack([x, y, np.where(np.isfinite(depth), depth, np.nan)], axis=2)
        return np.asarray(view @ self.axes.T + self.center, np.float64)


def projection_of(centerline: Centerline, camera: Camera) -> Projection:
    """Return the centerline in the view of the camera."""
    axes = np.stack([camera.right_axis, camera.up, camera.direction], axis=1)
    view = (centerline.points - camera.center) @ axes
    grid = Grid(*camera.size, camera.pixel_spacing)
    return Projection(centerline, grid, axes, camera.center, view[:, :2], view[:, 2])
