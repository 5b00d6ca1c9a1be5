"""Free-form flattening from Python and the command line: shapes, values, distortion, and what is rejected."""

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from lumencut import SettingsError, Vessel, VesselTree, VesselTreeError, Volume
from lumencut.cli import main
from lumencut.files.volume_writers import write_volume


def arc(radius, height, turn=1.2, points=201):
    """A part of a circle around the z axis (mm)."""
    angle = np.linspace(-turn / 2, turn / 2, points)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(points, height)], axis=1)


@pytest.fixture(scope="module")
def volume():
    """A volume whose values are 1000 + 10 x + y + 100 z, exact under trilinear interpolation."""
    k, j, i = np.mgrid[:40, :60, :60].astype(np.float32)
    return Volume(1000 + 10 * i + (j - 30) + 100 * k, origin=(0, -30, 0))


def test_a_cylinder_is_unrolled_without_distortion(volume):
    flat = lumencut.flatten(volume, [arc(30, 2), arc(30, 20)], pixel_spacing=0.5, device="cpu")
    height, width = flat.value.shape
    assert (width, height) == (37, 71)
    assert flat.size == (width, height)
    x, y, z = np.moveaxis(flat.position, -1, 0)
    np.testing.assert_allclose(np.hypot(x, y), 30, atol=2e-3)
    np.testing.assert_allclose(flat.value, 1000 + 10 * x + y + 100 * z, atol=0.01)
    # Columns run from the first curve to the last one, rows along the curves.
    np.testing.assert_allclose(np.diff(z, axis=1), 0.5, atol=1e-9)
    np.testing.assert_allclose(np.diff(np.arctan2(y, x), axis=0) * 30, 0.5, atol=1e-4)
    assert np.nanmax(np.abs(flat.distortion)) < 1e-3
    assert np.nanmax(flat.shear) < 1e-3
    assert not flat.folded.any()
    np.testing.assert_allclose(flat.arc_length, 0.5 * np.arange(height))


def test_the_area_of_a_sphere_is_distorted_by_the_cosine_of_the_latitude(volume):
    def meridian(longitude):
        latitude = np.linspace(-1.0, 1.0, 401)
        around = np.cos(latitude)
        parts = around * np.cos(longitude), around * np.sin(longitude), np.sin(latitude)
        return 20 * np.stack(parts, axis=1)

    meridians = [meridian(longitude) for longitude in np.linspace(-0.6, 0.6, 13)]
    flat = lumencut.flatten(volume, meridians, keep="rows", pixel_spacing=0.5, device="cpu")
    latitude = np.arcsin(np.clip(flat.position[..., 2] / 20, -1, 1))
    inner = np.isfinite(flat.distortion)
    assert inner.mean() > 0.8
    np.testing.assert_allclose(flat.distortion[inner], np.cos(latitude[inner]) - 1, atol=0.01)


@pytest.mark.parametrize("keep", ["lines", "rows"])
def test_pixels_and_world_points_belong_together(volume, keep):
    curves = VesselTree([Vessel(arc(25, 3)), Vessel(arc(30, 15)), Vessel(arc(28, 30))])
    flat = lumencut.flatten(volume, curves, keep=keep, pixel_spacing=0.5, device="cpu")
    shown = np.isfinite(flat.position).all(axis=-1)
    j, i = np.nonzero(shown)
    some = np.random.default_rng(5).choice(len(i), 30, replace=False)
    back = flat.pixel_from_world(flat.position[j[some], i[some]])
    np.testing.assert_allclose(back, np.stack([i[some], j[some]], axis=1), atol=1e-4)


def test_another_order_of_points_along_a_curve_changes_nothing(volume):
    same, turned = (
        lumencut.flatten(volume, [arc(30, 2), other], pixel_spacing=1.0, device="cpu").position
        for other in (arc(30, 20), arc(30, 20)[::-1])
    )
    np.testing.assert_allclose(same, turned, atol=1e-9)


def test_what_is_no_surface_is_rejected(volume):
    line = np.array([[10.0, 0, 5], [40, 0, 5]])
    with pytest.raises(VesselTreeError, match="found 1 curve; expected two or more curves"):
        lumencut.flatten(volume, [line], device="cpu")
    with pytest.raises(VesselTreeError, match="curves 0 and 1 that cross"):
        lumencut.flatten(volume, [line, [[20.0, -9, 5], [25, 9, 5]]], device="cpu")
    with pytest.raises(VesselTreeError, match="curve of the flattening"):
        lumencut.flatten(volume, [line, [[1.0, 2]]], device="cpu")
    with pytest.raises(VesselTreeError, match="found int"):
        lumencut.flatten(volume, 3, device="cpu")
    with pytest.raises(SettingsError, match="'lines', 'rows'"):
        lumencut.flatten(volume, [line, line + 5], keep="area", device="cpu")


def test_the_command_writes_the_picture_and_states_the_distortion(volume, tmp_path):
    write_volume(volume, tmp_path / "ct.nrrd")
    curves = VesselTree([Vessel(arc(30, 2)), Vessel(arc(30, 20))])
    lumencut.write_centerlines(curves, tmp_path / "rims.vtp")
    words = ["flatten", tmp_path / "ct.nrrd", tmp_path / "rims.vtp", "-o", tmp_path / "flat.png"]
    done = CliRunner().invoke(main, [*map(str, words), "--device", "cpu"])
    assert done.exit_code == 0, done.output
    assert "flattening of 2 curves" in done.output
    assert "areas within 0.0 % and shear within 0.00" in done.output
    assert (tmp_path / "flat.png").exists()
