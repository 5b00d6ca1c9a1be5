"""Frames of the GPU compared with frames of the CPU, and tests of this comparison."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from conftest import each_value, needs_shared_data
from device_scenes import CONTEXTS, SETTINGS, oblique, pair, scene
from frame_comparison import LIMITS, assert_alike, excess
from lumencut import (
    Camera,
    Renderer,
    Settings,
    SettingsError,
    Volume,
    Window,
)
from scenes import wandering


@pytest.mark.parametrize("name", SETTINGS)
@pytest.mark.usefixtures("gpu")
def test_frames_of_a_phantom(name):
    found, expected = pair("phantom")
    camera = oblique(expected.scene, (113, 91))
    frames = [one.render(camera, SETTINGS[name]) for one in (found, expected)]
    assert_alike(*frames)
    assert np.ptp(frames[0].image[..., :3]) > 100
    assert frames[0].has("context") == (SETTINGS[name].context is not None)


@each_value
@needs_shared_data
@pytest.mark.parametrize("name", ["default", "dvr shaded", "mida", "mip", "no context"])
@pytest.mark.parametrize("data", ["stent", "dissection"])
@pytest.mark.usefixtures("gpu")
def test_frames_of_real_data(data, name):
    found, expected = pair(data)
    for camera in (Camera.anterior(expected.scene, (160, 170)), oblique(expected.scene, (151, 140))):
        assert_alike(found.render(camera, SETTINGS[name]), expected.render(camera, SETTINGS[name]))


@pytest.mark.parametrize("size", [(1, 17), (17, 1), (257, 257)])
@pytest.mark.usefixtures("gpu")
def test_frames_of_any_size(size):
    found, expected = pair("phantom")
    camera = Camera.left(expected.scene, size)
    frames = [one.render(camera) for one in (found, expected)]
    assert frames[0].image.shape == (size[1], size[0], 4)
    assert_alike(*frames)


@pytest.mark.usefixtures("gpu")
@pytest.mark.parametrize("settings", [Settings(), Settings(levels=0, depth_filter=False, lumen_first=True)])
def test_the_cut_surface_alone(settings):
    tree = wandering(3)
    camera = oblique(tree, (120, 101))
    frames = [Renderer(None, tree, device).cut_surface(camera, settings) for device in ("gpu", "cpu")]
    assert_alike(*frames)
    assert [frame.has("image") for frame in frames] == [False, False]
    assert len(np.unique(frames[0].vessel)) > 2
    again = pair("phantom")
    camera = Camera.anterior(again[0].scene, (60, 50))
    assert_alike(*(one.cut_surface(camera, settings) for one in again))


@pytest.mark.parametrize("name", CONTEXTS)
@pytest.mark.usefixtures("gpu")
def test_the_context_alone(name):
    found, expected = pair("phantom", with_tree=False)
    camera = oblique(expected.scene, (83, 96))
    frames = [one.render(camera, SETTINGS[name]) for one in (found, expected)]
    assert_alike(*frames)
    assert [frame.has("depth") for frame in frames] == [False, False]
    assert frames[0].context[..., 3].any()


@pytest.mark.parametrize("kind", ["i1", "u2", "i4", "i8", "f4", "f8"])
@pytest.mark.usefixtures("gpu")
def test_voxels_of_any_type(kind):
    random = np.random.default_rng(3)
    affine = np.array([[2.1, 0.3, -0.2, -30], [-0.4, 2.3, 0.1, -35], [0.2, 0.5, -2.6, 40], [0, 0, 0, 1.0]])
    array = random.integers(0, 100, (14, 9, 12)).astype(kind)[:, :, ::-1]
    volume = Volume(array, world_from_index=affine)
    settings = Settings(context="dvr", context_window=Window(50, 100), context_transfer="grey")
    camera = oblique(volume, (50, 40))
    assert_alike(*(Renderer(volume, None, device).render(camera, settings) for device in ("gpu", "cpu")))


@pytest.mark.usefixtures("gpu")
def test_one_renderer_shows_any_view_in_any_order():
    found, expected = Renderer(*scene("phantom"), "gpu"), pair("phantom")[1]
    views = [
        (Camera.left(expected.scene, (40, 50)), "default"),
        (oblique(expected.scene, (61, 37)), "no context"),
    ]
    views += [(oblique(expected.scene, (61, 37)), "dvr shaded"), (views[0][0], "slab mean"), views[0]]
    for camera, name in views:
        assert_alike(found.render(camera, SETTINGS[name]), expected.render(camera, SETTINGS[name]))


@pytest.mark.parametrize(
    "stages", ["distance", "depth, depth_filter", "surface,silhouette,context", "context,composite"]
)
@pytest.mark.usefixtures("gpu")
def test_stages_that_the_cpu_does(stages, monkeypatch):
    monkeypatch.setenv("LUMENCUT_CPU_STAGES", stages)
    mixed, expected = Renderer(*scene("phantom"), "gpu"), pair("phantom")[1]
    camera, settings = oblique(expected.scene, (71, 52)), SETTINGS["mida"]
    assert_alike(mixed.render(camera, settings), expected.render(camera, settings))


@pytest.mark.usefixtures("gpu")
def test_unknown_stages_are_refused(monkeypatch):
    monkeypatch.setenv("LUMENCUT_CPU_STAGES", "distance,magic")
    with pytest.raises(SettingsError, match="stages of the CPU: found 'magic'; expected names of "):
        Renderer(None, wandering(1), "gpu")
    Renderer(None, wandering(1), "cpu")


@pytest.mark.parametrize(("name", "limit"), [(name, n) for name in LIMITS for n in range(len(LIMITS[name]))])
def test_the_comparison_counts(name, limit):
    camera = Camera.left(pair_of_cpus()[0].scene, (200, 150))
    one, other = (renderer.render(camera) for renderer in pair_of_cpus())
    assert excess(one, other) == {}
    tolerance, share = LIMITS[name][limit]
    array, most = getattr(one, f"_{name}"), int(share * 200 * 150)
    # Values below 128 are raised, all others lowered, in the last channel.
    last = array.reshape(200 * 150, -1)[:, -1]
    moved = np.where(last < 128, last + max(2.0 * tolerance, 2.0), last - max(2.0 * tolerance, 2.0))
    places = np.flatnonzero(np.isfinite(last))[: most + 1]
    last[places[:-1]] = moved[places[:-1]]
    assert excess(one, other) == {}
    last[places[-1]] = moved[places[-1]]
    assert list(excess(one, other)) == [name]
    with pytest.raises(AssertionError, match=f"{most + 1} of 30000 pixels"):
        assert_alike(one, other)
    with pytest.raises(AssertionError, match="compared with itself"):
        assert_alike(one, one)


@functools.cache
def pair_of_cpus():
    return tuple(Renderer(*scene("phantom"), "cpu") for _ in range(2))


def test_the_comparison_refuses_other_pictures():
    one, other = pair_of_cpus()
    camera = Camera.left(one.scene, (70, 60))
    turned = other.render(camera.rotated(0.02), SETTINGS["mida"])
    assert set(excess(one.render(camera, SETTINGS["mida"]), turned)) == set(LIMITS)
    assert excess(one.cut_surface(camera), other.cut_surface(camera)) == {}
    assert excess(one.render(camera), other.cut_surface(camera)) == dict.fromkeys(
        ("value", "context", "image"), "should not be there"
    )
