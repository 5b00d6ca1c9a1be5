"""The voxelizer of sick vessels agrees with closed forms."""

import numpy as np
import pytest

from sick_calibration import KINDS, Sections
from voxelizer import SickScene

EVEN = {"noise": 0.0, "wall": 0.0, "around": -100.0, "lumen": 300.0}


def areas(scene):
    """The area of the lumen in each slice (mm²), from the sum of all values: blur does not change it."""
    volume = scene.volume()
    excess = (volume.array[4:-4].astype(float) + 100.0).sum(axis=(1, 2)) / 400.0
    return excess * scene.spacing[0] * scene.spacing[1]


@pytest.mark.parametrize("diameter", [2.0, 4.0, 10.0])
@pytest.mark.parametrize("sharp", [0.0, 0.4])
def test_the_sum_of_a_slice_is_the_area_of_the_lumen(diameter, sharp):
    found = areas(SickScene(diameter, sharp=sharp, **EVEN))
    assert found == pytest.approx(np.pi * diameter**2 / 4, rel=0.03)
    assert found.mean() == pytest.approx(np.pi * diameter**2 / 4, rel=0.01)


def test_an_ellipse_and_a_tilt_change_the_area_as_stated():
    ellipse = areas(SickScene(6.0, aspect=1.5, **EVEN)).mean()
    tilted = areas(SickScene(6.0, tilt=(0.0, 0.5), **EVEN))[8:-8].mean()
    assert ellipse == pytest.approx(9 * np.pi, rel=0.01)
    assert tilted == pytest.approx(9 * np.pi / np.cos(0.5), rel=0.01)


def test_a_stenosis_has_its_area_and_lies_where_it_is_eccentric():
    scene = SickScene(6.0, narrowed=0.5, narrowed_length=6.0, eccentric=1.0, wall_level=-100.0, **EVEN)
    found = areas(scene)
    # Along z the blur takes in sections beside the throat, where the area is nearly the same.
    assert found.min() == pytest.approx(np.pi * 1.5**2, rel=0.02)
    line, diameters = scene.line()
    assert diameters.min() == pytest.approx(3.0)
    assert line.points[diameters.argmin()] == pytest.approx([1.5, 0.0, 0.0], abs=0.01)


def test_kinds_repeat_their_scenes():
    for kind in KINDS.values():
        assert kind(np.random.default_rng(3)) == kind(np.random.default_rng(3))


def test_a_silent_error_counts_and_is_wrong_by_more_than_a_tenth():
    true = np.full(4, 5.0)
    error = np.array([0.0, 0.6, 0.6, -0.4])
    counts = np.array([True, True, False, True])
    row = Sections(error, np.full(4, 0.3), true, counts).row()
    assert row[0] == "75 %"
    assert row[2] == "33/100/100"
    assert row[4] == "33.3 %"
