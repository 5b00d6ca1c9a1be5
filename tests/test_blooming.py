"""Next to calcium two diameters are stated: without everything brighter than lumen, and with it."""

import numpy as np
import pytest

from lumencut import Flag, Volume, measure
from measure_scenes import FWHM, Grid, round_tube

RADIUS, CALCIUM = 2.5, 1100.0


def plaque(inner, outer, half):
    """Return a function that paints calcium between two distances (mm), within an angle of the x axis."""

    def paint(values, x, y):
        distance, angle = np.hypot(x, y), np.abs(np.arctan2(y, x))
        return np.where((distance >= inner) & (distance <= outer) & (angle <= half), CALCIUM, values)

    return paint


def truth(inner, outer, half):
    """Return the diameter of a circle with the area that calcium leaves (mm)."""
    inside = max(min(outer, RADIUS) ** 2 - min(inner, RADIUS) ** 2, 0.0) * half
    return 2 * np.sqrt(RADIUS**2 - inside / np.pi)


@pytest.mark.parametrize(
    "kind",
    [
        (2.5, 3.5, 0.6),  # In the wall.
        (2.0, 3.0, 0.6),  # Half of it in the lumen.
        (1.5, 2.5, 0.5),  # All of it in the lumen.
        (2.4, 2.8, 0.8),  # Thinner than a voxel.
        (2.2, 3.4, 1.4),  # Nearly half around.
    ],
)
def test_the_true_diameter_lies_between_both(kind):
    tube = round_tube(2 * RADIUS, paint=plaque(*kind))
    profile = measure(
        tube.volume(Grid.even((0.5, 0.5, 0.5), (20.0, 20.0, 18.0))), tube.vessel(12.0), 1.0, FWHM, wall="off"
    )
    low, high = profile.diameter_calcium_excluded, profile.diameter_calcium_included
    assert (profile.flags & (Flag.CALCIUM | Flag.METAL) > 0).all()
    slack = 2 * profile.uncertainty
    assert (low - slack <= truth(*kind)).all()
    assert (truth(*kind) <= high + slack).all()
    assert (low <= profile.diameter_equivalent + 1e-9).all()
    assert (profile.diameter_equivalent <= high + 1e-9).all()
    # The bounds differ by no more than the width of the blur, so they are useful.
    assert (high - low < 2.0).all()


def test_without_calcium_there_are_no_bounds():
    tube = round_tube(2 * RADIUS)
    profile = measure(
        tube.volume(Grid.even((0.5, 0.5, 0.5), (20.0, 20.0, 18.0))), tube.vessel(12.0), 1.0, FWHM
    )
    assert np.isnan(profile.diameter_calcium_excluded).all()
    assert np.isnan(profile.diameter_calcium_included).all()


def test_the_rings_of_a_stent_are_one_stretch_of_metal():
    tube = round_tube(2 * RADIUS)
    volume = tube.volume(Grid.even((0.5, 0.5, 0.5), (20.0, 20.0, 40.0)))
    k, j, i = np.indices(volume.shape)
    z, across = (k - (k.max() / 2)) * 0.5, np.hypot(i - i.max() / 2, j - j.max() / 2) * 0.5
    ring = (np.abs(across - RADIUS) < 0.5) & (np.abs((z + 2) % 4 - 2) < 0.3) & (np.abs(z) < 9)
    stented = Volume(np.where(ring, 3000.0, volume.array), world_from_index=volume.world_from_index)
    profile = measure(stented, tube.vessel(30.0), 0.5, FWHM, wall="off")
    metal = (profile.flags & Flag.METAL) > 0
    (first, *_, last) = np.flatnonzero(metal)
    assert metal[first : last + 1].all()
    assert not (profile.flags[first : last + 1] & Flag.CALCIUM).any()
    assert 14 < profile.arc_length[last] - profile.arc_length[first] < 20
