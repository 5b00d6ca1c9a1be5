"""Masks with known topology and centerlines, and independent methods to count pieces and cycles."""

from __future__ import annotations

import numpy as np
import SimpleITK

from lumencut import Volume


def lumen_mask(tree, volume):
    """Return the voxels whose centres lie in the lumen of a tree: rods with linearly changing radius."""
    world, spacing = volume.world_from_index, volume.spacing
    inverse = np.linalg.inv(world)
    inside = np.zeros(volume.shape, np.uint8)
    for vessel in tree:
        for a, b, near, far in zip(
            vessel.points[:-1], vessel.points[1:], vessel.radius[:-1], vessel.radius[1:], strict=True
        ):
            ends = np.stack([a, b]) @ inverse[:3, :3].T + inverse[:3, 3]
            reach = max(near, far) / spacing + 1
            low = np.maximum(np.floor(ends.min(0) - reach).astype(int), 0)
            high = np.minimum(np.ceil(ends.max(0) + reach).astype(int) + 1, volume.size)
            if (high <= low).any():
                continue
            axes = [np.arange(start, end) for start, end in zip(low, high, strict=True)]
            index = np.stack(np.meshgrid(*axes, indexing="ij"), -1)
            away = index @ world[:3, :3].T + world[:3, 3] - a
            share = np.clip(away @ (b - a) / max((b - a) @ (b - a), 1e-12), 0, 1)
            lumen = np.linalg.norm(away - share[..., None] * (b - a), axis=-1) <= near + share * (far - near)
            box = inside[low[2] : high[2], low[1] : high[1], low[0] : high[0]]
            box |= lumen.transpose(2, 1, 0).astype(np.uint8)
    return Volume(inside, world_from_index=world)


def tubes(lines, radius, size=(40, 40, 40), world_from_index=None):
    """A mask of tubes along lines of points (index i, j, k) with a radius in voxels."""
    k, j, i = np.indices(size[::-1])
    place = np.stack([i, j, k], -1).astype(float)
    inside = np.zeros(size[::-1], bool)
    for line in lines:
        for a, b in zip(np.asarray(line, float)[:-1], np.asarray(line, float)[1:], strict=True):
            share = np.clip((place - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            inside |= np.linalg.norm(place - a - share[..., None] * (b - a), axis=-1) <= radius
    affine = np.eye(4) if world_from_index is None else world_from_index
    return Volume(inside.astype(np.uint8), world_from_index=affine)


def parts(mask, *, by_corners):
    """Return the number of connected parts that are not 0, as counted by SimpleITK."""
    count = SimpleITK.ConnectedComponentImageFilter()
    count.SetFullyConnected(by_corners)
    count.Execute(SimpleITK.GetImageFromArray((np.asarray(mask) > 0).astype(np.uint8)))
    return count.GetObjectCount()


def filled(mask):
    """Return a mask without cavities: background not joined by faces with the outside becomes lumen."""
    background = SimpleITK.GetImageFromArray(
        np.pad(np.asarray(mask) == 0, 1, constant_values=True).astype(np.uint8)
    )
    labels = SimpleITK.GetArrayFromImage(SimpleITK.ConnectedComponent(background, False))
    return (labels != labels[0, 0, 0])[1:-1, 1:-1, 1:-1]


def euler_characteristic(mask):
    """Vertices - edges + faces - cubes of the union of the closed cubes of a mask."""
    cubes = np.pad(np.asarray(mask) > 0, 1)
    total = 0
    for flat in range(8):
        axes = [axis for axis in range(3) if flat >> axis & 1]
        cells = cubes
        for axis in axes:
            cells = cells | np.roll(cells, 1, axis)
        total += (-1) ** (3 - len(axes)) * int(cells.sum())
    return total


def betti(mask):
    """Return the number of pieces and cycles of a mask after its cavities are filled."""
    solid = filled(mask)
    pieces = parts(solid, by_corners=True)
    return pieces, pieces - euler_characteristic(solid)


def betti_of(tree):
    """Return the number of pieces and cycles of a tree; vessels meet at bit-identical end points."""
    ends = [[vessel.points[n].tobytes() for n in (0, -1)] for vessel in tree]
    piece = {end: end for pair in ends for end in pair}

    def root(end):
        while piece[end] != end:
            end = piece[end]
        return end

    for a, b in ends:
        piece[root(a)] = root(b)
    pieces = len({root(end) for end in piece})
    return pieces, len(tree) - len(piece) + pieces
