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
