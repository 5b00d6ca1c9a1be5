"""The settings of the list of frames: every setting at several values.

Only varied settings are named, so settings added later change nothing here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from lumencut import Focus, Opacity, Settings, Slab, TransferFunction, Window

Values = dict[str, Any]
"""Settings by their names."""
POINTS = TransferFunction(
    ((100, (20, 200, 90), 0.0), (250, (250, 40, 10), 0.2), (900, (255, 250, 200), 0.9)),
)
TRANSFERS: dict[str, str | TransferFunction] = {
    **{name: name for name in ("grey", "angio", "bone", "soft-tissue")},
    "of three points": POINTS,
    "of one point": TransferFunction(((300, (200, 180, 160), 0.03),)),
    "with a step": TransferFunction(
        ((0, (0, 0, 255), 0.01), (200, (0, 0, 255), 0.02), (200, (255, 0, 0), 0.5))
    ),
    "of 64 points": TransferFunction(tuple((10 * n, (4 * n, 255 - 4 * n, 128), n / 64) for n in range(64))),
}
"""The values of `context_transfer`."""
PAPER: Values = {
    name: value for name, value in vars(Settings.paper()).items() if value != getattr(Settings(), name)
}
"""In what the paper's rules differ from the defaults."""
MODES: tuple[str, ...] = ("mida", "dvr", "mip", "minip", "average")
SEE_THROUGH = Opacity(50, 300)
"""An opacity that lets the context be seen in the middle of the vessels' surroundings."""


def each(name: str, values: Iterable[Any], **others: Any) -> Iterator[tuple[str, Values]]:
    """One setting at several values, the `others` fixed."""
    for value in values:
        yield f"{name} {worded(value)}", {name: value, **others}


def worded(value: Any) -> str:
    """A value as a part of a file name."""
    if isinstance(value, (Window, Opacity, Slab, Focus)):
        return " ".join(str(one) for one in vars(value).values())
    return " ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def surface_settings() -> Iterator[tuple[str, Values]]:
    """The settings that shape the cut surface."""
    yield from each("cost_weight", (0, 1, 3, 30, 100, 10_000))
    yield from each("levels", range(16))
    yield from each("level_distance", (0.5, 2, 20, 1000))
    yield "depth_filter False", {"depth_filter": False}
    for first in (False, True):
        within: Values = {"zone_filter": True, "lumen_first": first}
        yield f"zone_filter, lumen_first {first}", within
        yield from (
            (f"zone_filter, lumen_first {first}, {what}", {**within, **values})
            for what, values in each("depth_leap", (0.2, 5))
        )
    yield "preserve_lumen False", {"preserve_lumen": False}
    yield "centerlines at a low weight", {"preserve_lumen": False, "cost_weight": 3, "levels": 2}
    yield "lumen_first", {"lumen_first": True}
    yield "lumen_first False", {"lumen_first": False}
    yield from each("lumen_margin", (0, 0.5, 2, 10), lumen_first=True)
    yield "lumen_margin 2 alone", {"lumen_margin": 2}
    yield "lumen_margin 2, lumen_first False", {"lumen_margin": 2, "lumen_first": False}
    yield from each("unknown_radius", (0, 3, 20))
    yield "unknown_radius 3 of centerlines", {"unknown_radius": 3, "preserve_lumen": False}
    yield "lumen_first of centerlines", {"lumen_first": True, "preserve_lumen": False}
    yield "lumen_first, finest level", {"lumen_first": True, "levels": 0, "depth_filter": False}
    for choice in ("own", "nearest"):
        for first in (False, True):
            chosen: Values = {"level_choice": choice, "lumen_first": first}
            yield f"level_choice {choice}, lumen_first {first}", chosen
            yield f"level_choice {choice}, lumen_first {first}, unfiltered", {**chosen, "depth_filter": False}
    curve: Values = {"distance_rule": "whole curve", "lumen_first": False}
    yield "distance_rule whole curve, lumen_first False", curve
    yield "paper", PAPER
    yield "paper, distance_rule whole curve", {**PAPER, "distance_rule": "whole curve"}
    yield from ((f"paper, {what}", {**PAPER, **values}) for what, values in each("levels", (0, 3, 15)))
    yield "paper, unfiltered", {**PAPER, "depth_filter": False}
    yield "paper, lumen_first", {**PAPER, "lumen_first": True}
    yield from each("centerline_smoothing", (0.5, 2))
    yield from each("samples", (2, 3, 4))
    yield from each("edge_samples", (1, 2, 4))
    yield from each("turning_limit", (1, 4))


def picture_settings() -> Iterator[tuple[str, Values]]:
    """The settings that show the cut surface."""
    windows = [(300, 900), (100, 400), (40, 1e-3), (0, 1e6), (-50, 80)]
    yield from each("window", (Window(*one) for one in windows))
    ramps = [(50, 300), (300, 50), (200, 200), (-1000, 1000), (1e6, 2e6)]
    yield from each("opacity", (Opacity(*one) for one in ramps))
    yield "silhouettes False", {"silhouettes": False}
    for rule in ("leap", "gradient"):
        for choice in ("own", "nearest"):
            rules: Values = {"silhouette_rule": rule, "level_choice": choice}
            yield f"silhouette_rule {rule}, level_choice {choice}", rules
        yield f"silhouette_rule {rule}, unfiltered", {"silhouette_rule": rule, "depth_filter": False}
    # It acts only under this rule.
    yield from each("silhouette_slope", (0.001, 1, 8, 100, 1e6), silhouette_rule="gradient")
    yield from each("silhouette_reach", (None, 0, 1, 5, 40))
    yield from each("silhouette_reach", (8,), silhouette_rule="gradient")
    yield from each("far_rim", (0, 1))
    yield from each("occlusion", (0.6, 1))
    yield from each("silhouette_color", ((255, 0, 128), (0, 0, 0)))
    slope: Values = {"depth_filter": False, "silhouette_rule": "gradient", "silhouette_slope": 4}
    yield "silhouettes on a filter-free surface", slope
    yield from each("rim", ("diameter",))
    yield from each("rim_low", (2, 6), rim="diameter", rim_high=20)
    yield from each("rim_high", (8, 30), rim="diameter", rim_low=1)
    yield "paper, rim diameter", {**PAPER, "rim": "diameter"}
    backgrounds = [(10, 200, 30, 128), (255, 255, 255, 0), (20, 40, 60, 255), (0, 0, 0, 1)]
    yield from each("background", backgrounds, context=None, opacity=SEE_THROUGH)
    for background in backgrounds[:2]:
        both: Values = {"background": background, "opacity": SEE_THROUGH}
        yield f"background {worded(background)} behind the context", both
    for mode in ("max", "mean", "min"):
        yield from each("slab", (Slab(thickness, mode) for thickness in (0, 0.5, 4, 40, 1000)))
    yield from each("focus", (Focus(2, 6), Focus(-1, 4), Focus(0, 0), Focus(10, 40), Focus(1e6, 6)))
    yield from each("focus_vessels", ((0,), (2, 7)))
    levels: Values = {"focus_vessels": (2, 7), "level_choice": "nearest", "silhouettes": False}
    yield "focus_vessels 2 7, level_choice nearest", levels
    chosen: Values = {"focus": Focus(1, 9), "focus_vessels": (2,)}
    yield from each("others_strength", (0, 0.8, 1), **chosen)
    yield "focus and opacity", {"focus": Focus(1, 20), "opacity": SEE_THROUGH}
    yield from each("tree", ("wireframe",))
    yield "tree wireframe, samples 2", {"tree": "wireframe", "samples": 2}
    yield "slab and opacity", {"slab": Slab(6, "mean"), "opacity": SEE_THROUGH}


def context_settings() -> Iterator[tuple[str, Values]]:
    """The settings of the context."""
    yield from each("context", (None, *MODES[1:]))
    for mode in (None, *MODES):
        yield f"context {mode} behind", {"context": mode, "opacity": SEE_THROUGH}
    behind: Values = {"opacity": SEE_THROUGH}
    yield from each("context_gamma", (-1, -0.7, -0.3, 0.2, 0.4, 0.8, 1), **behind)
    for mode in ("mida", "dvr", "minip", "average"):
        for window in (Window(50, 100), Window(300, 900)):
            what = f"{mode}, context_window {worded(window)}"
            yield what, {"context": mode, "context_window": window, **behind}
    for mode in MODES[:3]:
        for name, transfer in TRANSFERS.items():
            yield (
                f"{mode}, context_transfer {name}",
                {"context": mode, "context_transfer": transfer, **behind},
            )
    for mode in MODES:
        for start in ("cut", "whole"):
            around: Values = {"focus": Focus(1, 10), "context_from": start}
            yield f"{mode}, context_from {start}", {"context": mode, **around}
    yield from each("context_strength", (0, 0.5, 0.65), focus=Focus(0, 12))
    yield from each("context_halo", (0.6, 1), focus=Focus(0, 12))
    yield "context_body", {"context_body": True, "focus": Focus(2, 6)}
    for mode in MODES[:2]:
        for step in (0.7, 2.7, 50):
            yield f"{mode}, context_step {step}", {"context": mode, "context_step": step, **behind}
    for mode in MODES:
        yield f"{mode}, context_preview", {"context": mode, "context_preview": True, **behind}
    for mode in MODES[:2]:
        shaded = {"context": mode, "context_shading": True, **behind}
        yield f"{mode}, context_shading", shaded
        yield f"{mode}, context_shading, preview", {**shaded, "context_preview": True}
        yield f"{mode}, context_shading, soft-tissue", {**shaded, "context_transfer": "soft-tissue"}
    yield (
        "blend of shaded points",
        {"context_gamma": 0.4, "context_shading": True, "context_transfer": POINTS},
    )
