"""Scenes for the tests of evaluations, and made-up frames of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lumencut import Camera, Settings, Vessel, VesselTree
from lumencut.evaluation.centerline import centerline_of, width_stations
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import truth_of

#: Settings that show lumens exactly: nearest lumen first, no levels of detail, no filter.
EXACT = Settings(lumen_first=True, lumen_margin=0, levels=0, depth_filter=False, zone_filter=False)


def tube(radius=4.0, length=60.0, depth=0.0, axis=0):
    """A straight tube along x or z in the plane y = depth; the front view looks along y."""
    points = np.zeros((61, 3))
    points[:, 0 if axis == 0 else 2] = np.linspace(-length / 2, length / 2, 61)
    points[:, 1] = depth
    return Vessel(points, radius)


def crossing_tubes(gap=20.0):
    """A tube along x of radius 4 mm, and one along z of radius 3 mm behind it."""
    return VesselTree([tube(4.0), tube(3.0, depth=gap, axis=2)])


def front(size=(161, 161), spacing=0.5):
    """The view along y onto the origin; the image centre is shifted, so that no pixel lies on a border."""
    return Camera((0.013, 0, 0.017), (0, 1, 0), (0, 0, 1), size, spacing)


def truth_in(tree, camera, unknown_radius=1.0):
    """The truth about a tree in a view."""
    line = centerline_of(tree, unknown_radius)
    return truth_of(line, camera, width_stations(line))


def perfect(truth, camera, beyond=0.0):
    """A frame that shows the truth, and a plane at depth `beyond` (mm) elsewhere; it never changes."""
    depth = np.where(np.isfinite(truth.nearest.depth), truth.nearest.depth, beyond)
    vessel = np.maximum(truth.nearest.vessel, 0)
    return Shown(
        depth, vessel, truth.seen.world(depth), depth.copy(), vessel.copy(), np.zeros(depth.shape, bool)
    )


def with_depth(shown, truth, depth):
    """A frame with another depth."""
    return replace(shown, depth=depth, position=truth.seen.world(depth))
