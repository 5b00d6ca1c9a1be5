"""The truth about a view: the depth of the nearest lumen at every pixel.

It is computed in 64-bit floats from the given centerline, without the engine's levels of detail, costs or
filters.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.centerline import Centerline, Stations
from lumencut.evaluation.crossings import Crossings, crossings_of
from lumencut.evaluation.pieces import pieces_of
from lumencut.evaluation.projection import Projection, projection_of
from lumencut.evaluation.ragged import ragged
from lumencut.evaluation.raster import pixels_within

if TYPE_CHECKING:
    from lumencut.scene.camera import Camera

#: Depths that differ by at most this are equal (mm).
EXACT = 0.05
#: Regions are widened by this (mm), more than rounding can move their border.
_ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class Nearest:
    """The nearest lumen at the centre of each pixel, each (H, W).

    Parameters
    ----------
    depth : numpy.ndarray
        Depth of the lumen (mm); infinite without a lumen.
    vessel : numpy.ndarray
        Id of the vessel; -1 without a lumen.
    arc, radius : numpy.ndarray
        The arc length along the vessel, and its radius at that point (mm).
    """

    depth: npt.NDArray[np.float64]
    vessel: npt.NDArray[np.intp]
    arc: npt.NDArray[np.float64]
    radius: npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Truth:
    """The truth about one view, the same for all methods.

    ``hidden`` states for each centerline point whether a nearer lumen covers it. Crossings behind a
    third lumen are excluded.
    """

    seen: Projection
    nearest: Nearest
    hidden: npt.NDArray[np.bool_]
    stations: Stations
    stations_left_out: int
    crossings: Crossings


def truth_of(centerline: Centerline, camera: Camera, stations: tuple[Stations, int]) -> Truth:
    """Return the truth about one view."""
    seen = projection_of(centerline, camera)
    hidden = lumen_depth_at(seen, seen.place) < seen.depth - EXACT
    crossings = crossings_of(seen)
    before = lumen_depth_at(seen, crossings.place) < crossings.depth - crossings.radius - EXACT
    return Truth(seen, nearest_lumen(seen), hidden, *stations, crossings.chosen(~before))


def nearest_lumen(seen: Projection) -> Nearest:
    """Return the nearest lumen at the centre of each pixel."""
    grid = seen.grid
    count = grid.width * grid.height
    depth, arc, radius = np.full(count, np.inf), np.full(count, np.nan), np.full(count, np.nan)
    vessel = np.full(count, -1)
    for pieces in pieces_of(seen):
        for piece, pixel in pixels_within(pieces.regions().widened(_ROUNDING), grid):
            offer = pieces.offer(piece, grid.centers(pixel))
            nearer = offer.covers & (offer.depth < depth[pixel])
            np.minimum.at(depth, pixel[nearer], offer.depth[nearer])
            won = np.flatnonzero(nearer & (offer.depth == depth[pixel]))
            for image, values in ((vessel, offer.vessel), (arc, offer.arc), (radius, offer.radius)):
                image[pixel[won]] = values[won]
    shape = (grid.height, grid.width)
    return Nearest(depth.reshape(shape), vessel.reshape(shape), arc.reshape(shape), radius.reshape(shape))


def lumen_depth_at(seen: Projection, place: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the depth (mm) of the nearest lumen at exact positions (n, 2), not at pixel centres.

    It is infinite without a lumen and outside the picture.
    """
    grid = seen.grid
    pixel, within = grid.pixels(place)
    order = np.flatnonzero(within)[np.argsort(pixel[within], kind="stable")]
    count = np.bincount(pixel[order], minlength=grid.width * grid.height)
    first = np.cumsum(count) - count
    depth = np.full(len(place), np.inf)
    for pieces in pieces_of(seen):
        # A position is at most half a pixel diagonal away from the centre of its pixel.
        regions = pieces.regions().widened(0.7072 * grid.side + _ROUNDING)
        for piece, met in pixels_within(regions, grid):
            busy = count[met] > 0
            owner, member = ragged(first[met[busy]], count[met[busy]])
            which = order[member]
            offer = pieces.offer(piece[busy][owner], place[which])
            np.minimum.at(depth, which[offer.covers], offer.depth[offer.covers])
    return depth
