"""Bounding boxes of scans and slices, and their distances."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.pickles import by_name

#: A side of a box counts only if the other box is longer than this share of it; a few slices show no length.
_THIN = 0.2


@by_name
@dataclass(frozen=True)
class Box:
    """A box along the axes of the patient.

    Attributes
    ----------
    low, high : tuple of 3 float
        Its smallest and largest coordinates (mm, LPS).
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]

    @classmethod
    def around(cls, points: npt.ArrayLike) -> Box:
        """Return the box around points (n, 3) (mm, LPS)."""
        places = np.asarray(points, np.float64).reshape(-1, 3)
        return cls(_corner(places.min(axis=0)), _corner(places.max(axis=0)))

    def distance(self, other: Box) -> float:
        """Return the distance between two boxes (mm); 0 if they touch."""
        gaps = np.maximum(np.subtract(other.low, self.high), np.subtract(self.low, other.high))
        return float(np.linalg.norm(np.maximum(gaps, 0)))

    def part_within(self, other: Box) -> float:
        """Return the share of a side that lies within another box, for the side where it is smallest.

        Sides along which the other box is thin, as the box of a single slice is, do not count.
        """
        length, its_length = np.subtract(self.high, self.low), np.subtract(other.high, other.low)
        common = np.minimum(self.high, other.high) - np.maximum(self.low, other.low)
        is_long = (length > 0) & (its_length > _THIN * length)
        parts = np.clip(common[is_long] / length[is_long], 0, 1)
        return float(parts.min()) if parts.size else 1.0


def box_of_slices(records: Iterable[dict[str, Any]]) -> Box | None:
    """Return the box around all slices of DICOM headers, None if no header states a position.

    Parameters
    ----------
    records : iterable of dict
        Headers in the form of `lumencut-dicom`; attributes of a frame are under ``frames`` or ``shared``.
    """
    corners = []
    for record in records:
        for frame in record["frames"] or [{}]:
            found = _corners({**record["attributes"], **record["shared"], **frame})
            if found is not None:
                corners.append(found)
    return Box.around(np.concatenate(corners)) if corners else None


def _corners(attributes: dict[str, Any]) -> npt.NDArray[np.float64] | None:
    """Return the four corners of a slice, shape (4, 3); None if the header does not state them."""
    place = _numbers(attributes.get("ImagePositionPatient"), 3)
    axes = _numbers(attributes.get("ImageOrientationPatient"), 6)
    spacing = _numbers(attributes.get("PixelSpacing"), 2)
    shape = _numbers([attributes.get("Rows"), attributes.get("Columns")], 2)
    if place is None or axes is None or spacing is None or shape is None:
        return None
    # PixelSpacing states the distance of rows first, ImageOrientation the direction along a row.
    down, right = axes[3:] * spacing[0] * (shape[0] - 1), axes[:3] * spacing[1] * (shape[1] - 1)
    return np.array([place, place + down, place + right, place + down + right])


def _numbers(values: Any, count: int) -> npt.NDArray[np.float64] | None:
    """Return the finite numbers of a header's value, None for anything else."""
    if not isinstance(values, Sequence) or isinstance(values, str) or len(values) != count:
        return None
    try:
        found = np.array([float(value) for value in values])
    except (TypeError, ValueError):
        return None
    return found if np.isfinite(found).all() else None


def _corner(values: npt.NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z
