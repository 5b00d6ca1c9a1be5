"""What the slow reference makes of a cut surface: filtered depth, leaps, positions and values."""

from __future__ import annotations

import numpy as np

from reference import pixel_centers

#: σ of the Gaussian (pixels).
SIGMA = 2 * np.sqrt(2 * np.log(2)) / np.pi


def depth_filter(image):
    """The 7 × 7 Gaussian of σ = 2√(2 ln 2)/π pixels, clamped at the border."""
    rows, columns = np.mgrid[-3:4, -3:4]
    weights = np.exp(-(rows**2 + columns**2) / (2 * SIGMA**2))
    padded = np.pad(image, 3, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (7, 7))
    return (windows * weights).sum(axis=(2, 3)) / weights.sum()


def zone_filter(depth, vessel, leap, tolerance):
    """The Gaussian within zones, columns first; and where rounding may count a pair that leaps, or not."""
    once, doubt = pairs_along(depth.T, vessel.T, leap, tolerance)
    smooth, further = pairs_along(once.T, vessel, leap, tolerance)
    for k in range(1, 4):
        further[:, k:] |= doubt.T[:, :-k]
        further[:, :-k] |= doubt.T[:, k:]
    return smooth, further | doubt.T


def pairs_along(depth, vessel, leap, tolerance):
    """Filter each row by itself: neighbours at ± k count only as a pair."""
    out, doubt = depth.copy(), np.zeros(depth.shape, bool)
    count = depth.shape[1]
    for i in range(count):
        total, weights, on_even_surface = depth[:, i].copy(), np.ones(len(depth)), np.ones(len(depth), bool)
        for k in range(1, 4):
            if i - k < 0 or i + k >= count:
                break
            # Another zone ends the pixel's own one: nothing beyond it counts.
            on_even_surface &= (vessel[:, i - k] == vessel[:, i]) & (vessel[:, i + k] == vessel[:, i])
            bend = np.abs(depth[:, i - k] + depth[:, i + k] - 2 * depth[:, i])
            weight = np.exp(-(k**2) / (2 * SIGMA**2)) * (on_even_surface & (bend < leap))
            total += weight * (depth[:, i - k] + depth[:, i + k])
            weights += 2 * weight
            doubt[:, i] |= on_even_surface & (np.abs(bend - leap) <= tolerance)
        out[:, i] = total / weights
    return out, doubt


def silhouettes(surface, camera, tolerance):
    """The strength of silhouettes of the rule leap, and where rounding may make a leap or not.

    Two neighbours leap where the depth differs from what the slope of either of them alone makes it, each
    time by more than the diameter of the vessel, and by more than 2 mm.
    """
    side, beside = camera.pixel_spacing, np.zeros(surface.depth.shape)
    doubt = surface.unsure_depth | surface.unsure_vessel
    beside_doubt = doubt.astype(float)
    for axis, along in ((1, (side, 0.0)), (0, (0.0, -side))):
        ends = [slice(None, -1), slice(1, None)]
        here, there = (tuple(end if n == axis else slice(None) for n in (0, 1)) for end in ends)
        change = surface.depth[there] - surface.depth[here]
        off = [
            np.abs(change - surface.slope[end] @ np.array(along)) - np.maximum(2 * surface.radius[end], 2.0)
            for end in (here, there)
        ]
        least = np.minimum(*off)
        for end in (here, there):
            beside[end] = np.maximum(beside[end], least > 0)
            vague = (np.abs(least) < tolerance) | doubt[here] | doubt[there]
            beside_doubt[end] = np.maximum(beside_doubt[end], vague)
    return depth_filter(beside), depth_filter(beside_doubt) > 0


def position(depth, camera):
    """World points (H, W, 3) of a depth image."""
    q = pixel_centers(camera).reshape(*depth.shape, 2)
    right = np.cross(camera.direction, camera.up)
    right /= np.linalg.norm(right)
    up = np.cross(right, camera.direction)
    return camera.center + q[..., :1] * right + q[..., 1:] * up + depth[..., None] * camera.direction


def trilinear(volume, world):
    """The volume at world points (H, W, 3): the border goes on for half a voxel, beyond is NaN."""
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
