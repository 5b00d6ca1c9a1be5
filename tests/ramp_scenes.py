"""Volumes whose values are coordinates: each value in a picture or a file shows its true position."""

from __future__ import annotations

from functools import cache

import numpy as np
import numpy.typing as npt

from lumencut import Volume

#: The sides of the patient at the low and the high end of x, y and z (LPS).
_ENDS = ("RL", "AP", "IS")
_SIZE, _SPACING = 81, 1.25


def oblique() -> npt.NDArray[np.float64]:
    """Return world from index (LPS) of a left-handed, oblique grid whose middle is the origin."""
    turn, _ = np.linalg.qr(np.array([[1, 0.3, 0.2], [-0.3, 1, 0.1], [0.1, -0.2, -1.0]]))
    affine = np.eye(4)
    affine[:3, :3] = turn * _SPACING
    affine[:3, 3] = -affine[:3, :3] @ np.full(3, (_SIZE - 1) / 2)
    return affine


@cache
def ramp_volumes() -> list[Volume]:
    """Return three volumes on the oblique grid: the value of a voxel is its x, y or z (mm, LPS)."""
    affine = oblique()
    index = np.stack(np.meshgrid(*[np.arange(_SIZE)] * 3, indexing="ij"), axis=-1)
    world = index @ affine[:3, :3].T + affine[:3, 3]
    return [
        Volume(np.ascontiguousarray(world[..., axis].T, np.float32), world_from_index=affine)
        for axis in range(3)
    ]


def letters_of(direction: npt.ArrayLike) -> str:
    """The sides that a direction (LPS) points to with at least a fifth of its length, main side first."""
    parts = np.asarray(direction, float) / np.linalg.norm(direction)
    order = np.argsort(-np.abs(parts).round(6), kind="stable")
    return "".join(_ENDS[axis][int(parts[axis] > 0)] for axis in order if abs(parts[axis]) >= 0.2)
