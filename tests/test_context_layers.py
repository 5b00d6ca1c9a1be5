"""Surface over context over background, thick cut surfaces, and what must not change the context."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import reference_context
from context_scenes import GRIDS, POINTS, VIEWS, WINDOW, assert_same, difference, drawn, noise, placed, settings
from context_scenes import viewed
from lumencut import Camera, Opacity, Renderer, Settings, Slab, Vessel, VesselTree, Volume, Window

STEP = 0.437
GREY = (100.0, 160.0)
RAMP = (90.0, 140.0)


def tree_in(volume, seed=0):
    """A few vessels inside the volume."""
    random = np.random.default_rng(seed)
    low, high = volume.corners.min(axis=0), volume.corners.max(axis=0)
    return VesselTree([Vessel(random.uniform(0.6 * low + 0.4 * high, 0.4 * low + 0.6 * high, (5, 3)), 0.5) for _ in range(2)])


def scene(seed=0, grid="sheared", view="oblique", size=(37, 23)):
    volume = placed(noise(seed, (17, 19, 21)), GRIDS[grid])
    return volume, tree_in(volume, seed), viewed(volume, view, size, zoom=1.7)


def layered(mode="mida", opacity=RAMP, background=(10, 60, 200, 255), **changes):
    own = {name: changes.pop(name) for name in ("slab", "depth_filter") if name in changes}
    made = settings(mode, step=STEP, **changes) if mode else Settings(context=None)
    ramp = None if opacity is None else Opacity(*opacity)
    return replace(
        made, window=Window(*GREY), opacity=ramp, background=background, silhouettes=False, **own
    )


def context_behind(frame, volume, opacity=RAMP, behind=0.0, mode="mida"):
    """The reference's rays, started where the frame's own depth and value say."""
    start = reference_context.starts(frame.value.astype(float), frame.depth.astype(float), behind, opacity)
    rays = reference_context.trace(volume, frame.camera, STEP, start=start)
    assert not rays.unsure.any()
    return reference_context.gather(rays, mode, POINTS, WINDOW)


def assert_layers(frame, volume, background, opacity=RAMP, behind=0.0, mode="mida"):
    layer = context_behind(frame, volume, opacity, behind, mode)
    # The surface is just opaque, or not quite, within the rounding of 32-bit floats.
    edge = np.abs(reference_context.ramp(opacity, frame.value.astype(float)).ravel() - 1) < 1e-6
    sure = ~edge | (np.nan_to_num(frame.value.ravel(), nan=np.inf) >= (opacity or (0, 0))[1] + 1e-3)
    assert sure.mean() > 0.99
    assert_same(frame.context.reshape(-1, 4)[sure], layer[sure])
    picture = reference_context.picture(frame.value.astype(float).ravel(), layer, GREY, opacity, background)
    assert_same(frame.image.reshape(-1, 4)[sure], picture[sure])
    return layer


@pytest.mark.parametrize("background", [(10, 60, 200, 255), (10, 60, 200, 90), (10, 60, 200, 0), (0, 0, 0, 0)])
@pytest.mark.parametrize("mode", ["dvr", "mida", "mip", "average"])
def test_rays_start_at_a_transparent_surface_and_cross_all_where_it_is_outside(mode, background):
    volume, tree, camera = scene()
    frame = Renderer(volume, tree).render(camera, layered(mode, background=background))
    shown = reference_context.ramp(RAMP, frame.value.astype(float))
    outside = np.isnan(shown)
    for group in (outside, shown == 0, (shown > 0) & (shown < 1), shown == 1):
        assert group.mean() > 0.05, "all kinds of pixels must be seen"
    layer = assert_layers(frame, volume, background, mode=mode)
    assert not frame.context[shown == 1].any()
    # Where the cut surface is outside, but within sight of the volume, the whole volume is crossed.
    assert (layer[outside.ravel()][:, 3] > 0.1).any()


@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("view", ["along j", "oblique"])
def test_layers_on_every_grid(grid, view):
    volume, tree, camera = scene(1, grid, view)
    frame = Renderer(volume, tree).render(camera, layered())
    assert_layers(frame, volume, (10, 60, 200, 255))


def test_without_an_opacity_the_surface_hides_the_context():
    volume, tree, camera = scene(2)
    frame = Renderer(volume, tree).render(camera, layered(opacity=None))
    inside = ~np.isnan(frame.value)
    assert 0.1 < inside.mean() < 0.9
    assert not frame.context[inside].any()
    assert frame.context[~inside][:, 3].any()
    assert_layers(frame, volume, (10, 60, 200, 255), opacity=None)


def test_without_a_context_the_background_shows():
    volume, tree, camera = scene(3)
    frame = Renderer(volume, tree).render(camera, layered(None, background=(10, 60, 200, 90)))
    nothing = np.zeros((frame.value.size, 4))
    picture = reference_context.picture(frame.value.astype(float).ravel(), nothing, GREY, RAMP, (10, 60, 200, 90))
    assert_same(frame.image, picture)


def test_where_the_cut_surface_is_outside_the_context_is_that_of_the_volume_alone():
    volume, tree, camera = scene(4)
    frame, alone = (Renderer(volume, t).render(camera, layered()) for t in (tree, None))
    outside = np.isnan(frame.value)
    assert 0.1 < outside.mean() < 0.9
    assert alone.context[outside].any()
    np.testing.assert_array_equal(frame.context[outside], alone.context[outside])


@pytest.mark.parametrize("kind", ["max", "mean", "min"])
@pytest.mark.parametrize("thickness", [0.0, 0.3, 2.5, 9.1, 80.0])
@pytest.mark.parametrize("grid", ["anisotropic", "sheared"])
def test_slabs_are_measured_in_millimetres(grid, thickness, kind):
    volume, tree, camera = scene(5, grid)
    frame = Renderer(volume, tree).render(camera, layered(slab=Slab(thickness, kind)))
    depth = frame.depth.astype(float)
    expected = reference_context.slab(volume, camera, depth, thickness, kind)
    # 80 mm reach out of the volume on both sides.
    assert 0.1 < np.isnan(expected).mean() < 0.9
    np.testing.assert_allclose(frame.value, expected, rtol=0, atol=2e-3)


def test_slabs_leave_out_what_is_nan_and_are_nan_where_the_cut_surface_is():
    volume, tree, camera = scene(6, "oblique")
    volume.array[np.random.default_rng(6).random(volume.array.shape) < 0.03] = np.nan
    for kind in ("max", "mean", "min"):
        frame = Renderer(volume, tree).render(camera, layered(slab=Slab(5.3, kind)))
        expected = reference_context.slab(volume, camera, frame.depth.astype(float), 5.3, kind)
        np.testing.assert_allclose(frame.value, expected, rtol=0, atol=2e-3)


def test_behind_a_slab_rays_start_where_it_ends():
    volume, tree, camera = scene(7)
    for kind in ("max", "mean"):
        frame = Renderer(volume, tree).render(camera, layered(slab=Slab(3.7, kind)))
        layer = assert_layers(frame, volume, (10, 60, 200, 255), behind=1.85)
        assert difference(frame.context, context_behind(frame, volume)).pixels > 20
        assert (layer[:, 3] > 0).any()


@pytest.mark.parametrize("size", [(36, 22), (37, 23), (1, 17), (1, 1)])
@pytest.mark.parametrize("mode", ["mida", "mip", "average"])
def test_a_preview_traces_the_middle_of_each_square_of_four_pixels(mode, size):
    volume = placed(noise(8), GRIDS["oblique"])
    camera = viewed(volume, "oblique", size)
    image = drawn(volume, camera, mode, step=STEP, preview=True)
    width, height = size
    x = (2 * np.arange((width + 1) // 2) + 1 - width / 2) * camera.pixel_spacing
    y = (height / 2 - 2 * np.arange((height + 1) // 2) - 1) * camera.pixel_spacing
    q = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    layer = reference_context.gather(reference_context.trace(volume, camera, STEP, q=q), mode, POINTS, WINDOW)
    squares = layer.reshape(len(y), len(x), 4).repeat(2, axis=0).repeat(2, axis=1)[:height, :width]
    assert_same(image, squares.reshape(-1, 4))


def test_a_preview_of_layers_keeps_the_surface_as_it_is():
    volume, tree, camera = scene(9)
    renderer = Renderer(volume, tree)
    fine, coarse = (renderer.render(camera, layered(preview=preview)) for preview in (False, True))
    np.testing.assert_array_equal(fine.value, coarse.value)
    opaque = reference_context.ramp(RAMP, fine.value.astype(float)) == 1
    np.testing.assert_array_equal(fine.image[opaque], coarse.image[opaque])
    assert not coarse.context[opaque].any()


def turned(volume, camera, turn, shift):
    """The whole scene moved: volume and camera alike."""
    move = np.eye(4)
    move[:3, :3], move[:3, 3] = turn, shift
    view = Camera(turn @ camera.center + shift, turn @ camera.direction, turn @ camera.up, camera.size, camera.pixel_spacing)
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
    # A camera is right-handed, so the mirrored view has its columns the other way round.
    flipped, view = turned(volume, camera, mirror, np.zeros(3))
    one, other = drawn(volume, camera, mode, step=STEP), drawn(flipped, view, mode, step=STEP)
    assert np.abs(one.astype(int) - other[:, ::-1])[one[..., 3] > 2].max() <= 1


def blobs():
    """Bright blobs in something clear, and the voxels all of whose neighbours are clear too."""
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
@pytest.mark.parametrize("mode", [("dvr", {}), ("dvr", {"shading": True}), ("mida", {}), ("mida", {"gamma": -0.5})], ids=str)
def test_painting_what_is_clear_changes_nothing_to_the_bit(mode, value):
    # Values that the transfer function hides, in voxels whose neighbours it hides too: no visible sample changes.
    array, hidden = blobs()
    assert 0.5 < hidden.mean() < 0.99
    # Gradients reach one voxel further.
    still = np.lib.stride_tricks.sliding_window_view(np.pad(hidden, 1), (3, 3, 3)).all(axis=(3, 4, 5))
    painted = np.where(still, np.float32(value), array)
    for view in ("along j", "oblique"):
        camera = viewed(placed(array, GRIDS["sheared"]), view, (61, 47))
        one, other = (drawn(placed(a, GRIDS["sheared"]), camera, mode[0], **mode[1]) for a in (array, painted))
        assert one[..., 3].max() > 100
        np.testing.assert_array_equal(one, other)


def test_painting_what_is_too_bright_to_be_seen_changes_nothing_for_dvr():
    # Clear above 300 as well: DVR does not care, MIDA pushes back what is in front of it.
    points = [*POINTS, (300.0, (0, 0, 0), 0.0)]
    array, hidden = blobs()
    array[:, 34:] = np.where(hidden[:, 34:], 300.0, array[:, 34:])
    deep = np.lib.stride_tricks.sliding_window_view(np.pad(array >= 300, 1), (3, 3, 3)).all(axis=(3, 4, 5))
    assert deep.any()
    painted = np.where(deep, np.float32(5000), array)
    one, other = (placed(a, GRIDS["isotropic"]) for a in (array, painted))
    camera = viewed(one, "along j", (61, 47))
    np.testing.assert_array_equal(
        *(drawn(volume, camera, "dvr", points=points) for volume in (one, other))
    )
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
    # Samples on voxel centres: δ = ½ keeps half of the red.
    image = drawn(Volume(volume), camera, "mida", points=points, window=(200.0, 400.0))
    assert np.abs(image - [125, 0, 125, 255.0]).max() <= 0.52
    assert (drawn(Volume(volume), camera, "dvr", points=points)[..., :3] == (250, 0, 0)).all()


def test_views_of_one_renderer_do_not_depend_on_each_other():
    volume, tree, _ = scene(15)
    renderer = Renderer(volume, tree)
    views = [viewed(volume, view, (37, 23)) for view in VIEWS]
    first = [renderer.render(view, layered()).image for view in views]
    for view, image in zip(reversed(views), reversed(first), strict=True):
        renderer.render(view, layered("dvr", shading=True))
        np.testing.assert_array_equal(renderer.render(view, layered()).image, image)
