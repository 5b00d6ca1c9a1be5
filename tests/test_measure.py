"""Measurements of vessels of known width, with known blur and noise."""

from pathlib import Path

import numpy as np
import pytest

import lumencut
from lumencut import Flag, Vessel, VesselTree, Volume, measure
from lumencut.measuring.profile import Profile
from measure_scenes import FWHM, LUMEN, TISSUE, Grid, Tube, narrowed, round_tube

EVEN = (0.4, 0.4, 0.4)


def box(tube: Tube, length: float) -> tuple[float, float, float]:
    return (max(tube.diameters) + 9,) * 2 + (length,)


@pytest.fixture(scope="module")
def wide() -> Profile:
    tube = round_tube(6.0)
    volume = tube.volume(Grid.even(EVEN, box(tube, 34)))
    return measure(volume, tube.vessel(30), fwhm=FWHM)


def test_a_wide_vessel_is_measured_to_a_part_of_a_voxel(wide):
    assert np.abs(wide.diameter_equivalent - 6.0).max() < 0.08
    assert np.mean(wide.diameter_equivalent) == pytest.approx(6.0, abs=0.015)
    assert np.abs(wide.inscribed_radius - 3.0).max() < 0.3
    assert np.linalg.norm(wide.center[:, :2], axis=1).max() < 0.06
    assert (wide.flags == 0).all()
    assert wide.noise == pytest.approx(26, rel=0.1)
    assert wide.levels.mean(axis=0) == pytest.approx([LUMEN, TISSUE], abs=3)
    away = np.linalg.norm(wide.contour - wide.center[:, None], axis=2)
    assert wide.contour.shape == (len(wide), 64, 3)
    assert np.abs(away - 3.0).max() < 0.5
    assert np.abs(away.mean() - 3.0) < 0.03


def test_numbers_belong_together(wide):
    assert wide.diameter_mean == pytest.approx((wide.diameter_min + wide.diameter_max) / 2)
    assert wide.area == pytest.approx(np.pi * wide.diameter_equivalent**2 / 4)
    assert wide.area == pytest.approx(np.pi * wide.diameter_min * wide.diameter_max / 4)
    assert (np.diff(wide.arc_length) > 0).all()
    assert wide.arc_length[[0, -1]] == pytest.approx([0, 30])
    assert np.diff(wide.arc_length).max() <= 0.5 + 1e-9
    assert wide.normal == pytest.approx(np.tile([0, 0, 1], (len(wide), 1)))
    assert wide.fwhm == FWHM
    assert wide.fwhm_source == "given"
    for array in (wide.arc_length, wide.area, wide.flags, wide.center, wide.contour):
        assert not array.flags.writeable


def test_a_stent_is_metal():
    def paint(values, x, y):
        return np.where(np.abs(np.hypot(x, y) - 3.2) < 0.2, 3000.0, values)

    tube = round_tube(6.0, paint=paint)
    profile = measure(tube.volume(Grid.even(EVEN, box(tube, 24))), tube.vessel(20), fwhm=FWHM)
    assert (profile.flags & Flag.METAL > 0).all()
    assert profile.diameter_equivalent.min() == pytest.approx(6.0, rel=0.12)
    # A strut blooms, so no place within a stent is suggested, and the reason is stated.
    assert profile.narrowest() is None
    (reason,) = profile.not_suggested()
    assert "sections that count has a doubt (metal)" in reason
    assert "metal" in reason


def test_flags_are_those_of_the_core():
    table = {name: bit for name, bit, *_ in lumencut._lumencut.MEASURING_FLAGS}
    assert {flag.name: flag.value for flag in Flag} == table


def test_the_guide_says_what_flags_mean_in_the_words_of_the_core():
    guide = (Path(__file__).parent.parent / "docs" / "measuring.md").read_text("utf-8")
    for _, _, word, meaning, *_ in lumencut._lumencut.MEASURING_FLAGS:
        assert f"\n| {word} | {meaning} |" in guide


def test_measured_radii_of_a_tree():
    volume, vessel = narrowed(50)
    tree = VesselTree([Vessel(vessel.points, 9.0, "artery"), Vessel([[0, 0, 60], [0, 0, 90]], 1.5)])
    measured = tree.measured(volume, fwhm=FWHM)
    assert measured[0].name == "artery"
    assert measured[0].radius[10] == pytest.approx(2.5, rel=0.03)
    assert measured[0].radius[60] == pytest.approx(1.25, rel=0.06)
    assert (measured[1].radius == 1.5).all()
    assert measured.notes == ("vessel 1: the radius of 2 points of 2 was not measured",)
    assert (measured[0].points == vessel.points).all()


def test_cross_sections_lie_across_the_vessel():
    tube = Tube((5.0, 5.0), (0.0, 0.5, 1.0))
    volume = tube.volume(Grid.even(EVEN, (14, 24, 24)), noise=0)
    vessel = tube.vessel(14)
    section = lumencut.cross_section(volume, vessel, 7.0, size=12.0, pixel_spacing=0.2)
    assert section.value.shape == (60, 60)
    assert section.normal == pytest.approx(tube.axes()[2])
    assert (section.position - vessel.points[14]) @ section.normal == pytest.approx(
        np.zeros((60, 60)), abs=1e-9
    )
    # The patient's left is on the right of the image, the back at the bottom.
    assert section.position[0, -1, 0] > section.position[0, 0, 0]
    assert section.position[-1, 0, 1] > section.position[0, 0, 1]
    assert section.value[30, 30] == pytest.approx(LUMEN, rel=0.02)
    inside = section.value > (LUMEN + TISSUE) / 2
    # A half-maximum threshold errs by the blur.
    assert inside.sum() * 0.04 == pytest.approx(np.pi * 2.5**2, rel=0.05)
    pixels = section.pixel_from_world(section.position[[3, 10], [50, 7]])
    assert pixels == pytest.approx(np.array([[50.0, 3.0], [7.0, 10.0]]), abs=1e-9)


def test_a_line_that_leaves_its_vessel_is_measured_as_far_as_there_is_a_wall():
    tube = round_tube(6.0)
    grid = Grid.even((0.8, 0.8, 0.8), (24.0, 24.0, 140.0))
    volume = tube.volume(grid)
    voxels = np.array(volume.array)
    # From 10 mm below the middle of the volume on there is only tissue.
    end = voxels.shape[0] // 2 - 12
    voxels[end:] = np.random.default_rng(5).normal(TISSUE, 26, voxels[end:].shape)
    cut = Volume(voxels, world_from_index=grid.affine)
    vessel = tube.vessel(130)
    profile = measure(cut, vessel, fwhm=FWHM)
    (words,) = profile.not_measured()
    assert words.startswith("Not measured from ")
    assert words.endswith("mm on: the vessel is as bright as its surroundings there.")
    behind = float(words.split()[3])
    assert 45 <= behind <= 56
    is_measured = np.isfinite(profile.area)
    assert is_measured[profile.arc_length < 45].all()
    assert not is_measured[profile.arc_length > behind + 1].any()
    assert np.abs(profile.diameter_equivalent[profile.arc_length < 40] - 6.0).max() < 0.3
    assert measure(volume, vessel, fwhm=FWHM).not_measured() == ()


def test_a_line_without_any_wall_is_refused_in_plain_numbers():
    flat = Volume(np.random.default_rng(3).normal(341.5264, 20, (60, 30, 30)).astype(np.float32))
    line = Vessel([[15.0, 15.0, z] for z in range(2, 58)])
    with pytest.raises(lumencut.MeasuringError, match=r"found 34\d both on the vessel and around it"):
        measure(flat, line, fwhm=FWHM)
