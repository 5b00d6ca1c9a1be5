"""The frames that compare two states of the code: every setting, many views and scenes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

from frames.scenes import ARRAYS, DTYPES, GRIDS, RANGES, SMALL, STENOSES, TREES
from frames.settings import (
    MODES,
    POINTS,
    SEE_THROUGH,
    Values,
    context_settings,
    picture_settings,
    surface_settings,
    worded,
)
from lumencut import VIEWS, Camera, Opacity, Slab, VesselTree, Volume, Window

Axis = Literal["up", "right", "direction"] | tuple[float, float, float]

OBLIQUE = ((0.4, 1.0, -0.3), (0.1, 0.2, 1.0))
"""Direction and up of the view that runs along no axis."""

THIN = [(1, 1), (1, 17), (17, 1)]
"""Sizes of less than a tile."""


@dataclass(frozen=True)
class View:
    """A view that is fitted to its scene and then turned, moved and magnified."""

    direction: str = "oblique"
    size: tuple[int, int] = (113, 91)
    turn: float = 0.0
    axis: Axis = "up"
    zoom: float = 1.0
    right: float = 0.0

    def camera(self, scene: VesselTree | Volume) -> Camera:
        """The camera of this view of a scene."""
        direction, up = OBLIQUE if self.direction == "oblique" else VIEWS[self.direction]
        fitted = Camera.fitted(scene, direction, up, self.size)
        return fitted.rotated(self.turn, self.axis).panned(self.right, 0.0).zoomed(self.zoom)


@dataclass(frozen=True)
class Entry:
    """One frame of the list."""

    scene: str
    what: str
    values: Values = field(default_factory=dict)
    view: View = View()
    shows: Literal["all", "cut surface", "context"] = "all"
    """All that the scene has, its tree without its volume, or its volume without its tree."""
    devices: tuple[str, ...] = ("cpu", "gpu")
    """What renders it."""
    cpu_stages: str = ""
    """The stages that the CPU does in the GPU's place."""

    @property
    def name(self) -> str:
        """The name of the frame, a file name too."""
        return f"{self.scene}, {self.what}"


def views() -> Iterator[tuple[str, View]]:
    """Views from all sides, in many sizes."""
    for name in VIEWS:
        yield name, View(name)
    axes: list[tuple[float, Axis]] = [(0.3, "up"), (-1.2, "right"), (0.7, "direction"), (2.5, (1, 2, 3))]
    for turn, axis in axes:
        yield f"turned {turn} about {worded(axis)}", View(turn=turn, axis=axis)
    for zoom in (0.2, 3, 40, 1e4):
        yield f"zoomed {zoom}", View("anterior", zoom=zoom)
    for right in (-60.0, 1e4):
        yield f"panned {right}", View("left", right=right)
    sizes = [*THIN, (2, 2), (7, 9), (8, 8), (16, 16), (63, 65), (64, 64), (300, 5), (257, 257)]
    for width, height in sizes:
        yield f"{width} x {height}", View("left", (width, height))
    yield "420 x 420", View(size=(420, 420))


def of_workload() -> Iterator[Entry]:
    """Every setting and every view of one scene, and its context alone."""
    scene = "aorta"
    yield Entry(scene, "default")
    for what, values in (*surface_settings(), *picture_settings(), *context_settings()):
        yield Entry(scene, what, values)
    for what, view in views():
        yield Entry(scene, what, view=view)
    for what, values in surface_settings():
        if not what.startswith(("levels ", "level_distance ")):
            yield Entry(scene, f"{what}, anterior", values, View("anterior", (96, 80)))
    for size in (*THIN, (257, 257)):
        values = {"context": "dvr", "context_preview": True, "opacity": SEE_THROUGH}
        yield Entry(scene, f"preview {size[0]} x {size[1]}", values, View("anterior", size))
    for mode in MODES:
        for name in ("anterior", "oblique"):
            view = View(name, (83, 96))
            yield Entry(scene, f"{mode} alone, {name}", {"context": mode}, view, "context")
        preview = {"context": mode, "context_preview": True}
        yield Entry(scene, f"{mode} alone, preview", preview, View("left", (83, 96)), "context")
    shaded = {"context": "dvr", "context_shading": True, "context_transfer": "bone"}
    yield Entry(scene, "dvr alone, shaded", shaded, View("right", (83, 96)), "context")
    yield Entry(scene, "default again")


def of_mixed_stages() -> Iterator[Entry]:
    """Frames whose stages are split between GPU and CPU."""
    behind, view = {"opacity": SEE_THROUGH}, View(size=(71, 52))
    for stages in ("distance", "depth", "distance,depth", "surface,silhouette", "context,composite"):
        what = f"on the CPU {stages}"
        yield Entry("aorta", what, behind, view, devices=("gpu",), cpu_stages=stages)


def of_phantoms() -> Iterator[Entry]:
    """Scenes with known answers."""
    for scene in (*SMALL, *(f"stenosis {percent}" for percent in STENOSES)):
        for view in (View("anterior", (90, 100)), View("left", (77, 64)), View(size=(81, 80))):
            yield Entry(scene, view.direction, view=view)
    hard = {"lumen_first": True, "levels": 1, "slab": Slab(3, "max"), "opacity": SEE_THROUGH}
    for scene in ("y_junction", "crossing", "trefoil", "collinear_run"):
        yield Entry(scene, "lumen first", hard, View("anterior", (90, 100)))
        yield Entry(scene, "no lumen", {"preserve_lumen": False, "context": None}, View("superior", (77, 64)))
        yield Entry(
            scene, "cut surface alone", {"depth_filter": False}, View("inferior", (77, 64)), "cut surface"
        )
    yield Entry("trefoil", "large", view=View("anterior", (420, 420)))
    for scene in ("runoff", "cervical"):
        for view in (View("anterior", (90, 120)), View(size=(85, 100), turn=0.8)):
            yield Entry(scene, view.direction, view=view)
            see_through = {"opacity": SEE_THROUGH, "context_transfer": "soft-tissue"}
            yield Entry(scene, f"{view.direction}, context behind", see_through, view)


def of_volumes() -> Iterator[Entry]:
    """Voxels of every type, on every grid, and unusual arrays of them."""
    window = Window(50, 100)
    dvr = {"context": "dvr", "context_transfer": "grey", "window": window, "context_window": window}
    mida = {
        "opacity": Opacity(20, 90),
        "context_shading": True,
        "slab": Slab(3, "mean"),
        **dvr,
        "context": "mida",
    }
    for kind, names in (("voxels", DTYPES), ("grid", GRIDS), ("array", ARRAYS)):
        for name in names:
            yield Entry(f"{kind} {name}", "dvr alone", dvr, View(size=(50, 40)), "context")
            yield Entry(f"{kind} {name}", "mida and cut surface", mida, View(size=(60, 50)))
    for name in RANGES:
        yield Entry(f"range of {name}", "default", view=View("left", (60, 50)))
        yield Entry(f"range of {name}", "mip alone", {"context": "mip"}, View(size=(60, 50)), "context")
    for name in GRIDS:
        yield Entry(f"grid {name}", "default", view=View("superior", (60, 50)))
        minimum = {"context": "minip", "context_window": window}
        yield Entry(f"grid {name}", "minip alone", minimum, View("left", (41, 50)), "context")


def of_trees() -> Iterator[Entry]:
    """Cut surfaces without a volume."""
    finest = {"levels": 0, "depth_filter": False, "lumen_first": True, "lumen_margin": 1}
    for name in TREES:
        scene = f"tree {name}"
        yield Entry(scene, "anterior", view=View("anterior", (96, 80)), shows="cut surface")
        yield Entry(scene, "finest lumen first", finest, View("anterior", (70, 71)), "cut surface")
        yield Entry(scene, "oblique", {"cost_weight": 2}, View(size=(96, 80)), "cut surface")
    for direction in ("left", "superior"):
        yield Entry("tree lattice", direction, view=View(direction, (120, 121)), shows="cut surface")
    yield Entry("tree many vessels", "large", view=View(size=(420, 420)), shows="cut surface")


def of_real_data() -> Iterator[Entry]:
    """Angiographies of patients, if their files exist."""
    several: dict[str, Values] = {
        "default": {},
        "no context": {"context": None, "silhouettes": False, "depth_filter": False},
        "dvr": {"context": "dvr", "context_shading": True, "opacity": SEE_THROUGH},
        "mida": {"context_gamma": 0.4, "context_transfer": POINTS, "opacity": SEE_THROUGH},
        "mip": {"context": "mip", "slab": Slab(5, "max"), "opacity": SEE_THROUGH, "lumen_first": True},
    }
    for scene in ("stent", "dissection", "aorta-mra"):
        for what, values in several.items():
            yield Entry(scene, f"{what}, anterior", values, View("anterior", (110, 120)))
            yield Entry(scene, f"{what}, oblique", values, View(size=(101, 90)))
        for mode in MODES:
            yield Entry(scene, f"{mode} alone", {"context": mode}, View("left", (64, 80)), "context")
        yield Entry(scene, "420 x 420", view=View(size=(420, 420), turn=0.5))


def of_the_cpu() -> Iterator[Entry]:
    """More and larger frames, on the CPU only: a software GPU would take minutes."""
    for scene in ("aorta", "trefoil", "tree lattice", "tree nearly along y", "tree many vessels", "stent"):
        shows: Literal["all", "cut surface"] = "cut surface" if scene.startswith("tree") else "all"
        for n in range(12):
            view = View("anterior", (320, 300), n * math.pi / 6, (0.2 * (n % 3), 0.0, 1.0))
            yield Entry(scene, f"turning {n}", {}, view, shows, ("cpu",))
        if scene != "aorta":
            for what, values in surface_settings():
                yield Entry(scene, what, values, View("anterior", (150, 160)), shows, ("cpu",))
    for what, values in (*picture_settings(), *context_settings()):
        yield Entry("stent", what, values, View(size=(100, 120)), devices=("cpu",))


def entries() -> list[Entry]:
    """The whole list, in rendering order."""
    groups = (of_workload, of_mixed_stages, of_phantoms, of_volumes, of_trees, of_real_data, of_the_cpu)
    return [entry for group in groups for entry in group()]
