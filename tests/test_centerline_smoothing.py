"""Smooth centerlines: `VesselTree.smoothed`, the setting, and the report of ``lumencut info``."""

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Vessel, VesselTree
from lumencut.cli import main
from lumencut.errors import SettingsError
from scene_files import bent_line, write_lines


def trembling_tree():
    rng = np.random.default_rng(4)
    points = np.linspace((0, 0, 0), (60, 20, -30), 120) + rng.normal(0, 0.2, (120, 3))
    bare = Vessel(rng.normal(0, 9, (20, 3)), name="bare")
    return VesselTree([bare, Vessel(points, np.linspace(4, 1, 120), "trunk")])


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
