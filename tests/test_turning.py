"""Turns whose surroundings follow the frame before: lumen and wall stay exact, and a full turn closes."""

import numpy as np
import pytest

from lumencut import Camera, Renderer, Settings, SettingsError, evaluate, phantom, turntable

LIMITED = Settings(turning_limit=4.0)


@pytest.fixture(scope="module")
def renderer():
    made = phantom.aorta(scale=0.06)
    return Renderer(made.volume, made.tree, "cpu")


@pytest.fixture(scope="module")
def camera(renderer):
    return Camera.anterior(renderer.tree, size=(96, 128))


def frames(renderer, camera, settings, **turn):
    return list(turntable(renderer, camera, settings, **turn))


def test_lumen_is_that_of_the_still_picture(renderer, camera):
    turn = {"frames": 6, "degrees": 12}
    held, still = (frames(renderer, camera, settings, **turn) for settings in (LIMITED, Settings()))
    assert np.array_equal(held[0].image, still[0].image)
    changed = 0
    for one, other in zip(held[1:], still[1:], strict=True):
        assert np.array_equal(one.vessel, other.vessel)
        finest = renderer.cut_surface(one.camera, Settings(depth_filter=False), images=["cost", "depth"])
        inside = finest.cost == finest.depth
        assert inside.sum() > 100
        for image in ("depth", "value"):
            assert np.array_equal(getattr(one, image)[inside], getattr(other, image)[inside], equal_nan=True)
        changed += (one.depth != other.depth).sum()
    assert changed > 100


def test_a_full_turn_ends_as_it_begins(renderer, camera):
    turn = frames(renderer, camera, LIMITED, frames=72)
    again = renderer.cut_surface(turn[0].camera, LIMITED, before=turn[-1])
    still = renderer.cut_surface(turn[0].camera, LIMITED)
    off, lag = (np.abs(one.depth - turn[0].depth).mean() for one in (again, still))
    assert lag > 0.1
    assert off < 0.05 * lag


def test_the_measures_state_that_it_slides_less(renderer):
    found = [
        evaluate(None, renderer.tree, ["csr"], 4, Settings(turning_limit=limit), (96, 96), device="cpu").table
        for limit in (None, 4.0)
    ]
    still, held = (table[0] for table in found)
    assert held["slides_per_degree_percent"] < 0.7 * still["slides_per_degree_percent"]
    assert held["slides_per_degree_max_percent"] < 0.5 * still["slides_per_degree_max_percent"]
    for name in ("lumen_within_0.05_mm_percent", "lumen_shown_percent", "crossings_in_order_percent"):
        assert held[name] == still[name]


@pytest.mark.parametrize("before", ["frame", 3, "without depth"])
def test_only_a_frame_with_depth_can_be_followed(renderer, camera, before):
    if before == "without depth":
        before = renderer.render(camera, images=["image"])
    with pytest.raises(SettingsError, match=r"before: found .*; expected a Frame of a cut surface"):
        renderer.render(camera, LIMITED, before=before)
