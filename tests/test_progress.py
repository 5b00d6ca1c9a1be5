"""The progress of a rendering, and the number of threads that render."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import lumencut
from lumencut import Camera, Renderer, Settings, SettingsError, phantom

IMAGES = ("image", "depth", "vessel", "distance", "value", "context")


@pytest.fixture(scope="module")
def made():
    return phantom.helix()


@pytest.fixture
def any_threads():
    yield
    lumencut.set_threads(None)


LARGE = (1500, 1400)


@pytest.mark.usefixtures("any_threads")
@pytest.mark.parametrize(
    ("settings", "size"),
    [
        (Settings(), LARGE),
        (Settings(context="mida", samples=2), (750, 700)),
        (Settings(context=None, level_choice="nearest"), LARGE),
    ],
    ids=["default", "samples", "surface"],
)
def test_progress_grows_to_its_total(made, settings, size):
    told = []
    lumencut.set_threads(1)
    renderer = Renderer(made.volume, made.tree, "cpu")
    camera = Camera.anterior(made.tree, size)
    frame = renderer.render(camera, settings, progress=lambda *parts: told.append(parts))
    done = [parts[0] for parts in told]
    assert {parts[1] for parts in told} == {1000}
    assert done == sorted(done)
    assert done[-1] == 1000
    assert any(0 < part < 1000 for part in done)
    np.testing.assert_array_equal(frame.image, renderer.render(camera, settings).image)


def test_the_function_tells_progress_too(made):
    told = []
    lumencut.render(
        made.volume, made.tree, Camera.anterior(made.tree, (20, 20)), progress=lambda *p: told.append(p)
    )
    assert told[-1] == (1000, 1000)


def test_what_the_callable_raises_ends_the_rendering(made):
    def enough(done, _):
        assert done < 1000
        raise RuntimeError("enough")

    renderer = Renderer(made.volume, made.tree, "cpu")
    with pytest.raises(RuntimeError, match="enough"):
        renderer.render(Camera.anterior(made.tree, LARGE), Settings(samples=4), progress=enough)
    small = Camera.anterior(made.tree, (30, 20))
    fresh = Renderer(made.volume, made.tree, "cpu")
    np.testing.assert_array_equal(renderer.render(small).image, fresh.render(small).image)


@pytest.mark.usefixtures("any_threads")
def test_pictures_are_the_same_with_any_number_of_threads(made):
    camera = Camera.anterior(made.tree, (157, 121)).rotated(0.4)
    settings = Settings(centerline_smoothing=0.5, context_shading=True)
    frames = []
    for count in (1, 2, 3):
        lumencut.set_threads(count)
        assert lumencut.get_threads() == count
        frames.append(Renderer(made.volume, made.tree, "cpu").render(camera, settings))
    for frame in frames[1:]:
        for name in IMAGES:
            np.testing.assert_array_equal(getattr(frame, name), getattr(frames[0], name))


@pytest.mark.usefixtures("any_threads")
def test_a_renderer_goes_on_with_another_number_of_threads(made):
    renderer = Renderer(made.volume, made.tree, "cpu")
    camera = Camera.anterior(made.tree, (60, 50))
    before = renderer.render(camera).image
    lumencut.set_threads(1)
    np.testing.assert_array_equal(renderer.render(camera).image, before)
    assert lumencut.get_threads() == 1
    lumencut.set_threads(None)
    np.testing.assert_array_equal(renderer.render(camera).image, before)


@pytest.mark.parametrize("count", [0, -1, 1.5, 1025, "2", True, [2], float("nan")])
def test_other_numbers_of_threads_are_refused(count):
    before = lumencut.get_threads()
    with pytest.raises(SettingsError, match="threads"):
        lumencut.set_threads(count)
    assert lumencut.get_threads() == before


@pytest.fixture(scope="module")
def narrow():
    return phantom.stenosis()


#: A distance of sections so small that one thread reports progress before the end (mm).
NEAR = 0.1


@pytest.mark.usefixtures("any_threads")
@pytest.mark.parametrize("whole_tree", [False, True])
def test_measuring_tells_how_far_it_is(narrow, whole_tree):
    told = []
    lumencut.set_threads(1)

    def watch(done, total):
        told.append((done, total))

    if whole_tree:
        radii = narrow.tree.measured(narrow.volume, NEAR, 1.0, progress=watch)[0].radius
        expected = narrow.tree.measured(narrow.volume, NEAR, 1.0)[0].radius
        np.testing.assert_array_equal(radii, expected)
    else:
        lumencut.measure(narrow.volume, narrow.tree[0], NEAR, 1.0, progress=watch)
    done = [part for part, _ in told]
    assert {total for _, total in told} == {1000}
    assert done == sorted(done)
    assert done[-1] == 1000
    assert any(0 < part < 1000 for part in done)


@pytest.mark.usefixtures("any_threads")
@pytest.mark.parametrize("whole_tree", [False, True])
def test_what_the_callable_raises_ends_the_measuring(narrow, whole_tree):
    def enough(done, _):
        assert done < 1000
        raise KeyboardInterrupt

    lumencut.set_threads(1)
    work = narrow.tree.measured if whole_tree else partial(lumencut.measure, vessel=narrow.tree[0])
    with pytest.raises(KeyboardInterrupt):
        work(narrow.volume, step=NEAR, fwhm=1.0, progress=enough)
    assert len(lumencut.measure(narrow.volume, narrow.tree[0], 5.0, 1.0)) == 13
