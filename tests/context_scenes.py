"""Volumes and views for the tests of the context, and the comparison of its pictures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import reference_context
from lumencut import Camera, Renderer, Settings, TransferFunction, Volume, Window

POINTS = [
    (60.0, (20, 200, 90), 0.0),
    (110.0, (250, 40, 10), 0.15),
    (170.0, (30, 60, 220), 0.05),
    (240.0, (255, 250, 200), 0.7),
]
WINDOW = (120.0, 220.0)
GRIDS = {
    "isotropic": np.eye(3),
    "anisotropic": np.diag([0.6, 0.9, 2.3]),
    "left-handed": np.diag([1.1, 0.8, -1.7]),
    "oblique": np.array([[0.8, -0.6, 0.0], [0.48, 0.64, -0.6], [0.36, 0.48, 0.8]]),
    "sheared": np.array([[1.0, 0.4, -0.1], [-0.2, 1.2, 0.3], [0.2, 0.0, -1.5]]),
}
VIEWS = {
    "along i": ((1, 0, 0), (0, 0, 1)),
    "along j": ((0, 1, 0), (0, 0, 1)),
    "against k": ((0, 0, -1), (0, -1, 0)),
    "in a plane": ((0.6, 0.8, 0), (0, 0, 1)),
    "oblique": ((0.4, 1.0, -0.7), (0.1, 0.2, 1)),
}


def placed(array, columns, center=(3.0, -40.0, 12.0)):
    """A volume whose middle is at `center`."""
    affine = np.eye(4)
    middle = (np.array(array.shape[::-1]) - 1) / 2
    affine[:3, :3], affine[:3, 3] = columns, np.array(center) - columns @ middle
    return Volume(array, world_from_index=affine)


def noise(seed, shape=(9, 11, 13), dtype=np.float32):
    return np.random.default_rng(seed).uniform(0, 250, shape).astype(dtype)


def viewed(volume, view, size=(37, 23), zoom=0.9):
    """A camera that sees the volume and some space beside it, slightly off the middle."""
    direction, up = VIEWS[view]
    return Camera.fitted(volume, direction, up, size).zoomed(zoom).panned(0.0317, -0.0531)


def settings(mode, points=POINTS, window=WINDOW, **changes):
    changes = {f"context_{name}": value for name, value in changes.items()}
    return Settings(
        context=mode, context_transfer=TransferFunction(points), context_window=Window(*window), **changes
    )


def drawn(volume, camera, mode, **changes):
    """Return the picture of the context only, RGBA with straight alpha, (H, W, 4).

    `step`, by default the side of a voxel, is only for modes that blend; the others reject it.
    """
    changes.setdefault("step", volume.spacing.min())
    if not reference_context.blends(mode, changes.get("gamma", 0.0)):
        del changes["step"]
    return Renderer(volume, None).render(camera, settings(mode, **changes)).context


def expected(volume, camera, mode, points=POINTS, window=WINDOW, gamma=0.0, **changes):
    """Return the picture of the reference: premultiplied colours and opacity, (H · W, 4), 0 to 1."""
    rays = reference_context.follow(volume, camera, mode, gamma=gamma, **changes)
    return reference_context.gather(rays, mode, points, window, gamma)


@dataclass
class Difference:
    """The largest differences of colour and opacity (of 255), and how many pixels differ by more than 1."""

    colour: float
    opacity: float
    pixels: int


def difference(found, layer):
    """Compare RGBA bytes with premultiplied colours.

    A colour counts if its opacity does not round to 0. The tolerance of 1 is the sum of ½ for the byte,
    ¼ for the rest of a ray that ends once its opacity exceeds 1 - 1/1024, and rounding of 32-bit floats.
    """
    found, alpha = found.reshape(-1, 4).astype(float), layer[:, 3]
    seen = alpha * 255 >= 0.5
    straight = np.divide(layer[:, :3], alpha[:, None], out=np.zeros((len(layer), 3)), where=seen[:, None])
    colour = np.where(seen[:, None], np.abs(found[:, :3] - 255 * straight), 0).max(axis=1)
    opacity = np.abs(found[:, 3] - 255 * alpha)
    return Difference(colour.max(), opacity.max(), int(((colour > 1) | (opacity > 1)).sum()))


def assert_same(found, layer):
    result = difference(found, layer)
    assert result.pixels == 0, result
