"""A scene of a reading study; as a script, makes the study in a folder."""

from __future__ import annotations

import sys

import numpy as np

from lumencut import Renderer, Vessel, VesselTree, Volume
from lumencut.evaluation.reading_study import make_study

#: Where the tubes of the scene are (x and y, mm): apart from each other in the views with tasks.
PLACES = ((-20.0, -24.0), (20.0, 24.0))


def two_tubes() -> tuple[Volume, VesselTree]:
    """Two vertical tubes of 3 mm radius."""
    _, y, x = np.mgrid[-32:33, -32:33, -32:33].astype(float)
    inside = np.any([np.hypot(x - a, y - b) < 3 for a, b in PLACES], axis=0)
    affine = np.eye(4)
    affine[:3, 3] = -32
    line = np.linspace(-28, 28, 57)
    tubes = [Vessel(np.stack([0 * line + a, 0 * line + b, line], axis=1), 3.0) for a, b in PLACES]
    return Volume(np.where(inside, 300, -100).astype(np.int16), world_from_index=affine), VesselTree(tubes)


if __name__ == "__main__":
    make_study(Renderer(*two_tubes()), sys.argv[1], readers=2, size=(160, 160))
