"""The cut surface agrees with the slow reference for the same scene.

If rounding decides which of two pieces wins in the reference, a pixel may differ. Such pixels are
counted and must be few.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import reference
import reference_images
import reference_surface
from conftest import each_value, needs_shared_data, odd_lines
from lumencut import (
    Camera,
    Renderer,
    Settings,
    SettingsError,
    Vessel,
    VesselTree,
    Volume,
    VolumeError,
    phantom,
    read_centerlines,
)
from lumencut.scene.checked_settings import checked
from scenes import lattice, nearly_along_y, of_few_points, wandering

TOLERANCE = 1e-3
#: A small picture, as the reference compares each pixel with each piece.
FEW = (31, 28)
PLAIN = Settings(depth_filter=False)
DIRECTIONS = {
    "front": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "oblique": ((0.4, 1.0, -0.2), (0.0, 0.0, 1.0)),
    "below": ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
}
PAPER = Settings.paper(depth_filter=False)
RULES = {
    "default": PLAIN,
    "paper": PAPER,
    "lumen_first": replace(PAPER, lumen_first=True, lumen_margin=0.7),
    "own_levels_by_cost": replace(PLAIN, lumen_first=False, lumen_margin=0.3),
    "whole_curve": replace(PAPER, distance_rule="whole curve"),
    "whole_curve_own_levels": replace(PLAIN, lumen_first=False, distance_rule="whole curve"),
}


def fitted(tree, direction, size=(46, 42)):
    return Camera.fitted(tree, *DIRECTIONS[direction], size)


def differences(frame, expected):
    """Return the number of pixels with each kind of difference."""
    error = np.abs(frame.depth - expected.depth)
    depth, vessel = error > TOLERANCE, frame.vessel != expected.vessel
    return {
        "depth": int(((error > TOLERANCE + expected.slack) & ~expected.unsure_depth).sum()),
        "vessel": int((vessel & ~expected.unsure_vessel).sum()),
        "distance": int((np.abs(frame.distance - expected.distance) > TOLERANCE / 10).sum()),
        "depth, unsure or not": int(depth.sum()),
        "vessel, unsure or not": int(vessel.sum()),
        "unsure depth": int(expected.unsure_depth.sum()),
    }


def assert_same(tree, camera, rule, most_unsure=0.005, most_different=0.001):
    frame = Renderer(None, tree).cut_surface(camera, rule)
    expected = reference_surface.cut_surface(tree, camera, rule, TOLERANCE)
    found = differences(frame, expected)
    assert (found["depth"], found["vessel"], found["distance"]) == (0, 0, 0), found
    # Ties are broken in the same way; the rest is rounding in one pixel of a thousand.
    different = found["depth, unsure or not"] + found["vessel, unsure or not"]
    assert different <= most_different * frame.depth.size, found
    assert found["unsure depth"] <= most_unsure * frame.depth.size, found
    return frame, expected


@each_value
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("seed", range(2))
def test_wandering_vessels(seed, direction, rule):
    tree = wandering(seed)
    assert_same(tree, fitted(tree, direction, FEW), RULES[rule])


@each_value
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("name", ["trefoil", "collinear_run", "y_junction", "helix"])
def test_phantoms(name, direction, rule):
    tree = getattr(phantom, name)().tree
    # With one distance for the whole curve, parts of it at one depth have equal costs.
    most_unsure = 0.01 if "whole" in rule else 0.005
    assert_same(tree, fitted(tree, direction, FEW), RULES[rule], most_unsure)


@each_value
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("levels", [0, 6])
@pytest.mark.parametrize("direction", [(0, 1, 0), (1, 0, 0)])
@pytest.mark.parametrize("seed", range(2))
def test_runs_of_collinear_segments(seed, direction, levels, rule):
    # The center has odd coordinates, so that no pixel lies on the border of a piece.
    camera = Camera((0.1313, 0.2777, 0.3177), direction, (0, 0, 1), (47, 33), 1.37)
    # Vessels that turn back on themselves have several places at the same arc distance from the winner's.
    assert_same(lattice(seed), camera, replace(RULES[rule], levels=levels), most_unsure=0.02)


@each_value
@pytest.mark.parametrize("rule", ["default", "paper"])
@pytest.mark.parametrize("levels", [0, 6])
@pytest.mark.parametrize("seed", range(3))
def test_segments_around_the_collinear_bound(seed, levels, rule):
    tree = nearly_along_y(seed)
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (61, 35), 1.1)
    assert_same(tree, camera, replace(RULES[rule], levels=levels))


@each_value
@pytest.mark.parametrize("rule", ["default", "paper"])
@pytest.mark.parametrize("seed", range(3))
def test_vessels_of_few_points(seed, rule):
    camera = Camera((0, 0, 0), (0.3, 0.5, -0.8), (0.1, 0.2, 1), (61, 35), 0.41)
    assert_same(of_few_points(seed), camera, RULES[rule])


@each_value
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("name", ["wandering", "collinear_run", "y_junction"])
def test_cost_level_and_kind_of_piece(name, direction, rule):
    tree = wandering(3) if name == "wandering" else getattr(phantom, name)().tree
    camera, images = fitted(tree, direction, FEW), ("cost", "level", "piece")
    frame = Renderer(None, tree).cut_surface(camera, RULES[rule], images=images)
    expected = reference_surface.cut_surface(tree, camera, RULES[rule], TOLERANCE)
    sure = ~(expected.unsure_depth | expected.unsure_vessel)
    # Near distance 0 the square root amplifies rounding.
    np.testing.assert_allclose(frame.level[sure], expected.level[sure], rtol=0, atol=0.01)
    # The cost changes by ten times the distance; several places may be equally near in arc length.
    different = np.abs(frame.cost - expected.cost) > 10 * TOLERANCE + expected.slack
    assert different[sure].mean() < 0.003, np.abs(frame.cost - expected.cost)[sure].max()
    assert (frame.piece != expected.kind)[sure].mean() < 0.01
    assert frame.cost.dtype == frame.level.dtype == np.float32
    assert frame.piece.dtype == np.int32


def test_cost_level_and_kind_of_a_straight_vessel():
    # 40 mm along x at depth 5 mm, radius 2 mm; level N at 8 mm from the wall.
    tree = VesselTree([Vessel([(x, 5.0, 0.0) for x in range(-20, 21)], 2.0)])
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (61, 21), 1.0)
    rule = Settings.paper(levels=6, level_distance=8.0)
    frame = Renderer(None, tree).cut_surface(camera, rule, images=["cost", "level", "piece", "depth"])
    x, height = np.arange(61) - 30.0, 10.0 - np.arange(21)[:, None]
    distance = np.hypot(np.maximum(np.abs(x) - 20, 0), height)
    np.testing.assert_allclose(frame.cost, 5 + 10 * np.maximum(distance - 2, 0), rtol=0, atol=1e-4)
    np.testing.assert_allclose(frame.level, np.minimum(np.sqrt(6 * distance / 8), 6), rtol=0, atol=1e-3)
    beyond = np.broadcast_to(np.abs(x) > 20, (21, 61))
    assert (frame.piece[beyond] == 2).all()
    assert (frame.piece[np.broadcast_to(np.abs(x) < 20, (21, 61))] < 2).all()
    along = Renderer(None, tree).cut_surface(
        Camera((0, 5, 0), (1, 0, 0), (0, 0, 1), (9, 9), 1.0), rule, images=["piece", "cost"]
    )
    # The vessel projects to a point: one full plane at its nearest point.
    assert (along.piece == 3).all()
    assert along.cost[4, 4] == -20


def test_a_frame_has_cost_level_and_piece_only_if_asked():
    tree = wandering(0)
    renderer, camera = Renderer(None, tree), fitted(tree, "front", FEW)
    frame = renderer.cut_surface(camera)
    with pytest.raises(VolumeError, match=r"cost of the frame: found a frame that was not asked for it"):
        _ = frame.cost
    both = renderer.cut_surface(camera, images=["cost", "depth"])
    assert both.has("cost")
    assert both.has("depth")
    assert not both.has("level")
    np.testing.assert_array_equal(both.depth, frame.depth)
    with pytest.raises(SettingsError, match="'cost', 'level', 'piece'"):
        renderer.cut_surface(camera, images=["picture"])


@each_value
@pytest.mark.parametrize("unknown_radius", [0.0, 1.0, 4.0])
@pytest.mark.parametrize("known", ["none", "every second", "not at some points"])
def test_vessels_without_radius_count_as_lumen(known, unknown_radius):
    tree = VesselTree(
        Vessel(one.points, known_radius(one.radius, known if n % 2 else "none"))
        for n, one in enumerate(wandering(2))
    )
    assert_same(tree, fitted(tree, "oblique"), replace(PLAIN, unknown_radius=unknown_radius))


def known_radius(radius, known):
    """Return the radii, where known."""
    if known == "not at some points":
        return np.where(np.arange(len(radius)) // 8 % 2, radius, 0.0)
    return radius if known == "every second" else None


@each_value
@pytest.mark.parametrize(
    "changes",
    [
        {"cost_weight": 0.0},
        {"cost_weight": 0.5},
        {"cost_weight": 300.0},
        {"levels": 0},
        {"levels": 1},
        {"levels": 15},
        {"preserve_lumen": False},
        {"level_distance": 2.0},
        {"level_distance": 100.0},
        {"lumen_first": True, "lumen_margin": 0.0},
        {"lumen_first": True, "lumen_margin": 5.0},
        {"lumen_first": True, "preserve_lumen": False, "lumen_margin": 2.0},
        {"lumen_first": False, "lumen_margin": 5.0},
        {"lumen_first": False, "level_choice": "own"},
        {"lumen_first": True, "level_choice": "nearest"},
    ],
    ids=str,
)
@pytest.mark.parametrize("rule", ["default", "paper"])
def test_every_setting_in_a_dense_tree(changes, rule):
    tree = wandering(7, vessels=40, points=24)
    camera = Camera((1, 2, 3), (0.3, 0.5, -0.8), (0.1, 0.2, 1), (21, 16), 5.4)
    assert_same(tree, camera, replace(RULES[rule], **changes), most_unsure=0.01)


def test_far_from_the_origin_of_world_space():
    tree = VesselTree([Vessel(v.points + np.array([1500, -2000, 900]), v.radius) for v in wandering(8)])
    camera = Camera((1501, -1998, 903), (0.3, 0.5, -0.8), (0.1, 0.2, 1), (53, 35), 2.1)
    assert_same(tree, camera, PLAIN)


@each_value
@needs_shared_data
@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize(
    "file",
    [
        "stent-cta/centerlines.vtp",
        "dissection-cta/aorta_arch_centerlines_LPS.vtp",
        "aorta-mra/aorta_full_centerlines_LPS.vtp",
    ],
)
def test_real_trees(file, direction, rule, shared_data):
    tree = read_centerlines(shared_data / file)
    # Within rounding, several places along a bend may have the same arc distance from the winner's.
    assert_same(tree, fitted(tree, direction, (22, 19)), RULES[rule], most_unsure=0.02, most_different=0.003)


@each_value
@pytest.mark.parametrize(
    "changes",
    [
        {"cost_weight": 14.0},
        {"levels": 5},
        {"level_distance": 8.4},
        {"preserve_lumen": False},
        {"lumen_first": True},
        {"lumen_first": False},
        {"lumen_margin": 0.5},
        {"level_choice": "nearest"},
        {"level_choice": "own"},
        {"unknown_radius": 1.5},
    ],
    ids=str,
)
@pytest.mark.parametrize("rule", ["default", "paper"])
def test_the_comparison_sees_a_wrong_setting(changes, rule):
    tree = VesselTree(Vessel(one.points, one.radius if n else None) for n, one in enumerate(wandering(0)))
    camera = fitted(tree, "oblique")
    frame = Renderer(None, tree).cut_surface(camera, RULES[rule])
    changed = replace(RULES[rule], **changes)
    found = differences(frame, reference_surface.cut_surface(tree, camera, changed, TOLERANCE))
    if changed == RULES[rule] or (rule == "paper" and changes.keys() & {"lumen_margin", "unknown_radius"}):
        # The rule itself, or settings without effect under this rule.
        assert found["depth"] == found["vessel"] == 0, found
    else:
        assert found["depth"] > 10, found


def test_the_comparison_sees_a_wrong_tree_and_a_wrong_view():
    tree = wandering(0)
    camera = fitted(tree, "oblique")
    frame = Renderer(None, tree).cut_surface(camera, PLAIN)
    moved = VesselTree([Vessel(v.points + np.array([0, 0.01, 0]), v.radius) for v in tree])
    swapped = VesselTree(list(tree)[::-1])
    scenes = {
        "depth": (moved, camera),
        "vessel": (swapped, camera),
        "distance": (tree, camera.panned(0.05, 0)),
    }
    for what, (other, view) in scenes.items():
        assert differences(frame, reference_surface.cut_surface(other, view, PLAIN))[what] > 1000


integers = st.integers(-3, 3).map(float)
tangles = st.lists(
    st.lists(st.tuples(integers, integers, integers), min_size=2, max_size=9), min_size=1, max_size=4
)


@odd_lines
@settings(max_examples=100, deadline=None)
@given(tangles, st.sampled_from([(0, 1, 0), (1, 0, 0), (1, 1, 1)]), st.booleans())
def test_tangles_of_points_with_whole_coordinates(lines, direction, lumen_first):
    tree = VesselTree([Vessel(line, 0.25 * number) for number, line in enumerate(lines)])
    camera = Camera((0.0613, 0.0777, 0.0419), direction, (0, 0, 1), (9, 7), 0.93)
    changed = replace(PLAIN, levels=0, lumen_first=lumen_first)
    frame = Renderer(None, tree).cut_surface(camera, changed)
    found = differences(frame, reference_surface.cut_surface(tree, camera, changed))
    assert (found["depth"], found["vessel"], found["distance"]) == (0, 0, 0), found


def test_levels_of_detail():
    tree = of_few_points(1)
    for found, expected in zip(tree.levels(6), reference.levels_of(tree, 6), strict=True):
        for vessel, (points, radius, _) in zip(found, expected, strict=True):
            np.testing.assert_allclose(vessel.points, points, rtol=0, atol=1e-10)
            np.testing.assert_allclose(vessel.radius, radius, rtol=0, atol=1e-10)


@each_value
@pytest.mark.parametrize("spacing", [0.5, 2.0])
@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("seed", range(2))
def test_silhouettes_of_leaps_and_how_far_apart_blends_are(seed, direction, spacing):
    tree = wandering(seed)
    camera = replace(fitted(tree, direction, (61, 47)), pixel_spacing=spacing)
    found = Renderer(None, tree)._core.details(camera, checked(Settings(silhouette_reach=None)))
    surface = reference_surface.cut_surface(tree, camera, Settings(), TOLERANCE)
    strength, doubt = reference_images.silhouettes(surface, camera, 0.01)
    assert doubt.mean() < 0.1
    # At 2 mm per pixel lines have half their strength.
    assert (strength[~doubt] > 0.4).any()
    np.testing.assert_allclose(found["strength"][~doubt], strength[~doubt], rtol=0, atol=1e-5)
    sure = ~(surface.unsure_depth | surface.unsure_vessel)
    assert sure.mean() > 0.99
    np.testing.assert_allclose(found["sheet_gap"][sure], surface.gap[sure], rtol=0, atol=1e-2)


def oblique_affine():
    """Return a sheared, left-handed grid around the origin: about 3 mm per voxel, 40 × 36 × 30 voxels."""
    columns = np.array([[3.0, 0.4, -0.3], [-0.5, 3.2, 0.2], [0.6, 0.1, -3.4]])
    affine = np.eye(4)
    affine[:3, :3], affine[:3, 3] = columns, -columns @ (19.5, 17.5, 14.5)
    return affine


@pytest.mark.parametrize("rule", [Settings(), Settings.paper()], ids=["default", "paper"])
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_from_end_to_end(direction, rule):
    k, j, i = np.mgrid[:30, :36, :40]
    volume = Volume((2.0 * i - 1.5 * j + 3.0 * k).astype(np.float64), world_from_index=oblique_affine())
    tree = wandering(6)
    frame = Renderer(volume, tree).render(fitted(tree, direction), rule)
    surface = reference_surface.cut_surface(tree, frame.camera, rule)
    unsure = (surface.unsure_depth | (surface.unsure_vessel & rule.zone_filter)).astype(float)
    near_unsure = reference_images.depth_filter(unsure) > 0
    if rule.zone_filter:
        leap = rule.depth_leap
        depth, doubt = reference_images.zone_filter(surface.depth, surface.vessel, leap, 4 * TOLERANCE)
        near_unsure |= doubt
    else:
        depth = reference_images.depth_filter(surface.depth)
    assert near_unsure.mean() < 0.1
    position = reference_images.position(depth, frame.camera)
    sure = ~near_unsure
    np.testing.assert_allclose(frame.depth[sure], depth[sure], rtol=0, atol=TOLERANCE)
    np.testing.assert_allclose(frame.position[sure], position[sure], rtol=0, atol=TOLERANCE)
    # The value changes by less than 2 per mm of depth.
    value = reference_images.trilinear(volume, position)
    np.testing.assert_allclose(frame.value[sure], value[sure], rtol=0, atol=2 * TOLERANCE)
