"""Tables 1 and 2 and Figure 9 of the paper."""

from __future__ import annotations

import os
import platform

from lumencut.evaluation import evaluate
from lumencut.evaluation.figures.figure import Figure
from lumencut.evaluation.figures.scenes import RULES, Scenes, settings_of

#: Stages of a frame and the paper's names of them.
_STAGES = {
    "distance": "level of detail estimation",
    "depth": "depth",
    "depth_filter": "depth filter",
    "surface": "surface",
    "silhouette": "silhouettes",
    "context": "context",
}
_ASPECTS = [
    ["", "CPR", "CR", "CSR"],
    ["lumen is read", "per pixel of a plane", "per pixel of a plane", "along a ray in the volume"],
    ["direction of vessels", "near the axis of the picture", "any", "any"],
    ["direction of view", "around one axis", "around one axis", "any"],
    ["nearer vessels in front", "no", "within discs", "in every pixel"],
    ["tissue around vessels", "whole", "traded for visibility", "whole, with cutaways"],
]
_CRITERIA = {
    "lumen_within_0.5_mm_percent": "lumen within 0.5 mm (%)",
    "width_error_mean_mm": "error of widths (mm)",
    "tissue_percent": "tissue in the picture (%)",
    "unbroken_surroundings_percent": "unbroken surroundings (%)",
    "visible_centerline_percent": "visible centerline shown (%)",
    "crossings_in_order_percent": "crossings in order (%)",
    "leaps_with_line_percent": "leaps with a line (%)",
}
_VIEWS, _VIEW_SIZE = 4, (192, 192)


def aspects(_: Scenes) -> Figure:
    """Table 1: what CPR, CR and CSR can show."""
    return Figure("Table 1", "What the methods can show, by their construction.", table=_ASPECTS)


def timings(scenes: Scenes) -> Figure:
    """Table 2: time of each stage (ms)."""
    renderers = {"Figure 1": scenes.aorta, "Figure 7": scenes.legs, "Figure 8": scenes.neck}
    columns = [(name, rule) for name in renderers for rule in RULES]
    frames = {}
    for name, renderer in renderers.items():
        camera = scenes.anterior(renderer)
        for rule in RULES:
            # The first frame prepares what later ones reuse.
            for _ in range(2):
                frames[name, rule] = renderer.render(camera, settings_of(rule), images=["image"])
    table = [["stage (ms)", *(f"{name}, {RULES[rule]}" for name, rule in columns)]]
    for stage, words in _STAGES.items():
        times = [frames[column].timings.get(stage) for column in columns]
        table.append([words, *("–" if ms is None else f"{ms:.1f}" for ms in times)])
    table.append(["whole frame", *(f"{sum(frames[column].timings.values()):.1f}" for column in columns)])
    width, height = scenes.size
    device = scenes.aorta.device
    machine = f"{platform.machine()}, {os.cpu_count()} cores"
    caption = f"Time of each stage at {width} × {height} pixels by {device} on this machine ({machine})."
    return Figure("Table 2", caption, table=table)


def criteria(scenes: Scenes) -> Figure:
    """Figure 9: the five criteria, measured instead of asked."""
    renderer = scenes.neck
    assert renderer.tree is not None
    methods = ("csr", "csr-paper", "mpcpr", "cr")
    found = evaluate(renderer.volume, renderer.tree, methods, _VIEWS, size=_VIEW_SIZE, device=scenes.device)
    table = [["", *(str(row["method"]) for row in found.table)]]
    for column, words in _CRITERIA.items():
        numbers = [row[column] for row in found.table]
        table.append([words, *("–" if number is None else f"{number:.4g}" for number in numbers)])
    caption = (
        f"The paper asked twelve radiologists. Here each criterion is measured over {_VIEWS} views of the "
        "phantom of the neck; `lumencut evaluate` explains the numbers."
    )
    return Figure("Figure 9", caption, table=table)
