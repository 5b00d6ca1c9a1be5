"""The images of the slow reference: filtered depth, jumps in depth, positions and values."""

from __future__ import annotations

import numpy as np

from reference import pixel_centers

SIGMA = 2 * np.sqrt(2 * np.log(2)) / np.pi


def depth_filter(image):
    """The 7 × 7 Gaussian of σ = 2√(2 ln 2)/π pixels, clamped at the border."""
    rows, columns = np.mgrid[-3:4, -3:4]
    weights = np.exp(-(rows**2 + columns**2) / (2 * SIGMA**2))
    padded = np.pad(image, 3, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (7, 7))
    return (windows * weights).sum(axis=(2, 3)) / weights.sum()


def zone_filter(depth, vessel, leap, tolerance):
    """Filter within zones, columns first; also return where rounding may decide which pairs count."""
    once, doubt = pairs_along(depth.T, vessel.T, leap, tolerance)
    smooth, further = pairs_along(once.T, vessel, leap, tolerance)
    for k in range(1, 4):
        further[:, k:] |= doubt.T[:, :-k]
        further[:, :-k] |= doubt.T[:, k:]
    return smooth, further | doubt.T


def pairs_along(depth, vessel, leap, tolerance):
    """Filter each row separately: neighbours at ± k count only as a pair."""
    out, doubt = depth.copy(), np.zeros(depth.shape, bool)
    count = depth.shape[1]
    for i in range(count):
        total, weights, on_even_surface = depth[:, i].copy(), np.ones(len(depth)), np.ones(len(depth), bool)
        for k in range(1, 4):
            if i - k < 0 or i + k >= count:
                break
            # The zone of the pixel ends at another zone; nothing beyond counts.
            on_even_surface &= (vessel[:, i - k] == vessel[:, i]) & (vessel[:, i + k] == vessel[:, i])
            bend = np.abs(depth[:, i - k] + depth[:, i + k] - 2 * depth[:, i])
            weight = np.exp(-(k**2) / (2 * SIGMA**2)) * (on_even_surface & (bend < leap))
            total += weight * (depth[:, i - k] + depth[:, i + k])
            weights += 2 * weight
            doubt[:, i] |= on_even_surface & (np.abs(bend - leap) <= tolerance)
        out[:, i] = total / weights
    return out, doubt


def silhouettes(surface, camera, tolerance):
    """Return the strength of silhouettes by the rule `leap`, and where rounding may change the strength.

    The depth jumps between two neighbours if it differs from the extrapolation of either slope, both
    times by more than the diameter of the vessel and by more than 2 mm. Folds are no jumps. Each jump draws
    its own line.
    """
    lumen, strength = surface.beyond <= 0, np.zeros(surface.depth.shape)
    vague_here = surface.unsure_depth | surface.unsure_vessel | (np.abs(surface.beyond) < tolerance)
    doubt, leaps = _near(vague_here), leaps_between(surface, camera)
    for here, there, least in leaps:
        if abs(least) < tolerance or (
            least > 0 and abs(surface.depth[there] - surface.depth[here]) < tolerance
        ):
            doubt |= _near(_at(here, strength.shape)) | _near(_at(there, strength.shape))
    leaps = {(here, there) for here, there, least in leaps if least > 0}
    width, sides = np.clip(1 / camera.pixel_spacing, 0.5, 1.5), []
    for here, there in leaps:
        far = max(here, there, key=lambda pixel: surface.depth[pixel])
        side = far if lumen[here] == lumen[there] else there if lumen[here] else here
        sides.append((side, there if side == here else here))
    for side, other in sides:
        draw_line(strength, side, other, width, lumen, leaps)
    for pixel in {other for _, other in sides} - {side for side, _ in sides}:
        strength[pixel] *= lumen[pixel]
    return strength, doubt


def draw_line(strength, side, other, width, lumen, leaps):
    """Draw the line of one jump on the side of the pixel `side`."""
    middle, outwards = (np.add(side, other)) / 2, np.subtract(side, other)
    for step in np.ndindex(5, 5):
        pixel = (side[0] + step[0] - 2, side[1] + step[1] - 2)
        if not (0 <= pixel[0] < strength.shape[0] and 0 <= pixel[1] < strength.shape[1]):
            continue
        apart = np.subtract(pixel, middle)
        if apart @ outwards <= 0:
            continue
        if lumen[pixel]:
            straight = tuple(np.add(side, outwards))
            goes_on = pixel == straight and not {(side, pixel), (pixel, side)} & leaps
            if not (lumen[side] and lumen[other] and (pixel == side or goes_on)):
                continue
        cover = np.clip(max(width, 1) + 0.5 - np.hypot(*apart), 0, 1) * min(width, 1)
        strength[pixel] = max(strength[pixel], cover)


def leaps_between(surface, camera):
    """Return both pixels of each pair of neighbours, and the excess over the smaller bound of a jump (mm)."""
    side, pairs = camera.pixel_spacing, []
    for axis, along in ((1, (side, 0.0)), (0, (0.0, -side))):
        ends = [slice(None, -1), slice(1, None)]
        here, there = (tuple(end if n == axis else slice(None) for n in (0, 1)) for end in ends)
        change = surface.depth[there] - surface.depth[here]
        off = [
            np.abs(change - surface.slope[end] @ np.array(along)) - np.maximum(2 * surface.radius[end], 2.0)
            for end in (here, there)
        ]
        least = np.minimum(*off)
        # One lumen that runs along the view between both pixels has folds instead, up to two diameters deep.
        apart, both = np.abs(change), surface.beyond <= 0
        most = 4 * np.minimum(surface.radius[here], surface.radius[there])
        fold = np.minimum(most - apart, apart - 0.9 * np.abs(surface.along[there] - surface.along[here]))
        is_one = both[here] & both[there] & (surface.vessel[here] == surface.vessel[there])
        least = np.where(is_one, np.minimum(least, -fold), least)
        for j, i in np.ndindex(least.shape):
            pairs.append(((j, i), (j + (axis == 0), i + (axis == 1)), least[j, i]))
    return pairs


def _at(pixel, shape):
    image = np.zeros(shape, bool)
    image[pixel] = True
    return image


def _near(pixels):
    """Return the pixels of a mask and all pixels up to two away along both axes."""
    padded = np.pad(pixels, 2)
    return np.lib.stride_tricks.sliding_window_view(padded, (5, 5)).any(axis=(2, 3))


def position(depth, camera):
    """Return the world points (H, W, 3) of a depth image."""
    q = pixel_centers(camera).reshape(*depth.shape, 2)
    right = np.cross(camera.direction, camera.up)
    right /= np.linalg.norm(right)
    up = np.cross(right, camera.direction)
    return camera.center + q[..., :1] * right + q[..., 1:] * up + depth[..., None] * camera.direction


def trilinear(volume, world):
    """Sample the volume at world points (H, W, 3): border values continue for half a voxel; NaN beyond."""
    affine, last = volume.world_from_index, np.asarray(volume.size) - 1
    index = np.linalg.solve(affine[:3, :3], (world - affine[:3, 3])[..., None])[..., 0]
    outside = ((index < -0.5) | (index > last + 0.5)).any(axis=-1)
    index = np.clip(index, 0, last)
    low = np.minimum(np.floor(index).astype(int), np.maximum(last - 1, 0))
    value = np.zeros(index.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.where(corner, index - low, 1 - (index - low)).prod(axis=-1)
        i, j, k = np.moveaxis(np.minimum(low + corner, last), -1, 0)
        value += weight * volume.array[k, j, i].astype(float)
    return np.where(outside, np.nan, value)
