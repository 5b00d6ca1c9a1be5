"""A notebook turns, moves and zooms a camera as the page does."""

import json
from pathlib import Path

import numpy as np
import pytest

from lumencut import Camera
from lumencut.notebook import gestures
from lumencut.scene.window import Window

CASES = json.loads((Path(__file__).parent / "drags.json").read_text("utf-8"))
TOLERANCE = 1e-12


def stepped(camera: Camera, step: list) -> Camera:
    name, *given = step
    if name == "rotate":
        return gestures.trackballed(camera, np.array(given[0]), *given[1])
    if name == "spin":
        return gestures.spun(camera, np.array(given[0]), given[1], given[2])
    if name == "pan":
        return gestures.panned(camera, *given[0])
    assert name == "zoom"
    return gestures.zoomed(camera, given[0], *given[1])


@pytest.mark.parametrize("case", CASES["drags"], ids=range(len(CASES["drags"])))
def test_drags_end_where_they_end_in_the_page(case):
    camera = Camera(**case["start"])
    for step in case["steps"]:
        camera = stepped(camera, step)
    end = case["end"]
    assert camera.size == tuple(end["size"])
    assert camera.pixel_spacing == pytest.approx(end["pixel_spacing"], rel=TOLERANCE)
    for name in ("center", "direction", "up"):
        np.testing.assert_allclose(getattr(camera, name), end[name], rtol=TOLERANCE, atol=TOLERANCE)


@pytest.mark.parametrize("case", CASES["windows"])
def test_a_drag_changes_the_window_as_in_the_page(case):
    window = gestures.dragged_window(Window(*case["window"]), *case["drag"])
    assert (window.level, window.width) == pytest.approx(tuple(case["end"]), rel=TOLERANCE)


@pytest.mark.parametrize("case", CASES["samples"])
def test_a_moving_view_has_as_many_pixels_as_in_the_page(case):
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), tuple(case["size"]), 0.5)
    found = gestures.sampled(camera, case["share"])
    assert (found.size, found.pixel_spacing) == (tuple(case["end"]), pytest.approx(case["pixel_spacing"]))
