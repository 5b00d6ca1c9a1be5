"""mpCPR: closed forms, an independent computation, both devices, and invalid input."""

import re

import numpy as np
import pytest
from PIL import Image

import reference_reformations as reference
from conftest import needs_shared_data
from device_scenes import SETTINGS, oblique, scene
from frame_comparison import assert_alike
from lumencut import (
    Camera,
    CameraError,
    Frame,
    Settings,
    SettingsError,
    Slab,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
    VolumeError,
    Window,
    _lumencut,
    mpcpr,
)
from lumencut.pictures.renderer import Renderer
from scenes import wandering

BARE = Settings(context=None, silhouettes=False, background=(0, 0, 0, 0), window=Window(50, 100))


def front(size=(61, 51), spacing=1.0):
    return Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), size, spacing)


@pytest.mark.parametrize("seed", range(3))
def test_every_row_shows_what_a_search_of_everything_finds(seed):
    tree = wandering(seed, vessels=8)
    camera = Camera.fitted(tree, (0.4, 1.0, -0.3), (0.1, 0.2, 1), (53, 71))
    frame = mpcpr(None, tree, camera)
    depth, vessel, folded = reference.mpcpr(tree, camera)
    assert np.array_equal(frame.vessel, vessel)
    assert np.array_equal(frame.folded, folded)
    assert np.allclose(frame.depth, depth, atol=1e-4, equal_nan=True)
    assert folded.any()
    assert (vessel >= 0).any()
    assert (vessel < 0).any()


@pytest.mark.parametrize("grid", reference.GRIDS)
def test_values_are_those_of_the_positions(grid):
    affine = reference.GRIDS[grid]
    line = np.array([[-6, -5, -8], [-2, 4, -3], [3, 0, 2], [1, 2, 9.0]])
    tree = VesselTree([Vessel(line, 2.0), Vessel(line[::-1] + np.array([5, 1, -2]), 1.0)])
    camera = Camera((0.2, 0.1, 0), (0.2, 1, 0.1), (0.1, 0, 1), (60, 40), 0.5)
    frames = [mpcpr(volume, tree, camera, BARE) for volume in reference.index_valued(affine)]
    position = frames[0].position.reshape(-1, 3)
    expected = (position - affine[:3, 3]) @ np.linalg.inv(affine[:3, :3]).T
    found = np.stack([frame.value.ravel() for frame in frames], axis=1)
    within = (expected >= 0).all(axis=1) & (expected <= np.array([29, 25, 21])).all(axis=1)
    assert within.sum() > 800
    assert np.abs(found - expected)[within].max() < 1e-3
    # The position itself lies on c(t) + s·(v × u): each row has the depth of the centerline in this row.
    depth, _, _ = reference.mpcpr(tree, camera)
    shown = (position - camera.center) @ camera.direction
    assert np.nanmax(np.abs(shown - depth.ravel())) < 1e-4


def test_a_straight_vessel_gives_the_plain_slice():
    random = np.random.default_rng(1)
    volume = Volume(random.integers(0, 100, (24, 20, 22)).astype(np.int16), origin=(-10.5, -9.5, -11.5))
    tree = VesselTree([Vessel([(2.0, 1.3, -11), (2.0, 1.3, 11)], 3.0)])
    camera = front((40, 40), 0.5)
    frame = mpcpr(volume, tree, camera, BARE)
    corner = camera.center - 9.75 * camera.right_axis + 9.75 * camera.up + 1.3 * camera.direction
    i, j = np.meshgrid(np.arange(40), np.arange(40))
    points = corner + 0.5 * (i[..., None] * camera.right_axis - j[..., None] * camera.up)
    slice_values = _lumencut.sample(volume, points.reshape(-1, 3)).reshape(40, 40)
    assert np.isfinite(slice_values).all()
    assert np.abs(frame.value - slice_values).max() < 1e-4
    assert not frame.folded.any()


def test_rows_beyond_the_ends_show_nothing():
    volume = Volume(np.full((8, 8, 8), 100, np.int16), spacing=(10, 10, 10), origin=(-35, -35, -35))
    tree = VesselTree([Vessel([(0, 0, -10), (3, 5, 10)], 2.0)])
    frame = mpcpr(volume, tree, front(), BARE)
    rows = np.abs(25 - np.arange(51)) <= 10
    for image in (frame.vessel >= 0, np.isfinite(frame.depth), np.isfinite(frame.value)):
        assert np.array_equal(image, np.broadcast_to(rows[:, None], image.shape))
    assert np.array_equal(np.isfinite(frame.position).all(axis=2), frame.vessel >= 0)
    assert (frame.image[~rows, :, 3] == 0).all()
    assert (frame.image[rows, :, 3] == 255).all()
    context = mpcpr(volume, tree, front(), Settings(window=Window(50, 100), context="mip"))
    assert (context.context[~rows][:, 10:50, 3] > 0).all()
    assert (context.context[rows][..., 3] == 0).all()


def test_the_other_images_of_the_frame():
    tree = wandering(2)
    camera = Camera.anterior(tree, (40, 30))
    alone = mpcpr(None, tree, camera)
    assert isinstance(alone, Frame)
    assert [name for name in ("image", "value", "context") if alone.has(name)] == []
    expected = Renderer(None, tree).cut_surface(camera, Settings()).distance
    assert np.array_equal(alone.distance, expected)
    with pytest.raises(VolumeError, match="folded of the frame: found a frame of another method"):
        _ = Renderer(None, tree).cut_surface(camera).folded


def test_files_hold_it(tmp_path):
    volume, tree = scene("phantom")
    frame = mpcpr(volume, tree, Camera.anterior(tree, (220, 210)))
    frame.save(tmp_path / "frame.npz")
    with np.load(tmp_path / "frame.npz") as arrays:
        assert np.array_equal(arrays["folded"], frame.folded)
    frame.save(tmp_path / "frame.png", annotate=True)
    with Image.open(tmp_path / "frame.png") as picture:
        assert "Lumencut" not in picture.info
        assert picture.info["dpi"][0] == pytest.approx(25.4 / frame.camera.pixel_spacing, rel=1e-3)


def test_samples_are_means_of_views_within_a_pixel():
    volume, tree = scene("phantom")
    camera = Camera.anterior(tree, (60, 50))
    one, many = (mpcpr(volume, tree, camera, Settings(samples=n, context=None)) for n in (1, 3))
    assert np.array_equal(one.depth, many.depth, equal_nan=True)
    assert 0 < np.abs(one.image.astype(int) - many.image).mean() < 20


@pytest.mark.parametrize("name", ["default", "slab mean", "mip", "no context", "gradient"])
@pytest.mark.usefixtures("gpu")
def test_both_devices_show_the_same(name):
    volume, tree = scene("phantom")
    camera = oblique(tree, (113, 91))
    # Next to rows that show nothing the gradient is as large as it can be.
    settings = Settings(silhouette_rule="gradient") if name == "gradient" else SETTINGS[name]
    found, expected = (mpcpr(volume, tree, camera, settings, device) for device in ("gpu", "cpu"))
    assert np.array_equal(found.vessel, expected.vessel)
    assert np.array_equal(found.folded, expected.folded)
    assert np.array_equal(np.isnan(found.depth), np.isnan(expected.depth))
    object.__setattr__(found, "_depth", np.nan_to_num(found.depth))
    object.__setattr__(expected, "_depth", np.nan_to_num(expected.depth))
    assert_alike(found, expected)


@needs_shared_data
@pytest.mark.usefixtures("gpu")
def test_both_devices_show_the_same_of_real_data():
    volume, tree = scene("stent")
    camera = Camera.anterior(tree, (160, 170))
    found, expected = (
        mpcpr(volume, tree, camera, SETTINGS["no context"], device) for device in ("gpu", "cpu")
    )
    assert np.array_equal(found.depth, expected.depth, equal_nan=True)
    different = (np.abs(found.image.astype(int) - expected.image) > 1).any(axis=2)
    assert different.mean() < 1e-3


ONE = VesselTree([Vessel([(0, 0, 0), (0, 0, 9)], 1.0)])
POINT = VesselTree([Vessel([(0, 0, 0), (0, 0, 9)], 1.0), Vessel([(1, 2, 3), (1, 2, 3)], 1.0)])


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"tree": None}, VesselTreeError, "tree"),
        ({"tree": POINT}, VesselTreeError, "vessel 1 of the tree: found all points within 0.001 mm"),
        ({"camera": "anterior"}, CameraError, "camera: found str"),
        ({"settings": {}}, SettingsError, "settings: found dict"),
        ({"device": "tpu"}, SettingsError, "tpu"),
        ({"volume": 3}, VolumeError, "int"),
    ],
)
def test_bad_arguments_are_named(arguments, error, words):
    with pytest.raises(error, match=re.escape(words)):
        mpcpr(**{"volume": None, "tree": ONE, **arguments})


def test_bad_parts_are_refused_where_they_are_made():
    with pytest.raises(CameraError, match="parallel"):
        Camera((0, 0, 0), (0, 1, 0), (0, 2, 0))
    with pytest.raises(VesselTreeError, match="at least 2 points"):
        Vessel([(0, 0, 0)])
    with pytest.raises(SettingsError):
        Slab(-1.0, "mean")
