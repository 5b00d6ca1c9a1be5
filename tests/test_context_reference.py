"""The context agrees with the slow reference: each channel of each pixel within 1 of 255."""

from __future__ import annotations

import numpy as np
import pytest

import reference_context
from conftest import each_value
from context_scenes import (
    GRIDS,
    POINTS,
    VIEWS,
    WINDOW,
    assert_same,
    difference,
    drawn,
    expected,
    noise,
    placed,
    viewed,
)
from lumencut import Camera, Volume
from reference_along import Extremes

MODES = {
    "dvr": ("dvr", {}),
    "mida": ("mida", {}),
    "between dvr and mida": ("mida", {"gamma": -0.4}),
    "between mida and mip": ("mida", {"gamma": 0.6}),
    "mip": ("mip", {}),
    "minip": ("minip", {}),
    "average": ("average", {}),
    "dvr, shaded": ("dvr", {"shading": True}),
    "mida, shaded": ("mida", {"shading": True}),
    "between mida and mip, shaded": ("mida", {"gamma": 0.3, "shading": True}),
}
#: The modes that take samples at steps.
BLENDS = [name for name, (mode, _) in MODES.items() if reference_context.blends(mode)]
#: A step (mm) that divides no chord along an axis.
STEP = 0.437


def assert_all_modes(volume, camera, step=STEP, modes=MODES):
    for mode, changes in (MODES[name] for name in modes):
        assert_same(
            drawn(volume, camera, mode, step=step, **changes),
            expected(volume, camera, mode, step=step, **changes),
        )


@each_value
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("grid", GRIDS)
def test_every_mode_on_every_grid_in_every_view(grid, mode):
    volume = placed(noise(1), GRIDS[grid])
    for view in VIEWS:
        assert_all_modes(volume, viewed(volume, view), modes=[mode])


@pytest.mark.parametrize("grid", ["anisotropic", "oblique", "sheared"])
@pytest.mark.parametrize("mode", ["dvr", "mida"])
def test_the_default_step_is_half_the_smallest_side_of_a_voxel(grid, mode):
    volume = placed(noise(2), GRIDS[grid])
    camera = viewed(volume, "oblique")
    side = min(np.linalg.norm(GRIDS[grid], axis=0))
    assert_same(drawn(volume, camera, mode, step=None), expected(volume, camera, mode, step=side / 2))


@pytest.mark.parametrize("step", [0.011, 0.1, 1.03, 3.1, 50.0])
def test_every_step(step):
    volume = placed(noise(3), GRIDS["sheared"])
    assert_all_modes(volume, viewed(volume, "oblique", (9, 7)), step, modes=BLENDS)


@pytest.mark.parametrize(
    "shape", [(1, 11, 13), (9, 1, 13), (9, 11, 1), (1, 1, 13), (1, 11, 1), (9, 1, 1), (1, 1, 1)]
)
def test_volumes_of_one_voxel_along_an_axis(shape):
    volume = placed(noise(4, shape) / 2 + 100, GRIDS["sheared"])
    for view in VIEWS:
        assert_all_modes(volume, viewed(volume, view, (13, 11)), 0.0537)


@pytest.mark.parametrize("size", [(1, 17), (17, 1), (1, 1), (67, 5), (5, 67)])
def test_odd_sizes_of_the_image(size):
    volume = placed(noise(5), GRIDS["anisotropic"])
    assert_all_modes(volume, viewed(volume, "oblique", size), modes=["mida", "mip", "average"])


def test_a_volume_of_many_blocks():
    # Smooth blobs in empty space, so that much can be skipped, and a wall that ends rays.
    k, j, i = np.mgrid[:70, :50, :60]
    blobs = 240 * np.exp(-(((i - 20) ** 2 + (j - 25) ** 2 + (k - 30) ** 2) / 60))
    blobs += 150 * np.exp(-(((i - 45) ** 2 + (j - 15) ** 2 + (k - 50) ** 2) / 90)) + 250 * (j > 44)
    volume = placed(blobs.astype(np.int16), GRIDS["sheared"])
    assert_all_modes(volume, viewed(volume, "oblique", (31, 23)))
    assert_all_modes(volume, viewed(volume, "along j", (31, 23)), modes=["mida"])


ARRAYS = {
    "uint8": lambda a: a.astype(np.uint8),
    "int16": lambda a: a.astype(np.int16),
    "uint16": lambda a: a.astype(np.uint16),
    "int32": lambda a: a.astype(np.int32),
    "float64": lambda a: a.astype(np.float64),
    "big-endian": lambda a: a.astype(">f4"),
    "Fortran order": lambda a: np.asfortranarray(a),
    "j fastest": lambda a: np.ascontiguousarray(a.transpose(0, 2, 1)).transpose(0, 2, 1),
    "every other voxel": lambda a: np.repeat(np.repeat(a, 2, axis=2), 2, axis=0)[::2, :, ::2],
    "backwards": lambda a: a[::-1, :, ::-1].copy()[::-1, :, ::-1],
}


@pytest.mark.parametrize("kind", ARRAYS)
def test_every_kind_of_array(kind):
    volume = placed(ARRAYS[kind](noise(6)), GRIDS["oblique"])
    modes = ["mida", "mip", "minip", "average", "dvr, shaded"]
    assert_all_modes(volume, viewed(volume, "oblique"), modes=modes)


@each_value
@pytest.mark.parametrize("share", [0.002, 0.05, 0.6, 1.0])
@pytest.mark.parametrize("view", ["along j", "oblique"])
def test_samples_beside_nan_do_not_exist(view, share):
    voxels = noise(7)
    voxels[np.random.default_rng(8).random(voxels.shape) < share] = np.nan
    volume = placed(voxels, GRIDS["sheared"])
    camera = viewed(volume, view)
    rays = reference_context.trace(volume, camera, STEP)
    assert np.isnan(rays.value).all(axis=1).any()
    assert_all_modes(volume, camera)


def test_nothing_but_nan_and_nothing_in_sight_leave_no_trace():
    volume = placed(np.full((3, 4, 5), np.nan, np.float32), np.eye(3))
    away = viewed(volume, "oblique").panned(100, 0)
    for mode, changes in MODES.values():
        assert not drawn(volume, viewed(volume, "oblique"), mode, **changes).any()
        assert not drawn(placed(noise(9), np.eye(3)), away, mode, **changes).any()


def test_rays_in_the_faces_of_the_box_and_just_beside_them():
    # Only integers and halves: these rays run exactly in the outer faces, half a voxel beyond the centres.
    volume = Volume(noise(10, (8, 8, 8)))
    camera = Camera((3.5, 0, 3.5), (0, 1, 0), (0, 0, 1), (11, 11), 1.0)
    on_faces = Camera((3.5, 0, 3.5), (0, 1, 0), (0, 0, 1), (9, 9), 1.0)
    for mode, changes in MODES.values():
        assert_same(
            drawn(volume, camera, mode, step=0.3, **changes),
            expected(volume, camera, mode, step=0.3, **changes),
        )
        assert drawn(volume, on_faces, mode, step=0.3, **changes)[..., 3].all()
        assert not drawn(volume, camera, mode, step=0.3, **changes)[0].any()


def test_far_from_the_origin_of_world_space_and_of_the_view():
    volume = placed(noise(13), GRIDS["sheared"], center=(-200_000.0, 300_000.0, 100_000.0))
    near = viewed(volume, "oblique")
    away = Camera(near.center + 3e5 * near.direction, near.direction, near.up, near.size, near.pixel_spacing)
    for camera in (near, away):
        assert_all_modes(volume, camera, modes=["mida, shaded", "mip", "average"])


def test_large_and_small_values():
    for scale, shift in ((1e-6, 0.0), (1e6, 0.0), (1.0, -3e4), (1.0, 1e6)):
        volume = placed(noise(14).astype(np.float64) * scale + shift, GRIDS["oblique"])
        points = [(at * scale + shift, rgb, opacity) for at, rgb, opacity in POINTS]
        window = (WINDOW[0] * scale + shift, WINDOW[1] * scale)
        camera = viewed(volume, "oblique")
        for mode, changes in (MODES[name] for name in ("dvr, shaded", "mida", "mip", "minip", "average")):
            same = {"points": points, "window": window, "step": STEP, **changes}
            assert_same(drawn(volume, camera, mode, **same), expected(volume, camera, mode, **same))


def test_as_many_control_points_as_there_may_be():
    random = np.random.default_rng(15)
    at = np.linspace(10, 240, 64)
    points = [(v, tuple(random.integers(0, 256, 3).tolist()), random.uniform(0, 0.3)) for v in at]
    volume = placed(noise(15), GRIDS["oblique"])
    camera = viewed(volume, "oblique")
    for mode in ("dvr", "mip"):
        same = {"points": points, "step": STEP}
        assert_same(drawn(volume, camera, mode, **same), expected(volume, camera, mode, **same))


def test_the_comparison_sees_wrong_settings():
    volume = placed(noise(11), GRIDS["sheared"])
    camera = viewed(volume, "oblique")
    changed = [(p[0] + 4, p[1], p[2]) for p in POINTS]
    for name, changes in {
        "points": {"points": changed},
        "gamma": {"gamma": 0.05},
        "step": {"step": 1.3 * STEP},
        "shading": {"shading": True},
        "window": {"window": (WINDOW[0], 1.2 * WINDOW[1])},
    }.items():
        layer = expected(volume, camera, "mida", **{"step": STEP, **changes})
        assert difference(drawn(volume, camera, "mida", step=STEP), layer).pixels > 50, name


def test_the_reference_agrees_with_itself():
    # γ = -1 is usual compositing; γ just below 1 is almost the maximum.
    volume = placed(noise(12), GRIDS["oblique"])
    rays = reference_context.trace(volume, viewed(volume, "oblique"), STEP)
    for gamma, plain, tolerance in ((-1.0, "dvr", 1e-12), (1 - 1e-9, "mip", 1e-8)):
        both = (reference_context.gather(rays, mode, POINTS, WINDOW, gamma) for mode in ("mida", plain))
        np.testing.assert_allclose(*both, rtol=0, atol=tolerance)


@pytest.mark.parametrize("grid", GRIDS)
def test_the_exact_values_of_the_reference_are_what_dense_samples_tend_to(grid):
    voxels = noise(16)
    voxels[2, 3, 4] = np.nan
    volume = placed(voxels, GRIDS[grid])
    for view in ("along j", "oblique"):
        camera = viewed(volume, view, (9, 7))
        found, dense = reference_context.exact(volume, camera), reference_context.trace(volume, camera, 0.002)
        none = np.isnan(dense.value).all(axis=1)
        np.testing.assert_array_equal(np.isnan(found.largest), none)
        assert 0 < none.sum() < len(none)
        value = dense.value[~none]
        high, low = np.nanmax(value, 1), np.nanmin(value, 1)
        for excess in (found.largest[~none] - high, low - found.smallest[~none]):
            assert excess.min() > -1e-9
            assert excess.max() < 0.5
        np.testing.assert_allclose(found.mean[~none], np.nanmean(value, 1), rtol=0, atol=0.2)


@pytest.mark.parametrize("mode", ["mip", "minip", "average"])
def test_the_comparison_sees_samples_in_place_of_exact_values(mode):
    volume = placed(noise(17), GRIDS["sheared"])
    camera = viewed(volume, "oblique")
    rays = reference_context.trace(volume, camera, volume.spacing.min())
    there = ~np.isnan(rays.value)
    mean = np.where(there, rays.value, 0).sum(axis=1) / np.where(there.any(axis=1), there.sum(axis=1), np.nan)
    smallest, largest = (np.fmin.reduce(rays.value, axis=1), np.fmax.reduce(rays.value, axis=1))
    layer = reference_context.gather(Extremes(smallest, largest, mean), mode, POINTS, WINDOW)
    assert difference(drawn(volume, camera, mode), layer).pixels > 20
