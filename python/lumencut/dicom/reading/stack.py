"""Slices on an even, straight grid: the pixels to read, and their places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut.dicom.reading.headers import Image


@dataclass(frozen=True, eq=False)
class Slice:
    """One frame of an image, its index k, and slope and intercept from stored values to the volume's unit."""

    image: Image
    frame: int
    place: float
    scaling: tuple[float, float]


@dataclass(frozen=True)
class Fill:
    """An interpolated slice: (1 - part) · slice `before` + part · slice `after`."""

    k: int
    before: int
    after: int
    part: float


@dataclass(frozen=True, eq=False)
class Stack:
    """The slices of a volume in order, and how to fill indices without a slice.

    Only places of resampled slices may be fractions.
    """

    slices: Sequence[Slice]
    fills: Sequence[Fill]
    size: tuple[int, int, int]
    world_from_index: npt.NDArray[np.float64]

    @property
    def missing(self) -> tuple[int, ...]:
        """The indices k that have no slice."""
        return tuple(fill.k for fill in self.fills)
