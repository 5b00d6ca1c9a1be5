"""Views: the six named ones, fitted views, turning, zooming and panning."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lumencut import VIEWS, Camera, CameraError, Renderer, Vessel, VesselTree, Volume

LEFT, POSTERIOR, SUPERIOR = np.eye(3)
BODY = {
    "anterior": (POSTERIOR, LEFT, SUPERIOR),
    "posterior": (-POSTERIOR, -LEFT, SUPERIOR),
    "left": (-LEFT, POSTERIOR, SUPERIOR),
    "right": (LEFT, -POSTERIOR, SUPERIOR),
    "superior": (-SUPERIOR, -LEFT, -POSTERIOR),
    "inferior": (SUPERIOR, LEFT, -POSTERIOR),
}
VIEW = Camera((3, -4, 5), (0.3, 0.9, -0.2), (0.1, 0, 1), (60, 40), 0.7)


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


def test_a_fitted_view_of_a_volume_holds_its_corners():
    affine = np.array([[2, 0.3, 0, 5], [0, 1.5, 0.4, -9], [0.2, 0, 3, 40], [0, 0, 0, 1]])
    volume = Volume(np.zeros((4, 5, 6)), world_from_index=affine)
    camera = Camera.fitted(volume, (1, 1, -1), (0, 0, 1), (80, 50))
    found = pixels(camera, volume.corners)
    assert (found > -0.5).all()
    assert (found < [79.5, 49.5]).all()


@pytest.mark.parametrize("factor", [0, -1, math.nan, math.inf, "2x", None])
def test_zooming_by_no_number_above_0(factor):
    with pytest.raises(CameraError, match=r"factor of the zoom: found .*; expected "):
        VIEW.zoomed(factor)


def test_an_axis_is_a_name_or_a_vector():
    front = Camera((0, 0, 0), POSTERIOR, SUPERIOR)
    assert_same_view(front.rotated(0.3, "up"), front.rotated(0.3, SUPERIOR * 7))
    np.testing.assert_allclose(front.rotated(math.pi / 2, "direction").up, LEFT, atol=1e-12)
