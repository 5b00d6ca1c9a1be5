"""Views: the six named ones, fitted views, turning, zooming and panning."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from lumencut import VIEWS, Camera, CameraError, Renderer, Settings, Vessel, VesselTree, Volume

LEFT, POSTERIOR, SUPERIOR = np.eye(3)
BODY = {
    "anterior": (POSTERIOR, LEFT, SUPERIOR),
    "posterior": (-POSTERIOR, -LEFT, SUPERIOR),
    "left": (-LEFT, POSTERIOR, SUPERIOR),
    "right": (LEFT, -POSTERIOR, SUPERIOR),
    "superior": (-SUPERIOR, -LEFT, -POSTERIOR),
    "inferior": (SUPERIOR, LEFT, -POSTERIOR),
}
small = st.floats(-100, 100)
clouds = hnp.arrays(np.float64, st.tuples(st.integers(2, 9), st.just(3)), elements=small)
angles = st.floats(-7, 7)
VIEW = Camera((3, -4, 5), (0.3, 0.9, -0.2), (0.1, 0, 1), (60, 40), 0.7)
thorough = settings(max_examples=100, deadline=None)


def pixels(camera, points):
    """Column and row of world points, shape (n, 2); the centre of the first pixel is (0, 0)."""
    width, height = camera.size
    flat = (points - camera.center) @ np.stack([camera.right_axis, camera.up], axis=1) / camera.pixel_spacing
    return np.stack([flat[:, 0] + width / 2 - 0.5, height / 2 - 0.5 - flat[:, 1]], axis=1)


def assert_same_view(a, b, atol=1e-9):
    for name in ("center", "direction", "up", "right_axis"):
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), atol=atol)
    assert a.pixel_spacing == pytest.approx(b.pixel_spacing)
    assert a.size == b.size


@pytest.mark.parametrize("name", BODY)
def test_the_views_of_the_body(name):
    tree = VesselTree([Vessel([[0, 0, 0], [30, 20, 10]])])
    for scene in (tree, Volume(np.zeros((4, 5, 6), np.int16))):
        camera = getattr(Camera, name)(scene, size=(40, 30))
        assert_same_view(camera, Camera.named(name, scene, (40, 30)))
        for found, expected in zip((camera.direction, camera.right_axis, camera.up), BODY[name], strict=True):
            np.testing.assert_array_equal(found, expected)
    assert set(VIEWS) == set(BODY)


def test_from_the_front_the_left_of_the_patient_is_on_the_right_of_the_image():
    centers = {"left": [20, 0, 0], "right": [-20, 0, 0], "head": [0, 0, 20], "feet": [0, 0, -20]}
    tree = VesselTree([Vessel([c, np.add(c, [0.5, 0, 0.5])], name=n) for n, c in centers.items()])
    frame = Renderer(None, tree).cut_surface(Camera.anterior(tree, (41, 41)))
    seen = [
        tree[int(frame.vessel[row, column])].name for row, column in ((20, 38), (20, 2), (2, 20), (38, 20))
    ]
    assert seen == ["left", "right", "head", "feet"]


@thorough
@given(clouds, st.sampled_from(sorted(VIEWS)), st.integers(8, 200), st.integers(8, 200))
def test_a_fitted_view_holds_all_points_and_little_more(points, name, width, height):
    camera = Camera.named(name, VesselTree([Vessel(points)]), (width, height))
    found = pixels(camera, points)
    free = np.array([width, height]) * 0.05
    assert (found > free - 0.5).all()
    assert (found < np.array([width, height]) - 0.5 - free).all()
    low, high = found.min(axis=0), found.max(axis=0)
    np.testing.assert_allclose(low + high, [width - 1, height - 1], atol=1e-6)
    used = (high - low) / [width, height]
    assert camera.pixel_spacing == 1e-3 or used.max() > 0.85


def test_a_fitted_view_of_a_volume_holds_its_corners():
    affine = np.array([[2, 0.3, 0, 5], [0, 1.5, 0.4, -9], [0.2, 0, 3, 40], [0, 0, 0, 1]])
    volume = Volume(np.zeros((4, 5, 6)), world_from_index=affine)
    camera = Camera.fitted(volume, (1, 1, -1), (0, 0, 1), (80, 50))
    found = pixels(camera, volume.corners)
    assert (found > -0.5).all()
    assert (found < [79.5, 49.5]).all()


@thorough
@given(angles, st.sampled_from(["up", "right", "direction"]))
def test_turning_there_and_back(angle, axis):
    turned = VIEW.rotated(angle, axis)
    assert_same_view(turned.rotated(-angle, axis), VIEW)
    assert_same_view(VIEW.rotated(angle / 2, axis).rotated(angle / 2, axis), turned)
    own = {"up": "up", "right": "right_axis", "direction": "direction"}[axis]
    np.testing.assert_allclose(getattr(turned, own), getattr(VIEW, own), atol=1e-9)
    assert VIEW.direction @ turned.direction == pytest.approx(
        1.0 if axis == "direction" else math.cos(angle), abs=1e-9
    )


@thorough
@given(angles, hnp.arrays(np.float64, 3, elements=st.floats(0.1, 10)))
def test_turning_about_a_world_axis_is_turning_the_world_the_other_way(angle, axis):
    points = np.random.default_rng(1).normal(size=(5, 3)) * 20
    unit = axis / np.linalg.norm(axis)
    offset = points - VIEW.center
    across = np.cross(unit, offset)
    along = unit * (offset @ unit)[:, None]
    # The points turned by -angle about the axis through the center.
    turned = VIEW.center + along + math.cos(angle) * (offset - along) - math.sin(angle) * across
    np.testing.assert_allclose(pixels(VIEW.rotated(angle, axis), points), pixels(VIEW, turned), atol=1e-6)


def test_turning_is_counterclockwise_seen_against_the_axis():
    front = Camera((0, 0, 0), POSTERIOR, SUPERIOR)
    np.testing.assert_allclose(front.rotated(math.pi / 2).direction, -LEFT, atol=1e-12)
    np.testing.assert_allclose(front.rotated(math.pi / 2, "right").direction, SUPERIOR, atol=1e-12)
    np.testing.assert_allclose(front.rotated(math.pi / 2, "direction").up, LEFT, atol=1e-12)
    assert_same_view(front.rotated(0.3, "up"), front.rotated(0.3, SUPERIOR * 7))


@thorough
@given(st.floats(1e-2, 1e2), small, small)
def test_zooming_and_panning_there_and_back(factor, right, up):
    points = np.random.default_rng(2).normal(size=(5, 3)) * 20
    middle = np.array([29.5, 19.5])
    zoomed = VIEW.zoomed(factor)
    assert_same_view(zoomed.zoomed(1 / factor), VIEW)
    np.testing.assert_allclose(pixels(zoomed, points) - middle, factor * (pixels(VIEW, points) - middle))
    panned = VIEW.panned(right, up)
    assert_same_view(panned.panned(-right, -up), VIEW)
    shift = np.array([-right, up]) / VIEW.pixel_spacing
    np.testing.assert_allclose(pixels(panned, points), pixels(VIEW, points) + shift, atol=1e-6)


def test_panning_does_not_change_depth():
    tree = VesselTree([Vessel([[0, 0, 0], [9, 8, 7]])])
    renderer, plain = Renderer(None, tree), Settings(depth_filter=False)
    frame = renderer.cut_surface(VIEW, plain)
    panned = renderer.cut_surface(VIEW.panned(7 * 0.7, 4 * 0.7), plain)
    np.testing.assert_allclose(panned.depth[4:, :-7], frame.depth[:-4, 7:], atol=1e-4)


@pytest.mark.parametrize("factor", [0, -1, math.nan, math.inf, "2x", None])
def test_zooming_by_no_number_above_0(factor):
    with pytest.raises(CameraError, match=r"factor of the zoom: found .*; expected "):
        VIEW.zoomed(factor)
