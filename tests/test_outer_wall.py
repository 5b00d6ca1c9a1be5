"""The outer wall around thrombus: numbers, files, report and pictures; never the lumen."""

import json

import numpy as np
import pytest

import lumencut
from lumencut import MeasuringError, Vessel, Volume, measure
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel

SIDE = 0.8
LUMEN, SAC = 14.0, 24.0


def volume(sac: float) -> Volume:
    """A lumen in a wider disc of thrombus in fat, both along z, with partial volume and a narrow blur."""
    k, j, i = np.mgrid[0:24, 0:48, 0:48]
    away = np.hypot(i - 23.5, j - 23.5) * SIDE
    within = [np.clip((diameter / 2 - away) / 1.2 + 0.5, 0, 1) for diameter in (LUMEN, sac)]
    value = -95 + 135 * within[1] + 280 * within[0] + np.random.default_rng(3).normal(0, 12, k.shape)
    return Volume(value.astype(np.float32), world_from_index=np.diag([SIDE, SIDE, SIDE, 1.0]))


@pytest.fixture(scope="module")
def profile():
    line = np.array([[23.5 * SIDE, 23.5 * SIDE, z] for z in np.arange(1.0, 18.0)])
    return measure(volume(SAC), Vessel(line), fwhm=0.9)


def test_numbers_of_the_outer_wall(profile):
    is_seen = np.array(profile.outer_wall) == "seen"
    assert is_seen.mean() > 0.8
    off = profile.diameter_outer[is_seen] - SAC
    assert (np.abs(off) < 3 * profile.diameter_outer_uncertainty[is_seen]).all()
    assert np.median(profile.diameter_equivalent) == pytest.approx(LUMEN, abs=0.3)
    assert profile.outer_contour.shape == profile.contour.shape
    assert (np.isfinite(profile.outer_contour).all((1, 2)) == is_seen).all()
    radii = np.linalg.norm(profile.outer_contour[is_seen] - profile.center[is_seen, None], axis=-1)
    assert np.median(radii) == pytest.approx(SAC / 2, abs=0.2)
    found, uncertainty = profile.outer_volume(3, 13)
    assert found == pytest.approx(10 * np.pi / 4 * SAC**2, abs=3 * uncertainty)
    with pytest.raises(MeasuringError, match="an arc length from"):
        profile.outer_volume(3, 99)


def test_files_and_findings_state_the_outer_wall(profile, tmp_path):
    for name in ("profile.csv", "profile.json"):
        profile.save(tmp_path / name)
    header, first = (tmp_path / "profile.csv").read_text().splitlines()[:2]
    assert first.split(",")[header.split(",").index("outer_wall")] == profile.outer_wall[0]
    written = json.loads((tmp_path / "profile.json").read_text())
    assert written["sections"]["outer_wall"] == profile.outer_wall
    stretch = written["outer_stretch"]
    volume_, uncertainty = profile.outer_volume(stretch["from_mm"], stretch["to_mm"])
    assert [stretch["volume_mm3"], stretch["volume_uncertainty_mm3"]] == [volume_, uncertainty]
    assert stretch["diameter_outer_mm"] == np.nanmax(profile.diameter_outer)
    vessel = Vessel(profile.center)
    lines = MeasuredVessel.of("0", vessel, profile, Marked()).lines
    widest = f"up to {stretch['diameter_outer_mm']:.1f} ±"
    assert lines[0].startswith(f"Outer wall, around thrombus or plaque: {widest}")
    assert f"{volume_ / 1000:.1f} ± " in lines[0]


def test_pictures_show_the_outer_wall_dashed(profile):
    from lumencut.reports.section_pictures import SectionView

    view = SectionView(volume(SAC), lumencut.Window(100, 700))
    one = MeasuredVessel.of("0", Vessel(profile.center), profile, Marked())
    number = profile.outer_wall.index("seen")
    picture = view.picture(one, number)
    pink = (np.abs(picture[..., :3].astype(int) - (255, 90, 208)) < 40).all(-1)
    assert 100 < pink.sum() < 3000
    far = np.hypot(*(np.argwhere(pink) - view.side / 2).T)
    # A fifth more than the outer diameter fits into a picture.
    assert np.median(far) == pytest.approx(view.side / 2 / 1.2, rel=0.25)


def test_a_wall_without_thrombus_has_no_outer_wall():
    line = np.array([[23.5 * SIDE, 23.5 * SIDE, z] for z in np.arange(1.0, 18.0)])
    thin = measure(volume(LUMEN + 2), Vessel(line), fwhm=0.9)
    assert set(thin.outer_wall) <= {"no thick layer around the lumen", "the lumen does not count"}
    assert np.isnan(thin.outer_contour).all()
    assert json.loads(thin.to_json())["outer_stretch"] is None
    with pytest.raises(MeasuringError, match="none from"):
        thin.outer_volume(3, 13)
