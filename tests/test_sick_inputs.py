"""Scans and lines that measuring meets in practice and cannot trust: no error is silent, and errors help."""

from dataclasses import replace

import numpy as np
import pytest

from calibration_scenes import Floats
from lumencut import Flag, Profile, Vessel, Volume, measure
from lumencut.errors import MeasuringError
from sick_calibration import SILENT, UNCOUNTED
from voxelizer import SickScene

SCENE = SickScene(5.0, length=30, noise=15)


@pytest.fixture(scope="module")
def volume() -> Volume:
    return SCENE.volume()


@pytest.fixture(scope="module")
def line() -> Vessel:
    return SCENE.line()[0]


def of(volume: Volume, values: Floats) -> Volume:
    return Volume(np.asarray(values, dtype=volume.array.dtype), world_from_index=volume.world_from_index)


def distance_from(point: Floats, volume: Volume) -> Floats:
    k, j, i = np.indices(volume.array.shape)
    world = np.stack([i, j, k], axis=-1) @ volume.world_from_index[:3, :3].T + volume.world_from_index[:3, 3]
    return np.asarray(np.linalg.norm(world - point, axis=-1))


def silent(profile: Profile, true: float = SCENE.diameter) -> Floats:
    """Return the arc lengths of sections that count with a wrong diameter."""
    counts = (profile.flags & int(UNCOUNTED)) == 0
    wrong = np.abs(profile.diameter_equivalent / true - 1) > SILENT
    return profile.arc_length[counts & wrong]


def test_a_scan_without_hu_says_that_walls_are_part_of_the_lumen(volume, line):
    profile = measure(of(volume, np.clip(volume.array, -1024, None) + 1024), line)
    assert profile.wall_source == "not separated: nothing says that the values are HU"
    assert not silent(profile).size


def test_an_inverted_scan_gives_the_diameters_of_the_scan(volume, line):
    plain, inverted = (measure(of(volume, sign * volume.array), line, wall="off") for sign in (1, -1))
    assert inverted.diameter_equivalent == pytest.approx(plain.diameter_equivalent, abs=0.01)
    assert measure(of(volume, -volume.array), line).wall_source == "not separated: the lumen is dark"


@pytest.mark.parametrize("later", [180, 250])
def test_two_phases_of_contrast_change_no_diameter_silently(volume, line, later):
    values = volume.array.copy()
    half = len(values) // 2
    values[half:] = replace(SCENE, lumen=float(later)).volume().array[half:]
    assert not silent(measure(of(volume, values), line)).size


def test_noise_of_half_the_contrast_is_named(line):
    noisy = replace(SCENE, noise=260.0).volume()
    with pytest.raises(MeasuringError, match=r"next to it, with noise of \d+; .*smooth the volume"):
        measure(noisy, line)


def test_noise_of_a_fifth_of_the_contrast_is_in_the_uncertainty(line):
    profile = measure(replace(SCENE, noise=90.0).volume(), line)
    error = np.abs(profile.diameter_equivalent - SCENE.diameter)
    counts = (profile.flags & int(UNCOUNTED)) == 0
    assert counts.mean() > 0.5
    assert (error[counts] <= 3 * profile.uncertainty[counts]).mean() > 0.9
    assert not silent(profile).size


def test_a_vessel_that_ends_in_a_mass_is_measured_up_to_it(volume, line):
    mass = distance_from(line.points[-1], volume) < 7
    noise = np.random.default_rng(0).normal(0, 15, mass.sum())
    values = volume.array.copy()
    values[mass] = 60 + noise
    profile = measure(of(volume, values), line)
    before = profile.arc_length < profile.arc_length[-1] - 9
    assert profile.diameter_equivalent[before] == pytest.approx(SCENE.diameter, rel=0.06)
    within = profile.arc_length > profile.arc_length[-1] - 5
    assert (profile.flags[within] & int(UNCOUNTED) != 0).all()


def test_metal_that_fills_the_lumen_does_not_change_the_rest(volume, line):
    values = volume.array.copy()
    for point in line.points[9 * len(line) // 20 : 11 * len(line) // 20 : 5]:
        values[distance_from(point, volume) < 2.4] = 2500
    profile, before = measure(of(volume, values), line), measure(volume, line)
    is_metal = profile.flags & int(Flag.METAL) > 0
    middle = np.abs(profile.arc_length - profile.arc_length[-1] / 2) < 2
    assert is_metal[middle].all()
    beside = ~is_metal & (np.abs(profile.arc_length - profile.arc_length[-1] / 2) > 7)
    change = profile.diameter_equivalent - before.diameter_equivalent
    assert np.abs(change[beside]).max() < 2 * before.uncertainty.max()


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_wrong_radii_of_the_line_do_not_matter(volume, line, factor):
    radius = np.full(len(line), factor * SCENE.diameter / 2)
    profile, expected = measure(volume, Vessel(line.points, radius=radius)), measure(volume, line)
    assert profile.diameter_equivalent == pytest.approx(expected.diameter_equivalent, abs=0.02)
