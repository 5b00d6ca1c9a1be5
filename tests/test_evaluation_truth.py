"""The truth of evaluations, compared with every piece at every pixel and with closed forms."""

import time

import numpy as np
import pytest

import reference
from evaluation_scenes import crossing_tubes, front, truth_in, tube
from lumencut import Camera, Vessel, VesselTree
from lumencut.evaluation.centerline import centerline_of, width_stations
from lumencut.evaluation.crossings import crossings_of
from lumencut.evaluation.projection import projection_of
from lumencut.evaluation.ragged import parts, ragged
from lumencut.evaluation.truth import lumen_depth_at, nearest_lumen, truth_of
from lumencut.evaluation.views import cameras, directions
from scenes import lattice, nearly_along_y, of_few_points, wandering

FRONT = ((0, 1, 0), (0, 0, 1))
OBLIQUE = ((0.4, 1, -0.2), (0, 0, 1))


def radius_of(vessel, unknown):
    known = np.zeros(len(vessel)) if vessel.radius is None else vessel.radius
    return np.where(known > 0, known, unknown)


def brute_force(tree, camera, places, unknown=1.0, slack=0.0):
    """Return the depth of the nearest lumen at positions (n, 2), from all pieces; `slack` widens them."""
    best = np.full(len(places), np.inf)
    for vessel in tree:
        kept = reference.distinct(vessel.points)
        view = reference.view_from_world(vessel.points[kept], camera)
        pieces = reference.pieces_of(view, radius_of(vessel, unknown)[kept], np.zeros(len(kept)))
        found = reference.candidates(pieces, places)
        within = (found.inside >= -slack) & (found.d <= found.r + slack)
        best = np.minimum(best, np.where(within, found.z, np.inf).min(axis=1))
    return best


def assert_between(found, tree, camera, places, unknown=1.0):
    """Check that depths are those of the pieces, on whichever side rounding puts the borders."""
    low = brute_force(tree, camera, places, unknown, 1e-6)
    high = brute_force(tree, camera, places, unknown, -1e-6)
    assert (found >= low - 1e-6).all()
    assert (found <= high + 1e-6).all()
    assert (low == high).mean() > 0.9


@pytest.mark.parametrize("view", [FRONT, OBLIQUE], ids=["front", "oblique"])
@pytest.mark.parametrize("scene", [wandering, lattice, nearly_along_y, of_few_points])
@pytest.mark.parametrize("seed", [1, 2])
def test_the_truth_is_that_of_every_piece_at_every_pixel(scene, seed, view):
    tree = scene(seed)
    camera = Camera.fitted(tree, *view, (46, 42))
    seen = projection_of(centerline_of(tree, 1.0), camera)
    nearest = nearest_lumen(seen)
    assert np.isfinite(nearest.depth).any()
    assert_between(nearest.depth.ravel(), tree, camera, reference.pixel_centers(camera))
    # The same at random positions in the pixels, without positions outside the picture.
    places = seen.place + 0.3 * np.random.default_rng(seed).normal(size=seen.place.shape)
    _, within = seen.grid.pixels(places)
    assert_between(lumen_depth_at(seen, places)[within], tree, camera, places[within])
    assert np.isinf(lumen_depth_at(seen, seen.place + 1e4)).all()


def test_the_winner_is_the_vessel_at_that_depth():
    tree = wandering(3)
    camera = Camera.fitted(tree, *OBLIQUE, (60, 50))
    nearest = nearest_lumen(projection_of(centerline_of(tree, 1.0), camera))
    lumen = nearest.vessel >= 0
    assert np.array_equal(lumen, np.isfinite(nearest.depth))
    assert np.array_equal(lumen, np.isfinite(nearest.arc))
    for row, column in np.argwhere(lumen)[::17]:
        vessel, arc = nearest.vessel[row, column], nearest.arc[row, column]
        station = centerline_of(tree, 1.0).at(np.array([vessel]), np.array([arc]))
        depth = reference.view_from_world(station.points, camera)[0, 2]
        assert depth == pytest.approx(nearest.depth[row, column], abs=1e-6)
        assert station.radius[0] == pytest.approx(nearest.radius[row, column], abs=1e-6)


def test_a_tube_is_a_rectangle_with_round_ends():
    camera = front()
    nearest = nearest_lumen(projection_of(centerline_of(VesselTree([tube(4.0, 40.0, 7.0)]), 1.0), camera))
    x, y = (reference.pixel_centers(camera) + np.array([0.013, 0.017])).T
    inside = np.hypot(np.maximum(np.abs(x) - 20, 0), y) <= 4.0
    assert np.array_equal(np.isfinite(nearest.depth).ravel(), inside)
    assert np.allclose(nearest.depth[np.isfinite(nearest.depth)], 7.0)


@pytest.mark.parametrize("radius", [None, 0.0])
def test_unknown_radii_count_as_the_setting_says(radius):
    tree = VesselTree([Vessel([(-10, 0, 0), (10, 0, 0)], radius)])
    seen = projection_of(centerline_of(tree, 2.5), front())
    rows = np.flatnonzero(np.isfinite(nearest_lumen(seen).depth[:, 80]))
    assert len(rows) * 0.5 == pytest.approx(5.0)


def test_a_vessel_along_the_view_is_a_disc_at_its_nearest_point():
    tree = VesselTree([Vessel([(0, y, 0) for y in (5.0, 3.0, 9.0)], 3.0)])
    truth = truth_in(tree, front())
    lumen = np.isfinite(truth.nearest.depth)
    assert lumen.sum() * 0.25 == pytest.approx(9 * np.pi, rel=0.03)
    assert np.allclose(truth.nearest.depth[lumen], 3.0)
    assert truth.hidden.tolist() == [True, False, True]


def test_points_behind_another_vessel_are_hidden():
    truth = truth_in(crossing_tubes(), front())
    points = truth.seen.centerline.points
    behind = (truth.seen.centerline.vessel == 1) & (np.abs(points[:, 2]) <= 4.0)
    assert np.array_equal(truth.hidden, behind)


@pytest.mark.parametrize(("gap", "count"), [(20.0, 1), (7.5, 1), (6.5, 0), (0.0, 0)])
def test_crossings_are_where_lumens_do_not_touch(gap, count):
    crossings = truth_in(crossing_tubes(gap), front()).crossings
    assert len(crossings.depth) == count
    if count:
        assert np.allclose(crossings.place, [[-0.013, -0.017]])
        assert (crossings.depth[0], crossings.radius[0]) == pytest.approx((0.0, 4.0))


def test_a_crossing_behind_a_third_vessel_does_not_count():
    tree = VesselTree([*crossing_tubes(), Vessel([(-5, -30, -5), (5, -30, 5)], 3.0)])
    # The remaining crossings are those of the third vessel with both others.
    assert truth_in(tree, front()).crossings.depth == pytest.approx([-30.0, -30.0], abs=1e-6)


def test_a_vessel_crosses_itself_when_the_stretches_are_far_apart():
    turn = np.linspace(-0.5, 2 * np.pi - 0.5, 200)
    loop = np.stack([20 * np.sin(turn), 10 * np.cos(turn / 2), 10 * np.sin(2 * turn)], axis=1)
    assert len(truth_in(VesselTree([Vessel(loop, 1.0)]), front()).crossings.depth) == 1


def crossings_by_hand(tree, camera):
    """Count the crossings, comparing all pairs of segments."""
    line, found = centerline_of(tree, 1.0), 0
    view = reference.view_from_world(line.points, camera)
    segments = line.segments
    for place, i in enumerate(segments):
        for j in segments[place + 1 :]:
            if line.vessel[i] == line.vessel[j] and abs(line.arc[i] - line.arc[j]) <= 20:
                continue
            matrix = np.column_stack([view[i + 1, :2] - view[i, :2], view[j, :2] - view[j + 1, :2]])
            t, u = np.linalg.solve(matrix, view[j, :2] - view[i, :2])
            if not (0 <= t < 1 and 0 <= u < 1):
                continue
            ends = ((i, t), (j, u))
            gap = np.subtract(*(view[k, 2] + s * (view[k + 1, 2] - view[k, 2]) for k, s in ends))
            found += abs(gap) > sum(
                line.radius[k] + s * (line.radius[k + 1] - line.radius[k]) for k, s in ends
            )
    return found


def test_crossings_are_those_of_all_pairs():
    tree = wandering(5, vessels=5, points=25)
    for ahead in ((0, 1, 0), (0.4, 1, -0.2), (1, 0.2, 0.3)):
        camera = Camera.fitted(tree, ahead, (0, 0, 1), (64, 64))
        found = crossings_of(projection_of(centerline_of(tree, 1.0), camera))
        assert len(found.depth) == crossings_by_hand(tree, camera)


def test_stations_keep_off_ends_and_junctions():
    trunk, branch = tube(4.0), Vessel([(0, 0, 0), (0, 0, 30)], 2.0)
    stations, left_out = width_stations(centerline_of(VesselTree([trunk, branch]), 1.0))
    # Every 5 mm, except 8 mm from the trunk's ends, 6 mm from its middle, 4 mm from the branch's end.
    assert stations.points[stations.vessel == 0, 0].tolist() == [-17.5, -12.5, -7.5, 7.5, 12.5, 17.5]
    assert stations.points[stations.vessel == 1, 2].tolist() == [7.5, 12.5, 17.5, 22.5]
    assert left_out == 12 + 6 - 10


def test_points_that_repeat_do_not_count():
    line = centerline_of(VesselTree([Vessel([(0, 0, 0), (0, 0, 1e-5), (0, 0, 2), (0, 0, 2)], 1.0)]), 1.0)
    assert line.arc.tolist() == [0.0, 2.0]


def test_one_pixel():
    truth = truth_in(crossing_tubes(), front((1, 1), 0.5))
    assert truth.nearest.depth.tolist() == [[0.0]]
    assert truth.nearest.vessel.tolist() == [[0]]


def test_views_are_spread_evenly_and_always_the_same():
    ahead = directions(40)
    assert np.allclose(np.linalg.norm(ahead, axis=1), 1)
    assert np.abs(ahead.mean(axis=0)).max() < 0.02
    nearest = np.sort(np.arccos(np.clip(ahead @ ahead.T, -1, 1)), axis=1)[:, 1]
    assert nearest.min() > 0.6 * np.sqrt(4 * np.pi / 40)
    assert np.allclose(directions(1), [(0, 1, 0)])
    tree = crossing_tubes()
    assert all(camera.pixel_spacing == 0.7 for camera in cameras(tree, 1200, (8, 8), 0.7))


def test_ranges_become_pairs_and_work_is_cut():
    owner, member = ragged(np.array([5, 0, 9]), np.array([2, 0, 3]))
    assert owner.tolist() == [0, 0, 2, 2, 2]
    assert member.tolist() == [5, 6, 9, 10, 11]
    sizes = np.array([3, 3, 9, 1, 1])
    assert [(part.start, part.stop) for part in parts(sizes, 6)] == [(0, 2), (2, 3), (3, 5)]
    assert list(parts(np.array([], int))) == []


def test_five_thousand_segments_take_less_than_a_second():
    line = centerline_of(tree := wandering(3, vessels=125, points=41), 1.0)
    stations = width_stations(line)
    camera = Camera.anterior(tree)
    start = time.process_time()
    truth_of(line, camera, stations)
    assert tree.segment_count == 5000
    assert time.process_time() - start < 1.0
