"""Small angiographies of every kind that windows must suit, with the tissue of each voxel.

One body and one head contain the same vessels; each kind defines intensities, noise and mask.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import Vessel, VesselTree, Volume

SIZE = (48, 48, 56)

AIR, FAT, SOFT, LUNG, BONE, WALL, CALCIFIED, LUMEN, METAL = range(9)

#: Intensities of a CT angiography (HU), in the order above.
HU = (-1000.0, -100.0, 45.0, -850.0, 700.0, 60.0, 800.0, 320.0, 2800.0)
#: The same for magnetic resonance, where air and bone are dark.
TIME_OF_FLIGHT = (12.0, 130.0, 100.0, 15.0, 25.0, 90.0, 25.0, 320.0, 10.0)
CONTRAST_MR = (20.0, 420.0, 180.0, 30.0, 60.0, 180.0, 40.0, 1300.0, 10.0)


@dataclass(frozen=True)
class Angiography:
    """A volume on a grid of 1 mm, its centerlines, and the tissue of each voxel."""

    name: str
    array: npt.NDArray[Any]
    tree: VesselTree
    labels: npt.NDArray[np.uint8]
    #: Whether the lumen is darker than its surroundings.
    is_dark: bool
    #: Tissues that hide the lumen in a picture of the brightest values.
    brighter: tuple[int, ...]

    @property
    def volume(self) -> Volume:
        """The volume as the package takes it."""
        return Volume(self.array.T)


@dataclass(frozen=True)
class Kind:
    """How a kind of angiography converts tissues to voxels."""

    intensities: tuple[float, ...]
    noise: float = 0.0
    anatomy: str = "body"
    finish: Callable[[npt.NDArray[Any], npt.NDArray[np.uint8]], npt.NDArray[Any]] = field(
        default=lambda array, labels: array
    )
    is_dark: bool = False
    #: Tissues brighter than the lumen.
    brighter: tuple[int, ...] = (BONE, CALCIFIED, METAL)


def _as(dtype: str, scale: float = 1.0, shift: float = 0.0) -> Callable[..., npt.NDArray[Any]]:
    """Voxels of another type, clipped to its range."""

    def finish(array: npt.NDArray[Any], labels: npt.NDArray[np.uint8]) -> npt.NDArray[Any]:
        scaled = array * scale + shift
        if np.dtype(dtype).kind == "f":
            return scaled.astype(dtype)
        limits = np.iinfo(dtype)
        return np.clip(np.rint(scaled), limits.min, limits.max).astype(dtype)

    return finish


def _kept(kept: tuple[int, ...], outside: float, dtype: str = "int16") -> Callable[..., npt.NDArray[Any]]:
    """Keep only voxels of some tissues; all others get one value."""

    def finish(array: npt.NDArray[Any], labels: npt.NDArray[np.uint8]) -> npt.NDArray[Any]:
        return _as(dtype)(np.where(np.isin(labels, kept), array, outside), labels)

    return finish


def _round_field(outside: float) -> Callable[..., npt.NDArray[Any]]:
    """Keep the round field of view of a scanner; all other voxels get one value."""

    def finish(array: npt.NDArray[Any], labels: npt.NDArray[np.uint8]) -> npt.NDArray[Any]:
        x, y = np.indices(labels.shape)[:2] - 23.5
        return np.where(np.hypot(x, y) < 23.5, array, outside).astype("int16")

    return finish


def _cropped_values(low: float, high: float, dtype: str) -> Callable[..., npt.NDArray[Any]]:
    return lambda array, labels: np.clip(np.rint(array), low, high).astype(dtype)


def _changed(intensities: tuple[float, ...], **given: float) -> tuple[float, ...]:
    """Return the intensities with some of them replaced."""
    named = {"air": AIR, "fat": FAT, "soft": SOFT, "bone": BONE, "lumen": LUMEN, "calcified": CALCIFIED}
    places = {named[name]: value for name, value in given.items()}
    return tuple(places.get(place, value) for place, value in enumerate(intensities))


VESSELS = (WALL, CALCIFIED, LUMEN)
#: A subtraction angiography of the head: everything except the vessels is removed.
ROTATIONAL = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 540.0, 439.0, 560.0)

KINDS = {
    "CTA, HU": Kind(HU, 15.0, finish=_as("int16")),
    "CTA, HU, noisy": Kind(HU, 45.0, finish=_as("int16")),
    "CTA, HU, weak contrast": Kind(_changed(HU, lumen=230.0), 12.0, finish=_as("int16")),
    "CTA, HU, strong contrast": Kind(_changed(HU, lumen=600.0), 15.0, finish=_as("int16")),
    "CTA, HU, chest": Kind(HU, 15.0, "chest", _as("int16")),
    "CTA, HU, much fat": Kind(HU, 15.0, "stout", _as("int16")),
    "CTA, HU, stent graft": Kind(HU, 15.0, "stent", _as("int16")),
    "CTA, +1024": Kind(HU, 15.0, finish=_as("uint16", 1.0, 1024.0)),
    "CTA, 0 to 1": Kind(HU, 15.0, finish=_as("float32", 1 / 2000, 0.5)),
    "CTA, uint8": Kind(HU, 15.0, finish=_as("uint8", 255 / 800, 64)),
    "CTA, uint8, to 300 HU": Kind(HU, 15.0, finish=_as("uint8", 255 / 500, 102)),
    "CTA, round field": Kind(HU, 15.0, finish=_round_field(-2000.0)),
    "CTA, bone removed": Kind(HU, 15.0, finish=_kept((FAT, SOFT, *VESSELS), -1024.0)),
    "CTA, body at 0": Kind(HU, 15.0, finish=_kept((SOFT, *VESSELS), 0.0, "uint16")),
    "CTA, vessels at −1024": Kind(HU, 15.0, finish=_kept(VESSELS, -1024.0)),
    "CTA, lumen at 0": Kind(HU, 15.0, finish=_kept((CALCIFIED, LUMEN), 0.0)),
    "CTA, lumen in NaN": Kind(HU, 15.0, finish=_kept(VESSELS, np.nan, "float32")),
    "rotational, 0 to 563": Kind(
        ROTATIONAL, 14.0, "head", _cropped_values(0, 563, "uint16"), brighter=(CALCIFIED,)
    ),
    "TOF MRA": Kind(TIME_OF_FLIGHT, 14.0, "head", _as("uint16"), brighter=()),
    "TOF MRA, brain alone": Kind(TIME_OF_FLIGHT, 14.0, "head", _kept((SOFT, *VESSELS), 0.0), brighter=()),
    "TOF MRA, 99 % zeros": Kind(
        _changed(TIME_OF_FLIGHT, lumen=150.0), 8.0, "head", _kept((LUMEN,), 0.0, "uint8"), brighter=()
    ),
    "0.8 % at 200": Kind(
        (0.0,) * LUMEN + (200.0, 0.0), 0.0, finish=lambda _, labels: np.uint8(200) * (labels == LUMEN)
    ),
    "mask, 0 and 1": Kind((0.0,) * 9, finish=lambda _, labels: (labels == LUMEN).astype("float32")),
    "contrast MRA": Kind(CONTRAST_MR, 30.0, finish=_as("float32")),
    "contrast MRA, 1e-6": Kind(CONTRAST_MR, 30.0, finish=_as("float64", 1e-9)),
    "contrast MRA, subtracted": Kind(
        (0.0, 10.0, 5.0, 0.0, 5.0, 10.0, 0.0, 900.0, 0.0), 35.0, finish=_as("int16")
    ),
    "CTA, inverted": Kind(HU, 15.0, finish=_as("int16", -1.0), is_dark=True),
    "CTA, uint8, inverted": Kind(HU, 15.0, finish=_as("uint8", -255 / 800, 191), is_dark=True),
    "black-blood MR": Kind(
        (5.0, 350.0, 200.0, 5.0, 60.0, 240.0, 50.0, 12.0, 5.0), 10.0, finish=_as("uint16"), is_dark=True
    ),
}


@functools.cache
def angiography(name: str) -> Angiography:
    """The angiography of one kind, the same each time."""
    kind = KINDS[name]
    labels = _labels(kind.anatomy)
    array = _blurred(np.array(kind.intensities)[labels])
    array += np.random.default_rng(7).normal(0.0, 1.0, SIZE) * kind.noise
    return Angiography(name, kind.finish(array, labels), tree(), labels, kind.is_dark, kind.brighter)


@functools.cache
def tree() -> VesselTree:
    """A trunk that divides, and a side branch (mm, LPS)."""
    along = np.linspace(0.0, 1.0, 40)[:, None]
    trunk = np.array([25.0, 21.0, 4.0]) + along * (0.0, 0.0, 28.0) + np.sin(6 * along) * (1.5, 1.0, 0.0)
    fork = trunk[-1]
    left = fork + along * (9.0, -2.0, 19.0) + np.sin(np.pi * along) * (2.0, 3.0, 0.0)
    right = fork + along * (-9.0, -3.0, 19.0) - np.sin(np.pi * along) * (2.0, -2.0, 0.0)
    branch = trunk[20] + along * (-11.0, -7.0, 3.0) + np.sin(np.pi * along) * (0.0, -2.0, 4.0)
    lines, radii = (trunk, left, right, branch), (3.2, 2.1, 2.1, 1.4)
    return VesselTree([Vessel(line, radius) for line, radius in zip(lines, radii, strict=True)])


@functools.cache
def _labels(anatomy: str) -> npt.NDArray[np.uint8]:
    """What each voxel is."""
    place = np.moveaxis(np.indices(SIZE, dtype=np.float64), 0, -1)
    x, y, z = np.moveaxis(place, -1, 0)
    if anatomy == "head":
        shell = np.sqrt(((x - 23.5) / 22) ** 2 + ((y - 22.5) / 21.5) ** 2 + ((z - 28.5) / 28) ** 2)
        labels = np.select([shell > 1, shell > 0.94, shell > 0.86], [AIR, FAT, BONE], SOFT)
    else:
        ring = np.hypot((x - 23.5) / 22, (y - 23.5) / 20)
        labels = np.select([ring > 1, ring > (0.5 if anatomy == "stout" else 0.85)], [AIR, FAT], SOFT)
        lungs = np.hypot((abs(x - 23.5) - 12) / 6, (y - 22) / 10) < 1
        labels[lungs & (anatomy == "chest")] = LUNG
        labels[np.hypot(x - 23.5, y - 35) < 5] = BONE
    wall = _beyond_wall(place)
    labels[wall < 0.9] = WALL
    labels[(wall < 0.9) & (z % 14 < 3) & (y < 20)] = CALCIFIED
    labels[wall < 0.0] = LUMEN
    labels[(abs(wall - 0.4) < 0.5) & (z < 24) & (z % 4 < 1) & (anatomy == "stent")] = METAL
    return labels.astype(np.uint8)


def _beyond_wall(place: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return how far each position lies beyond the nearest wall (mm), below 0 inside."""
    nearest = np.full(place.shape[:3], np.inf)
    for vessel in tree():
        assert vessel.radius is not None
        for point, radius in zip(vessel.points, vessel.radius, strict=True):
            np.minimum(nearest, np.linalg.norm(place - point, axis=-1) - radius, out=nearest)
    return nearest


def _blurred(array: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Blurred a little along each axis, as every scanner does."""
    for axis in range(3):
        ahead, behind = np.roll(array, 1, axis), np.roll(array, -1, axis)
        array = 0.7 * array + 0.15 * (ahead + behind)
    return array
