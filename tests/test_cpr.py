"""Curved Planar Reformation: the positions of its pixels, and their values."""

from __future__ import annotations

import numpy as np
import pytest

from conftest import each_value
from cpr_scenes import GRIDS, index_volumes, noise, trilinear, vessel, wave
from lumencut import Settings, Slab, Volume, cpr, straightened_volume

MODES = ("projected", "stretched", "straightened")

each_mode = pytest.mark.parametrize("mode", MODES)


def blank(reach=60.0):
    """A volume around the origin, whose values do not matter."""
    return Volume(np.zeros((3, 3, 3), np.int16), spacing=[reach] * 3, origin=[-reach] * 3)


def along(points, at):
    """Return points of a polyline at arc lengths."""
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    return np.stack([np.interp(at, length, points[:, axis]) for axis in range(3)], axis=1)


@each_mode
@pytest.mark.parametrize("grid", GRIDS)
def test_a_straight_vessel_is_the_plain_slice(mode, grid):
    volume = noise(grid)
    made = cpr(volume, vessel([[3, -2, 20], [3, -2, 5], [3, -2, -21]]), mode, width=30, pixel_spacing=0.5)
    assert made.size == (61, 83)
    x, z = np.meshgrid(3 + 0.5 * (np.arange(61) - 30), 20 - 0.5 * np.arange(83))
    places = np.stack([x, np.full_like(x, -2), z], axis=-1)
    np.testing.assert_allclose(made.position, places, atol=1e-12)
    expected = trilinear(volume, places)
    inside = ~np.isnan(expected)
    assert inside.mean() > 0.5
    np.testing.assert_allclose(made.value[inside], expected[inside], atol=0.02)
    assert not made.folded.any()
    np.testing.assert_allclose(made.arc_length, 0.5 * np.arange(83), atol=1e-12)


@each_mode
@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("angle", [0.0, 0.9])
def test_values_of_index_volumes_are_the_positions(mode, grid, angle):
    volumes = index_volumes(grid)
    inverse = np.linalg.inv(volumes[0].world_from_index)
    for axis, volume in enumerate(volumes):
        made = cpr(volume, wave(), mode, width=24, pixel_spacing=0.7, angle=angle)
        index = made.position @ inverse[axis, :3] + inverse[axis, 3]
        inside = ~np.isnan(made.value)
        assert inside.mean() > 0.9
        assert np.abs(made.value - index)[inside].max() < 1e-3


def test_a_projected_vessel_is_not_measurable():
    assert [cpr(blank(), wave(), mode, pixel_spacing=1).measurable for mode in MODES] == [False, True, True]


def test_the_first_section_is_seen_from_the_front():
    made = cpr(blank(), vessel([[0, 0, 10], [1, -3, -10]]), "straightened", width=10, pixel_spacing=1)
    right = made.position[0, -1] - made.position[0, 0]
    assert right[0] > 9.9
    assert right[1] == pytest.approx(0, abs=1e-9) or abs(right[1]) < 0.2
    # A vessel that starts along the view direction is seen from below, like axial slices.
    made = cpr(blank(), vessel([[0, -10, 0], [0, 10, 0]]), "straightened", width=10, pixel_spacing=1)
    np.testing.assert_allclose(made.position[0, -1] - made.position[0, 0], [10, 0, 0], atol=1e-12)
    line = vessel([[0, 0, 10], [0, 0, -10]])
    made = cpr(blank(), line, "straightened", width=10, pixel_spacing=1, normal=[5, 0, 1])
    np.testing.assert_allclose(made.position[0, -1] - made.position[0, 0], [0, 10, 0], atol=1e-12)


@each_mode
def test_the_viewer_of_a_turned_cpr_moves_to_the_right(mode):
    line = vessel([[0, 0, 10], [0, 0, -10]])
    made = cpr(blank(), line, mode, width=10, pixel_spacing=1, degrees=90)
    np.testing.assert_allclose(made.position[0, -1] - made.position[0, 0], [0, 10, 0], atol=1e-12)
    turned = cpr(blank(), line, mode, width=10, pixel_spacing=1, angle=0.3).rotated(degrees=60)
    again = cpr(blank(), line, mode, width=10, pixel_spacing=1, angle=0.3 + np.pi / 3)
    np.testing.assert_array_equal(turned.position, again.position)
    assert turned.angle == pytest.approx(0.3 + np.pi / 3)


@each_value
@each_mode
@pytest.mark.parametrize("kept", ["max", "mean", "min"])
def test_a_slab_is_that_of_many_samples(mode, kept):
    volume = noise("sheared")
    made = cpr(volume, wave(), mode, width=14, pixel_spacing=1, slab=(3.0, kept))
    thin = cpr(volume, wave(), mode, width=14, pixel_spacing=1)
    direction = through_the_surface(volume, thin)[:, None]
    samples = np.stack(
        [trilinear(volume, thin.position + direction * s) for s in np.linspace(-1.5, 1.5, 1201)]
    )
    reduced = {"max": samples.max(axis=0), "mean": samples.mean(axis=0), "min": samples.min(axis=0)}[kept]
    sure = ~np.isnan(reduced)
    assert sure.mean() > 0.6
    # The extremes lie between samples 2.5 µm apart; the steepest slope is about 2000 per mm.
    assert np.abs(made.value - reduced)[sure].max() < 3
    assert np.abs(thin.value - reduced)[sure].max() > 500


def through_the_surface(volume, made):
    """Return the unit vector along which each row's slab is thick, computed independently, (H, 3)."""
    count = made.size[1]
    if made.mode == "projected":
        return np.tile([0.0, 1.0, 0.0], (count, 1))
    if made.mode == "straightened":
        space = straightened_volume(volume, wave(), 14, 1)
        k = np.arange(count)
        one, other = (space.world_from_index(np.stack([0 * k, 0 * k + j, k], axis=1)) for j in (0, 1))
        return other - one
    rows = np.arange(count)
    middle, below = (made.world_from_pixel(np.stack([0 * rows, rows + y], axis=1)) for y in (0, 1e-5))
    ahead = np.cross(made.position[:, 1] - made.position[:, 0], below - middle)
    return ahead / np.linalg.norm(ahead, axis=1, keepdims=True)


def test_outside_the_volume_pixels_are_transparent():
    volume = noise("straight", (20, 20, 40))
    made = cpr(volume, vessel([[0, 0, 15], [0, 0, -15]]), "straightened", width=30)
    outside = np.isnan(made.value)
    assert 0.2 < outside.mean() < 0.8
    assert (made.image[outside] == 0).all()
    assert (made.image[~outside][:, 3] == 255).all()


def test_a_slab_of_the_settings_counts_and_one_by_name_comes_before_it():
    volume, line = noise(), wave()
    named = cpr(volume, line, slab=Slab(4.0, "max"))
    np.testing.assert_array_equal(
        named.value, cpr(volume, line, settings=Settings(slab=Slab(4.0, "max"))).value
    )
    other = cpr(volume, line, slab=4.0, settings=Settings(slab=Slab(2.0, "min")))
    np.testing.assert_array_equal(named.value, other.value)
