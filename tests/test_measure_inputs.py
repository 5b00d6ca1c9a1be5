"""What cannot be measured is rejected with a reason and the value."""

import numpy as np
import pytest

import lumencut
from lumencut import MeasuringError, SettingsError, Vessel, VesselTree, VesselTreeError, Volume, VolumeError
from measure_scenes import FWHM, Grid, round_tube

TUBE = round_tube(4.0)
GRID = Grid.even((0.5, 0.5, 0.5), (14, 14, 24))


@pytest.fixture(scope="module")
def volume() -> Volume:
    return TUBE.volume(GRID)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fwhm": 0}, "fwhm: found 0 mm; expected a width above 0 mm"),
        ({"fwhm": -1}, "fwhm: found -1; expected between 0 and 20 mm"),
        ({"fwhm": np.nan}, "fwhm: found NaN; expected between 0 and 20 mm"),
        ({"fwhm": 21}, "fwhm: found 21; expected between 0 and 20 mm"),
        ({"fwhm": "wide"}, "fwhm: found 'wide'; expected numbers of shape one number"),
        ({"step": 0}, "step: found 0 mm; expected a number above 0 mm"),
        ({"step": np.inf}, "step: found inf mm; expected a number above 0 mm"),
        ({"step": 1e-3}, "step: found 0.001 mm, which makes 2"),
        ({"step": 1e-3}, "expected a step that makes at most 20000 sections; give a step of 0.01 mm or more"),
        ({"step": None}, "step: found None"),
    ],
)
def test_settings_that_are_none(volume, options, message):
    with pytest.raises(SettingsError, match=message):
        lumencut.measure(volume, TUBE.vessel(20), **options)


def test_what_is_no_vessel_tree_or_volume(volume):
    with pytest.raises(VesselTreeError, match="vessel to measure: found ndarray; expected a Vessel"):
        lumencut.measure(volume, TUBE.vessel(20).points)
    with pytest.raises(
        VesselTreeError, match="tree of the vessel: found Vessel; expected a VesselTree or None"
    ):
        lumencut.measure(volume, TUBE.vessel(20), tree=TUBE.vessel(20))
    with pytest.raises(VesselTreeError, match="a vessel without length"):
        lumencut.measure(volume, Vessel([[1, 1, 1], [1, 1, 1]]))
    with pytest.raises(VolumeError):
        lumencut.measure(np.zeros((3, 3)), TUBE.vessel(20))


def test_a_vessel_outside_the_volume(volume):
    with pytest.raises(MeasuringError, match="points of the vessel: found none within the volume"):
        lumencut.measure(volume, Vessel(TUBE.vessel(20).points + np.array([50, 0, 0])), fwhm=FWHM)


@pytest.mark.parametrize("noise", [0.0, 26.0])
def test_a_vessel_without_contrast(noise):
    even = round_tube(4.0, levels=(50.0, 50.0)).volume(GRID, noise=noise)
    with pytest.raises(MeasuringError, match=r"lumen of the vessel: found .* expected a lumen"):
        lumencut.measure(even, TUBE.vessel(20), fwhm=FWHM)


def test_a_line_in_the_tissue_far_from_the_lumen():
    wide = TUBE.volume(Grid.even((0.5, 0.5, 0.5), (40, 14, 24)))
    with pytest.raises(MeasuringError, match="lumen of the vessel: found"):
        lumencut.measure(wide, Vessel(TUBE.vessel(20).points + np.array([14, 0, 0]), 2.0), fwhm=FWHM)


def test_a_vessel_that_leaves_the_volume_is_measured_within(volume):
    profile = lumencut.measure(volume, TUBE.vessel(40), fwhm=FWHM)
    outside = np.abs(profile.arc_length - 20) > 12.3
    assert np.isnan(profile.area[outside]).all()
    assert (profile.flags[outside] & lumencut.Flag.OUTSIDE > 0).all()
    inside = np.abs(profile.arc_length - 20) < 11
    assert profile.diameter_equivalent[inside] == pytest.approx(np.full(inside.sum(), 4.0), rel=0.06)
    with pytest.raises(MeasuringError, match=r"found nothing measured at 1\.0 mm"):
        profile.diameter_at(1)
    assert np.isnan(profile.contour[0]).all()


@pytest.mark.parametrize("kind", [np.int16, np.uint8, np.float64])
def test_all_types_of_voxels_give_the_same(volume, kind):
    values = volume.array - 150 if kind is np.int16 else volume.array / 2
    typed = Volume(
        np.clip(np.round(values), 0 if kind is np.uint8 else -1e4, 255 if kind is np.uint8 else 1e4).astype(
            kind
        ),
        world_from_index=GRID.affine,
    )
    # Only one volume has values in HU, so walls are not distinguished in either.
    first = lumencut.measure(volume, TUBE.vessel(20), fwhm=FWHM, wall="off")
    second = lumencut.measure(typed, TUBE.vessel(20), fwhm=FWHM, wall="off")
    assert second.diameter_equivalent == pytest.approx(first.diameter_equivalent, abs=0.02)


def test_voxels_that_are_no_numbers_are_left_out(volume):
    values = volume.array.copy()
    values[20:22, 10:12] = np.nan
    profile = lumencut.measure(Volume(values, world_from_index=GRID.affine), TUBE.vessel(20), fwhm=FWHM)
    assert np.nanmedian(profile.diameter_equivalent) == pytest.approx(4.0, rel=0.02)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"at": 21}, MeasuringError, "place on the vessel: found 21 mm; expected an arc length from 0 to 20"),
        ({"at": np.nan}, MeasuringError, "place on the vessel: found NaN mm"),
        ({"at": 3, "size": 0}, SettingsError, "size of the cross-section: found 0"),
        ({"at": 3, "pixel_spacing": -1}, SettingsError, "pixel_spacing of the cross-section: found -1"),
        ({"at": 3, "size": 900, "pixel_spacing": 0.01}, SettingsError, "90000 × 90000 pixels"),
    ],
)
def test_sections_that_are_none(volume, options, error, message):
    with pytest.raises(error, match=message):
        lumencut.cross_section(volume, TUBE.vessel(20), **options)


def test_a_tree_that_cannot_be_measured_keeps_its_radii(volume):
    tree = VesselTree([Vessel([[90, 0, 0], [99, 0, 0]])])
    measured = tree.measured(volume)
    assert measured[0].radius is None
    assert len(measured.notes) == 1
    with pytest.raises(SettingsError, match="fwhm: found 0 mm"):
        tree.measured(volume, fwhm=0)
