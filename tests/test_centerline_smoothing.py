"""Smooth centerlines: `VesselTree.smoothed`, the setting, and the report of ``lumencut info``."""

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree
from lumencut.cli import main
from lumencut.errors import SettingsError
from scene_files import bent_line, write_lines


def trembling_tree():
    rng = np.random.default_rng(4)
    points = np.linspace((0, 0, 0), (60, 20, -30), 120) + rng.normal(0, 0.2, (120, 3))
    bare = Vessel(rng.normal(0, 9, (20, 3)), name="bare")
    return VesselTree([bare, Vessel(points, np.linspace(4, 1, 120), "trunk")])


def integrated(points, at, sigma):
    """Return the Gaussian mean around a point far from the ends, by small steps along the polyline."""
    arc = np.concatenate([[0], np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()])
    steps = np.linspace(-6, 6, 24_001)
    weights = np.exp(-(steps**2) / 2)
    places = arc[at] + sigma * steps
    assert places[0] >= 0
    assert places[-1] <= arc[-1]
    return np.array([np.average(np.interp(places, arc, axis), weights=weights) for axis in points.T])


def test_a_smoothed_point_is_the_gaussian_mean_of_the_curve():
    tree = trembling_tree()
    trunk, smoothed = tree[1], tree.smoothed(0.5)[1]
    for at in range(40, 80):
        expected = integrated(trunk.points, at, 0.5 * trunk.radius[at])
        # The core approximates the Gaussian by several box filters.
        assert np.linalg.norm(smoothed.points[at] - expected) < 2e-3


def test_what_stays():
    tree = trembling_tree()
    smoothed = tree.smoothed(2)
    assert [vessel.name for vessel in smoothed] == ["bare", "trunk"]
    assert smoothed[0].radius is None
    np.testing.assert_array_equal(smoothed[0].points, tree[0].points)
    np.testing.assert_array_equal(smoothed[1].radius, tree[1].radius)
    np.testing.assert_array_equal(smoothed[1].points[[0, -1]], tree[1].points[[0, -1]])
    np.testing.assert_array_equal(tree.smoothed(0).points, tree.points)


@pytest.mark.parametrize("radii", [-0.1, 10.1, float("nan"), float("inf"), "much", None, [1, 2]])
def test_radii_are_those_of_the_setting(radii):
    with pytest.raises(SettingsError, match="centerline_smoothing"):
        trembling_tree().smoothed(radii)


def test_the_setting_shows_the_smoothed_tree():
    tree = trembling_tree()
    camera = Camera.anterior(tree, size=(60, 50))
    shown = Renderer(None, tree, "cpu").cut_surface(camera, Settings(centerline_smoothing=1.5))
    given = Renderer(None, tree.smoothed(1.5), "cpu").cut_surface(camera)
    np.testing.assert_array_equal(shown.depth, given.depth)
    np.testing.assert_array_equal(shown.vessel, given.vessel)


def info(*words):
    return CliRunner().invoke(main, ["info", *map(str, words)]).stdout


def test_info_tells_the_largest_shift(tmp_path):
    rng = np.random.default_rng(1)
    line = bent_line() + rng.normal(0, 0.1, bent_line().shape)
    path = write_lines(tmp_path / "lines.vtk", line, radius=3)
    told = re.search(
        r"largest shift +([\d.]+) mm by a centerline smoothing of 0.5 radii "
        r"\(vessel 0, (\d+) mm from its start\)",
        info(path),
    )
    (found,) = json.loads(info("--json", path))["files"]
    shift = found["largest_shift"]
    moved = np.linalg.norm(VesselTree([Vessel(line, 3)]).smoothed(0.5).points - line, axis=1)
    assert shift["shift_mm"] == pytest.approx(moved.max(), rel=1e-3)
    assert (shift["smoothing_radii"], shift["vessel"]) == (0.5, 0)
    arc = np.linalg.norm(np.diff(line, axis=0), axis=1)[: moved.argmax()].sum()
    assert shift["from_start_mm"] == pytest.approx(arc, abs=0.01)
    assert told.groups() == (f"{shift['shift_mm']:.2f}", f"{shift['from_start_mm']:.0f}")


@pytest.mark.parametrize("radius", [None, 3])
def test_info_says_nothing_where_nothing_moves(tmp_path, radius):
    line = np.linspace((0, 0, 0), (0, 30, 30), 20) if radius else bent_line()
    path = write_lines(tmp_path / "lines.vtk", line, radius=radius)
    assert "largest shift" not in info(path)
    assert json.loads(info("--json", path))["files"][0]["largest_shift"] is None
