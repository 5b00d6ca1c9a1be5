"""A renderer with another tree, frames with only some images, and pictures of several samples."""

from __future__ import annotations

import numpy as np
import pytest

import lumencut
from lumencut import Camera, Renderer, Settings, VesselTree, phantom
from lumencut.errors import SettingsError, VesselTreeError, VolumeError
from lumencut.pictures.frame import IMAGES

SIZE = (64, 48)


@pytest.fixture(scope="module")
def scene():
    made = phantom.y_junction()
    return made.volume, made.tree


@pytest.fixture(scope="module")
def one_branch(scene):
    return VesselTree([scene[1][0]])


def assert_same(one, other, names=IMAGES):
    for name in names:
        assert np.array_equal(getattr(one, name), getattr(other, name), equal_nan=name == "value"), name


@pytest.mark.parametrize("device", ["cpu", "gpu"])
def test_another_tree_is_shown_as_by_a_renderer_of_its_own(scene, one_branch, device, request):
    if device == "gpu":
        request.getfixturevalue("gpu")
    volume, tree = scene
    first = Renderer(volume, tree, device)
    camera, settings = Camera.anterior(tree, SIZE), Settings(window=first.window)
    before = first.render(camera, settings)
    other = first.with_tree(one_branch)
    assert (other.volume, other.tree, other.device) == (volume, one_branch, first.device)
    assert_same(other.render(camera, settings), Renderer(volume, one_branch, device).render(camera, settings))
    assert_same(first.render(camera, settings), before)
    alone = other.with_tree(None)
    assert alone.scene is volume
    fresh = Renderer(volume, None, device).render(camera, Settings(context_window=first.window))
    shown = alone.render(camera, Settings(context_window=first.window))
    assert_same(shown, fresh, ("image", "context"))


def test_another_tree_keeps_the_window(scene, one_branch):
    volume, tree = scene
    first = Renderer(volume, tree, "cpu")
    assert first.with_tree(one_branch).window is first.window
    assert first.with_tree(None).with_tree(one_branch).window is first.window


def test_a_tree_of_another_kind_and_one_outside_are_refused(scene):
    volume, tree = scene
    renderer = Renderer(volume, tree, "cpu")
    with pytest.raises(VesselTreeError, match="tree: found str; expected a VesselTree"):
        renderer.with_tree("lines.vtp")
    far = VesselTree([lumencut.Vessel(vessel.points + 1e4, vessel.radius) for vessel in tree])
    with pytest.raises(VesselTreeError, match="none of its"):
        renderer.with_tree(far)
    with pytest.raises(VolumeError, match="neither a volume nor a tree"):
        Renderer(None, tree, "cpu").with_tree(None)


def test_a_cut_surface_has_another_tree_too(scene, one_branch):
    _, tree = scene
    camera = Camera.anterior(tree, SIZE)
    other = Renderer(None, tree, "cpu").with_tree(one_branch)
    expected = Renderer(None, one_branch, "cpu").cut_surface(camera)
    assert_same(other.cut_surface(camera), expected, ("depth", "vessel", "distance"))


@pytest.mark.parametrize(
    "images", [["image"], ("depth", "value"), {"vessel", "distance", "context"}, "image", []]
)
def test_a_frame_has_the_images_that_are_asked_for(scene, images):
    renderer = Renderer(*scene, "cpu")
    whole = renderer.render(Camera.anterior(scene[1], SIZE))
    frame = renderer.render(Camera.anterior(scene[1], SIZE), images=images)
    asked = {images} if isinstance(images, str) else set(images)
    assert {name for name in IMAGES if frame.has(name)} == asked
    assert frame.has("position") == ("depth" in asked)
    assert_same(frame, whole, asked)
    for name in set(IMAGES) - asked:
        with pytest.raises(VolumeError, match=f"{name} of the frame: found a frame that was asked for"):
            getattr(frame, name)


def test_an_image_of_another_name_is_refused(scene):
    with pytest.raises(SettingsError, match="image of the frame: found 'picture'"):
        Renderer(*scene, "cpu").render(images=["image", "picture"])
    with pytest.raises(SettingsError, match="images of the frame: found 5; expected names of image, depth"):
        Renderer(*scene, "cpu").render(images=5)


@pytest.mark.parametrize("device", ["cpu", "gpu"])
@pytest.mark.parametrize("samples", [2, 3])
def test_samples_change_the_picture_alone(scene, samples, device, request):
    if device == "gpu":
        request.getfixturevalue("gpu")
    renderer = Renderer(*scene, device)
    camera = Camera.anterior(scene[1], SIZE).rotated(0.4)
    one, several = renderer.render(camera), renderer.render(camera, Settings(samples=samples))
    assert_same(several, one, [name for name in IMAGES if name != "image"])
    # The mean of views from several positions within a pixel, each rendered alone.
    offsets = ((np.arange(samples) + 0.5) / samples - 0.5) * camera.pixel_spacing
    views = [camera.panned(float(right), float(up)) for up in offsets for right in offsets]
    pictures = [renderer.render(view, Settings(edge_samples=1)).image.astype(float) for view in views]
    assert np.abs(several.image - np.mean(pictures, axis=0)).max() <= 0.5 + 1e-9
    assert (several.image != one.image).any()
    assert set(several.timings) == set(one.timings)


@pytest.mark.parametrize("samples", [0, 5, 2.5, "2", None])
def test_samples_out_of_range_are_refused(samples):
    with pytest.raises(SettingsError, match="samples"):
        Settings(samples=samples)
