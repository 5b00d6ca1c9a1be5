"""Vessels and volumes with closed-form answers for the tests of CPR."""

from __future__ import annotations

import numpy as np

from lumencut import Vessel, Volume

GRIDS = {
    "straight": np.diag([0.8, 0.9, 1.1, 1.0]),
    "oblique": np.array([[0.7, -0.3, 0.1, 0], [0.25, 0.8, -0.2, 0], [0, 0.2, 1.0, 0], [0, 0, 0, 1]]),
    "sheared": np.array([[0.9, 0, 0, 0], [0, 1.0, 0.35, 0], [0, 0, 1.2, 0], [0, 0, 0, 1]]),
}


def grid(name, size):
    """A grid of this size (i, j, k) with the world's origin in its middle."""
    affine = GRIDS[name].copy()
    affine[:3, 3] = -affine[:3, :3] @ ((np.array(size) - 1) / 2)
    return affine


def index_volumes(name, size=(70, 66, 74)):
    """Three volumes on one grid whose values are the indices i, j and k."""
    affine = grid(name, size)
    k, j, i = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in size[::-1]), indexing="ij")
    return [Volume(array, world_from_index=affine) for array in (i, j, k)]


def noise(name="oblique", size=(60, 64, 70), seed=1):
    """A volume of noise."""
    array = np.random.default_rng(seed).integers(-500, 1500, size[::-1]).astype(np.int16)
    return Volume(array, world_from_index=grid(name, size))


def vessel(points):
    return Vessel(np.asarray(points, dtype=float))


def wave(count=160):
    """A smooth vessel that winds downwards through all directions."""
    t = np.linspace(0, 1, count)
    return vessel(np.stack([9 * np.sin(5 * t), 7 * np.cos(4 * t), 22 - 44 * t + 2 * np.sin(9 * t)], axis=1))


def trilinear(volume, points):
    """Sample the volume at world points (…, 3) with numpy only; NaN outside the outermost voxel centres."""
    inverse = np.linalg.inv(volume.world_from_index)
    index = points @ inverse[:3, :3].T + inverse[:3, 3]
    top = np.array(volume.size) - 1
    inside = ((index >= 0) & (index <= top)).all(axis=-1)
    low = np.clip(np.floor(index), 0, top - 1).astype(int)
    part = index - low
    value = np.zeros(index.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, part, 1 - part), axis=-1)
        i, j, k = np.moveaxis(low + corner, -1, 0)
        value += weight * volume.array[k, j, i]
    return np.where(inside, value, np.nan)
