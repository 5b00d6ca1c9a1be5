"""Comparisons of centerlines, against values computed by hand and against an independent algorithm."""

import heapq

import numpy as np
import pytest

import lumencut
from lumencut import Vessel, VesselTree, compare_centerlines


def straight(start, end, count=50, radius=2.0, name=None):
    return Vessel(np.linspace(start, end, count), radius, name)


def cheapest_sum(first, second):
    """Return the smallest total length of connections, by Dijkstra's search; each step advances one line."""
    lengths = np.linalg.norm(first[:, None] - second, axis=2)
    end = (len(first) - 1, len(second) - 1)
    waiting, done = [(lengths[0, 0], (0, 0))], set()
    while waiting:
        total, (a, b) = heapq.heappop(waiting)
        if (a, b) == end:
            return total
        if (a, b) in done:
            continue
        done.add((a, b))
        for c, d in ((a + 1, b), (a, b + 1)):
            if c <= end[0] and d <= end[1]:
                heapq.heappush(waiting, (total + lengths[c, d], (c, d)))
    raise AssertionError


def test_connections_are_those_of_dijkstras_search():
    random = np.random.default_rng(4)
    for rows, columns in ((1, 1), (1, 9), (8, 1), (40, 60), (65, 64)):
        first = np.cumsum(random.normal(size=(rows, 3)), axis=0)
        second = np.cumsum(random.normal(size=(columns, 3)), axis=0)
        pairs = lumencut._lumencut.correspondence(first, second)
        assert len(pairs) == rows + columns - 1
        assert pairs[0].tolist() == [0, 0]
        assert pairs[-1].tolist() == [rows - 1, columns - 1]
        assert np.diff(pairs, axis=0).sum(axis=1).tolist() == [1] * (len(pairs) - 1)
        assert np.diff(pairs, axis=0).min(initial=0) >= 0
        total = np.linalg.norm(first[pairs[:, 0]] - second[pairs[:, 1]], axis=1).sum()
        assert total == pytest.approx(cheapest_sum(first, second), rel=1e-12)


def test_the_same_line_overlaps_wholly():
    line = straight((0, 0, 0), (0, 0, 40))
    found = compare_centerlines(line, line)
    assert (found.ov, found.of, found.ot, found.false_length) == (1, 1, 1, 0)
    assert found.first_error is None
    assert found.length == pytest.approx(40)
    # Every second connection joins a point with the next point of the other line.
    assert found.ai == pytest.approx(0.015, rel=0.01)


@pytest.mark.parametrize("sampling", [0.03, 0.1])
def test_a_line_beside_the_reference_is_as_far_as_it_is(sampling):
    found = compare_centerlines(
        straight((0.8, 0, 0), (0.8, 0, 40)), straight((0, 0, 0), (0, 0, 40)), sampling=sampling
    )
    assert (found.ov, found.of, found.ot) == (1, 1, 1)
    assert found.ai == pytest.approx((0.8 + np.hypot(0.8, sampling)) / 2, rel=1e-4)


def test_a_line_that_ends_early_misses_the_rest():
    # The last point is connected to all following points; the first 2 mm of these are closer than the radius.
    found = compare_centerlines(straight((0, 0, 0), (0, 0, 30)), straight((0, 0, 0), (0, 0, 40)))
    assert found.of == pytest.approx(32 / 40, abs=0.002)
    assert found.first_error == pytest.approx(32, abs=0.06)
    assert found.ov == pytest.approx((30 + 32) / (30 + 40), abs=0.002)


def test_a_line_that_goes_on_is_wrong_beyond_the_end():
    found = compare_centerlines(straight((0, 0, 0), (0, 0, 50)), straight((0, 0, 0), (0, 0, 40)))
    assert found.of == 1
    assert found.ov == pytest.approx((42 + 40) / (50 + 40), abs=0.002)
    assert found.false_length == pytest.approx(8, abs=0.6)


def test_errors_near_the_start_are_no_first_error():
    bent = Vessel([(5, 0, 0), (5, 0, 4), (0, 0, 4), (0, 0, 40)])
    found = compare_centerlines(bent, straight((0, 0, 0), (0, 0, 40)))
    assert found.of == 1
    assert found.ov < 0.97
    late = Vessel([(0, 0, 0), (0, 0, 10), (9, 0, 10), (9, 0, 14), (0, 0, 14), (0, 0, 40)])
    found = compare_centerlines(late, straight((0, 0, 0), (0, 0, 40), radius=1.0))
    assert 10 < found.first_error < 14
    assert found.of == pytest.approx(found.first_error / 40, abs=0.001)


def test_the_relevant_part_ends_where_the_vessel_becomes_narrow():
    # The radius is 0.75 mm at half of the length; beyond it the traced line is wrong.
    reference = Vessel(np.linspace((0, 0, 0), (0, 0, 40), 81), np.linspace(1.25, 0.25, 81))
    traced = Vessel([(0, 0, 0), (0, 0, 24), (6, 0, 40)])
    found = compare_centerlines(traced, reference)
    assert found.ot == 1
    assert found.ov < 0.9
    narrow = straight((0, 0, 0), (0, 0, 40), radius=0.5)
    assert np.isnan(compare_centerlines(traced, narrow).ot)


def test_what_comes_before_the_disc_at_the_start_is_left_out():
    reference = straight((0, 0, 0), (0, 0, 40))
    early = Vessel([(0, 0, -30), (0, 0, 40)])
    assert compare_centerlines(early, reference).ov == pytest.approx(1, abs=1e-3)
    # The line crosses the plane of the disc, but outside the disc, whose radius is 4 mm.
    aside = Vessel([(20, 0, -30), (20, 0, 5), (0, 0, 5), (0, 0, 40)])
    assert compare_centerlines(aside, reference).ov < 0.8


def test_a_line_is_turned_round_where_it_runs_backwards():
    reference = straight((0, 0, 0), (0, 0, 40))
    assert compare_centerlines(straight((0, 0, 40), (0, 0, 0)), reference).ov == 1


def test_inside_counts_only_what_is_nearer_than_the_radius():
    reference = straight((0, 0, 0), (0, 0, 40), radius=1.0)
    half = Vessel([(0.5, 0, 0), (0.5, 0, 20), (3, 0, 20), (3, 0, 40)])
    found = compare_centerlines(half, reference)
    assert found.ai == pytest.approx(0.5, abs=0.02)
    assert found.ov == pytest.approx(0.5, abs=0.04)
    far = compare_centerlines(straight((3, 0, 0), (3, 0, 40)), reference)
    assert (far.ov, far.ot) == (0, 0)
    assert far.of == pytest.approx(5 / 40, abs=0.002)
    assert np.isnan(far.ai)
    assert far.false_length == pytest.approx(40)


def forked(step=50):
    """Return a trunk with two branches as three vessels, and the same as two vessels."""
    trunk = straight((0, 0, 0), (0, 0, 30), step, name="trunk")
    left, right = straight((0, 0, 30), (20, 0, 60), step), straight((0, 0, 30), (-20, 0, 60), step)
    through = Vessel(np.concatenate([trunk.points, left.points[1:]]), 2.0)
    return VesselTree([trunk, left, right]), VesselTree([right, through])


def test_trees_that_are_parted_elsewhere_are_alike():
    three, two = forked()
    for traced, reference in ((three, two), (two, three)):
        found = compare_centerlines(traced, reference)
        assert (found.ov, found.of, found.ot, found.false_length) == (1, 1, 1, 0)
        assert len(found.vessels) == len(reference)
        assert found.length == pytest.approx(sum(vessel.length for vessel in reference))
        assert found.ai < 0.02


def test_a_missing_branch_is_missed():
    three, _ = forked()
    found = compare_centerlines(three.without(2), three)
    assert [round(one.ov, 2) for one in found.vessels[:2]] == [1, 1]
    # The path to the missing end stays at the fork.
    assert found.vessels[2].ov < 0.2
    assert found.ov < 0.8
    more = compare_centerlines(three, three.without(2))
    assert more.ov == 1
    # It starts in the lumen of the other branch, 2 mm wide, at an angle whose sine is 12/13.
    assert more.false_length == pytest.approx(three[2].length - 2 / (12 / 13), abs=0.6)


def test_the_piece_that_fits_best_is_taken():
    reference = straight((0, 0, 0), (0, 0, 40))
    pieces = VesselTree([straight((0.2, 0, 1), (0.2, 0, 39)), straight((0, 0, -0.2), (0, -20, -0.2))])
    assert compare_centerlines(pieces, reference).ov > 0.97


def test_ways_around_a_cycle_take_the_side_of_the_reference():
    turn = np.linspace(0, 2 * np.pi, 121)
    ring = np.stack([20 * np.cos(turn), 20 * np.sin(turn), np.zeros(121)], axis=1)
    ring[-1] = ring[0]
    traced = VesselTree([Vessel(ring[:31], 2.0), Vessel(ring[30:], 2.0)])
    for reference in (Vessel(ring, 2.0), Vessel(ring[30:], 2.0), Vessel(ring[:91], 2.0)):
        assert compare_centerlines(traced, VesselTree([reference])).ov == 1


def test_what_cannot_be_compared_is_refused():
    line = straight((0, 0, 0), (0, 0, 40))
    with pytest.raises(lumencut.VesselTreeError, match=r"vessel 0 of the reference: found no radius"):
        compare_centerlines(line, Vessel([(0, 0, 0), (0, 0, 1)]))
    with pytest.raises(lumencut.VesselTreeError, match=r"traced centerlines: found list"):
        compare_centerlines([line], line)
    for wrong in (0, -1, float("nan"), float("inf"), "fine"):
        with pytest.raises(lumencut.SettingsError, match="sampling"):
            compare_centerlines(line, line, sampling=wrong)
    with pytest.raises(lumencut.VesselTreeError, match="sample them at larger distances"):
        compare_centerlines(line, line, sampling=1e-5)
