"""The point spread is that of the scan: a tree shares it, and no sharp wall passes for a blurred one."""

import numpy as np
import pytest

from lumencut import Vessel, VesselTree, Volume, measure
from lumencut.profile import Profile
from measure_scenes import Grid, round_tube

LINE = Vessel(np.linspace([0, 0, -10], [0, 0, 10], 41))


def binary(diameter: float, noise: float) -> Profile:
    """A tube of 300 in 0, on voxels of 1 mm that are one or the other."""
    grid = Grid.even((1, 1, 1), (25, 25, 25))
    points = grid.points(1)
    values = np.where(np.hypot(points[0], points[1]) <= diameter / 2, 300.0, 0.0)
    values += np.random.default_rng(1).normal(0, noise, values.shape)
    return measure(Volume(values.astype(np.float32), world_from_index=grid.affine), LINE)


@pytest.mark.parametrize("noise", [0, 20])
@pytest.mark.parametrize("diameter", [4, 5, 6, 8, 10])
def test_a_sharp_wall_does_not_pass_for_a_blurred_one(diameter, noise):
    profile = binary(diameter, noise)
    assert np.mean(profile.diameter_equivalent) == pytest.approx(diameter, rel=0.05)
    assert profile.levels.mean(axis=0) == pytest.approx([300, 0], abs=60)
    assert profile.fwhm == pytest.approx(1.2)
    assert profile.fwhm_source.startswith(
        "assumed: 1.2 sides of a voxel, as the walls of wide vessels are sharper"
    )


def test_a_vessel_too_narrow_tells_no_point_spread():
    narrow = round_tube(1.2)
    profile = measure(narrow.volume(Grid.even((0.4, 0.4, 0.4), (10, 10, 24))), narrow.vessel(20))
    assert profile.fwhm_source == "assumed: 1.2 sides of a voxel, as no vessel is wide enough to tell it"


def test_all_vessels_of_a_tree_are_measured_with_one_point_spread():
    grid = Grid.even((0.4, 0.4, 0.4), (24, 12, 24))
    wide, narrow = round_tube(6.0), round_tube(3.0)
    x = grid.points(1)[0]
    # Side by side: each of them is moved by whole voxels.
    left, right = (np.roll(tube.volume(grid).array, by, axis=2) for tube, by in ((wide, -12), (narrow, 14)))
    volume = Volume(np.where(x < 1.6, left, right), world_from_index=grid.affine)
    lines = (Vessel(LINE.points - [4.8, 0, 0], 3.0), Vessel(LINE.points - [-5.6, 0, 0], 1.5))
    tree = VesselTree(lines)
    first, second = (measure(volume, line, tree=tree) for line in lines)
    assert first.fwhm == second.fwhm == pytest.approx(0.8, rel=0.1)
    assert first.fwhm_source == second.fwhm_source
    assert first.fwhm_source.endswith(" of vessel 0 of the tree")
    assert np.mean(second.diameter_equivalent) == pytest.approx(3.0, rel=0.03)
    given = tree.measured(volume, fwhm=first.fwhm)
    for one, other in zip(tree.measured(volume), given, strict=True):
        assert (one.radius == other.radius).all()
