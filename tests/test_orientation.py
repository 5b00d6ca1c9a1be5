"""The sides of the patient and the names of views, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lumencut import VIEWS, Camera
from lumencut.scene.orientation import edges, sides, view_name


def seen_from(viewer, up=(0, 0, 1)):
    return Camera((0, 0, 0), -np.asarray(viewer, dtype=float), up)


@pytest.mark.parametrize(
    ("name", "left", "right", "top", "bottom"),
    [
        ("anterior", "R", "L", "S", "I"),
        ("posterior", "L", "R", "S", "I"),
        ("left", "A", "P", "S", "I"),
        ("right", "P", "A", "S", "I"),
        ("superior", "L", "R", "A", "P"),
        ("inferior", "R", "L", "A", "P"),
    ],
)
def test_the_views_of_the_body(name, left, right, top, bottom):
    camera = Camera((0, 0, 0), *VIEWS[name])
    assert edges(camera) == {"left": left, "right": right, "top": top, "bottom": bottom}
    assert view_name(camera) == name


@pytest.mark.parametrize("to_the_left", [-180, -179, -120, -30, -1, 0, 1, 30, 45, 90, 135, 180])
@pytest.mark.parametrize("to_the_head", [-89, -60, -15, 0, 20, 88])
def test_c_arm_angles(to_the_left, to_the_head):
    """The viewer's position in spherical coordinates around the patient, with the head on top."""
    side, height = math.radians(to_the_left), math.radians(to_the_head)
    viewer = (math.sin(side) * math.cos(height), -math.cos(side) * math.cos(height), math.sin(height))
    name = view_name(seen_from(viewer))
    to_the_left = 180 if to_the_left == -180 else to_the_left
    if to_the_head == 0 and to_the_left in (0, 90, 180):
        assert name == {0: "anterior", 90: "left", 180: "posterior"}[to_the_left]
        return
    words = [f"{'LAO' if to_the_left > 0 else 'RAO'} {abs(to_the_left)}°"] if to_the_left else []
    words += [f"{'CRA' if to_the_head > 0 else 'CAU'} {abs(to_the_head)}°"] if to_the_head else []
    assert name == " ".join(words)


def test_turning_by_the_options_of_a_camera_gives_its_angles():
    camera = Camera((0, 0, 0), *VIEWS["anterior"]).rotated(degrees=30).rotated(degrees=-15, axis="right")
    assert view_name(camera) == "LAO 30° CRA 15°"


@pytest.mark.parametrize(
    ("name", "up", "expected"),
    [
        # The top points 30 degrees from the head to the patient's right: the head appears right of the top.
        ("anterior", (-0.5, 0, math.sqrt(0.75)), "anterior turned -30°"),
        ("anterior", (0.5, 0, math.sqrt(0.75)), "anterior turned 30°"),
        ("anterior", (0, 0, -1), "anterior turned 180°"),
        ("superior", (0, 1, 0), "superior turned 180°"),
        ("inferior", (1, 0, 0), "inferior turned 90°"),
    ],
)
def test_views_turned_in_their_plane(name, up, expected):
    assert view_name(Camera((0, 0, 0), VIEWS[name][0], up)) == expected


def test_angles_are_whole_and_steady_under_rounding():
    camera = seen_from((1e-9, -1, 1e-9))
    assert view_name(camera) == "anterior"
    assert view_name(camera.rotated(degrees=1.6)) == "LAO 2°"
    diagonal = [sides(np.array([1.0, 1.0 + noise, 0])) for noise in (-1e-12, 0, 1e-12)]
    assert diagonal == ["LP"] * 3
