"""A substitute for the demo's CT, which must be downloaded: its centerlines in an artificial volume."""

from importlib.resources import as_file, files

import numpy as np

from lumencut import VesselTree, Volume, read_centerlines

_LUMEN, _TISSUE, _SHAPE = 310, 60, (256, 128, 128)


def stent_stand_in() -> tuple[Volume, VesselTree]:
    """Return the tree of the demo, and a CT of the same size with bright tubes of the tree's radii."""
    with as_file(files("lumencut.demo") / "stent-centerlines.vtp") as path:
        tree = read_centerlines(path, "lps", unit="mm")
    voxels = np.full(_SHAPE, _TISSUE, np.int16)
    for vessel in tree:
        assert vessel.radius is not None
        for (x, y, z), radius in list(zip(vessel.points, vessel.radius, strict=True))[::2]:
            low = [max(int(middle - radius), 0) for middle in (z, y, x)]
            part = tuple(slice(at, at + int(2 * radius) + 3) for at in low)
            k, j, i = np.indices(voxels[part].shape)
            apart = (k + low[0] - z) ** 2 + (j + low[1] - y) ** 2 + (i + low[2] - x) ** 2
            voxels[part][apart < radius**2] = _LUMEN
    return Volume(voxels, states_spacing=False, states_orientation=True), tree
