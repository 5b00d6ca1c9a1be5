"""The contour of a section lies in the plane of the picture."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

import lumencut
from lumencut import MeasuringError, Vessel, _lumencut
from lumencut.reports.section_pictures import SectionView
from lumencut.scene.window import Window
from measure_scenes import FWHM, LUMEN, TISSUE, bent

PLACES = (4.13, 12.6, 18.87, 25.4)


@pytest.fixture(scope="module")
def scene():
    volume, vessel = bent()
    return volume, vessel, lumencut.measure(volume, vessel, fwhm=FWHM)


def off_plane(section, points):
    """Return how far points are from the plane of a section (mm)."""
    return (points - section.position[0, 0]) @ section.normal


@pytest.mark.parametrize("at", PLACES)
def test_a_contour_lies_in_the_measured_plane(scene, at):
    volume, vessel, profile = scene
    number = int(np.abs(profile.arc_length - at).argmin())
    section = lumencut.cross_section(volume, vessel, at, size=12.0, pixel_spacing=0.1, profile=profile)
    assert section.arc_length == profile.arc_length[number]
    assert np.abs(off_plane(section, profile.contour[number])).max() < 1e-9
    pixels = section.pixel_from_world(profile.contour[number])
    # Inside the contour the image shows lumen, outside tissue; the vessel is in the middle of the image.
    rows, columns = np.mgrid[:120, :120]
    away = np.hypot(columns - pixels[:, 0].mean(), rows - pixels[:, 1].mean()) * section.pixel_spacing
    assert section.value[away < 2.0].mean() == pytest.approx(LUMEN, rel=0.05)
    assert section.value[(away > 4.5) & (away < 5.5)].mean() == pytest.approx(TISSUE, abs=15)


def test_the_axes_span_the_sections(scene):
    _, _, profile = scene
    assert profile.axes.shape == (len(profile), 2, 3)
    assert np.einsum("nij,nkj->nik", profile.axes, profile.axes) == pytest.approx(
        np.tile(np.eye(2), (len(profile), 1, 1)), abs=1e-12
    )
    assert np.abs(np.einsum("nij,nj->ni", profile.axes, profile.normal)).max() < 1e-12
    away = np.einsum("nrj,nj->nr", profile.contour - profile.center[:, None], profile.normal)
    assert np.abs(away).max() < 1e-9
    with pytest.raises(ValueError, match="read-only"):
        profile.axes[0] = 0
    sections = json.loads(profile.to_json())["sections"]
    assert sections["right_y_lps"] == profile.axes[:, 0, 1].tolist()
    assert sections["down_z_lps"] == profile.axes[:, 1, 2].tolist()


def test_a_vessel_with_radii_is_cut_as_it_is_measured(scene):
    volume, vessel, profile = scene
    at = float(profile.arc_length[25])
    radius = float(np.median(profile.diameter_equivalent)) / 2
    known = lumencut.cross_section(volume, Vessel(vessel.points, radius), at)
    cut = lumencut.cross_section(volume, vessel, at, profile=profile)
    # The directions of sections depend on the measured radii, up to small changes by the fit.
    assert np.degrees(np.arccos(known.normal @ cut.normal)) < 0.5
    # The centerline jitters; without a radius it is smoothed less.
    bare = lumencut.cross_section(volume, vessel, at)
    assert np.degrees(np.arccos(bare.normal @ known.normal)) > 1


def test_pictures_of_sections_show_the_measured_plane(scene):
    volume, vessel, profile = scene
    number, side = 25, 121
    view = SectionView(volume, Window(200.0, 400.0), side)
    picture = view.picture(SimpleNamespace(profile=profile), number, has_contour=False)
    spacing = _lumencut.section_spacing(profile._core, side)
    section = lumencut.cross_section(
        volume, vessel, profile.arc_length[number], side * spacing, spacing, profile=profile
    )
    # The middle of the picture is the lumen's, that of the section the vessel's.
    shift = section.pixel_from_world(profile.center[[number]])[0] - (side - 1) / 2
    assert np.abs(shift).max() < 5
    grey = np.clip((section.value - 200) / 400 + 0.5, 0, 1) * 255
    row, column = (np.arange(30, 91)[:, None] + shift[1], np.arange(30, 91)[None, :] + shift[0])
    expected = grey[row.round().astype(int), column.round().astype(int)]
    assert np.abs(picture[30:91, 30:91, 0] - expected).mean() < 8


def test_the_profile_of_another_vessel_is_refused(scene):
    volume, vessel, profile = scene
    shorter = Vessel(vessel.points[:-3])
    with pytest.raises(MeasuringError, match="profile of the cross-section: found that of another vessel"):
        lumencut.cross_section(volume, shorter, 5.0, profile=profile)
    with pytest.raises(MeasuringError, match="profile of the cross-section: found str; expected a Profile"):
        lumencut.cross_section(volume, vessel, 5.0, profile="measured")
    with pytest.raises(MeasuringError, match="place on the vessel: found 99 mm"):
        lumencut.cross_section(volume, vessel, 99.0, profile=profile)
