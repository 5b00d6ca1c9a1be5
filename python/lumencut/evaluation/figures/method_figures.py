"""Figures 2, 3, 5 and 6 of the paper: how the cut surface is made."""

from __future__ import annotations

import numpy as np

from lumencut.evaluation.figures import drawing
from lumencut.evaluation.figures.drawing import Picture
from lumencut.evaluation.figures.figure import Figure, Panel
from lumencut.evaluation.figures.scenes import RULES, Scenes, settings_of, uneven_line
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree


def cost_of_a_knot(scenes: Scenes) -> Figure:
    """Figure 2: how the cost resolves the visibility of a trefoil knot."""
    renderer = scenes.trefoil
    camera, tree = scenes.anterior(renderer), _tree(renderer)
    found = {rule: scenes.surface(renderer, camera, settings_of(rule)) for rule in RULES}
    side = camera.pixel_spacing
    literal = settings_of("paper", distance_rule="whole curve")
    hidden = renderer.cut_surface(camera, literal, images=["depth"]).depth
    return Figure(
        "Figure 2",
        "A cost orders the surfaces that lie above each other along a ray; the smallest one is shown. The "
        "knot crosses itself three times.",
        [
            Panel("a", "The trefoil knot as a wireframe.", {"": scenes.wireframe(renderer, camera, None)}),
            Panel(
                "b",
                "Depth of the cut surface; near is bright.",
                {rule: drawing.grey(frame.depth) for rule, frame in found.items()},
            ),
            Panel(
                "c",
                "The cost of Equation 2 in place of the depth, lit; little cost is bright.",
                {rule: drawing.relief(frame.cost, side) for rule, frame in found.items()},
            ),
            Panel(
                "d",
                "Depth with the distance to the whole curve, Equation 2 to the letter: most of the knot is "
                "hidden. The paper's figure shows the distance to each part, as the others here do.",
                {"": drawing.with_centerlines(drawing.grey(hidden), tree, camera)},
            ),
        ],
    )


def levels_of_an_uneven_line(scenes: Scenes) -> Figure:
    """Figure 3: small bends fold the surface, and levels of detail unfold it."""
    tree = uneven_line()
    camera = Camera.fitted(tree, (0, 1, 0), (0, 0, 1), scenes.size).zoomed(0.8)
    coarser = tree.levels(4)
    steps = [
        ("a", "The centerline as given: its waves fold the surface.", tree, 0),
        ("b", "Level 2 of the centerline everywhere.", coarser[2], 0),
        ("c", "Level 4 everywhere: the surface is smooth, but the line has lost its shape.", coarser[4], 0),
        ("d", "Levels by distance: the shape near the line, a smooth surface farther away.", tree, 6),
    ]
    panels = []
    for part, caption, shown, levels in steps:
        pictures = {}
        for rule in RULES:
            settings = settings_of(rule, levels=levels)
            frame = Renderer(None, shown, scenes.device).cut_surface(camera, settings, images=["depth"])
            surface = drawing.relief(frame.depth, camera.pixel_spacing)
            pictures[rule] = drawing.with_centerlines(surface, shown, camera)
        panels.append(Panel(part, caption, pictures))
    return Figure("Figure 3", "The surface of a centerline with small bends, lit; the line is red.", panels)


def zones_and_lines(scenes: Scenes) -> Figure:
    """Figure 5: zones of vessels, and lines where the depth jumps."""
    renderer = scenes.aorta
    camera = Camera.inferior(renderer.scene, scenes.size)
    zones: dict[str, Picture] = {}
    pictures: dict[str, Picture] = {}
    for rule in RULES:
        frame = renderer.render(camera, settings_of(rule), images=["image", "vessel"])
        zones[rule], pictures[rule] = drawing.zones(frame.vessel), frame.image[..., :3]
    return Figure(
        "Figure 5",
        "The aorta from below.",
        [
            Panel("a", "A colour for the zone of each vessel.", zones),
            Panel("b", "Lines where the depth of the cut surface jumps.", pictures),
        ],
    )


def steps_of_the_method(scenes: Scenes) -> Figure:
    """Figure 6: the steps from the centerlines to the picture."""
    renderer = scenes.aorta
    tree, camera = _tree(renderer), scenes.anterior(renderer)
    black = np.zeros((*scenes.size[::-1], 3), np.uint8)
    segments = sum(len(vessel.points) - 1 for vessel in tree)
    kinds: dict[str, Picture] = {}
    images: dict[str, dict[str, Picture]] = {name: {} for name in ("depth", "cost", "level", "picture")}
    side = camera.pixel_spacing
    for rule in RULES:
        settings = settings_of(rule)
        finest = scenes.surface(renderer, camera, settings_of(rule, levels=0, depth_filter=False))
        kinds[rule] = drawing.lit(drawing.pieces(finest.piece), finest.depth, side)
        frame = scenes.surface(renderer, camera, settings)
        images["depth"][rule] = drawing.grey(frame.depth)
        images["cost"][rule] = drawing.relief(frame.cost, side)
        images["level"][rule] = drawing.levels(frame.level)
        images["picture"][rule] = _picture(renderer, camera, settings)
    return Figure(
        "Figure 6",
        "The steps of the method, from the centerlines to the picture.",
        [
            Panel(
                "a",
                f"The centerlines, {segments} segments.",
                {"": drawing.with_centerlines(black, tree, camera)},
            ),
            Panel(
                "b",
                "Pieces of the finest level: stripes dark brown, wedges light brown, half-planes dark blue, "
                "full planes light blue.",
                kinds,
            ),
            Panel("c", "Depth after the filter; near is bright.", images["depth"]),
            Panel("d", "The cost in place of the depth, lit.", images["cost"]),
            Panel("e", "Levels of detail: even ones green, odd ones red.", images["level"]),
            Panel("f", "The picture with the context around the cut surface.", images["picture"]),
        ],
    )


def _picture(renderer: Renderer, camera: Camera, settings: Settings) -> Picture:
    picture: Picture = renderer.render(camera, settings, images=["image"]).image[..., :3]
    return picture


def _tree(renderer: Renderer) -> VesselTree:
    tree = renderer.tree
    assert tree is not None
    return tree
