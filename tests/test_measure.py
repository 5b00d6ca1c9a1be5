"""Measurements of vessels of known width, with known blur and noise."""

from pathlib import Path

import numpy as np
import pytest

import lumencut
from lumencut import Flag, Vessel, VesselTree, Volume, measure
from lumencut.measuring.profile import Profile
from measure_scenes import FWHM, LUMEN, PARTS, TISSUE, Grid, Tube, blurred, narrowed, round_tube

EVEN = (0.4, 0.4, 0.4)


def bias(profile: Profile, diameter: float) -> float:
    """Return the error of the mean diameter in percent."""
    return 100 * (np.nanmean(profile.diameter_equivalent) / diameter - 1)


def spread(profile: Profile) -> float:
    """Return the scatter of diameters in percent."""
    measured = profile.diameter_equivalent
    return 100 * np.nanstd(measured) / np.nanmean(measured)


def box(tube: Tube, length: float) -> tuple[float, float, float]:
    return (max(tube.diameters) + 9,) * 2 + (length,)


@pytest.fixture(scope="module")
def wide() -> Profile:
    tube = round_tube(6.0)
    volume = tube.volume(Grid.even(EVEN, box(tube, 34)))
    return measure(volume, tube.vessel(30), fwhm=FWHM)


@pytest.mark.parametrize(("diameter", "most"), [(4.0, 2.0), (2.4, 2.0), (1.6, 5.0), (1.2, 5.0)])
def test_narrow_vessels_have_no_bias_by_the_blur(diameter, most):
    tube = round_tube(diameter)
    volume = tube.volume(Grid.even(EVEN, box(tube, 40)))
    profile = measure(volume, tube.vessel(36), fwhm=FWHM)
    assert abs(bias(profile, diameter)) <= most
    assert (diameter < 2 * FWHM) or spread(profile) <= 3
    assert np.isfinite(profile.area).all()
    # The scatter agrees with the stated uncertainty.
    off = (profile.diameter_equivalent - diameter) / profile.uncertainty
    assert 0.4 < np.sqrt(np.mean(off**2)) < 1.6


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


def test_a_narrow_part_takes_its_level_from_the_wide_one():
    volume, vessel = narrowed(70)
    profile = measure(volume, vessel, fwhm=FWHM)
    assert profile.diameter_at(30)[0] == pytest.approx(1.5, abs=0.15)
    assert profile.levels[len(profile) // 2, 0] == pytest.approx(LUMEN, rel=0.03)


@pytest.mark.parametrize(
    ("spacing", "direction", "shear"),
    [
        (EVEN, (1.0, -0.7, 0.9), 0.0),
        ((0.4, 0.4, 1.0), (1.0, 0.1, 0.3), 0.0),
        ((0.4, 0.4, 0.8), (0.2, 0.1, 1.0), 0.35),
    ],
)
def test_ellipses_on_oblique_sheared_and_uneven_grids(spacing, direction, shear):
    tube = Tube((6.0, 3.0), direction)
    along = np.abs(tube.axes()[2])
    size = 13 + 16 * along
    grid = Grid.even(spacing, tuple(size))
    grid.sides[1, 2] = shear * spacing[2]
    profile = measure(tube.volume(grid), tube.vessel(16), fwhm=FWHM)
    assert np.mean(profile.diameter_max) == pytest.approx(6.0, rel=0.03)
    assert np.mean(profile.diameter_min) == pytest.approx(3.0, rel=0.03)


def test_dark_lumens_are_lumens_too():
    tube = round_tube(3.0, levels=(20.0, 280.0))
    volume = tube.volume(Grid.even(EVEN, box(tube, 24)))
    profile = measure(volume, tube.vessel(20), fwhm=FWHM)
    assert abs(bias(profile, 3.0)) < 2
    assert profile.levels.mean(axis=0) == pytest.approx([20, 280], abs=6)


def test_the_scene_may_be_turned():
    tube = round_tube(3.0)
    grid = Grid.even(EVEN, box(tube, 24))
    volume = tube.volume(grid)
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turned = Volume(
        volume.array, world_from_index=np.block([[turn, np.zeros((3, 1))], [np.zeros(3), 1]]) @ grid.affine
    )
    vessel = tube.vessel(20)
    first = measure(volume, vessel, fwhm=FWHM)
    second = measure(turned, Vessel(vessel.points @ turn.T), fwhm=FWHM)
    # The rays begin in another direction; nothing else differs.
    assert second.diameter_equivalent == pytest.approx(first.diameter_equivalent, abs=0.02)
    assert second.center == pytest.approx(first.center @ turn.T, abs=0.02)


def test_threads_change_nothing(wide):
    tube = round_tube(6.0)
    volume = tube.volume(Grid.even(EVEN, box(tube, 34)))
    count = lumencut.get_threads()
    lumencut.set_threads(1)
    try:
        alone = measure(volume, tube.vessel(30), fwhm=FWHM)
    finally:
        lumencut.set_threads(count)
    assert (alone.area == wide.area).all()
    assert (alone.contour == wide.contour).all()


def test_the_point_spread_is_estimated_where_the_vessel_is_wide():
    tube = round_tube(6.0, fwhm=1.1)
    volume = tube.volume(Grid.even(EVEN, box(tube, 24)))
    profile = measure(volume, tube.vessel(20))
    assert profile.fwhm == pytest.approx(1.1, rel=0.1)
    assert profile.fwhm_source.startswith("estimated on ")
    narrow = round_tube(1.2)
    profile = measure(narrow.volume(Grid.even(EVEN, box(narrow, 24))), narrow.vessel(20))
    assert profile.fwhm == 0.85
    assert profile.fwhm_source.startswith("assumed")


def test_a_line_beside_the_middle_is_recentred_and_where_it_is_outside_that_is_said():
    tube = round_tube(4.0)
    volume = tube.volume(Grid.even(EVEN, box(tube, 24)))
    vessel = tube.vessel(20)
    profile = measure(volume, Vessel(vessel.points + np.array([1.2, 0, 0])), fwhm=FWHM)
    assert abs(bias(profile, 4.0)) < 2
    assert np.abs(profile.center[:, 0]).max() < 0.1
    assert (profile.flags == 0).all()
    # The centerline leaves the lumen 2 mm from its middle.
    shift = np.linspace(0, 2.8, len(vessel))
    profile = measure(volume, Vessel(vessel.points + shift[:, None] * np.array([1, 0, 0])), fwhm=FWHM)
    outside = profile.flags & Flag.RECENTERED > 0
    assert abs(profile.arc_length[outside].min() - 20 * 2 / 2.8) < 1.5
    assert outside[-1]
    assert np.nanmax(np.abs(profile.center[:, 0])) < 0.3


def test_calcium_in_the_wall_is_no_lumen():
    def paint(values, x, y):
        return np.where((np.hypot(x - 2.7, y) < 0.8) & (np.hypot(x, y) > 2.0), 1100.0, values)

    tube = round_tube(4.0, paint=paint)
    profile = measure(tube.volume(Grid.even(EVEN, box(tube, 24))), tube.vessel(20), fwhm=FWHM)
    assert (profile.flags & Flag.CALCIUM > 0).mean() > 0.9
    assert abs(bias(profile, 4.0)) < 8


@pytest.mark.parametrize(
    ("away", "reach", "value"), [(2.4, 0.8, 164.0), (0.0, 3.0, 155.0), (-1.0, 2.0, 155.0)]
)
def test_what_is_brighter_than_lumen_by_more_than_its_noise_is_no_lumen(away, reach, value):
    # Dense plaque over 6 mm in an 8-bit scan without HU: at the wall, in the entire lumen, or across it.
    grid = Grid.even((0.5, 0.5, 0.5), (14, 14, 42))
    x, y, z = grid.axes(PARTS)
    share = np.clip(0.5 - (np.hypot(x, y) - 3) * PARTS / 0.5, 0, 1)
    inside = (np.abs(z) < 3) & (np.hypot(x - away, y) < reach) & (np.hypot(x, y) < 3.2)
    noisy = grid.scanned(np.where(inside, value, 5 + 115 * share), 3, 1.5, 0.9)
    scan = Volume(np.clip(np.round(noisy.array), 0, 255).astype(np.uint8), world_from_index=grid.affine)
    z = np.linspace(-19, 19, 77)
    profile = measure(scan, Vessel(np.stack([0 * z, 0 * z, z], axis=1)))
    within = np.abs(profile.arc_length - 19) <= 2
    assert (profile.flags[within] & (Flag.CALCIUM | Flag.METAL) > 0).all()
    beside = np.abs(profile.arc_length - 19) > 5
    assert (profile.flags[beside] == 0).all()


def test_contrast_medium_that_mixes_and_an_edge_that_is_enhanced_are_lumen():
    grid = Grid.even((0.5, 0.5, 0.5), (14, 14, 42))
    x, y, z = grid.points(PARTS)
    share = np.clip(0.5 - (np.hypot(x, y) - 3) * PARTS / 0.5, 0, 1)
    step = (0.5 / PARTS,) * 3
    values = blurred(5 + 115 * (1 + 0.15 * np.tanh(z / 10)) * share, step, 0.9)
    # A sharp reconstruction kernel overshoots at edges.
    sharp = values + (values - blurred(values, step, 1.8))
    along = np.linspace(-19, 19, 77)
    for scanned in (values, sharp):
        profile = measure(
            grid.volume(scanned, 3, 1.5), Vessel(np.stack([0 * along, 0 * along, along], axis=1))
        )
        assert (profile.flags == 0).all()
        assert abs(bias(profile, 6.0)) < 1.5


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
    assert "no section is reliable (metal)" in reason
    assert "metal" in reason


def test_a_neighbour_at_a_millimetre_is_marked_and_harms_little():
    def paint(values, x, y):
        return np.where(np.hypot(x - 5.0, y) < 2.0, LUMEN, values)

    tube = round_tube(4.0, paint=paint)
    profile = measure(tube.volume(Grid.even(EVEN, box(tube, 24))), tube.vessel(20), fwhm=FWHM)
    assert (profile.flags & Flag.NEIGHBOR > 0).mean() > 0.9
    assert abs(bias(profile, 4.0)) < 5


def test_sections_within_a_junction_are_left_out():
    tube = round_tube(4.0)
    grid = Grid.even(EVEN, (22, 11, 26))
    volume = tube.volume(grid)
    beside = Tube((3.0, 3.0), (1.0, 0.0, 0.0)).volume(grid, noise=0)
    points = grid.points(1)
    array = np.where(points[0] > 0, np.maximum(volume.array, beside.array), volume.array)
    volume = Volume(array.astype(np.float32), world_from_index=grid.affine)
    main = tube.vessel(22)
    branch = Vessel(np.linspace([0, 0, 0], [10, 0, 0], 21), 1.5)
    halves = (Vessel(main.points[:23], 2.0), Vessel(main.points[22:], 2.0))
    profile = measure(volume, main, fwhm=FWHM, tree=VesselTree([*halves, branch]))
    marked = profile.arc_length[profile.flags & Flag.BRANCH > 0]
    assert abs(marked.min() - 9.5) <= 1.5
    assert abs(marked.max() - 12.5) <= 1.5
    assert profile.widest().diameter < 4.5
    assert abs(100 * (np.mean(profile.diameter_equivalent[profile.flags == 0]) / 4 - 1)) < 2


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
