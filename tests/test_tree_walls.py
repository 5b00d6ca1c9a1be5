"""Vessels of one tree share the estimated level of their walls."""

from collections.abc import Sequence

import numpy as np
import pytest

from calibration_scenes import MUSCLE, Scene, tree_of
from lumencut import Profile, Vessel, VesselTree, Volume, measure

#: Walls of 0 HU differ much from the expected level; the narrowest vessel alone says little about its wall.
DIAMETERS = (5.0, 4.0, 1.8)


@pytest.fixture(scope="module")
def arteries() -> tuple[Volume, VesselTree]:
    return tree_of([Scene(diameter, wall=0.0, seed=n) for n, diameter in enumerate(DIAMETERS)])


def profiles(volume: Volume, tree: VesselTree, vessels: Sequence[Vessel], **more: object) -> list[Profile]:
    return [measure(volume, vessel, fwhm=0.9, tree=tree, **more) for vessel in vessels]  # type: ignore[arg-type]


def same(one: Profile, other: Profile) -> bool:
    return all(
        np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True)
        for name in ("diameter_equivalent", "uncertainty", "wall")
    )


def test_a_narrow_artery_is_measured_better_with_its_tree(arteries):
    volume, tree = arteries
    alone = measure(volume, tree[2], fwhm=0.9)
    among = profiles(volume, tree, [tree[2]])[0]
    off = [abs(np.mean(one.diameter_equivalent) - DIAMETERS[2]) for one in (alone, among)]
    assert off[1] < 0.9 * off[0]
    assert np.median(among.uncertainty_parts["wall"]) < np.median(alone.uncertainty_parts["wall"])
    assert alone.wall_source == "45 ± 25 HU, as walls in CT"
    assert among.wall_source.startswith("45 ± 25 HU, as walls in CT; ")
    assert among.wall_source.endswith(" pooled with 2 other vessels of the tree")


def test_the_order_of_vessels_changes_nothing(arteries):
    volume, tree = arteries
    turned = VesselTree([tree[2], tree[0], tree[1]])
    first, second = profiles(volume, tree, [tree[1]])[0], profiles(volume, turned, [tree[1]])[0]
    assert same(first, second)
    assert first.wall_source == second.wall_source


def test_a_tree_of_one_vessel_is_measured_as_the_vessel(arteries):
    volume, tree = arteries
    alone = measure(volume, tree[1], fwhm=0.9)
    among = profiles(volume, VesselTree([tree[1]]), [tree[1]])[0]
    assert same(alone, among)
    assert alone.wall_source == among.wall_source


def test_radii_of_a_tree_are_those_of_its_profiles(arteries):
    volume, tree = arteries
    radii = [vessel.radius for vessel in tree.measured(volume, fwhm=0.9)]
    for radius, profile in zip(radii, profiles(volume, tree, tree), strict=True):
        assert np.median(radius) == pytest.approx(np.median(profile.diameter_equivalent) / 2, abs=0.01)


def test_a_level_that_is_given_is_pooled_too_and_none_is_where_none_is_asked(arteries):
    volume, tree = arteries
    given = profiles(volume, tree, [tree[2]], wall=(30, 20))[0].wall_source
    assert given.startswith("30 ± 20, given; ")
    assert "pooled with 2 other" in given
    assert profiles(volume, tree, [tree[2]], wall="off")[0].wall_source == "not separated, as requested"


def test_walls_that_are_hidden_tell_nothing_and_are_told_nothing():
    scenes = [Scene(4.0, seed=1), Scene(4.0, wall=MUSCLE, around=(MUSCLE,), seed=3)]
    volume, tree = tree_of(scenes)
    clear, hidden = profiles(volume, tree, tree)
    assert clear.wall_source == "45 ± 25 HU, as walls in CT"
    assert hidden.wall_source == "not separated: the surroundings are as bright"
    for vessel, among in zip(tree, (clear, hidden), strict=True):
        assert same(measure(volume, vessel, fwhm=0.9), among)
