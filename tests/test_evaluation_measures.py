"""Each measure gives no error for correct frames, and the known error for made-up wrong frames."""

import math
from dataclasses import replace

import numpy as np
import pytest

from evaluation_scenes import crossing_tubes, front, perfect, truth_in, tube, with_depth
from lumencut import Vessel, VesselTree
from lumencut.evaluation.amounts import percent, pooled
from lumencut.evaluation.measures import MEASURES, columns_of
from lumencut.evaluation.shown import slid
from lumencut.evaluation.silhouettes import leaps


@pytest.fixture(scope="module")
def camera():
    return front()


@pytest.fixture(scope="module")
def tubes(camera):
    """The truth about two crossing tubes, the second 20 mm behind the first."""
    return truth_in(crossing_tubes(), camera)


@pytest.fixture(scope="module")
def lone(camera):
    """The truth about one tube of 60 mm by 8 mm."""
    return truth_in(VesselTree([tube(4.0)]), camera)


def numbers(truth, shown):
    return columns_of({name: measure.amounts(truth, shown) for name, measure in MEASURES.items()})


def test_a_perfect_frame_is_perfect(tubes, camera):
    found = numbers(tubes, perfect(tubes, camera, beyond=10.0))
    for name in ("visible_centerline", "lumen_within_0.05_mm", "lumen_within_2_mm", "crossings_in_order"):
        assert found[f"{name}_percent"] == 100
    # Each tube has 61 points; those of the second tube within 4 mm of the first tube's axis are hidden.
    assert (found["centerline_points"], found["hidden_centerline_points"]) == (122 - 9, 9)
    assert found["width_error_max_mm"] <= 0.25
    assert found["depth_change_per_degree_mm"] == 0
    assert found["tissue_percent"] is None
    assert found["blended_sheets_percent"] is None
    assert found["leaps_with_line_percent"] is found["leaps"] is None


def test_depth_that_is_a_little_off_on_half_of_the_pixels(lone, camera):
    shown = perfect(lone, camera)
    columns = np.flatnonzero(np.isfinite(lone.nearest.depth[80]))
    depth = shown.depth.copy()
    depth[:, columns[: len(columns) // 2]] += 0.3
    found = numbers(lone, with_depth(shown, lone, depth))
    assert found["lumen_within_0.05_mm_percent"] == pytest.approx(50, abs=0.7)
    assert found["lumen_within_0.5_mm_percent"] == 100
    assert found["visible_centerline_percent"] == pytest.approx(50, abs=1)
    found = numbers(lone, with_depth(shown, lone, shown.depth + 1.9))
    shares = [found[f"lumen_within_{bound}_mm_percent"] for bound in ("0.05", "0.5", "2")]
    assert shares == [0, 0, 100]


def test_a_narrowed_vessel(lone, camera):
    shown = perfect(lone, camera, beyond=50.0)
    narrow = numbers(lone, shown)
    assert narrow["width_error_max_mm"] <= 0.25
    depth = shown.depth.copy()
    # The rows in which the tube is 6 mm wide.
    lumen = np.flatnonzero(np.isfinite(lone.nearest.depth[:, 80]))
    depth[lumen[:2]] = depth[lumen[-2:]] = 50.0
    found = numbers(lone, with_depth(shown, lone, depth))
    for name in ("width_error_mean_mm", "width_error_95_percent_mm", "width_error_max_mm"):
        assert found[name] == pytest.approx(2.0, abs=0.26)
    assert found["width_bias_mm"] == pytest.approx(-2.0, abs=0.26)
    # Pixels that are not connected to the middle do not count.
    depth[lumen[0]] = 0.0
    assert numbers(lone, with_depth(shown, lone, depth))["width_bias_mm"] == found["width_bias_mm"]
    # If its middle is not shown, a vessel has no width.
    gone = numbers(lone, with_depth(shown, lone, np.full_like(depth, 50.0)))
    assert gone["width_bias_mm"] == -8.0


def test_stations_that_cannot_be_judged(tubes, camera):
    # Stations begin 8 mm from the ends of the first tube, and 6 mm from the ends of the second.
    assert len(tubes.stations) == 8 + 10
    found = numbers(tubes, perfect(tubes, camera))
    # Two stations of the second tube, at ± 2.5 mm, lie behind the first.
    assert found["width_stations"] == 8 + 8
    assert found["width_stations_left_out"] == 24 - 16
    small = front((60, 161))
    found = numbers(truth := truth_in(crossing_tubes(), small), perfect(truth, small))
    # In a picture 30 mm wide only the stations of the first tube within 15 mm are visible.
    assert found["width_stations"] == 6 + 8
    along = VesselTree([tube(4.0, axis=2)])
    up = replace(front(), direction=(0, 0.1, 1), up=(0, 1, 0))
    found = numbers(truth := truth_in(along, up), perfect(truth, up))
    assert (found["width_stations"], found["width_stations_left_out"]) == (0, 12)
    assert found["width_error_mean_mm"] is found["width_error_max_mm"] is None


def test_the_wrong_vessel_at_a_crossing(tubes, camera):
    shown = perfect(tubes, camera)
    depth = shown.depth.copy()
    depth[70:90, 70:90] = 20.0
    found = numbers(tubes, with_depth(shown, tubes, depth))
    assert (found["crossings_in_order_percent"], found["crossings"]) == (0, 1)
    assert found["visible_centerline_percent"] < 95
    # Within the nearer vessel's radius plus half a millimetre.
    depth[70:90, 70:90] = 4.4
    assert numbers(tubes, with_depth(shown, tubes, depth))["crossings_in_order_percent"] == 100


def test_zones_that_change_and_depths_that_jump(tubes, camera):
    shown = perfect(tubes, camera)
    turned = shown.depth.copy()
    turned[:, :16] += 6.0
    turned[:, 16:32] -= 4.0
    zones = shown.vessel.copy()
    zones[:23] = 1 - zones[:23]
    found = numbers(tubes, replace(shown, turned_depth=turned, turned_vessel=zones))
    assert found["depth_change_per_degree_mm"] == pytest.approx(16 * 10 / 161)
    assert found["jumps_per_degree_percent"] == pytest.approx(100 * 16 / 161)
    assert found["zone_changes_per_degree_percent"] == pytest.approx(100 * 23 / 161)


def test_surroundings_and_blends(tubes, camera):
    shown = perfect(tubes, camera)
    value, gap = np.full(shown.depth.shape, 5.0), np.zeros(shown.depth.shape)
    value[:40] = np.nan
    gap[:10], gap[10:30], gap[30:33] = 20.0, -21.0, 35.0
    found = numbers(tubes, replace(shown, value=value, sheet_gap=gap))
    assert found["tissue_percent"] == pytest.approx(100 * 121 / 161)
    assert found["blended_sheets_percent"] == pytest.approx(100 * 23 / 161)


def test_surroundings_end_at_leaps(lone, camera):
    """Of 20 mm on each side of a tube: a jump 12 mm above its wall, nothing shown 5 mm below it."""
    shown = perfect(lone, camera)
    assert numbers(lone, shown)["unbroken_surroundings_percent"] == 100
    middle = np.flatnonzero(np.isfinite(lone.nearest.depth[:, 80]))
    depth = shown.depth.copy()
    depth[: middle[0] - 24] = 30.0
    found = numbers(lone, with_depth(shown, lone, depth))
    assert found["unbroken_surroundings_percent"] == pytest.approx(100 * 32 / 40, abs=1.5)
    depth[middle[-1] + 1 + 10 :] = np.nan
    found = numbers(lone, with_depth(shown, lone, depth))
    assert found["unbroken_surroundings_percent"] == pytest.approx(100 * 17 / 40, abs=1.5)
    # A slope is not a jump; surroundings that start elsewhere do not belong to this vessel.
    slope = shown.depth + 3.0 * (np.arange(161)[:, None] - 80.0)
    assert numbers(lone, with_depth(shown, lone, slope))["unbroken_surroundings_percent"] == 100
    away = numbers(lone, with_depth(shown, lone, shown.depth + 40.0))
    assert away["unbroken_surroundings_percent"] == 0


def test_surroundings_reach_to_the_next_lumen_and_to_the_border():
    """A second tube begins 10 mm above the wall; the picture ends 8 mm below the other wall."""
    above = tube(4.0)
    above = Vessel(above.points + np.array([0, 0, 18.0]), 4.0)
    tree, camera = VesselTree([tube(4.0), above]), front((161, 48))
    truth = truth_in(tree, camera)
    shown = perfect(truth, camera)
    assert numbers(truth, shown)["unbroken_surroundings_percent"] == 100
    # Above the lower tube nothing is connected; there are 10 mm of tissue up to the next lumen.
    depth = shown.depth.copy()
    depth[np.isnan(truth.nearest.arc) & (np.arange(48)[:, None] < 24)] = np.nan
    found = numbers(truth, with_depth(shown, truth, depth))
    assert found["unbroken_surroundings_percent"] == pytest.approx(50, abs=3)


def test_lumen_that_is_shown_anywhere_in_it(lone, camera):
    """Other depths within the same lumen count; depths beyond its wall do not."""
    shown = perfect(lone, camera)
    assert numbers(lone, shown)["lumen_shown_percent"] == 100
    deeper = numbers(lone, with_depth(shown, lone, shown.depth + 1.9))
    # Within 4 mm of the axis in space: of these pixels, those within √(4² − 1.9²) of the axis.
    x, z = np.meshgrid(lone.seen.grid.x(np.arange(161)) + 0.013, lone.seen.grid.y(np.arange(161)) + 0.017)
    away = np.hypot(np.maximum(np.abs(x) - 30, 0), z)
    expected = 100 * (away <= np.sqrt(16 - 1.9**2)).sum() / (away <= 4).sum()
    assert deeper["lumen_shown_percent"] == pytest.approx(expected, abs=0.1)
    assert deeper["lumen_within_0.5_mm_percent"] == 0
    gone = np.where(np.arange(161) < 80, np.nan, shown.depth)
    assert numbers(lone, with_depth(shown, lone, gone))["lumen_shown_percent"] == pytest.approx(50, abs=1)


def test_what_shows_nothing_is_neither_near_nor_in_order(tubes, camera):
    shown = perfect(tubes, camera)
    nothing = np.full_like(shown.depth, np.nan)
    none = np.full_like(shown.vessel, -1)
    strength = np.zeros(shown.depth.shape)
    found = numbers(
        tubes,
        replace(
            with_depth(shown, tubes, nothing),
            vessel=none,
            turned_depth=shown.depth,
            turned_vessel=none,
            plain_depth=nothing,
            strength=strength,
        ),
    )
    for name in ("lumen_within_2_mm", "lumen_shown", "visible_centerline", "crossings_in_order"):
        assert found[f"{name}_percent"] == 0
    assert found["unbroken_surroundings_percent"] == 0
    assert found["depth_change_per_degree_mm"] is found["jumps_per_degree_percent"] is None
    assert found["leaps"] == 0


def test_a_surface_that_only_turns_slides_nowhere():
    camera = front((121, 101), 1.0)
    turned = camera.rotated(math.radians(1.0), "up")

    def plane(seen, shift):
        # The plane z = 10 + 0.8 x, moved away by the shift, as seen by a camera.
        x = (np.arange(121) - 60.0)[None, :] + np.zeros((101, 1))
        towards, up = np.array(seen.direction), np.array(seen.up)
        down = (np.arange(101) - 50.0)[:, None, None] * -up
        foot = seen.center + x[..., None] * np.cross(towards, up) + down
        normal = np.array(camera.direction) - 0.8 * np.cross(camera.direction, camera.up)
        depth = (10.0 + shift - (foot - camera.center) @ normal) / (towards @ normal)
        return depth, foot + depth[..., None] * towards

    depth, _ = plane(camera, 0.0)
    for shift, share in ((0.0, 0.0), (4.0, 0.0), (9.0, 1.0), (-9.0, 1.0)):
        slides = slid(camera, depth, *plane(turned, shift))
        assert slides[:, 8:-8].mean() == share
    hole = np.where(np.arange(121) < 40, np.nan, depth)
    assert not slid(camera, hole, *plane(turned, 9.0))[:, 8:38].any()
    # A plane that faces the viewer in both views moves at its border but does not slide.
    flat = np.zeros((101, 121))
    facing = turned.center + (np.arange(121) - 60.0)[:, None] * np.cross(turned.direction, turned.up)
    position = np.broadcast_to(facing, (101, 121, 3))
    assert not slid(front((121, 101), 9.0), flat, flat, position).any()


def test_the_worst_view_counts_alone(lone, camera):
    still, half = perfect(lone, camera), np.zeros((161, 161), bool)
    half[:, :40] = True
    amounts = [MEASURES["steadiness"].amounts(lone, one) for one in (still, replace(still, slides=half))]
    found = MEASURES["steadiness"].columns(pooled(amounts))
    assert found["slides_per_degree_max_percent"] == pytest.approx(100 * 40 / 161)
    assert found["slides_per_degree_percent"] == pytest.approx(50 * 40 / 161)


def test_depths_are_compared_where_there_are_two(tubes, camera):
    shown = perfect(tubes, camera)
    turned = shown.depth + 6.0
    turned[:40] = np.nan
    found = numbers(tubes, replace(shown, turned_depth=turned))
    assert found["depth_change_per_degree_mm"] == pytest.approx(6)
    assert found["jumps_per_degree_percent"] == 100


def test_leaps_are_steps_and_no_slopes():
    rows, columns = np.mgrid[:12, :16].astype(float)
    bound = np.full((12, 16), 4.0)
    assert not any(which.any() for which in leaps(9 * columns - 7 * rows, bound))
    step = 9 * columns + np.where(columns >= 8, 5.0, 0.0)
    across, down = leaps(step, bound)
    assert np.argwhere(across)[:, 1].tolist() == [7] * 12
    assert not down.any()
    across, down = leaps(step.T, bound.T)
    assert np.argwhere(down)[:, 0].tolist() == [7] * 12
    assert not across.any()
    # A step lower than the bound, and a fold, where only one side has a slope.
    assert not leaps(step, bound + 2)[0].any()
    assert not leaps(np.maximum(0, 9 * (columns - 8)), bound)[0].any()
    assert [which.shape for which in leaps(np.zeros((1, 1)), np.ones((1, 1)))] == [(1, 0), (0, 1)]


def test_lines_at_leaps_and_elsewhere(lone, camera):
    shown = perfect(lone, camera)
    depth = np.zeros(shown.depth.shape)
    depth[:, 80:] = 30.0
    drawn = np.zeros(depth.shape)
    drawn[:81, 79:81] = 0.9
    drawn[:, 20] = 0.3
    drawn[:, 40] = 0.2
    found = numbers(lone, replace(shown, plain_depth=depth, strength=drawn))
    assert found["leaps"] == 161
    assert found["leaps_with_line_percent"] == pytest.approx(100 * 82 / 161)
    # Lines of 161 pixels of 0.5 mm in all columns except two at the jump and one on each side.
    assert found["lines_elsewhere_mm_per_mm2"] == pytest.approx(1 / (157 * 0.5))
    # A jump must be higher than the vessel is wide.
    low = numbers(lone, replace(shown, plain_depth=depth * 7.9 / 30, strength=drawn))
    assert (low["leaps"], low["leaps_with_line_percent"]) == (0, None)


def test_views_are_pooled_by_their_counts():
    views = [
        {"part": 1, "whole": 10, "errors": np.array([1.0, 2.0]), "gap": None},
        {"part": 9, "whole": 10_000, "errors": np.array([4.0]), "gap": None},
    ]
    found = pooled(views)
    assert percent(found["part"], found["whole"]) == pytest.approx(100 * 10 / 10_010)
    assert found["errors"].tolist() == [1.0, 2.0, 4.0]
    assert found["gap"] is None
    assert percent(0, 0) is None


def test_one_pixel_has_numbers():
    camera = front((1, 1))
    truth = truth_in(crossing_tubes(), camera)
    found = numbers(
        truth, replace(shown := perfect(truth, camera), plain_depth=shown.depth, strength=shown.depth)
    )
    assert (found["lumen_pixels"], found["lumen_within_0.05_mm_percent"]) == (1, 100)
    assert (found["leaps"], found["width_stations"], found["crossings"]) == (0, 0, 1)
    assert found["centerline_points_outside"] == 122 - 2


def test_a_crossing_beside_the_centre_of_its_pixel_is_left_out():
    camera = replace(front((3, 3), 20.0), center=(8.0, 0, 8.0))
    truth = truth_in(crossing_tubes(), camera)
    found = numbers(truth, perfect(truth, camera))
    assert (found["crossings"], found["crossings_left_out"]) == (0, 1)
    assert found["crossings_in_order_percent"] is None
