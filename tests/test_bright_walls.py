"""Walls of plaque nearly as bright as the lumen: such a vessel is measured with the level of plaque."""

from dataclasses import replace

import numpy as np
import pytest

from calibration_scenes import Floats
from lumencut import Profile, Volume, measure
from voxelizer import SickScene

PLAQUE = SickScene(
    4.3, length=32, wall=0.74, wall_level=190, lumen=415, tilt=(0.2, 0.1), narrowed=0.4, eccentric=0.7, seed=3
)
HEALTHY = replace(PLAQUE, wall_level=50.0, narrowed=0.0)


def measured(scene: SickScene, volume: Volume | None = None) -> Profile:
    return measure(volume or scene.volume(), scene.line()[0])


def error(profile: Profile) -> Floats:
    return profile.diameter_equivalent / PLAQUE.diameter - 1


def test_a_wall_of_plaque_is_no_lumen():
    profile = measured(PLAQUE)
    assert profile.wall_source == "150 ± 40 HU, as plaque: the values show it"
    assert np.median(error(profile)) == pytest.approx(0, abs=0.03)


def test_a_given_level_is_kept():
    profile = measure(PLAQUE.volume(), PLAQUE.line()[0], wall=(45, 25))
    assert profile.wall_source == "45 ± 25, given"
    assert np.median(error(profile)) > 0.06


def test_plaque_in_one_place_leaves_the_others_as_they_are():
    healthy, plaque = HEALTHY.volume(), PLAQUE.volume()
    values, heights = healthy.array.copy(), np.arange(healthy.array.shape[0])
    middle = np.abs(heights - heights.mean()) * healthy.spacing[0] < 4
    values[middle] = plaque.array[middle]
    profile = measured(HEALTHY, Volume(values, world_from_index=healthy.world_from_index))
    before = measured(HEALTHY)
    ends = np.abs(profile.arc_length - profile.arc_length[-1] / 2) > 7
    assert before.wall_source.startswith("45 ± 25 HU, as walls in CT")
    assert profile.wall_source.startswith("45 ± 25 HU, as walls in CT")
    assert np.median(error(profile)[ends]) == pytest.approx(np.median(error(before)[ends]), abs=0.02)
    assert (profile.flags[ends] == 0).mean() > 0.9
