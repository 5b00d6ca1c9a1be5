"""Judges what a reader returned for a DICOM case.

Every returned slice is searched among the written images (also mirrored): equal pixels identify the image,
and the corners of both give the error of its position. A slice that equals no image was interpolated by the
reader: it must agree with the phantom's formula.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from dicom_peers import Answer, Grid

from dicom_phantom import Image, field
from dicom_series import Case, Made

RIGHT, REFUSED, CANNOT, WARNED, WRONG = "right", "refused", "cannot", "wrong, warned", "WRONG, silently"
NEAR = 0.05
"""The farthest (mm) that a voxel may be from its place."""
SMOOTH, RESAMPLED = 3.0, 25.0
"""How far interpolated values may be from the formula: half of them, and 99 of 100."""
LOST = 100.0
"""Beyond this distance (mm) a place is no place that the files state."""
FEWEST = 3
"""The fewest slices of what counts as a volume."""


@dataclass(frozen=True)
class Verdict:
    """The verdict (one of five), and an explanation."""

    kind: str
    words: str = ""


@dataclass(frozen=True)
class Found:
    """The images that a returned volume shows, and its errors."""

    part: str | None
    fault: str = ""
    slices: int = 0
    lost: int = 0


def judged(case: Case, made: Made, answer: Answer) -> Verdict:
    """Judge what a reader returned for one case."""
    found = [
        volume_found(volume, made.images, case.loss) for volume in answer.volumes if len(volume[0]) >= FEWEST
    ]
    faults = [one.fault for one in found if one.fault]
    right = [one.part for one in found if not one.fault]
    whole = {one.part for one in found}
    if case.words and right and not faults:
        return Verdict(RIGHT, "each stack on its own" if len(right) > 1 else "")
    if not case.words and made.wanted in right:
        return Verdict(RIGHT, f"a second volume is not: {faults[0]}" if faults else "")
    everything = sum(one.slices for one in found) == len(made.images)
    if not case.words and everything and whole == {made.wanted} and all(one.lost for one in found):
        return Verdict(CANNOT, f"{len(found)} volumes, one of each file")
    if faults:
        words = "; ".join(dict.fromkeys(faults)) + ("; one more, resampled, is right" if right else "")
        return Verdict(WARNED if answer.warnings or answer.errors else WRONG, words)
    return Verdict(REFUSED if case.words else CANNOT)


def volume_found(volume: Grid, images: Sequence[Image], loss: float) -> Found:
    """Identify a volume."""
    voxels, affine = volume
    if not np.isfinite(voxels).all():
        return Found(None, "values that are no numbers")
    matched, far = [], 0.0
    for k, values in enumerate(voxels.astype(float)):
        image, distance = placed(values, affine, k, images, loss)
        if image is None:
            return made_up(volume, images)
        matched.append(image)
        far = max(far, distance)
    parts = sorted({one.part for one in matched})
    if len(parts) > 1:
        return Found(None, f"{' and '.join(parts)} mixed")
    if twice := len(matched) - len({id(one) for one in matched}):
        return Found(parts[0], f"{twice} slice{'s' * (twice > 1)} twice")
    if far > NEAR:
        return Found(parts[0], off(far))
    lost = sum(one.part == parts[0] for one in images) - len(matched)
    fault = f"{lost} slice{'s' * (lost > 1)} lost" if lost else ""
    return Found(parts[0], fault, len(matched), lost)


def off(far: float) -> str:
    """Describe how far slices are from their true positions."""
    if far > LOST:
        return "at a made-up place"
    return f"up to {far:.2g} mm off" if far < 10 else f"up to {far:.0f} mm off"


def placed(
    values: npt.NDArray[Any],
    affine: npt.NDArray[np.float64],
    k: int,
    images: Sequence[Image],
    loss: float,
) -> tuple[Image | None, float]:
    """Return the image that a slice shows, and the largest error (mm) of the position of its corners."""
    rows, columns = values.shape
    best: tuple[Image | None, float] = (None, np.inf)
    for image in images:
        if image.values.shape != values.shape:
            continue
        for flip_j in (False, True):
            for flip_i in (False, True):
                seen = values[:: -1 if flip_j else 1, :: -1 if flip_i else 1]
                if np.abs(seen - image.values).max() > loss + 2e-3:
                    continue
                corners = np.array([(i, j) for i in (0, columns - 1) for j in (0, rows - 1)], float)
                own = corners.copy()
                own[:, 0] = columns - 1 - own[:, 0] if flip_i else own[:, 0]
                own[:, 1] = rows - 1 - own[:, 1] if flip_j else own[:, 1]
                there = own @ affine[:3, :2].T + k * affine[:3, 2] + affine[:3, 3]
                truth = corners @ image.plane[:3, :2].T + image.plane[:3, 3]
                distance = float(np.linalg.norm(there - truth, axis=1).max())
                if distance < best[1]:
                    best = image, distance
    return best


def made_up(volume: Grid, images: Sequence[Image]) -> Found:
    """Judge a volume with interpolated slices by the formula of the phantom."""
    voxels, affine = volume
    for image in images:
        if image.values.shape == voxels.shape[1:] and np.ptp(voxels[0] + image.values) < 1e-3:
            return Found(None, "values inverted")
    k, j, i = np.indices(voxels.shape)
    world = np.stack([i, j, k], -1) @ affine[:3, :3].T + affine[:3, 3]
    corners = np.concatenate([corner_points(one) for one in images])
    # The margin excludes padding and values interpolated from half of the neighbours.
    inside = ((world > corners.min(0) + 4) & (world < corners.max(0) - 4)).all(-1)
    inside &= voxels != voxels.min()
    if not inside.any():
        return Found(None, "values or places that no image has")
    world, values = world[inside], voxels[inside]
    for part, contrast in (("only", 300.0), ("late", 120.0)):
        if agrees(values, world, contrast):
            return Found(part)
    moved = np.linalg.norm(shift_of(values, world))
    if agrees(values, world + shift_of(values, world), 300.0):
        return Found("only", f"resampled, but moved by {moved:.0f} mm")
    return Found(None, "wrong values")


def agrees(values: npt.NDArray[Any], world: npt.NDArray[np.float64], contrast: float) -> bool:
    """Return whether interpolated values agree with the phantom at these positions."""
    off = np.abs(values - field(world, contrast))
    return bool(np.median(off) < SMOOTH and np.quantile(off, 0.99) < RESAMPLED)


def shift_of(values: npt.NDArray[Any], world: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the shift (mm) that explains the values best; first in millimetres, then in tenths."""
    some = np.random.default_rng(0).choice(len(values), min(400, len(values)), replace=False)
    values, world = values[some], world[some]
    best = np.zeros(3)
    for step, reach in ((2.0, 10), (0.5, 5), (0.1, 6)):
        steps = np.stack(np.meshgrid(*[np.arange(-reach, reach + 1) * step] * 3), -1).reshape(-1, 3) + best
        best = min(steps, key=lambda one: float(np.abs(values - field(world + one)).mean()))
    return np.asarray(best)


def corner_points(image: Image) -> npt.NDArray[np.float64]:
    """Return the positions of the corners of an image."""
    rows, columns = image.values.shape
    corners = np.array([(i, j) for i in (0, columns - 1) for j in (0, rows - 1)], float)
    return np.asarray(corners @ image.plane[:3, :2].T + image.plane[:3, 3])
