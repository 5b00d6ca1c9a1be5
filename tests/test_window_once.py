"""Windows from the data: computed once per volume and tree, and only if an image needs one."""

from __future__ import annotations

import copy
import gc
import pickle
from collections import Counter

import numpy as np
import pytest

import lumencut
from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, Volume, Window, _lumencut
from window_scenes import angiography


@pytest.fixture
def found(monkeypatch):
    """Return how often each window was computed from the data, by its name."""
    counts, find = Counter(), _lumencut.find_window

    def counting(name, *given):
        counts[name] += 1
        return find(name, *given)

    monkeypatch.setattr(_lumencut, "find_window", counting)
    return counts


@pytest.fixture
def scene():
    """A volume and a tree that no other test uses."""
    made = angiography("CTA, HU")
    return Volume(made.array.T.copy()), made.tree


def test_a_cpr_finds_no_window_until_its_picture_is_asked_for(scene, found):
    volume, tree = scene
    made = lumencut.cpr(volume, tree[0])
    assert np.isfinite(made.value).any()
    assert made.position.any()
    assert made.arc_length.max() > 0
    assert "Reformation" in repr(made.rotated(degrees=90))
    assert not found
    picture = made.image
    assert found == {"auto": 1}
    given = Settings(window=made.settings.window)
    np.testing.assert_array_equal(lumencut.cpr(volume, tree[0], settings=given).image, picture)
    np.testing.assert_array_equal(lumencut.cpr(volume, tree[0], settings=given).value, made.value)


def test_the_values_are_the_same_before_and_after_the_picture(scene):
    volume, tree = scene
    first, second = (lumencut.cpr(volume, tree[0]) for _ in range(2))
    values, _ = first.value, second.image
    np.testing.assert_array_equal(values, second.value)


def test_a_volume_and_a_vessel_have_their_window_found_once(scene, found):
    volume, tree = scene
    for _ in range(3):
        assert lumencut.cpr(volume, tree[0]).image.any()
    assert found == {"auto": 1}
    for _ in range(2):
        assert lumencut.cpr(volume, tree[1]).image.any()
    assert found == {"auto": 2}


def test_views_of_a_volume_and_a_tree_share_a_window(scene, found):
    volume, tree = scene
    camera = Camera.anterior(tree, (40, 30))
    for _ in range(2):
        assert lumencut.render(volume, tree, camera).image.any()
        assert Window.from_data(volume, tree) == Renderer(volume, tree).window
    assert found == {"auto": 1}


@pytest.mark.parametrize("context", ["mip", "mida", "minip"])
def test_windows_of_a_volume_alone_are_found_once(scene, found, context):
    volume, _ = scene
    camera = Camera.anterior(volume, (40, 30))
    for _ in range(2):
        assert lumencut.render(volume, None, camera, Settings(context=context)).image.any()
    assert sum(found.values()) == 1


def test_a_frame_without_picture_and_context_needs_no_window(scene, found):
    volume, tree = scene
    camera = Camera.anterior(tree, (40, 30))
    frame = Renderer(volume, tree).render(camera, images=["depth", "vessel", "value"])
    reformed = Renderer(volume, tree)._by(("mpcpr",), camera, None, ["value"])
    assert np.isfinite(frame.value).any()
    assert np.isfinite(reformed.value).any()
    assert not found
    np.testing.assert_array_equal(frame.value, Renderer(volume, tree).render(camera).value)
    assert found == {"auto": 1}


def test_named_windows_are_found_once(scene, found):
    volume, _ = scene
    for _ in range(2):
        assert Window.named("full", volume).width > Window.named("mra", volume).width
    assert found == {"full": 1, "mra": 1}


def test_voxels_that_were_exchanged_have_a_window_of_their_own(scene):
    volume, tree = scene
    before = Window.from_data(volume, tree)
    volume.array[:] = volume.array // 4 + 1000
    after = Window.from_data(volume, tree)
    assert after == Window.from_data(Volume(volume.array.copy()), tree)
    assert after != before


def test_another_tree_in_the_same_place_of_memory_has_a_window_of_its_own(scene):
    volume = Volume(scene[0].array[16:40, 4:34, 8:44].copy())
    points = np.array([[2.0, 2.0, 2.0], [2.0, 2.0, 20.0]])
    windows = set()
    for shift in range(12):
        vessel = Vessel(points + np.array([2.0 * shift, shift, 0.0]), 2.0)
        window = Window.from_data(volume, VesselTree([vessel]))
        fresh = Window.from_data(Volume(volume.array), VesselTree([vessel]))
        assert window == fresh
        windows.add(window)
        del vessel, window
        gc.collect()
    assert len(windows) > 6


def test_a_volume_forgets_the_windows_of_trees_that_are_gone(scene):
    volume = Volume(scene[0].array[20:30, 15:30, 20:30].copy())
    for shift in range(100):
        vessel = Vessel(np.array([[2.0 + shift / 20, 2.0, 2.0], [2.0, 2.0, 8.0]]), 2.0)
        Window.from_data(volume, VesselTree([vessel]))
    assert len(volume._windows) <= 32


def test_copies_of_a_volume_do_not_carry_its_windows(scene, found):
    volume, tree = scene
    window = Window.from_data(volume, tree)
    for other in (copy.deepcopy(volume), pickle.loads(pickle.dumps(volume))):
        other.array[:] += 500
        assert Window.from_data(other, tree).level == pytest.approx(window.level + 500)


def test_a_cfa_finds_no_window_until_its_picture_is_asked_for(scene, found):
    volume, tree = scene
    made = lumencut.cfa(volume, tree[0], radius=4.0)
    assert np.isfinite(made.value).any()
    assert not found
    assert made.image.any()
    assert found == {"auto": 1}
