"""Renderers with a context: of only a volume, over several views, and the images of their frames."""

from __future__ import annotations

import signal
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from lumencut import (
    Camera,
    Opacity,
    Renderer,
    Settings,
    SettingsError,
    Slab,
    TransferFunction,
    VesselTreeError,
    Volume,
    VolumeError,
    Window,
    phantom,
    render,
)
from lumencut.pictures.turntables import fitted_turn, turntable

SIZE = (50, 40)
WINDOW = Window(350, 900)
#: Almost transparent everywhere, so that no ray ends early and no part is skipped.
CLEAR = TransferFunction([(0, (255, 255, 255), 1e-6)])


@pytest.fixture(scope="module")
def made():
    return phantom.aorta(scale=0.25)


@pytest.fixture(scope="module")
def alone(made):
    return Renderer(made.volume, None)


def test_a_volume_alone_is_shown_whole_and_from_the_front(made, alone):
    frame = alone.render()
    expected = Camera.anterior(made.volume)
    np.testing.assert_array_equal(frame.camera.center, expected.center)
    assert (frame.camera.size, frame.camera.pixel_spacing) == (expected.size, expected.pixel_spacing)
    assert (alone.tree, alone.volume, alone.scene) == (None, made.volume, made.volume)
    assert alone.window == Window.from_data(made.volume)
    np.testing.assert_array_equal(render(made.volume).image, frame.image)
    shown = replace(Settings(), context_window=alone.window)
    np.testing.assert_array_equal(render(made.volume, None, None, shown).image, frame.image)


def test_a_frame_of_the_context_alone(alone, made, tmp_path):
    camera = Camera.anterior(made.volume, SIZE)
    frame = alone.render(camera, Settings(context_window=WINDOW, background=(0, 0, 0, 0)))
    assert (frame.context.dtype, frame.context.shape) == (np.uint8, (40, 50, 4))
    np.testing.assert_array_equal(frame.context[..., 3], frame.image[..., 3])
    assert 0.02 < (frame.context[..., 3] > 0).mean() < 0.98
    assert list(frame.timings) == ["blocks", "context", "composite"]
    for name in ("depth", "vessel", "distance", "position", "value"):
        text = f"{name} of the frame: found the context alone; expected a frame with a cut surface; give the"
        with pytest.raises(VolumeError, match=text):
            getattr(frame, name)
        assert not frame.has(name)
    frame.save(tmp_path / "view.npz")
    with np.load(tmp_path / "view.npz") as arrays:
        assert sorted(arrays) == ["context", "image"]
        np.testing.assert_array_equal(arrays["context"], frame.context)
    frame.save(tmp_path / "view.png")


def test_a_frame_is_described_without_its_pixels(alone, made):
    assert repr(alone.render(Camera.left(alone.volume, (9, 8)))) == "Frame(9 × 8 pixels: image, context)"
    cut = Renderer(None, made.tree).cut_surface(Camera.left(made.tree, (9, 8)))
    assert repr(cut) == "Frame(9 × 8 pixels: depth, vessel, distance, position)"


def test_the_context_of_a_frame_is_what_is_behind_its_surface(made):
    renderer, camera = Renderer(made.volume, made.tree), Camera.anterior(made.tree, SIZE)
    frame = renderer.render(camera)
    assert (frame.context[~np.isnan(frame.value)] == 0).all()
    faint = renderer.render(camera, Settings(opacity=Opacity(100, 300)))
    assert (faint.context[~np.isnan(faint.value) & (faint.value < 100), 3] > 0).any()
    bare = renderer.render(camera, Settings(context=None))
    text = "context of the frame: found a frame rendered without a context; expected a frame with one; give"
    with pytest.raises(VolumeError, match=text):
        _ = bare.context
    assert (bare.has("depth"), bare.has("position"), bare.has("context")) == (True, True, False)
    assert not bare.has("camera")


def test_the_window_of_the_context_does_not_follow_the_window(made):
    renderer, camera = Renderer(made.volume, made.tree), Camera.anterior(made.tree, SIZE)
    settings = Settings(opacity=Opacity(100, 300))
    expected = renderer.render(camera, settings)
    other = renderer.render(camera, replace(settings, window=Window(0, 5000)))
    np.testing.assert_array_equal(other.context, expected.context)
    assert (other.image != expected.image).any()
    named = renderer.render(camera, replace(settings, context_window=renderer.window))
    np.testing.assert_array_equal(named.image, expected.image)


def test_windows_from_the_data_are_those_that_settings_leave_open(made, alone):
    renderer = Renderer(made.volume, made.tree)
    along, whole = Window.from_data(made.volume, made.tree), Window.whole(made.volume)
    assert renderer.windowed(Settings()) == Settings(window=along, context_window=along)
    given = Settings(window=WINDOW, context_window=WINDOW, context="dvr")
    assert renderer.windowed(given) == given
    assert renderer.windowed(Settings(context=None)) == Settings(window=along, context=None)
    for name in ("minip", "average"):
        low = Settings(context=name)
        assert renderer.windowed(low) == replace(low, window=along, context_window=whole)
        assert alone.windowed(low) == replace(low, context_window=whole)
    image = alone.render(Camera.anterior(made.volume, SIZE), Settings(context="average")).image
    assert image[..., :3].max() > 100, "means of much air are seen"
    with pytest.raises(
        VolumeError, match="volume of the renderer: found None; expected a volume to take the"
    ):
        Renderer(None, made.tree).windowed(Settings())


def test_a_slab_shows_larger_and_smaller_values(made):
    renderer, camera = Renderer(made.volume, made.tree), Camera.anterior(made.tree, SIZE)
    values = [renderer.render(camera, Settings(slab=Slab(6, mode))).value for mode in ("min", "mean", "max")]
    thin = renderer.render(camera, Settings()).value
    inside = np.isfinite([*values, thin]).all(axis=0)
    low, mean, high = (value[inside] for value in values)
    assert (low <= mean + 1e-3).all()
    assert (mean <= high + 1e-3).all()
    assert high.mean() - low.mean() > 10


def test_what_the_first_view_learnt_serves_the_second(made):
    views = [Camera.anterior(made.volume, SIZE).rotated(angle) for angle in (0.0, 0.7, 2.0)]
    settings = Settings(context_window=WINDOW)
    for tree in (None, made.tree):
        kept = Renderer(made.volume, tree)
        for view in views:
            fresh = Renderer(made.volume, tree)
            np.testing.assert_array_equal(
                kept.render(view, settings).image, fresh.render(view, settings).image
            )


def test_threads_share_a_renderer_of_a_volume_alone(alone, made):
    views = [Camera.anterior(made.volume, SIZE).rotated(0.4 * n) for n in range(8)]
    expected = [alone.render(view).image for view in views]
    fresh = Renderer(made.volume)
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda view: fresh.render(view).image, views * 4))
    for image, other in zip(found, expected * 4, strict=True):
        np.testing.assert_array_equal(image, other)


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_a_context_and_the_renderer_goes_on(alone, made):
    ended, main = threading.Event(), threading.get_ident()

    def interrupt_once_it_runs():
        while sys._current_frames()[main].f_code.co_name != "render" and not ended.wait(0.02):
            pass
        if not ended.wait(0.1):
            signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=interrupt_once_it_runs)
    camera = Camera.anterior(made.volume, (3000, 3000))
    slow = Settings(context="dvr", context_window=WINDOW, context_transfer=CLEAR, context_step=0.02)
    thread.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            alone.render(camera, slow)
    finally:
        ended.set()
        thread.join()
    small = Camera.anterior(made.volume, SIZE)
    np.testing.assert_array_equal(alone.render(small).image, Renderer(made.volume).render(small).image)


def test_a_turntable_of_a_volume_alone(alone, made):
    first = next(turntable(alone, settings=Settings(context_preview=True), frames=3))
    expected = fitted_turn(Camera.anterior(made.volume), made.volume)
    assert first.camera.pixel_spacing == expected.pixel_spacing
    # The corners move on circles, so their distance from the axis must fit into the view.
    reach = np.linalg.norm((made.volume.corners - expected.center)[:, :2], axis=1).max()
    assert reach < 256 * expected.pixel_spacing < 1.2 * reach


def test_what_cannot_be_shown(made, alone):
    text = "scene of the renderer: found neither a volume nor a tree; expected one of them or both"
    with pytest.raises(VolumeError, match=text):
        Renderer(None, None)
    with pytest.raises(
        VesselTreeError, match="tree of the renderer: found None; expected a tree to cut along"
    ):
        alone.cut_surface()
    text = (
        "context: found None without a vessel tree; expected something to show; give the renderer a tree, or"
    )
    with pytest.raises(SettingsError, match=text):
        alone.render(settings=Settings(context=None))
    with pytest.raises(VesselTreeError, match="tree: found str; expected a VesselTree"):
        Renderer(made.volume, "tree")
    with pytest.raises(
        SettingsError, match=r"context_step: found 0\.001 mm for a volume .* across; expected at l"
    ):
        alone.render(settings=Settings(context_step=0.001))


def test_volume_and_tree_stay_those_of_the_renderer(alone):
    for name in ("volume", "tree", "scene", "window"):
        with pytest.raises(AttributeError):
            setattr(alone, name, None)


def test_any_grid_and_any_type_is_shown():
    random = np.random.default_rng(3)
    affine = np.array([[2.1, 0.3, -0.2, -30], [-0.4, 2.3, 0.1, -35], [0.2, 0.5, -2.6, 40], [0, 0, 0, 1.0]])
    for kind in ("i1", "u2", "i4", "f4", "f8"):
        array = random.integers(0, 100, (9, 1, 7)).astype(kind)
        frame = Renderer(Volume(array[:, :, ::-1], world_from_index=affine)).render(
            settings=Settings(context="mip")
        )
        assert frame.context[..., 3].any()
