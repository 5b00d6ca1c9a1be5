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
from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, Volume, phantom, read_centerlines
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
    assert_same(tree, fitted(tree, direction, FEW), RULES[rule])


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


def test_on_a_tie_the_smaller_id_wins_to_the_bit():
    once = wandering(3)
    twice = VesselTree([v for vessel in once for v in (vessel, vessel)])
    camera = fitted(once, "oblique")
    first, second = (Renderer(None, tree).cut_surface(camera) for tree in (once, twice))
    np.testing.assert_array_equal(second.vessel, 2 * first.vessel)
    np.testing.assert_array_equal(second.depth, first.depth)
    np.testing.assert_array_equal(second.distance, first.distance)


@pytest.mark.parametrize("link", [True, False], ids=["one vessel", "two vessels"])
@pytest.mark.parametrize("deep_first", [True, False])
def test_on_a_tie_the_earlier_piece_wins(deep_first, link):
    # From the front, 1.5 mm above the shallow line both costs are equal: 0 + 10 · 1.5 = 10 + 10 · 0.5.
    lines = [[[-64.0, 0, 0], [64, 0, 0]], [[64.0, 10, 2], [-64, 10, 2]]]
    lines = lines[::-1] if deep_first else lines
    tree = VesselTree([Vessel(np.concatenate(lines))] if link else [Vessel(line) for line in lines])
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (2, 8), 1.0)
    frame = Renderer(None, tree).cut_surface(camera, replace(PAPER, levels=0))
    deep = 0 if link else 1 - deep_first
    np.testing.assert_array_equal(frame.depth[[1, 2, 3], 0], [10, 10 * deep_first, 0])
    np.testing.assert_array_equal(frame.vessel[[1, 2, 3], 0], [deep, 0, 0 if link else 1 - deep])


@pytest.mark.parametrize("apart", [0.0, 1e-9, 5e-4, 2e-3])
def test_a_point_nearly_repeated_changes_little(apart):
    line = np.array([[-20.0, 0, 0], [0, 10, 0], [0, 60, 20], [-20, 70, 20]])
    rule = replace(PLAIN, levels=0)
    camera = Camera((0, 30, 0), (0, 1, 0), (0, 0, 1), (60, 60), 1.0)
    exact, near = (
        Renderer(None, VesselTree([Vessel(np.insert(line, 1, line[1] - (d, 0, 0), axis=0), 1.0)]))
        for d in (0.0, apart)
    )
    error = np.abs(near.cut_surface(camera, rule).depth - exact.cut_surface(camera, rule).depth)
    assert (error > 0.1).mean() < 0.002


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


@pytest.mark.parametrize("tree", [wandering(1), of_few_points(1), lattice(1)], ids=["long", "short", "odd"])
def test_levels_of_detail(tree):
    for found, expected in zip(tree.levels(6), reference.levels_of(tree, 6), strict=True):
        for vessel, (points, radius, _) in zip(found, expected, strict=True):
            np.testing.assert_allclose(vessel.points, points, rtol=0, atol=1e-10)
            np.testing.assert_allclose(vessel.radius, radius, rtol=0, atol=1e-10)
            assert (vessel.points[[0, -1]] == points[[0, -1]]).all()


@pytest.mark.parametrize("size", [(53, 37), (3, 2), (1, 1)])
def test_depth_filter(size):
    renderer, camera = Renderer(None, tree := wandering(2)), fitted(wandering(2), "oblique", size)
    raw, smooth = renderer.cut_surface(camera, PAPER), renderer.cut_surface(camera, Settings.paper())
    assert len(tree) > raw.vessel.max()
    np.testing.assert_allclose(smooth.depth, reference_images.depth_filter(raw.depth), rtol=0, atol=1e-4)
    np.testing.assert_array_equal(smooth.vessel, raw.vessel)
    np.testing.assert_array_equal(smooth.distance, raw.distance)


@each_value
@pytest.mark.parametrize("leap", [0.0, 0.05, 1.0, 1e6])
@pytest.mark.parametrize("size", [(53, 37), (3, 2), (1, 9), (1, 1)])
@pytest.mark.parametrize("rule", [PLAIN, PAPER], ids=["default", "paper"])
def test_the_filter_within_zones(rule, size, leap):
    renderer, camera = Renderer(None, wandering(2)), fitted(wandering(2), "oblique", size)
    filtered = replace(rule, depth_filter=True, zone_filter=True, depth_leap=leap)
    raw, smooth = renderer.cut_surface(camera, rule), renderer.cut_surface(camera, filtered)
    # If no pair counts, nothing is in doubt.
    tolerance = 1e-4 if leap else -1.0
    expected, doubt = reference_images.zone_filter(raw.depth.astype(float), raw.vessel, leap, tolerance)
    assert doubt.mean() < 0.02
    np.testing.assert_allclose(smooth.depth[~doubt], expected[~doubt], rtol=0, atol=1e-4)
    np.testing.assert_array_equal(smooth.vessel, raw.vessel)
    if size == (53, 37) and leap in (0.05, 1.0):
        other, _ = reference_images.zone_filter(raw.depth.astype(float), raw.vessel, 2 * leap, 1e-4)
        assert (np.abs(other - smooth.depth) > 1e-3).sum() > 10
    if leap == 0:
        np.testing.assert_array_equal(smooth.depth, raw.depth)


@each_value
@pytest.mark.parametrize("spacing", [0.5, 2.0])
@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("seed", range(2))
def test_silhouettes_of_leaps_and_how_far_apart_blends_are(seed, direction, spacing):
    tree = wandering(seed)
    camera = replace(fitted(tree, direction, (61, 47)), pixel_spacing=spacing)
    found = Renderer(None, tree)._core.details(camera, checked(Settings()))
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


@each_value
@pytest.mark.parametrize("dtype", ["uint8", "int16", "uint16", "float32", "float64"])
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_value_and_position(direction, dtype):
    voxels = np.random.default_rng(4).uniform(0, 250, (30, 36, 40)).astype(dtype)
    volume, tree = Volume(voxels, world_from_index=oblique_affine()), wandering(5)
    frame = Renderer(volume, tree).render(fitted(tree, direction))
    position = reference_images.position(frame.depth.astype(float), frame.camera)
    np.testing.assert_allclose(frame.position, position, rtol=0, atol=1e-9)
    expected = reference_images.trilinear(volume, position)
    assert 0.05 < np.isnan(expected).mean() < 0.95, "inside and outside must both be seen"
    np.testing.assert_allclose(frame.value, expected, rtol=0, atol=1e-3)


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
