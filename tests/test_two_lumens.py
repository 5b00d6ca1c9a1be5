"""True and false lumen behind a flap: numbers, files, report and pictures; never where no flap is."""

import csv
import json

import numpy as np
import pytest

from calibration_scenes import gaussian
from lumencut import Profile, Vessel, Volume, Window, measure
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
from lumencut.reports.section_pictures import SectionView

SIDE, FINE = 0.8, 4
RADIUS, FLAP, THICKNESS = 11.0, 3.0, 1.0
COUNT, SLICES = 44, 40


def volume(thickness: float = THICKNESS) -> Volume:
    """A vessel in fat along z, with a flap across x, blurred by 1 mm."""
    step = SIDE / FINE
    place = (np.arange(COUNT * FINE) + 0.5) * step - COUNT * SIDE / 2
    y, x = np.meshgrid(place, place, indexing="ij")
    away = np.hypot(x, y)
    level = np.where(away < RADIUS, 350.0, np.where(away < RADIUS + 1.6, 50.0, -95.0))
    level[(away < RADIUS) & (np.abs(x - FLAP) < thickness / 2)] = 50.0
    level = gaussian(level, np.full(2, 1 / np.sqrt(8 * np.log(2)) / step))
    level = level.reshape(COUNT, FINE, COUNT, FINE).mean(axis=(1, 3))
    noise = np.random.default_rng(5).normal(0, 15, (SLICES, COUNT, COUNT))
    affine = np.diag([SIDE, SIDE, SIDE, 1.0])
    affine[:2, 3] = (0.5 - COUNT / 2) * SIDE
    return Volume((level + noise).astype(np.float32), world_from_index=affine)


def line(x: float) -> Vessel:
    return Vessel(np.array([[x, 0.0, z] for z in np.arange(2.0, 29.0)]))


def truth() -> tuple[float, float]:
    """Areas to the left and to the right of the flap (mm²)."""

    def left(x: float) -> float:
        return RADIUS**2 * np.arccos(-x / RADIUS) + x * np.sqrt(RADIUS**2 - x**2)

    return left(FLAP - THICKNESS / 2), left(-FLAP - THICKNESS / 2)


@pytest.fixture(scope="module")
def profile() -> Profile:
    return measure(volume(), line(-3.0), fwhm=1.0)


def test_numbers_of_both_lumens(profile):
    is_seen = np.array(profile.flap) == "seen"
    assert is_seen.mean() > 0.8
    own, other = truth()
    for name, area in (("own_lumen", own), ("other_lumen", other), ("both_lumens", own + other)):
        found = getattr(profile, f"area_{name}")
        unsure = getattr(profile, f"area_{name}_uncertainty")
        assert (np.abs(found - area)[is_seen] < 3 * unsure[is_seen]).all()
        assert (unsure[is_seen] < 0.03 * area).all()
        assert (np.isfinite(found) == is_seen).all()
    for points, sign in ((profile.own_lumen, -1), (profile.other_lumen, 1)):
        assert points.shape == profile.contour.shape
        assert (np.isfinite(points).all((1, 2)) == is_seen).all()
        beyond = sign * (points[is_seen][..., 0] - FLAP)
        # Blur rounds the two corners at which the flap meets the wall.
        assert (beyond > -0.5).all()
        assert (beyond > 0).mean() > 0.97


def test_a_line_in_the_other_lumen_swaps_both(profile):
    swapped = measure(volume(), line(7.0), fwhm=1.0)
    for name, opposite in (("own", "other"), ("other", "own")):
        areas = [getattr(one, f"area_{each}_lumen") for one, each in ((swapped, name), (profile, opposite))]
        assert np.nanmedian(areas[0]) == pytest.approx(np.nanmedian(areas[1]), rel=0.02)


def test_files_and_findings_state_both_lumens(profile, tmp_path):
    for name in ("profile.csv", "profile.json"):
        profile.save(tmp_path / name)
    number = profile.flap.index("seen")
    with (tmp_path / "profile.csv").open(newline="") as file:
        cells = list(csv.DictReader(file))[number]
    assert cells["flap"] == "seen"
    assert float(cells["area_other_lumen_mm2"]) == pytest.approx(profile.area_other_lumen[number])
    sections = json.loads((tmp_path / "profile.json").read_text())["sections"]
    assert sections["flap"] == profile.flap
    assert sections["area_both_lumens_mm2"][number] == pytest.approx(profile.area_both_lumens[number])
    lines = MeasuredVessel.of("0", Vessel(profile.center), profile, Marked()).lines
    (said,) = [words for words in lines if words.startswith("Two lumens from")]
    assert f"other lumen next to it {profile.area_other_lumen[number]:.0f} ±" in said


def test_pictures_show_both_lumens(profile):
    view = SectionView(volume(), Window(100, 700))
    one = MeasuredVessel.of("0", Vessel(profile.center), profile, Marked())
    picture = view.picture(one, profile.flap.index("seen"))[..., :3].astype(int)
    for color in ((90, 230, 120), (178, 140, 255)):
        assert (np.abs(picture - color) < 40).all(-1).sum() > 100


def test_a_vessel_without_flap_has_one_lumen():
    whole = measure(volume(thickness=0.0), line(-3.0), fwhm=1.0)
    assert set(whole.flap) == {"no thin flap next to the lumen"}
    assert np.isnan(whole.own_lumen).all()
    assert np.isnan(whole.area_both_lumens).all()


def test_values_that_are_not_in_hu_have_no_flap():
    scan = volume()
    shifted = Volume(np.asarray(scan.array) + 1000, world_from_index=scan.world_from_index)
    assert set(measure(shifted, line(-3.0), fwhm=1.0).flap) == {"the level of the flap is unknown"}
