"""Surface over context over background, thick cut surfaces, previews."""

from __future__ import annotations

from dataclasses import replace

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
    noise,
    placed,
    settings,
    viewed,
)
from lumencut import Camera, Opacity, Renderer, Settings, Slab, Vessel, VesselTree, Volume, Window

STEP = 0.437
GREY = (100.0, 160.0)
RAMP = (90.0, 140.0)


def tree_in(volume, seed=0):
    """Return a few vessels inside the volume."""
    random = np.random.default_rng(seed)
    low, high = volume.corners.min(axis=0), volume.corners.max(axis=0)
    return VesselTree(
        [
            Vessel(random.uniform(0.6 * low + 0.4 * high, 0.4 * low + 0.6 * high, (5, 3)), 0.5)
            for _ in range(2)
        ]
    )


def scene(seed=0, grid="sheared", view="oblique", size=(37, 23)):
    volume = placed(noise(seed, (17, 19, 21)), GRIDS[grid])
    return volume, tree_in(volume, seed), viewed(volume, view, size, zoom=1.7)


def layered(mode="mida", opacity=RAMP, background=(10, 60, 200, 255), **changes):
    own = {name: changes.pop(name) for name in ("slab", "depth_filter") if name in changes}
    if reference_context.blends(mode):
        changes["step"] = STEP
    made = settings(mode, **changes) if mode else Settings(context=None)
    ramp = None if opacity is None else Opacity(*opacity)
    return replace(made, window=Window(*GREY), opacity=ramp, background=background, silhouettes=False, **own)


def context_behind(frame, volume, opacity=RAMP, behind=0.0, mode="mida"):
    """Return the reference's context, with rays that start at the frame's own depth and value."""
    start = reference_context.starts(frame.value.astype(float), frame.depth.astype(float), behind, opacity)
    rays = reference_context.follow(volume, frame.camera, mode, step=STEP, start=start)
    return reference_context.gather(rays, mode, POINTS, WINDOW)


def assert_layers(frame, volume, background, opacity=RAMP, behind=0.0, mode="mida"):
    layer = context_behind(frame, volume, opacity, behind, mode)
    # The surface may be opaque or not within the rounding of 32-bit floats.
    transparent, opaque = opacity or (0, 1)
    share = (frame.value.ravel().astype(float) - transparent) / (opaque - transparent)
    sure = ~(np.abs(share - 1) < 1e-6)
    assert sure.mean() > 0.99
    assert_same(frame.context.reshape(-1, 4)[sure], layer[sure])
    picture = reference_context.picture(frame.value.astype(float).ravel(), layer, GREY, opacity, background)
    assert_same(frame.image.reshape(-1, 4)[sure], picture[sure])
    return layer


@pytest.mark.parametrize(
    "background", [(10, 60, 200, 255), (10, 60, 200, 90), (10, 60, 200, 0), (0, 0, 0, 0)]
)
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
    # If the cut surface is outside the volume but the ray meets the volume, the ray crosses all of it.
    assert (layer[outside.ravel()][:, 3] > 0.1).any()


@each_value
@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("view", ["along j", "oblique"])
def test_layers_on_every_grid(grid, view):
    volume, tree, camera = scene(1, grid, view)
    frame = Renderer(volume, tree).render(camera, layered())
    assert_layers(frame, volume, (10, 60, 200, 255))


def test_layers_where_the_dark_is_opaque():
    volume, tree, camera = scene(1)
    frame = Renderer(volume, tree).render(camera, layered(opacity=RAMP[::-1]))
    assert (reference_context.ramp(RAMP[::-1], frame.value.astype(float)) == 1).any()
    assert_layers(frame, volume, (10, 60, 200, 255), opacity=RAMP[::-1])


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
    picture = reference_context.picture(
        frame.value.astype(float).ravel(), nothing, GREY, RAMP, (10, 60, 200, 90)
    )
    assert_same(frame.image, picture)


def test_where_the_cut_surface_is_outside_the_context_is_that_of_the_volume_alone():
    volume, tree, camera = scene(4)
    frame, alone = (Renderer(volume, t).render(camera, layered()) for t in (tree, None))
    outside = np.isnan(frame.value)
    assert 0.1 < outside.mean() < 0.9
    assert alone.context[outside].any()
    np.testing.assert_array_equal(frame.context[outside], alone.context[outside])


@each_value
@pytest.mark.parametrize("kind", ["max", "mean", "min"])
@pytest.mark.parametrize("thickness", [0.0, 0.3, 2.5, 9.1, 80.0])
@pytest.mark.parametrize("grid", ["anisotropic", "sheared"])
def test_slabs_are_measured_in_millimetres(grid, thickness, kind):
    volume, tree, camera = scene(5, grid)
    frame = Renderer(volume, tree).render(camera, layered(slab=Slab(thickness, kind)))
    depth = frame.depth.astype(float)
    expected = reference_context.slab(volume, camera, depth, thickness, kind)
    # A slab of 80 mm extends out of the volume on both sides.
    assert 0.1 < np.isnan(expected).mean() < 0.9
    np.testing.assert_allclose(frame.value, expected, rtol=0, atol=2e-3)


def test_a_slab_may_hold_any_number_of_voxels():
    voxels = noise(16, (3, 70_000, 3))
    volume = Volume(voxels, spacing=(1.0, 0.005, 1.0))
    tree = VesselTree([Vessel([[0.2, 175.0, 0.3], [1.7, 175.0, 1.6]], 0.5)])
    camera = Camera((1.0, 175.0, 1.0), (0, 1, 0), (0, 0, 1), (3, 2), 0.3)
    frame = Renderer(volume, tree).render(camera, layered(None, slab=Slab(350, "mean")))
    expected = reference_context.slab(volume, camera, frame.depth.astype(float), 350, "mean")
    assert np.isfinite(expected).all()
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


@pytest.mark.parametrize("size", [(36, 24), (37, 23), (1, 17), (1, 1)])
@pytest.mark.parametrize("mode", ["mida", "mip", "average"])
def test_a_preview_blends_rays_through_the_middles_of_squares(mode, size):
    volume = placed(noise(8), GRIDS["oblique"])
    camera = viewed(volume, "oblique", size)
    image = drawn(volume, camera, mode, step=STEP, preview=True)
    side, (width, height) = 6, size
    columns, rows = -(-width // side), -(-height // side)
    x = (side * np.arange(columns) + side / 2 - width / 2) * camera.pixel_spacing
    y = (height / 2 - side * np.arange(rows) - side / 2) * camera.pixel_spacing
    q = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    rays = reference_context.follow(volume, camera, mode, step=STEP, q=q)
    layer = reference_context.gather(rays, mode, POINTS, WINDOW).reshape(rows, columns, 4)
    for axis, count, squares in ((0, height, rows), (1, width, columns)):
        place = np.clip((np.arange(count) + 0.5) / side - 0.5, 0, squares - 1)
        low = place.astype(int)
        part = (place - low).reshape(-1, *[1] * (2 - axis))
        near, far = (np.take(layer, np.minimum(low + step, squares - 1), axis) for step in (0, 1))
        layer = near + part * (far - near)
    assert_same(image, layer.reshape(-1, 4))


def test_a_preview_of_layers_keeps_the_surface_as_it_is():
    volume, tree, camera = scene(9)
    renderer = Renderer(volume, tree)
    fine, coarse = (renderer.render(camera, layered(preview=preview)) for preview in (False, True))
    np.testing.assert_array_equal(fine.value, coarse.value)
    opaque = reference_context.ramp(RAMP, fine.value.astype(float)) == 1
    np.testing.assert_array_equal(fine.image[opaque], coarse.image[opaque])
    assert not coarse.context[opaque].any()


def test_views_of_one_renderer_do_not_depend_on_each_other():
    volume, tree, _ = scene(15)
    renderer = Renderer(volume, tree)
    views = [viewed(volume, view, (37, 23)) for view in VIEWS]
    first = [renderer.render(view, layered()).image for view in views]
    for view, image in zip(reversed(views), reversed(first), strict=True):
        renderer.render(view, layered("dvr", shading=True))
        np.testing.assert_array_equal(renderer.render(view, layered()).image, image)
