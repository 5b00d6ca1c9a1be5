"""Pairs of places on different vessels for the question which one is closer to the viewer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut.errors import VesselTreeError
from lumencut.pictures.lettering import Sheet

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lumencut.pictures.frame import Frame
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_tree import VesselTree

#: Least distance between both depths (mm): three diameters of a small artery.
LEAST_DEPTH_MM = 8.0
#: Least distance between both marks, and between marks and edges, as a share of the shorter side.
_LEAST_APART, _MARGIN = 0.08, 0.03
#: Points of a vessel that are tried, evenly along its line.
_POINTS = 60
#: Radius of the circle about a place, as a share of the shorter side.
_CIRCLE = 0.015


@dataclass(frozen=True)
class Pair:
    """Two places of a view: their pixels (column, row), and the number of the closer one."""

    pixels: tuple[tuple[float, float], tuple[float, float]]
    closer: int


def pairs(
    tree: VesselTree, camera: Camera, frames: Sequence[Frame], count: int, draw: np.random.Generator
) -> list[Pair]:
    """Return pairs of places that all frames show, each on another vessel and at another depth.

    Raises
    ------
    VesselTreeError
        If the view has too few pairs.
    """
    places, vessels = _places(tree, camera, frames)
    first, second = np.triu_indices(len(places), 1)
    apart = np.abs(places[first] - places[second])
    side = min(camera.size)
    fits = (
        (vessels[first] != vessels[second])
        & (apart[:, 2] >= LEAST_DEPTH_MM)
        & (np.hypot(apart[:, 0], apart[:, 1]) >= _LEAST_APART * side)
    )
    found = np.stack([first[fits], second[fits]], axis=1)
    if len(found) < count:
        raise VesselTreeError(
            "centerlines",
            f"{len(found)} pairs of visible places whose depths differ by {LEAST_DEPTH_MM:g} mm in a view",
            f"{count} or more, on different vessels; give more vessels of the scan",
        )
    chosen = draw.permuted(found[draw.choice(len(found), count, replace=False)], axis=1)
    return [_pair(places[ends]) for ends in chosen]


def _pair(ends: npt.NDArray[np.float64]) -> Pair:
    (a, b), depths = ends[:, :2].tolist(), ends[:, 2]
    return Pair(((a[0], a[1]), (b[0], b[1])), int(np.argmin(depths)))


def _places(
    tree: VesselTree, camera: Camera, frames: Sequence[Frame]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Return places (column, row, depth) that every frame shows, and the vessel of each."""
    places, vessels = [], []
    for number, vessel in enumerate(tree):
        chosen = np.unique(np.linspace(0, len(vessel.points) - 1, _POINTS).round().astype(int))
        projected = camera.project(vessel.points[chosen])
        column, row = projected[:, :2].round().astype(int).T
        width, height = camera.size
        margin = _MARGIN * min(camera.size)
        inside = (column >= margin) & (column < width - margin) & (row >= margin) & (row < height - margin)
        projected, column, row = projected[inside], column[inside], row[inside]
        is_shown = np.all([frame.vessel[row, column] == number for frame in frames], axis=0)
        places.append(projected[is_shown])
        vessels.append(np.full(int(is_shown.sum()), number))
    return np.concatenate(places), np.concatenate(vessels)


def marked(picture: npt.NDArray[np.uint8], pair: Pair, names: Sequence[str]) -> npt.NDArray[np.uint8]:
    """Return the picture with both places marked; the places themselves stay visible."""
    sheet = Sheet(picture)
    radius = max(4.0, _CIRCLE * min(sheet.size))
    for name, (column, row) in zip(names, pair.pixels, strict=True):
        sheet.arc((column, row), radius, 0.0, 2 * math.pi)
        sheet.write(name, (column + radius, row - radius), "ld", is_large=True)
    return sheet.pixels()
