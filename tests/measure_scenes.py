"""Vessels of known width, blurred by a known point spread, with seeded noise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut import Vessel, Volume

Floats = npt.NDArray[np.float64]
Paint = Callable[[Floats, Floats, Floats], Floats]

LUMEN, TISSUE, NOISE, FWHM = 310.0, 50.0, 26.0, 0.8

#: Number of samples along each axis of a voxel whose mean is the value of the voxel.
PARTS = 3


@dataclass
class Grid:
    """Voxels around the origin; the columns of a matrix are their sides (mm)."""

    sides: Floats
    size: tuple[int, int, int]

    @classmethod
    def even(cls, spacing: tuple[float, float, float], extent: tuple[float, float, float]) -> Grid:
        """Voxels along the axes of the world that fill a box (mm)."""
        return cls(np.diag(spacing), tuple(int(np.ceil(e / s)) for e, s in zip(extent, spacing, strict=True)))

    @property
    def affine(self) -> Floats:
        """World from index."""
        affine = np.eye(4)
        affine[:3, :3] = self.sides
        affine[:3, 3] = -self.sides @ (np.array(self.size) - 1) / 2
        return affine

    def points(self, parts: int) -> Floats:
        """Return positions in all voxels, shape (3, k, j, i), each axis with `parts` times as many."""
        along = [(np.arange(n * parts) - (parts - 1) / 2) / parts for n in self.size]
        k, j, i = np.meshgrid(along[2], along[1], along[0], indexing="ij")
        affine = self.affine
        return np.stack(
            [affine[a, 0] * i + affine[a, 1] * j + affine[a, 2] * k + affine[a, 3] for a in range(3)]
        )

    def axes(self, parts: int) -> list[Floats]:
        """The positions of `points` along x, y and z, if the sides of the voxels lie along them."""
        assert np.count_nonzero(self.sides) == 3
        along = [(np.arange(n * parts) - (parts - 1) / 2) / parts for n in self.size]
        shapes = ((1, 1, -1), (1, -1, 1), (-1, 1, 1))
        return [
            (self.affine[a, a] * along[a] + self.affine[a, 3]).reshape(shape)
            for a, shape in enumerate(shapes)
        ]

    def means(self, values: Floats) -> Floats:
        """The means over the voxels."""
        k, j, i = self.size[::-1]
        return values.reshape(k, PARTS, j, PARTS, i, PARTS).mean(axis=(1, 3, 5))

    def volume(self, values: Floats, seed: int, noise: float) -> Volume:
        """The means over the voxels with noise."""
        return self.noisy(self.means(values), seed, noise)

    def scanned(self, values: Floats, seed: int, noise: float, fwhm: float = FWHM) -> Volume:
        """The means over the voxels after a blur, with noise; for sides along x, y and z."""
        for axis, side in enumerate(np.diag(self.sides)[::-1]):
            values = means_of_parts(values, axis, fwhm / np.sqrt(8 * np.log(2)) * PARTS / side, PARTS)
        return self.noisy(values, seed, noise)

    def noisy(self, means: Floats, seed: int, noise: float) -> Volume:
        """The voxels, or layers that are all alike, with noise."""
        random = np.random.default_rng(seed)
        voxels = means + random.normal(0, noise, self.size[::-1])
        return Volume(voxels.astype(np.float32), world_from_index=self.affine)


def means_of_parts(values: Floats, axis: int, sigma: float, parts: int) -> Floats:
    """Means of equal parts along one axis, after a blur along it (samples)."""
    margin, count = int(np.ceil(4 * sigma)), values.shape[axis]
    step = np.arange(-margin, margin + 1)
    bell = np.exp(-0.5 * (step / sigma) ** 2)
    sample = np.arange(count)[:, None]
    weights = np.zeros((count // parts, count))
    places = (sample // parts + 0 * step, np.clip(sample + step, 0, count - 1))
    np.add.at(weights, places, bell / bell.sum() / parts)
    return np.moveaxis(np.tensordot(weights, values, (1, axis)), 0, axis)


def blurred(values: Floats, steps: tuple[float, ...], fwhm: float) -> Floats:
    """Return values on a grid (steps in mm), blurred along each axis; border values continue outside."""
    sigma = fwhm / np.sqrt(8 * np.log(2))
    for axis, step in enumerate(steps):
        margin = int(np.ceil(5 * sigma / step))
        bell = np.exp(-0.5 * (np.arange(-margin, margin + 1) * step / sigma) ** 2)
        padded = np.pad(
            values, [(margin, margin) if a == axis else (0, 0) for a in range(values.ndim)], "edge"
        )
        count = padded.shape[axis]
        spectrum = np.fft.rfft(padded, axis=axis)
        shape = [-1 if a == axis else 1 for a in range(values.ndim)]
        kernel = np.zeros(count)
        kernel[: 2 * margin + 1] = bell / bell.sum()
        kernel = np.roll(kernel, -margin)
        smooth = np.fft.irfft(spectrum * np.fft.rfft(kernel).reshape(shape), count, axis=axis)
        values = np.take(smooth, np.arange(margin, count - margin), axis=axis)
    return values


@dataclass
class Tube:
    """A straight vessel through the origin with the same section everywhere."""

    diameters: tuple[float, float]
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    fwhm: float = FWHM
    levels: tuple[float, float] = (LUMEN, TISSUE)
    #: Changes the sharp section, given the distances along both axes (mm).
    paint: Paint | None = None

    def axes(self) -> Floats:
        """Unit vectors: two across the vessel and one along it, as rows."""
        along = np.asarray(self.direction) / np.linalg.norm(self.direction)
        first = np.cross([0.0, 1.0, 0.0], along)
        first /= np.linalg.norm(first)
        return np.stack([first, np.cross(along, first), along])

    def section(self) -> tuple[Floats, float, float]:
        """The blurred section on a fine grid, its step and its reach (mm)."""
        reach, step = max(self.diameters) / 2 + 7, 0.04
        line = np.arange(-reach, reach + step / 2, step)
        shift = (np.arange(4) - 1.5) / 4 * step
        a, b = (d / 2 for d in self.diameters)
        share = np.mean(
            [
                ((line[None, :] + u) / a) ** 2 + ((line[:, None] + v) / b) ** 2 <= 1
                for u in shift
                for v in shift
            ],
            axis=0,
        )
        values = self.levels[1] + (self.levels[0] - self.levels[1]) * share
        if self.paint is not None:
            values = self.paint(values, line[None, :], line[:, None])
        return blurred(values, (step, step), self.fwhm), step, reach

    def volume(self, grid: Grid, seed: int = 0, noise: float = NOISE) -> Volume:
        """The vessel on a grid."""
        values, step, reach = self.section()
        is_even = np.allclose(self.axes()[:2] @ grid.sides[:, 2], 0)
        # Along the vessel all layers of voxels are alike.
        layers = Grid(grid.sides, (*grid.size[:2], 1)) if is_even else grid
        x, y = np.tensordot(self.axes()[:2], layers.points(PARTS), axes=1)
        i, j = (np.clip((c + reach) / step, 0, len(values) - 1.001) for c in (x, y))
        left, top = i.astype(int), j.astype(int)
        u, v = i - left, j - top
        upper = values[top, left] * (1 - u) + values[top, left + 1] * u
        lower = values[top + 1, left] * (1 - u) + values[top + 1, left + 1] * u
        return grid.noisy(layers.means(upper * (1 - v) + lower * v), seed, noise)

    def vessel(self, length: float, step: float = 0.5) -> Vessel:
        """Its centerline."""
        t = np.linspace(-length / 2, length / 2, int(length / step) + 1)
        return Vessel(t[:, None] * self.axes()[2])


def round_tube(diameter: float, **more: object) -> Tube:
    """A round vessel."""
    return Tube((diameter, diameter), **more)  # type: ignore[arg-type]


def narrowed(
    percent: float, at: float = 0.0, length: float = 12.0, diameter: float = 5.0
) -> tuple[Volume, Vessel]:
    """A vessel of 60 mm along z with a stenosis in its middle, in voxels of 0.4 mm."""
    grid = Grid.even((0.4, 0.4, 0.4), (diameter + 8, diameter + 8, 66.0))
    x, y, z = grid.axes(PARTS)
    away = np.minimum(np.abs(z - at) / (length / 2), 1)
    radius = diameter / 2 * (1 - percent / 100 * (0.5 + 0.5 * np.cos(np.pi * away)))
    step = 0.4 / PARTS
    share = np.clip(0.5 - (np.hypot(x, y) - radius) / step, 0, 1)
    z = np.linspace(-30, 30, 121)
    scan = grid.scanned(TISSUE + (LUMEN - TISSUE) * share, int(percent), NOISE)
    return scan, Vessel(np.stack([0 * z, 0 * z, z], axis=1))


def bent(radius: float = 3.0, bend: float = 12.0) -> tuple[Volume, Vessel]:
    """A vessel along half of a circle, whose centerline jitters about its axis as traced ones do."""
    grid = Grid.even((0.5, 0.5, 0.5), (2 * bend + 14, 2 * radius + 6, 2 * bend + 14))
    x, y, z = grid.axes(PARTS)
    share = np.clip(0.5 - (np.hypot(np.hypot(x, z) - bend, y) - radius) * PARTS / 0.5, 0, 1)
    t = np.linspace(0, np.pi, 41)
    jitter = np.random.default_rng(5).normal(0, 0.15, (len(t), 2))
    away = bend + jitter[:, 0]
    points = np.stack([away * np.cos(t), jitter[:, 1], away * np.sin(t)], axis=1)
    return grid.scanned(TISSUE + (LUMEN - TISSUE) * share, 1, NOISE), Vessel(points)
