"""CR: an independent computation, the effect of its thresholds, both devices, and invalid input."""

import re

import numpy as np
import pytest

import reference_reformations as reference
from device_scenes import SETTINGS, oblique, scene
from frame_comparison import assert_alike
from lumencut import (
    Camera,
    Renderer,
    Settings,
    SettingsError,
    Vessel,
    VesselTree,
    VesselTreeError,
    VolumeError,
    Window,
    cr,
)
from scenes import wandering


def joined(seed):
    """Return vessels; each except the first begins at a point of another one: an end or an inner point."""
    random = np.random.default_rng(seed)
    made = [*wandering(seed, vessels=4, points=25)]
    for number, vessel in enumerate(made[1:], 1):
        parent = made[random.integers(number)].points
        start = parent[-1] if number % 2 else parent[12]
        made[number] = Vessel(vessel.points - vessel.points[0] + start, vessel.radius)
    return VesselTree(made)


@pytest.mark.parametrize("thresholds", [(0, 0), (3, 8), (10, 25), (40, 15)])
@pytest.mark.parametrize("seed", range(3))
def test_every_pixel_shows_what_a_search_of_everything_finds(seed, thresholds):
    tree = joined(seed)
    camera = Camera.fitted(tree, (0.4, 1.0, -0.3), (0.1, 0.2, 1), (47, 39))
    frame = cr(None, tree, camera, None, *thresholds)
    depth, vessel = reference.cr(tree, camera, *thresholds)
    same = (np.abs(frame.depth - depth) < 1e-3) & (frame.vessel == vessel)
    # 32-bit floats may decide differently if two points are equally near within rounding.
    same |= (frame.vessel != vessel) & (np.abs(frame.depth - depth) < 1e-3)
    assert (~same).sum() <= 3
    nearest, _ = reference.cr(tree, camera, -1e9, 0)
    assert (np.abs(frame.depth - nearest) > 1e-2).any() == (thresholds != (0, 0)) or thresholds == (0, 0)


def crossing():
    """A horizontal vessel in front, and a vertical one 40 mm behind it, both with a radius of 4 mm."""
    return VesselTree([Vessel([(-60, 0, 0), (60, 0, 0)], 4.0), Vessel([(0, 40, -60), (0, 40, 60)], 4.0)])


@pytest.mark.parametrize("offset", [0, 5, 20, 55])
def test_a_larger_offset_keeps_more_surroundings_and_hides_more_lumen(offset):
    """A crossing of 120 mm: tissue around the vessel in front, and visible lumen of the vessel behind."""
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (240, 240), 0.5)
    frame = cr(None, crossing(), camera, radius_offset=2 * offset)
    x, y = np.meshgrid(*reference.places(camera))
    expected = (np.abs(y) <= 4 + offset) | (np.abs(y) <= np.abs(x))
    assert np.array_equal(frame.vessel == 0, expected)
    assert np.array_equal(frame.depth, np.where(expected, 0, 40))
    shown = (frame.vessel == 1) & (np.abs(x) <= 4)
    assert shown.sum() / 4 == 8 * (120 - 2 * (4 + offset))
    band = (frame.vessel == 0) & (np.abs(x) <= 20) & (np.abs(y) <= 20)
    reach = min(4 + offset, 20)
    assert band.sum() / 4 == pytest.approx(40 * 40 - (20 - reach) * (40 + 2 * reach), abs=45)


def test_the_threshold_decides_what_is_one_stretch():
    """A hairpin: within one stretch the limb nearer in the image is shown, otherwise the one in front."""
    tree = VesselTree(
        [Vessel([(0, 0, 50), (0, 0, -50)], 2.0), Vessel([(0, 0, -50), (10, 40, -50), (10, 40, 50)], 2.0)]
    )
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (60, 21), 1.0)
    way = 50 + np.hypot(10, 40) + 50
    short, long = (cr(None, tree, camera, None, 10, threshold) for threshold in (way - 12, way + 12))
    # The pixel at (8.5, 0) is in the disc of the limb in front, but nearer to the limb behind.
    assert [frame.vessel[10, 38] for frame in (short, long)] == [0, 1]


def test_the_images_of_the_frame():
    volume, tree = scene("phantom")
    camera = Camera.anterior(tree, (70, 60))
    frame = cr(volume, tree, camera)
    assert all(frame.has(name) for name in ("image", "depth", "vessel", "distance", "value", "position"))
    assert not frame.has("folded")
    assert np.isfinite(frame.depth).all()
    assert (frame.vessel >= 0).all()
    alone = cr(None, tree, camera)
    assert np.array_equal(alone.depth, frame.depth)
    with pytest.raises(VolumeError, match="folded"):
        _ = frame.folded


@pytest.mark.parametrize("grid", reference.GRIDS)
def test_values_are_those_of_the_positions(grid):
    affine = reference.GRIDS[grid]
    tree = VesselTree(
        [Vessel([(-6, -5, -8), (3, 0, 2), (1, 2, 9)], 2.0), Vessel([(6, -3, -8), (-5, 1, 8)], 1.0)]
    )
    camera = Camera((0.2, 0.1, 0), (0.2, 1, 0.1), (0.1, 0, 1), (60, 40), 0.5)
    bare = Settings(context=None, silhouettes=False, window=Window(50, 100))
    frames = [cr(volume, tree, camera, bare, 4, 20) for volume in reference.index_valued(affine)]
    position = frames[0].position.reshape(-1, 3)
    expected = (position - affine[:3, 3]) @ np.linalg.inv(affine[:3, :3]).T
    found = np.stack([frame.value.ravel() for frame in frames], axis=1)
    within = (expected >= 0).all(axis=1) & (expected <= np.array([29, 25, 21])).all(axis=1)
    assert within.sum() > 800
    assert np.abs(found - expected)[within].max() < 1e-3


def test_within_their_lumen_vessels_without_others_are_shown_as_by_csr():
    tree = VesselTree([Vessel([(-20, 4, -30), (10, -9, 28)], 4.0)])
    camera = Camera.anterior(tree, (80, 80))
    csr = Renderer(None, tree).cut_surface(camera, Settings(levels=0, depth_filter=False))
    assert np.array_equal(cr(None, tree, camera).depth, csr.depth)


@pytest.mark.parametrize("name", ["default", "slab mean", "mip", "no context"])
@pytest.mark.usefixtures("gpu")
def test_both_devices_show_the_same(name):
    volume, tree = scene("phantom")
    camera = oblique(tree, (113, 91))
    frames = [cr(volume, tree, camera, SETTINGS[name], device=device) for device in ("gpu", "cpu")]
    assert_alike(*frames)


ONE = VesselTree([Vessel([(0, 0, 0), (0, 0, 9)], 1.0)])
POINT = VesselTree([Vessel([(1, 2, 3), (1, 2, 3)], 1.0)])


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"radius_offset": -1}, SettingsError, "radius_offset: found -1; expected a finite number of pixels"),
        ({"radius_offset": np.inf}, SettingsError, "radius_offset: found inf"),
        ({"arc_threshold": np.nan}, SettingsError, "arc_threshold: found NaN"),
        ({"arc_threshold": -0.5}, SettingsError, "arc_threshold: found -0.5"),
        ({"arc_threshold": "far"}, SettingsError, "arc_threshold: found 'far'"),
        ({"radius_offset": 1e7}, SettingsError, "between 0 and 1e6"),
        ({"tree": POINT}, VesselTreeError, "vessel 0 of the tree: found all points within 0.001 mm"),
        ({"tree": None}, VesselTreeError, "tree"),
        ({"device": "tpu"}, SettingsError, "tpu"),
    ],
)
def test_bad_arguments_are_named(arguments, error, words):
    with pytest.raises(error, match=re.escape(words)):
        cr(**{"volume": None, "tree": ONE, **arguments})
