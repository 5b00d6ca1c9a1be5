"""The context, computed again: slow, in numpy with 64-bit floats, from the description only.

If colours blend, every ray is sampled from end to end: no part is skipped, no ray ends early. Pixels are
rows of arrays, the parts of their rays are columns; missing parts are NaN. The other modes use no
samples: see `reference_along`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import reference_along
from reference import pixel_centers

#: By this part of a step a chord may exceed whole steps without another part, and the error of that length.
SPARE, ROUNDING = 1e-3, 1e-9


@dataclass
class Rays:
    """The samples of all rays."""

    value: np.ndarray  # (P, N)
    length: np.ndarray  # of a part of each ray (mm), (P,)
    slope: np.ndarray  # cosine between gradient and view, NaN without; change over two voxels, (P, N, 2)
    unsure: np.ndarray  # whether rounding decides about the number of parts, (P,)

    @property
    def largest(self):
        """Return the largest sample of each ray, (P,)."""
        largest = np.where(np.isnan(self.value), -np.inf, self.value).max(axis=1)
        return np.where(np.isfinite(largest), largest, np.nan)


def index_from_view(volume, camera):
    """Matrix (3, 3) and origin (3,): continuous index as an affine map of view coordinates."""
    right = np.cross(camera.direction, camera.up)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(right, camera.direction), camera.direction], axis=1)
    columns = np.linalg.inv(volume.world_from_index[:3, :3])
    return columns @ axes, columns @ (camera.center - volume.world_from_index[:3, 3])


def interpolate(array, index):
    """Return the voxels [k, j, i] at continuous indices (..., 3); border values continue outside."""
    last = np.array(array.shape[::-1]) - 1
    index = np.clip(index, 0, last)
    low = np.minimum(np.floor(index).astype(int), np.maximum(last - 1, 0))
    high, share = np.minimum(low + 1, last), index - low

    def between(one, other, axis):
        return one + (other - one) * share[..., axis]

    def row(j, k):
        return between(array[k, j, low[..., 0]], array[k, j, high[..., 0]], 0)

    def plane(k):
        return between(row(low[..., 1], k), row(high[..., 1], k), 1)

    return between(plane(low[..., 2]), plane(high[..., 2]), 2)


def chords(volume, camera, q, start):
    """Depths (mm) at which the rays at view x and y `q` enter and leave the box, no earlier than `start`."""
    matrix, origin = index_from_view(volume, camera)
    index, toward = origin + q @ matrix[:, :2].T, matrix[:, 2]
    near, far = np.array(start, dtype=float), np.full(len(q), np.inf)
    for axis in range(3):
        low, high = -0.5 - index[:, axis], volume.size[axis] - 0.5 - index[:, axis]
        if abs(toward[axis]) < 1e-12:
            near[(low > 0) | (high < 0)] = np.inf
            continue
        ends = np.sort(np.stack([low, high]) / toward[axis], axis=0)
        near, far = np.maximum(near, ends[0]), np.minimum(far, ends[1])
    return near, far


def blends(mode, gamma=0.0):
    """Return whether a mode blends samples; the other modes use exact values along rays, without steps."""
    return mode == "dvr" or (mode == "mida" and gamma < 1)


def follow(volume, camera, mode, *, gamma=0.0, step=None, **others):
    """Return what a mode needs of the rays: samples, or exact values. `step` is only for samples."""
    if blends(mode, gamma):
        rays = trace(volume, camera, step, **others)
        assert not rays.unsure.any(), "choose another step: here rounding decides about the number of parts"
        return rays
    others.pop("shading", None)
    return exact(volume, camera, **others)


def exact(volume, camera, *, start=None, q=None):
    """Return exact extremes and means along the rays at view x and y `q`, from depth `start` on."""
    q = pixel_centers(camera) if q is None else q
    start = np.full(len(q), -np.inf) if start is None else start
    near, far = chords(volume, camera, q, start)
    matrix, origin = index_from_view(volume, camera)
    foot = origin + q @ matrix[:, :2].T
    return reference_along.along(volume.array.astype(float), foot, matrix[:, 2], near, far)


def trace(volume, camera, step=None, *, start=None, q=None, shading=False):
    """Return the samples of the rays at view x and y `q`, by default of all pixels, from depth `start` on."""
    q = pixel_centers(camera) if q is None else q
    start = np.full(len(q), -np.inf) if start is None else start
    step = volume.spacing.min() if step is None else step
    near, far = chords(volume, camera, q, start)
    hits = far > near
    chord = np.where(hits, far, 0) - np.where(hits, near, 0)
    steps = chord / step - SPARE
    count = np.where(hits, np.maximum(np.ceil(steps), 1), 0).astype(int)
    length = chord / np.maximum(count, 1)
    part = np.arange(count.max(initial=1))
    depth = np.where(hits, near, 0)[:, None] + (part + 0.5) * length[:, None]
    matrix, origin = index_from_view(volume, camera)
    index = origin + (q @ matrix[:, :2].T)[:, None] + depth[..., None] * matrix[:, 2]
    array = volume.array.astype(float)
    value = np.where(part < count[:, None], interpolate(array, index), np.nan)
    slope = slopes(array, index, matrix) if shading else np.full((*value.shape, 2), np.nan)
    unsure = hits & (np.abs(steps - np.round(steps)) < ROUNDING)
    return Rays(value, length, slope, unsure)


def slopes(array, index, matrix):
    """Return the cosine between gradient and view, NaN if a neighbour is missing, and the change of value."""
    sides = np.eye(3)
    change = [interpolate(array, index + s) - interpolate(array, index - s) for s in sides]
    change = np.stack(change, axis=-1)
    gradient = change @ matrix
    length = np.linalg.norm(gradient, axis=-1)
    cosine = np.divide(np.abs(gradient[..., 2]), length, out=np.full(length.shape, np.nan), where=length > 0)
    return np.stack([cosine, np.linalg.norm(change, axis=-1)], axis=-1)


def normalised(window, value):
    """Map the window's black end to 0, its white end to 1."""
    level, width = window
    return np.clip((value - level) / width + 0.5, 0, 1)


def colour(points, value):
    """Return RGB (..., 3) from 0 to 1 of a transfer function [(intensity, rgb, opacity per mm), …]."""
    at = [p[0] for p in points]
    return np.stack([np.interp(value, at, [p[1][c] / 255 for p in points]) for c in range(3)], axis=-1)


def opacity(points, value, length):
    """Return the opacity of `length` mm."""
    per_mm = np.interp(value, [p[0] for p in points], [p[2] for p in points])
    return 1 - (1 - per_mm) ** length


def shaded(rgb, slope, window):
    """Return colours lit from the viewer; half the shading at a change of a tenth of the window."""
    cosine, change = slope[..., :1], slope[..., 1:]
    share = change**2 / (change**2 + (0.1 * window[1]) ** 2)
    lit = rgb * (1 + share * (0.4 + 0.6 * cosine - 1)) + share * 0.2 * cosine**16
    return np.where(np.isnan(cosine), rgb, np.minimum(lit, 1))


def blend(rays, points, window, gamma):
    """γ-blend: colours times opacity, and opacity, (P, 4)."""
    pixels, parts = rays.value.shape
    out, most = np.zeros((pixels, 4)), np.zeros(pixels)
    for n in range(parts):
        value = rays.value[:, n]
        there = ~np.isnan(value)
        value = np.where(there, value, 0)
        f = normalised(window, value)
        keep = 1 - np.maximum(0, f - most) * (1 + min(gamma, 0))
        own = opacity(points, value, rays.length)
        rgba = np.column_stack([shaded(colour(points, value), rays.slope[:, n], window), np.ones(pixels)])
        share = (1 - keep * out[:, 3]) * own
        out = np.where(there[:, None], keep[:, None] * out + share[:, None] * rgba, out)
        most = np.where(there, np.maximum(most, f), most)
    if gamma > 0:
        out += gamma * (coloured(rays.largest, points) - out)
    return out


def plain_dvr(rays, points, window):
    """Front-to-back compositing as in textbooks, with the product of the transparencies in front."""
    there = ~np.isnan(rays.value)
    value = np.where(there, rays.value, 0)
    own = np.where(there, opacity(points, value, rays.length[:, None]), 0)
    before = np.cumprod(np.column_stack([np.ones(len(own)), 1 - own[:, :-1]]), axis=1)
    rgba = np.concatenate(
        [shaded(colour(points, value), rays.slope, window), np.ones((*own.shape, 1))], axis=-1
    )
    return ((before * own)[..., None] * rgba).sum(axis=1)


def opaque(rgb, value):
    """Return opacity 1 if a ray has a value, otherwise 0."""
    there = ~np.isnan(value)
    return np.where(there[:, None], np.column_stack([rgb, np.ones(len(rgb))]), 0)


def coloured(value, points):
    """Return the colours of the values of rays."""
    return opaque(colour(points, value), value)


def grey(value, window):
    """Return the grey levels of the values of rays."""
    return opaque(np.column_stack([normalised(window, value)] * 3), value)


def gather(rays, mode, points, window, gamma=0.0):
    """Return what a mode makes of the rays: premultiplied colours and opacity, (P, 4), 0 to 1."""
    made = {
        "mida": lambda: blend(rays, points, window, gamma) if gamma < 1 else coloured(rays.largest, points),
        "dvr": lambda: plain_dvr(rays, points, window),
        "mip": lambda: coloured(rays.largest, points),
        "minip": lambda: grey(rays.smallest, window),
        "average": lambda: grey(rays.mean, window),
    }
    return made[mode]()


def starts(value, depth, behind, opacity):
    """Return where the rays of pixels with these surface values start: nowhere (∞) if it is opaque."""
    shown = np.where(np.isnan(value), 0, ramp(opacity, value))
    return np.where(np.isnan(value), -np.inf, np.where(shown < 1, depth + behind, np.inf)).ravel()


def ramp(opacity, value):
    """Return the opacity by the ramp (transparent, opaque); without a ramp everything is opaque."""
    if opacity is None:
        return np.ones(np.shape(value))
    return np.clip((value - opacity[0]) / (opacity[1] - opacity[0]), 0, 1)


def picture(value, context, window, opacity, background):
    """Return surface over context over background, (P, 4): premultiplied colours and opacity."""
    there = ~np.isnan(value)
    shown = np.where(there, ramp(opacity, np.where(there, value, 0)), 0)[:, None]
    grey = normalised(window, np.where(there, value, 0))
    surface = np.column_stack([grey, grey, grey, np.ones(len(grey))]) * shown
    behind = np.array(background) / 255
    behind = np.append(behind[:3] * behind[3], behind[3])
    return surface + (1 - shown) * (context + (1 - context[:, 3:]) * behind)


def slab(volume, camera, depth, thickness, kind):
    """Return the values (H, W) of a thick cut surface at `depth` (H, W); NaN if the surface has none."""
    matrix, origin = index_from_view(volume, camera)
    q, depth, array = pixel_centers(camera), depth.ravel(), volume.array.astype(float)
    foot = origin + q @ matrix[:, :2].T
    index = foot + depth[:, None] * matrix[:, 2]
    outside = ((index < -0.5) | (index > np.array(volume.size) - 0.5)).any(axis=-1)
    thin = np.where(outside, np.nan, interpolate(array, index))
    near, far = chords(volume, camera, q, depth - thickness / 2)
    found = reference_along.along(array, foot, matrix[:, 2], near, np.minimum(far, depth + thickness / 2))
    thick = {"max": found.largest, "min": found.smallest, "mean": found.mean}[kind]
    # If the slab meets no value, the value of the surface itself is shown.
    return np.where(np.isnan(thin) | np.isnan(thick), thin, thick).reshape((camera.size[1], camera.size[0]))
