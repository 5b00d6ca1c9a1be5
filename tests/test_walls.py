"""Arteries with walls in fat: the lumen without the wall, and the message if walls are not distinguished."""

import numpy as np
import pytest

from calibration_scenes import FAT, Scene
from lumencut import Profile, Volume, measure
from lumencut.errors import SettingsError


def of(scene: Scene, **more: object) -> Profile:
    return measure(scene.volume(), scene.vessel(), fwhm=scene.fwhm, **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def coronary() -> Profile:
    return of(Scene(3.0, thickness=0.8))


@pytest.mark.parametrize("percent", [50, 70, 90])
def test_stenoses_in_fat_are_graded_to_four_points(percent):
    scene = Scene(
        6.0, stenosis=percent, stenosis_length=16, length=40, spacing=(0.4, 0.4, 0.4), fwhm=0.6, kernel=0.4
    )
    told = of(scene)
    assert told.stenosis(20, 35).percent == pytest.approx(percent, abs=4)


def test_the_wall_is_measured_too(coronary):
    is_told = np.isfinite(coronary.wall)
    assert is_told.mean() > 0.9
    assert np.median(coronary.wall[is_told]) == pytest.approx(0.8, abs=0.15)
    assert np.median(coronary.diameter_outer[is_told]) == pytest.approx(3.0 + 2 * 0.8, abs=0.3)
    assert (coronary.wall_uncertainty[is_told] > 0).all()
    assert (coronary.diameter_outer_uncertainty[is_told] > coronary.wall_uncertainty[is_told]).all()
    assert (np.isnan(coronary.wall) == np.isnan(coronary.diameter_outer)).all()


def test_the_parts_make_up_the_uncertainty(coronary):
    parts = coronary.uncertainty_parts
    assert list(parts) == ["noise", "point_spread", "wall", "lumen_level", "surroundings"]
    assert np.sqrt(sum(part**2 for part in parts.values())) == pytest.approx(coronary.uncertainty)
    assert (parts["point_spread"] == 0).all()
    assert (parts["wall"] > 0.005).all()


def test_correlated_noise_makes_diameters_less_sure():
    white, smooth = (of(Scene(4.0, kernel=kernel, seed=5)) for kernel in (0.0, 1.0))
    noise = [np.median(told.uncertainty_parts["noise"]) for told in (white, smooth)]
    assert noise[1] > 1.5 * noise[0]
    spread = [np.std(told.diameter_equivalent) for told in (white, smooth)]
    assert spread[1] > 1.3 * spread[0]


def test_the_source_of_the_wall_is_told(coronary):
    scene = Scene(3.0, seed=6)
    volume, vessel = scene.volume(), scene.vessel()
    assert coronary.wall_source == "45 ± 25 HU, as walls in CT"
    assert of(scene, wall=(30, 10)).wall_source == "30 ± 10, given"
    assert of(scene, wall="off").wall_source == "not separated, as requested"
    shares = Volume((volume.array - FAT) / 440, world_from_index=volume.world_from_index)
    told = measure(Volume(shares.array.clip(0), world_from_index=volume.world_from_index), vessel, fwhm=0.9)
    assert told.wall_source == "not separated: nothing says that the values are HU"
    dark = Volume(300 - volume.array, world_from_index=volume.world_from_index)
    assert measure(dark, vessel, fwhm=0.9, wall=(100, 30)).wall_source == "100 ± 30, given"
    told = measure(dark, vessel, fwhm=0.9)
    assert told.wall_source == "not separated: the lumen is dark"
    assert np.isnan(told.wall).all()


@pytest.mark.parametrize(
    ("wall", "words"),
    [
        ((340, 20), "expected a level below that of the lumen"),
        ((45, 0), 'expected a standard deviation above 0, or "off"'),
        ((45, -5), 'expected a standard deviation above 0, or "off"'),
        ((float("nan"), 25), "wall: found NaN"),
        ((45, 1e9), "the standard deviation of the wall's level"),
        ((45,), "expected numbers of shape 2"),
        ("on", "expected one of 'off'"),
    ],
)
def test_an_absurd_wall_is_refused(wall, words):
    scene = Scene(3.0)
    with pytest.raises(SettingsError, match=words):
        of(scene, wall=wall)
