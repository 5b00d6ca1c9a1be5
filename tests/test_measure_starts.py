"""Measurements do not depend on the position of the centerline within the lumen."""

import numpy as np
import pytest

from calibration_scenes import FAT, MUSCLE, Scene
from lumencut import Vessel, measure

#: Lumens that no model fits exactly, because their surroundings are patchy, and a narrow one.
SCENES = {
    "round": Scene(5.0, around=(FAT, MUSCLE), patches=40, seed=4),
    "flat": Scene(6.0, around=(FAT, MUSCLE), patches=40, stretch=1.7, seed=5),
    "narrow": Scene(2.0, seed=7),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_line_beside_the_middle_measures_the_same_lumen(name):
    scene = SCENES[name]
    volume, line = scene.volume(), scene.vessel()
    middle = measure(volume, line, 1.0, scene.fwhm)
    away = []
    for angle in (0.0, 2.1, 4.2):
        # Straight lines moved sideways have the same planes of sections.
        sideways = 0.35 * scene.diameter / 2 * np.array([np.cos(angle), np.sin(angle), 0.0])
        moved = measure(volume, Vessel(line.points + sideways), 1.0, scene.fwhm)
        judged = (middle.flags == 0) & (moved.flags == 0)
        assert judged.mean() > 0.9
        apart = np.abs(moved.diameter_equivalent - middle.diameter_equivalent)
        away.append((apart / middle.uncertainty)[judged])
    # In stated standard deviations.
    assert np.quantile(np.concatenate(away), 0.99) < 0.25
