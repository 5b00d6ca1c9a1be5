"""Scenes for `find_vessels.py`: scans with known vessels, harder phantoms, volumes without vessels."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut import Vessel, VesselTree, Volume, phantom, read_centerlines, read_volume

SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"
PATIENTS = {
    "stent-cta": ("stent_cta.nii.gz", "centerlines.vtp"),
    "dissection-cta": ("ct_cropped.nii.gz", "aorta_arch_centerlines_LPS.vtp"),
    "aorta-mra": ("aorta.mha", "aorta_full_centerlines_LPS.vtp"),
}
"""Volumes of patients and centerlines of some of their vessels."""
PHANTOMS = ("aorta", "cervical", "runoff")
NEGATIVE = ("noise", "tissue", "constant", "empty", "bones-aorta", "bones-cervical")
WALL, LUMEN, BONE, STENT = 60.0, 350.0, 900.0, 1600.0
"""Values of wall, lumen, bone and stent (HU)."""
VEINS = (75.0, 160.0)
"""Range of the phantoms' veins, which have no truth, and of organs as bright (HU)."""

Floats = npt.NDArray[np.float64]
Values = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Scene:
    """A volume and the vessels to find; None if it has none."""

    volume: Volume
    truth: VesselTree | None
    is_complete: bool
    """Whether the truth has every vessel, so any other found vessel is false."""
    besides: tuple[Vessel, ...] = ()
    """More vessels that may be found in another part."""


def scene(name: str) -> Scene:
    """Make or read a scene: of a patient, a phantom such as `aorta@0.5+noise20+veins`, or without vessels."""
    if name in PATIENTS:
        volume, lines = PATIENTS[name]
        folder = SHARED / name
        return Scene(
            read_volume(folder / volume),
            read_centerlines(folder / lines, coordinates="lps"),
            is_complete=False,
        )
    if name in NEGATIVE:
        return Scene(_without_vessels(name), None, is_complete=True)
    base, *changes = name.split("+")
    base, _, scale = base.partition("@")
    made = getattr(phantom, base)(scale=float(scale or 1))
    found = Scene(made.volume, made.tree, is_complete=True)
    for change in changes:
        found = _changed(found, change)
    return found


def voxel_of(volume: Volume) -> float:
    """Return the geometric mean of the sides of a voxel (mm)."""
    return float(abs(np.linalg.det(volume.world_from_index[:3, :3])) ** (1 / 3))


def resampled(vessel: Vessel, step: float) -> tuple[Floats, Floats]:
    """Return points and radii of a vessel at equal steps of about `step` (mm)."""
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(vessel.points, axis=0), axis=1))]
    places = np.linspace(0, along[-1], max(2, int(np.ceil(along[-1] / step)) + 1))
    points = np.stack([np.interp(places, along, axis) for axis in vessel.points.T], axis=1)
    radius = np.zeros(len(along)) if vessel.radius is None else vessel.radius
    return points, np.interp(places, along, radius)


# Harder phantoms


def _changed(scene: Scene, change: str) -> Scene:
    name, number = change.rstrip("0123456789"), change[len(change.rstrip("0123456789")) :]
    changes: dict[str, Callable[[Scene], Scene]] = {
        "noise": lambda scene: _with_noise(scene, float(number)),
        "bone": _with_bone,
        "fading": _fading,
        "stent": _stented,
        "veins": _with_veins,
    }
    return changes[name](scene)


def _values(volume: Volume) -> tuple[Values, Callable[[Values], Volume]]:
    """A copy of the values [k, j, i], and a function that makes a volume from new values."""
    array = np.asarray(volume.array)

    def made(values: Values) -> Volume:
        kept = np.round(values).astype(array.dtype) if array.dtype.kind in "iu" else values
        return Volume(kept, world_from_index=volume.world_from_index)

    return array.astype(np.float32), made


def _with_noise(scene: Scene, sigma: float) -> Scene:
    values, made = _values(scene.volume)
    random = np.random.default_rng(1)
    for plane in values:
        plane += sigma * random.standard_normal(plane.shape, dtype=np.float32)
    return replace(scene, volume=made(values))


def _fading(scene: Scene) -> Scene:
    """Reduce the contrast to a third, in proportion to the distance from the root."""
    assert scene.truth is not None
    values, made = _values(scene.volume)
    original, depths = values.copy(), _depths(scene.truth)
    deepest = max(float(depth.max()) for depth in depths)
    side = voxel_of(scene.volume)
    for vessel, depth in zip(scene.truth, depths, strict=True):
        points, radius = resampled(vessel, side)
        share = (
            1
            - 2
            / 3
            * np.interp(np.linspace(0, 1, len(points)), np.linspace(0, 1, len(depth)), depth)
            / deepest
        )
        for box, beyond, nearest in _around(scene.volume, points, radius, side):
            old = original[box]
            lumen = (beyond < side) & (old > WALL) & (old <= LUMEN + 5)
            values[box] = np.where(lumen, WALL + (old - WALL) * share[nearest], values[box])
    return replace(scene, volume=made(values))


def _largest(tree: VesselTree, count: int) -> list[Vessel]:
    """The vessels with the largest wall area."""
    return sorted(tree, key=lambda one: -one.length * float(np.mean(np.asarray(one.radius, float))))[:count]


def _stented(scene: Scene) -> Scene:
    """Add rings of metal along 60 mm of the largest vessel."""
    assert scene.truth is not None
    values, made = _values(scene.volume)
    side = voxel_of(scene.volume)
    points, radius = resampled(_largest(scene.truth, 1)[0], side)
    kept = slice(-int(60 / side), None)
    for box, beyond, nearest in _around(scene.volume, points[kept], radius[kept], side):
        ring = (np.abs(beyond) < side / 2) & (nearest * side % 4 < 2)
        values[box][ring] = STENT
    return replace(scene, volume=made(values))


def _with_bone(scene: Scene) -> Scene:
    """Add balls of bone, marrow as bright as lumen, that touch the middles of the three largest vessels."""
    assert scene.truth is not None
    values, made = _values(scene.volume)
    side = voxel_of(scene.volume)
    for vessel in _largest(scene.truth, 3):
        points, radius = resampled(vessel, side)
        half = len(points) // 2
        center = points[half] + _across(points)[half] * (radius[half] + 9)
        for thick, value in ((0.0, BONE), (1.5, LUMEN)):
            for box, beyond, _ in _around(scene.volume, center[None], np.array([10.0 - thick]), side):
                values[box][beyond < 0] = value
    return replace(scene, volume=made(values))


def _with_veins(scene: Scene) -> Scene:
    """Add equally wide and bright veins 2 mm from the walls of the two largest vessels."""
    assert scene.truth is not None
    values, made = _values(scene.volume)
    side = voxel_of(scene.volume)
    veins = []
    for vessel in _largest(scene.truth, 2):
        points, radius = resampled(vessel, side)
        veins.append(Vessel(points + _across(points) * (2 * radius + 2)[:, None], radius))
        for box, beyond, _ in _around(scene.volume, veins[-1].points, radius, side):
            share = np.clip(0.5 - beyond / side, 0, 1)
            painted = np.where(share > 0, WALL + share * (LUMEN - WALL), -np.inf)
            values[box] = np.maximum(values[box], painted)
    return replace(scene, volume=made(values), besides=tuple(veins))


def _across(points: Floats) -> Floats:
    """A direction perpendicular to the line and to the front at each point."""
    across = np.cross(np.gradient(points, axis=0), (0.0, 1.0, 0.0))
    return np.asarray(across / (np.linalg.norm(across, axis=1)[:, None] + 1e-9))


def without_vessels(scene: Scene) -> Volume:
    """Return the volume with its lumen, and everything as bright as its veins, replaced by tissue."""
    assert scene.truth is not None
    values, made = _values(scene.volume)
    side = voxel_of(scene.volume)
    for vessel in scene.truth:
        points, radius = resampled(vessel, side)
        for box, beyond, _ in _around(scene.volume, points, radius, 2 * side):
            values[box] = np.where((beyond < 1.5 * side) & (values[box] > WALL), WALL, values[box])
    values[(values > VEINS[0]) & (values < VEINS[1])] = WALL
    return made(values)


def _around(
    volume: Volume, points: Floats, radius: Floats, margin: float
) -> Iterator[tuple[tuple[slice, ...], Values, npt.NDArray[np.intp]]]:
    """Boxes of voxels [k, j, i] along a line: distance beyond its wall (mm), index of the nearest point."""
    affine = volume.world_from_index
    inverse = np.linalg.inv(affine)
    shape = np.asarray(volume.array).shape
    for first in range(0, len(points), 16):
        part, wide = points[first : first + 16], radius[first : first + 16]
        index = part @ inverse[:3, :3].T + inverse[:3, 3]
        reach = np.linalg.norm(inverse[:3, :3], axis=1) * (wide.max() + margin)
        low = np.maximum(np.floor(index.min(axis=0) - reach), 0).astype(int)
        high = np.minimum(np.ceil(index.max(axis=0) + reach) + 1, shape[::-1]).astype(int)
        if (high <= low).any():
            continue
        grid = np.stack(
            np.meshgrid(*[np.arange(a, b) for a, b in zip(low, high, strict=True)], indexing="ij"), -1
        )
        places = grid.transpose(2, 1, 0, 3) @ affine[:3, :3].T + affine[:3, 3]
        beyond = np.stack([np.linalg.norm(places - p, axis=-1) - r for p, r in zip(part, wide, strict=True)])
        box = tuple(slice(low[axis], high[axis]) for axis in (2, 1, 0))
        yield box, beyond.min(axis=0).astype(np.float32), first + beyond.argmin(axis=0)


def _depths(tree: VesselTree) -> list[Floats]:
    """Distance of the points of each vessel from the root, the widest end, along the tree (mm)."""
    along = [np.r_[0, np.cumsum(np.linalg.norm(np.diff(one.points, axis=0), axis=1))] for one in tree]
    ends: dict[tuple[float, ...], list[int]] = {}
    for number, vessel in enumerate(tree):
        for end in (0, -1):
            ends.setdefault(tuple(np.round(vessel.points[end], 2)), []).append(number)
    widest = {
        key: max(float(np.nanmax(np.asarray(tree[n].radius, float))) for n in at)
        for key, at in ends.items()
        if len(at) == 1
    }
    reached = {max(widest, key=lambda key: widest[key]): 0.0}
    waiting = [(0.0, key) for key in reached]
    while waiting:
        depth, key = heapq.heappop(waiting)
        for number in ends[key]:
            for end in (0, -1):
                other = tuple(np.round(tree[number].points[end], 2))
                further = depth + float(along[number][-1])
                if other != key and further < reached.get(other, np.inf):
                    reached[other] = further
                    heapq.heappush(waiting, (further, other))
    depths = []
    for length, vessel in zip(along, tree, strict=True):
        first, last = (reached.get(tuple(np.round(vessel.points[end], 2)), 0.0) for end in (0, -1))
        depths.append(np.minimum(first + length, last + length[-1] - length))
    return depths


# Volumes without vessels


def _without_vessels(name: str) -> Volume:
    random = np.random.default_rng(2)
    shape, spacing = (160, 160, 160), (0.8, 0.8, 0.8)
    if name.startswith("bones-"):
        return without_vessels(scene(name.removeprefix("bones-")))
    if name == "empty":
        fat = np.full_like(np.asarray(phantom.y_junction().volume.array), -100)
        return _with_noise(Scene(Volume(fat, spacing=spacing), None, True), 15.0).volume
    if name == "constant":
        return Volume(np.full(shape, 40, np.int16), spacing=spacing)
    values = 20 * random.standard_normal(shape)
    if name == "tissue":
        # Fat, muscle and organs: a random field with bodies about 15 mm wide.
        field = random.uniform(-1, 1, (10, 10, 10))
        for axis, count in enumerate(shape):
            low, share = np.divmod(np.linspace(0, 8.999, count), 1)
            first, second = (np.take(field, low.astype(int) + n, axis) for n in (0, 1))
            share = np.expand_dims(share, [other for other in range(3) if other != axis])
            field = first + share * (second - first)
        values += np.select([field < -0.1, field < 0.15], [-100.0, 50.0], 110.0)
    return Volume(np.round(values).astype(np.int16), spacing=spacing)
