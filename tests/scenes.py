"""Vessel trees made from random numbers."""

from __future__ import annotations

import numpy as np

from lumencut import Vessel, VesselTree


def wandering(seed: int, vessels: int = 6, points: int = 40, step: float = 2.0) -> VesselTree:
    """Smooth vessels of varying radius within about 100 mm."""
    random = np.random.default_rng(seed)
    made = []
    for _ in range(vessels):
        ahead = random.normal(size=3) + 0.4 * np.cumsum(random.normal(size=(points, 3)), axis=0)
        ahead *= step / np.linalg.norm(ahead, axis=1)[:, None]
        line = random.uniform(-50, 50, 3) + np.cumsum(ahead, axis=0)
        made.append(Vessel(line, random.uniform(0.5, 4, points)))
    return VesselTree(made)


def lattice(seed: int, vessels: int = 8, points: int = 25) -> VesselTree:
    """Vessels along the axes of a lattice: in axis-aligned views, many segments are collinear with the view.

    The vessels cross, touch, turn back on themselves; a tenth of the points repeat the point before.
    """
    random = np.random.default_rng(seed)
    made = []
    for _ in range(vessels):
        steps = np.zeros((points, 3))
        lengths = random.choice([-4.0, 4.0, 0.0], points, p=[0.45, 0.45, 0.1])
        steps[np.arange(points), random.integers(0, 3, points)] = lengths
        line = 4.0 * random.integers(-5, 6, 3) + np.cumsum(steps, axis=0)
        made.append(Vessel(line, random.uniform(0.5, 3, points)))
    return VesselTree(made)


def nearly_along_y(seed: int, vessels: int = 5, points: int = 30) -> VesselTree:
    """Vessels of which two fifths of the segments are 1 mm to 10 nm long when seen along y."""
    random = np.random.default_rng(seed)
    made = []
    for _ in range(vessels):
        steps = 2 * random.normal(size=(points, 3))
        short = random.random(points) < 0.4
        steps[short, ::2] *= 10.0 ** random.uniform(-5, 0, (short.sum(), 2))
        made.append(Vessel(random.uniform(-10, 10, 3) + np.cumsum(steps, axis=0), 1.0))
    return VesselTree(made)


def of_few_points(seed: int) -> VesselTree:
    """Vessels of 2 to 7 points: too few for a cubic spline, just enough, and a few more."""
    random = np.random.default_rng(seed)
    counts = (2, 2, 3, 3, 4, 4, 5, 6, 7)
    return VesselTree([Vessel(random.uniform(-5, 5, (n, 3)), random.uniform(0, 3, n)) for n in counts])
