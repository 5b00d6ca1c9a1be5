"""The context does not change if the whole scene moves, or if invisible values change."""

from __future__ import annotations

import numpy as np
import pytest

from context_scenes import GRIDS, POINTS, drawn, noise, placed, viewed
from lumencut import Camera, Volume

STEP = 0.437


def turned(volume, camera, turn, shift):
    """Move the whole scene: volume and camera together."""
    move = np.eye(4)
    move[:3, :3], move[:3, 3] = turn, shift
    view = Camera(
        turn @ camera.center + shift,
        turn @ camera.direction,
        turn @ camera.up,
        camera.size,
        camera.pixel_spacing,
    )
    return Volume(volume.array, world_from_index=move @ volume.world_from_index), view


@pytest.mark.parametrize("mode", ["dvr", "mida", "mip", "minip", "average"])
def test_turning_scene_and_camera_together_changes_nothing(mode):
    volume = placed(noise(10), GRIDS["sheared"])
    camera = viewed(volume, "oblique")
    turn, _ = np.linalg.qr(np.random.default_rng(10).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    moved = turned(volume, camera, turn, np.array([500.0, -800, 300]))
    for shading in (False, True):
        one = drawn(volume, camera, mode, step=STEP, shading=shading)
        other = drawn(*moved, mode, step=STEP, shading=shading)
        np.testing.assert_array_equal(one[..., 3] > 0, other[..., 3] > 0)
        assert np.abs(one.astype(int) - other)[one[..., 3] > 2].max() <= 1


@pytest.mark.parametrize("mode", ["dvr", "mida"])
def test_a_mirrored_scene_gives_the_mirrored_picture(mode):
    volume = placed(noise(11), GRIDS["anisotropic"])
    camera = viewed(volume, "oblique")
    mirror = np.diag([-1.0, 1, 1])
    # A camera is always right-handed, so the columns of the mirrored view run in the other direction.
    flipped, view = turned(volume, camera, mirror, np.zeros(3))
    one, other = drawn(volume, camera, mode, step=STEP), drawn(flipped, view, mode, step=STEP)
    assert np.abs(one.astype(int) - other[:, ::-1])[one[..., 3] > 2].max() <= 1


def blobs():
    """Return bright blobs in transparent values, and the voxels with only transparent neighbours."""
    random = np.random.default_rng(12)
    array = random.uniform(0, 55, (40, 44, 48)).astype(np.float32)
    k, j, i = np.mgrid[:40, :44, :48]
    for center in random.uniform(8, 32, (5, 3)):
        near = ((k - center[0]) ** 2 + (j - center[1]) ** 2 + (i - center[2]) ** 2) < 16
        array[near] = random.uniform(90, 240)
    padded = np.pad(array > 60, 1)
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3, 3))
    return array, ~windows.any(axis=(3, 4, 5))


@pytest.mark.parametrize("value", [-1000.0, 0.0, 59.0])
@pytest.mark.parametrize(
    "mode", [("dvr", {}), ("dvr", {"shading": True}), ("mida", {}), ("mida", {"gamma": -0.5})], ids=str
)
def test_painting_what_is_clear_changes_nothing_to_the_bit(mode, value):
    # Change values of voxels whose neighbours are all hidden too: no visible sample uses them.
    array, hidden = blobs()
    assert 0.5 < hidden.mean() < 0.99
    still = np.lib.stride_tricks.sliding_window_view(np.pad(hidden, 1), (3, 3, 3)).all(axis=(3, 4, 5))
    painted = np.where(still, np.float32(value), array)
    for view in ("along j", "oblique"):
        camera = viewed(placed(array, GRIDS["sheared"]), view, (61, 47))
        one, other = (
            drawn(placed(a, GRIDS["sheared"]), camera, mode[0], **mode[1]) for a in (array, painted)
        )
        assert one[..., 3].max() > 100
        np.testing.assert_array_equal(one, other)


def test_painting_what_is_too_bright_to_be_seen_changes_nothing_for_dvr():
    # Transparent above 300 as well: DVR ignores this, MIDA dims what lies in front.
    points = [*POINTS, (300.0, (0, 0, 0), 0.0)]
    array, hidden = blobs()
    array[:, 34:] = np.where(hidden[:, 34:], 300.0, array[:, 34:])
    deep = np.lib.stride_tricks.sliding_window_view(np.pad(array >= 300, 1), (3, 3, 3)).all(axis=(3, 4, 5))
    assert deep.any()
    painted = np.where(deep, np.float32(5000), array)
    one, other = (placed(a, GRIDS["isotropic"]) for a in (array, painted))
    camera = viewed(one, "along j", (61, 47))
    np.testing.assert_array_equal(*(drawn(volume, camera, "dvr", points=points) for volume in (one, other)))
    mida = [drawn(volume, camera, "mida", points=points, window=(2500, 5000)) for volume in (one, other)]
    assert (mida[0] != mida[1]).any(axis=2).mean() > 0.02


@pytest.mark.parametrize("mode", ["dvr", "mida"])
def test_nothing_dimmer_shows_behind_what_is_opaque(mode):
    points = [(60.0, (20, 200, 90), 0.0), (200.0, (250, 240, 10), 1.0)]
    array = noise(13, (20, 30, 25)).clip(0, 190)
    array[:, 10:13] = 200
    other = array.copy()
    other[:, 14:] = np.random.default_rng(14).uniform(0, 200, other[:, 14:].shape)
    camera = viewed(placed(array, GRIDS["anisotropic"]), "along j", zoom=1.9)
    one, two = (drawn(placed(a, GRIDS["anisotropic"]), camera, mode, points=points) for a in (array, other))
    assert (one[..., 3] == 255).mean() > 0.3
    inside = one[..., 3] == 255
    np.testing.assert_array_equal(one[inside], two[inside])


def test_something_brighter_shines_through_what_is_opaque_in_mida():
    points = [(60.0, (20, 200, 90), 0.0), (200.0, (250, 0, 0), 1.0), (400.0, (0, 0, 250), 1.0)]
    volume = np.zeros((5, 20, 5), np.float32)
    volume[:, 5:8] = 200
    volume[:, 12:15] = 400
    camera = Camera((2, 0, 2), (0, 1, 0), (0, 0, 1), (5, 5))
    # The samples lie on voxel centres: δ = ½ keeps half of the red.
    image = drawn(Volume(volume), camera, "mida", points=points, window=(200.0, 400.0))
    assert np.abs(image - [125, 0, 125, 255.0]).max() <= 0.52
    assert (drawn(Volume(volume), camera, "dvr", points=points)[..., :3] == (250, 0, 0)).all()
