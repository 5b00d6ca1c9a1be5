"""Masks with a volume: grey values move the lines to the true middle and give the true radius."""

import numpy as np
import pytest

from lumencut import Vessel, VesselTree, Volume, trace_mask
from mask_scenes import lumen_mask

START, END = np.array([6.3, 14.2, 13.7]), np.array([53.6, 17.4, 16.1])
ALONG = (END - START) / np.linalg.norm(END - START)
RADIUS = 3.3
ASIDE = np.array([0, 9, 0])


def blurred_tube(start, end, radius, lumen=400.0, tissue=60.0, shape=(30, 32, 60)):
    """A tube whose wall is blurred over about a voxel, with seeded noise of 15."""
    k, j, i = np.mgrid[: shape[0], : shape[1], : shape[2]]
    places = np.stack([i, j, k], axis=-1).astype(float)
    share = np.clip((places - start) @ (end - start) / ((end - start) ** 2).sum(), 0, 1)
    away = np.linalg.norm(places - start - share[..., None] * (end - start), axis=-1)
    inside = 1 / (1 + np.exp((away - radius) / 0.3))
    return tissue + (lumen - tissue) * inside + np.random.default_rng(5).normal(0, 15, shape)


def shifted_mask(shift):
    """Return a mask of the tube, moved sideways by `shift` (mm)."""
    vessel = Vessel(np.stack([START, END]) + shift, RADIUS)
    return lumen_mask(VesselTree([vessel]), Volume(np.zeros((30, 32, 60), np.int16)))


def middle_and_radius(tree):
    """How far the inner points lie from the true axis (mm), and their radii (mm)."""
    (vessel,) = tree
    way = (vessel.points - START) @ ALONG
    inner = (way > 4) & (way < np.linalg.norm(END - START) - 4)
    away = np.linalg.norm(vessel.points - START - way[:, None] * ALONG, axis=1)[inner]
    return away, vessel.radius[inner]


def test_grey_values_tell_middle_and_radius_better_than_the_mask():
    mask = shifted_mask([0.0, 0.4, 0.3])
    volume = Volume(blurred_tube(START, END, RADIUS))
    away, _ = middle_and_radius(trace_mask(mask))
    assert np.median(away) > 0.4
    tree = trace_mask(mask, volume)
    away, radius = middle_and_radius(tree)
    assert np.median(away) < 0.05
    assert away.max() < 0.15
    assert np.median(radius) == pytest.approx(RADIUS, abs=0.1)
    assert not [note for note in tree.notes if "half a voxel" in note]
    (vessel,) = tree
    assert np.median(vessel.confidence) > 0.9


def test_ends_of_the_mask_stay():
    mask = shifted_mask([0, 0, 0])
    (plain,) = trace_mask(mask)
    (refined,) = trace_mask(mask, Volume(blurred_tube(START, END, RADIUS)))
    assert refined.points[[0, -1]] == pytest.approx(plain.points[[0, -1]], abs=1.0)


@pytest.mark.parametrize("what", ["nothing", "dark", "elsewhere", "no numbers"])
def test_a_volume_that_does_not_show_the_vessel_changes_nothing(what):
    mask = shifted_mask([0, 0, 0])
    values = {
        "nothing": np.full(mask.shape, 60.0),
        "dark": blurred_tube(START, END, RADIUS, lumen=60, tissue=400),
        "elsewhere": blurred_tube(START + ASIDE, END + ASIDE, RADIUS),
        "no numbers": np.full(mask.shape, np.nan),
    }[what]
    tree = trace_mask(mask, Volume(values))
    assert tree == trace_mask(mask)
    accuracy = "the centre and radius are accurate to about half a voxel (0.5 mm)"
    assert f"{accuracy}: the volume gives no better estimate there" in tree.notes


def test_vessels_that_meet_still_share_their_ends():
    lines = [[START, END], [(START + END) / 2, [30.0, 15.6, 28.0]]]
    tubes = [blurred_tube(*map(np.array, line), 2.6) for line in lines]
    tree = VesselTree(Vessel(np.array(line), 2.6) for line in lines)
    mask = lumen_mask(tree, Volume(np.zeros((30, 32, 60), np.int16)))
    traced = trace_mask(mask, Volume(np.maximum(*tubes)))
    ends = [tuple(vessel.points[n]) for vessel in traced for n in (0, -1)]
    assert len(traced) == 3
    assert max(ends.count(end) for end in ends) == 3
    assert all(vessel.confidence is not None for vessel in traced)
    for vessel in traced:
        steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
        assert steps.max() <= 0.5 + 1e-9
        # Where vessels meet, and at their ends, a cross-section is not a circle of the tube.
        assert vessel.radius[12:-8] == pytest.approx(2.6, abs=0.3)
