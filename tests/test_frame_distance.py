"""The distance image of a frame: computed on first use if nothing else needs it."""

from __future__ import annotations

import copy
import dataclasses
import pickle

import numpy as np
import pytest

from lumencut import Camera, Renderer, Settings, VolumeError, phantom
from lumencut.pictures.frame import Frame

#: Settings with which the distance is computed later, and settings with which it is computed at once.
LATER = Settings()
AT_ONCE = Settings(level_choice="nearest")


@pytest.fixture(scope="module")
def scene():
    return phantom.crossing()


@pytest.fixture
def camera(scene):
    return Camera.anterior(scene.tree, size=(40, 30)).rotated(0.3)


@pytest.fixture
def computed(scene, monkeypatch):
    """A renderer, and the images requested from its core: one list per call."""
    renderer, asked = Renderer(scene.volume, scene.tree, "cpu"), []
    core = renderer._core

    class Watched:
        interrupted = False

        def render(self, volume, camera, settings, images=None, *more):
            asked.append(images)
            if self.interrupted:
                raise KeyboardInterrupt
            return core.render(volume, camera, settings, images, *more)

    monkeypatch.setattr(renderer, "_core", Watched())
    return renderer, asked


def drawn(renderer, way, camera, settings=LATER):
    """Return a frame with a picture, or one of only the cut surface."""
    return getattr(renderer, way)(camera, settings)


@pytest.mark.parametrize("way", ["render", "cut_surface"])
def test_it_is_computed_once_and_when_it_is_asked_for(computed, camera, way):
    renderer, asked = computed
    frame = drawn(renderer, way, camera)
    assert len(asked) == 1
    assert "distance" not in asked[0]
    assert "distance" not in frame.timings
    assert frame.has("distance")
    assert "distance" in repr(frame)
    assert len(asked) == 1, "to tell what there is nothing is computed"
    distance = frame.distance
    assert asked[1:] == [["distance"]]
    assert frame.distance is distance
    assert len(asked) == 2
    assert "distance" not in frame.timings
    assert (distance.shape, distance.dtype) == ((30, 40), np.float32)


@pytest.mark.parametrize(
    "settings", [LATER, Settings(levels=0), Settings(samples=2), Settings(lumen_first=False)]
)
def test_it_is_the_same_as_at_once(scene, camera, settings):
    renderer = Renderer(scene.volume, scene.tree, "cpu")
    named = renderer.render(camera, settings, images=("distance", "depth"))
    assert "distance" in named.timings
    near = dataclasses.replace(settings, level_choice="nearest")
    for frame in (
        named,
        renderer.cut_surface(camera, settings),
        renderer.render(camera, settings, images="distance"),
        renderer.cut_surface(camera, near),
    ):
        np.testing.assert_array_equal(frame.distance, renderer.render(camera, settings).distance)


@pytest.mark.parametrize("way", ["render", "cut_surface"])
def test_where_the_levels_need_it_it_is_handed_over_at_once(computed, camera, way):
    renderer, asked = computed
    frame = drawn(renderer, way, camera, AT_ONCE)
    assert "distance" in frame.timings
    assert frame.distance.shape == (30, 40)
    assert asked == [None]


@pytest.mark.parametrize("settings", [LATER, AT_ONCE], ids=["later", "at once"])
def test_images_say_whether_there_is_one(computed, camera, settings):
    renderer, asked = computed
    frame = renderer.render(camera, settings, images=("image", "depth"))
    assert not frame.has("distance")
    assert "distance" not in repr(frame)
    with pytest.raises(VolumeError, match=r"name it in images="):
        _ = frame.distance
    assert len(asked) == 1


def test_a_context_alone_has_none(scene):
    frame = Renderer(scene.volume).render(Camera.left(scene.volume, (9, 8)))
    assert not frame.has("distance")
    with pytest.raises(VolumeError, match="the context alone"):
        _ = frame.distance


@pytest.mark.parametrize("way", ["render", "cut_surface"])
def test_all_arrays_are_saved(computed, camera, way, tmp_path):
    frame = drawn(computed[0], way, camera)
    frame.save(tmp_path / "all.npz")
    with np.load(tmp_path / "all.npz") as arrays:
        assert {"depth", "vessel", "distance", "position"} <= set(arrays)
        np.testing.assert_array_equal(arrays["distance"], frame.distance)


@pytest.mark.parametrize(
    "again",
    [lambda frame: pickle.loads(pickle.dumps(frame)), copy.copy, copy.deepcopy, dataclasses.replace],
    ids=["pickle", "copy", "deepcopy", "replace"],
)
def test_frames_made_again_have_it(computed, camera, again):
    renderer, asked = computed
    frame = renderer.render(camera)
    made = again(frame)
    np.testing.assert_array_equal(made.distance, frame.distance)
    np.testing.assert_array_equal(made.image, frame.image)
    assert made.timings == frame.timings
    assert 2 <= len(asked) <= 3
    bare = again(renderer.render(camera, images=("depth",)))
    assert not bare.has("distance")


def test_a_frame_stays_frozen(computed, camera):
    frame = computed[0].render(camera)
    _ = frame.distance
    assert dataclasses.is_dataclass(Frame)
    with pytest.raises(dataclasses.FrozenInstanceError):
        frame._distance = None


def test_it_does_not_depend_on_what_is_rendered_in_between(scene, camera):
    renderer = Renderer(scene.volume, scene.tree, "cpu")
    frame, expected = renderer.render(camera), renderer.cut_surface(camera, AT_ONCE).distance
    other = renderer.with_tree(phantom.helix().tree)
    other.render(camera.rotated(1.0), Settings(levels=2, context="mip"))
    renderer.render(camera.zoomed(2))
    np.testing.assert_array_equal(frame.distance, expected)


def test_what_is_interrupted_can_be_asked_for_again(computed, camera):
    renderer, _ = computed
    frame = renderer.render(camera)
    renderer._core.interrupted = True
    with pytest.raises(KeyboardInterrupt):
        _ = frame.distance
    renderer._core.interrupted = False
    assert frame.has("distance")
    assert frame.distance.min() >= 0
