"""Vessels of a tree cut and joined, the brightest place on a ray, and profiles that are kept."""

import numpy as np
import pytest

import lumencut
from lumencut import (
    Camera,
    CameraError,
    MeasuringError,
    SettingsError,
    TracingError,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
)
from measure_scenes import FWHM, bent


def straight(first, last, name=None, **known):
    """A vessel along x with a point for each millimetre."""
    x = np.arange(first, last + np.sign(last - first), np.sign(last - first), dtype=float)
    return Vessel(np.stack([x, 0 * x, 0 * x], axis=1), 1 + np.abs(x) / 10, name, **known)


def test_a_cut_vessel_is_both_of_its_parts():
    whole = straight(0, 10, "LAD", confidence=np.linspace(0, 1, 11), bridged=np.arange(11) > 8)
    tree = VesselTree([straight(0, -5), whole, straight(20, 30, "LAD part 1")])
    cut = tree.cut("LAD", 3.5)
    assert [vessel.name for vessel in cut] == [None, "LAD", "LAD part 2", "LAD part 1"]
    assert (cut[0], cut[3]) == (tree[0], tree[2])
    first, second = cut[1], cut[2]
    assert (first.length, second.length) == pytest.approx((3.5, 6.5))
    np.testing.assert_array_equal(first.points[-1], second.points[0])
    np.testing.assert_allclose(first.points[-1], [3.5, 0, 0])
    assert (first.radius[-1], first.confidence[-1]) == pytest.approx((1.35, 0.35))
    np.testing.assert_array_equal(second.points[1:], whole.points[4:])
    np.testing.assert_array_equal(second.bridged[1:], whole.bridged[4:])
    back = cut.joined("LAD", "LAD part 2")
    assert [vessel.name for vessel in back] == [None, "LAD", "LAD part 1"]
    np.testing.assert_array_equal(np.delete(back[1].points, 4, axis=0), whole.points)
    np.testing.assert_allclose(np.delete(back[1].confidence, 4), whole.confidence)


def test_parts_of_a_vessel_without_a_name_have_none():
    assert [vessel.name for vessel in VesselTree([straight(0, 4)]).cut(0, 2.0)] == [None, None]


@pytest.mark.parametrize("at", [0.0, 10.0, -1.0, 11.0, float("nan")])
def test_a_cut_lies_between_the_ends(at):
    with pytest.raises(VesselTreeError, match="between its ends"):
        VesselTree([straight(0, 10)]).cut(0, at)


def test_joined_vessels_run_as_the_first_one():
    tree = VesselTree([straight(13, 20, "tail"), straight(0, 10, "head")])
    joined = tree.joined("head", "tail")
    assert len(joined) == 1
    (vessel,) = joined
    assert vessel.name == "head"
    np.testing.assert_array_equal(vessel.points[[0, -1]], [[0, 0, 0], [20, 0, 0]])
    between = (vessel.points[:, 0] > 10) & (vessel.points[:, 0] < 13)
    np.testing.assert_array_equal(vessel.bridged, between)
    assert between.sum() == 5
    # The result has the direction and the position of the first vessel.
    turned = tree.joined("tail", "head")
    np.testing.assert_array_equal(turned[0].points, vessel.points)
    other = VesselTree([straight(20, 13), straight(0, 10)]).joined(0, 1)
    np.testing.assert_array_equal(other[0].points, vessel.points[::-1])


@pytest.mark.parametrize(
    ("first", "second", "found"),
    [
        (0, 0, "the same one"),
        (0, 1, "30.0 mm apart"),
        (0, 7, "7 in a tree of 3 vessels"),
        ("twin", 0, "2 vessels"),
    ],
)
def test_vessels_that_cannot_be_joined_are_refused(first, second, found):
    tree = VesselTree([straight(0, 10), straight(40, 50, "twin"), straight(60, 70, "twin")])
    with pytest.raises(VesselTreeError, match=found):
        tree.joined(first, second)


def lit(*places):
    """A volume of 1 mm with some bright voxels (i, j, k) of given values."""
    values = np.zeros((20, 20, 20), dtype=np.int16)
    for (i, j, k), value in places:
        values[k, j, i] = value
    return Volume(values, spacing=(1, 1, 1))


VIEW = Camera(center=(9.5, 9.5, 9.5), direction=(0, 1, 0), up=(0, 0, 1), size=(20, 20), pixel_spacing=1.0)


def test_the_brightest_place_of_a_ray_is_found():
    volume = lit(((4, 5, 12), 300), ((4, 15, 12), 500), ((5, 9, 12), 900))
    pixel = (4, 7)
    np.testing.assert_allclose(lumencut.brightest(volume, VIEW, pixel), [4, 15, 12])
    np.testing.assert_allclose(lumencut.brightest(volume, VIEW, pixel, (-9, 0)), [4, 5, 12])
    # Of two equally bright voxels the nearer one is taken.
    twins = lit(((4, 5, 12), 500), ((4, 15, 12), 500))
    np.testing.assert_allclose(lumencut.brightest(twins, VIEW, pixel), [4, 5, 12])


def test_a_ray_beside_the_volume_has_no_brightest_place():
    volume = lit()
    with pytest.raises(TracingError, match="meets no voxel"):
        lumencut.brightest(volume, VIEW, (40, 7))
    with pytest.raises(TracingError, match="meets no voxel"):
        lumencut.brightest(volume, VIEW, (4, 7), (50, 60))
    with pytest.raises(CameraError, match="a Camera"):
        lumencut.brightest(volume, "anterior", (4, 7))
    with pytest.raises(CameraError, match="pixel"):
        lumencut.brightest(volume, VIEW, (4, 7, 1))


@pytest.fixture(scope="module")
def scan():
    volume, vessel = bent()
    return volume, VesselTree([vessel.named("bent")])


def test_measurements_are_those_of_measure(scan):
    volume, tree = scan
    found = lumencut.Measurements(volume, tree, step=1.0).profile("bent")
    expected = lumencut.measure(volume, tree[0], step=1.0, tree=tree)
    np.testing.assert_array_equal(found.area, expected.area)
    assert (found.fwhm, found.fwhm_source) == (expected.fwhm, expected.fwhm_source)


def test_a_vessel_is_measured_once(scan):
    values = np.array(scan[0])
    volume, tree = Volume(values, world_from_index=scan[0].world_from_index), scan[1]
    measurements = lumencut.Measurements(volume, tree, step=2.0, fwhm=FWHM)
    assert (measurements.volume, measurements.tree) == (volume, tree)
    first = measurements.profile(0)
    # Stored profiles are not measured again, so changed voxels have no effect.
    values[:] = 0
    for asked in (0, "bent", tree[0]):
        np.testing.assert_array_equal(measurements.profile(asked).area, first.area)
    with pytest.raises(MeasuringError):
        measurements.profile(tree.cut("bent", 20.0)[0])


def test_odd_measurements_are_refused(scan):
    volume, tree = scan
    with pytest.raises(VesselTreeError, match="VesselTree"):
        lumencut.Measurements(volume, tree[0])
    with pytest.raises(SettingsError, match="fwhm"):
        lumencut.Measurements(volume, tree, fwhm=-1.0).profile(0)
    with pytest.raises(VesselTreeError, match="no vessel of this name"):
        lumencut.Measurements(volume, tree).profile("RCA")
