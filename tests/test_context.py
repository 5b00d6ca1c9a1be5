"""The context along rays through volumes for which a formula gives the answer."""

from __future__ import annotations

import numpy as np
import pytest

import reference_context
from context_scenes import GRIDS, POINTS, VIEWS, WINDOW, assert_same, drawn, noise, placed, viewed
from lumencut import Camera, Volume

#: Error from rounding to a byte, and from rounding of 32-bit floats.
BYTE = 0.5 + 0.02
#: Views along the axes of a plain grid: the axis of the array [k, j, i], and from which end.
ALONG = {"along i": (2, 1), "along j": (1, 1), "against k": (0, -1)}


def along(profile, view, others=(5, 4)):
    """A plain volume with the values of `profile` along a view, and a camera that sees its voxel centres."""
    axis, sign = ALONG[view]
    values = np.asarray(profile)[::sign]
    shape = np.insert(others, axis, len(values))
    line = values.reshape([len(values) if a == axis else 1 for a in range(3)])
    volume = Volume(np.broadcast_to(line, shape).copy())
    direction, up = VIEWS[view]
    center = np.insert((np.array(others[::-1]) - 1) / 2, 2 - axis, 0)
    return volume, Camera(center, direction, up, others[::-1], 1.0)


@pytest.mark.parametrize("view", ALONG)
def test_projections_of_a_ramp(view):
    profile = np.arange(20, 220, 10.0)
    volume, camera = along(profile, view)
    grey = lambda value: 255 * (value - WINDOW[0] + WINDOW[1] / 2) / WINDOW[1]  # noqa: E731
    for mode, value in (("minip", 20), ("average", 115), ("mip", 210)):
        points = [(10.0, (0, 0, 0), 0.0), (230.0, (255, 255, 255), 0.0)]
        image = drawn(volume, camera, mode, points=points)
        assert (image[..., 3] == 255).all()
        assert np.abs(image[..., :3] - grey(value)).max() <= BYTE, mode


@pytest.mark.parametrize("gamma", [-1.0, -0.7, 0.0, 0.4, 1.0])
@pytest.mark.parametrize("view", ALONG)
def test_a_brighter_slab_shines_through_by_the_formula(view, gamma):
    # Samples lie on voxel centres: 3 mm of one value, a gap, then 2 mm of another value.
    dim, bright = 65.0, 175.0
    profile = [0.0, dim, dim, dim, 0.0, 0.0, bright, bright, 0.0]
    points = [
        (dim - 5, (0, 0, 0), 0.0),
        (dim, (250, 0, 0), 0.6),
        (bright, (0, 250, 0), 0.3),
    ]
    volume, camera = along(profile, view)
    image = drawn(volume, camera, "mida", points=points, window=(100.0, 200.0), gamma=gamma)
    rise = (bright - dim) / 200
    front = (1 - rise * (1 + min(gamma, 0))) * (1 - 0.4**3)
    red, green = front, (1 - front) * (1 - 0.7**2)
    mix = max(gamma, 0)
    red, green = red * (1 - mix), green * (1 - mix) + mix
    alpha = (front + (1 - front) * (1 - 0.7**2)) * (1 - mix) + mix
    expected = [250 * red / alpha, 250 * green / alpha, 0, 255 * alpha]
    assert np.abs(image - expected).max() <= BYTE
    if gamma == -1:
        np.testing.assert_array_equal(image, drawn(volume, camera, "dvr", points=points))


@pytest.mark.parametrize("view", ["along j", "oblique"])
@pytest.mark.parametrize("points", [POINTS, [(100.0, (9, 90, 200), 0.4)]], ids=["many", "one"])
def test_the_ends_of_gamma_are_dvr_and_mip_bit_for_bit(view, points):
    volume = placed(noise(2), GRIDS["sheared"])
    camera = viewed(volume, view)
    dvr, mip = (
        reference_context.gather(
            reference_context.follow(volume, camera, mode, step=0.437), mode, points, WINDOW
        )
        for mode in ("dvr", "mip")
    )
    for gamma, mode, plain in ((-1.0, "dvr", dvr), (1.0, "mip", mip)):
        both = [
            drawn(volume, camera, name, points=points, step=0.437, **changes)
            for name, changes in (("mida", {"gamma": gamma}), (mode, {}))
        ]
        np.testing.assert_array_equal(*both)
        assert_same(both[0], plain)
