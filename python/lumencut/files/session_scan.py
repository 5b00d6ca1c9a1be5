"""Checks whether a session file belongs to the scan with which it is read."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from lumencut import _lumencut
from lumencut.errors import FormatError
from lumencut.scene.extents import Box
from lumencut.scene.volume import Volume

#: The viewer may load every second voxel, so outermost voxels may differ by this number of steps.
_STEPS = 2.0


def other_scan(content: bytes, name: str, volume: Volume) -> str | None:
    """Return a sentence if a session belongs to another scan; None otherwise, or if unknown.

    Parameters
    ----------
    content : bytes
        The content of the file.
    name : str
        The name of the file.
    volume : Volume
        The scan that it is read with.
    """
    if not _lumencut.is_session_file(content):
        return None
    try:
        scan = json.loads(_lumencut.read_session_file(content, name))["scan"]
    except FormatError:  # its lines can still be read
        return None
    if scan is None or not (volume.states_spacing and volume.states_orientation):
        return None
    own, saved = _middles(volume.size, volume.world_from_index), _middles(**scan)
    apart = np.abs(np.subtract((own.low, own.high), (saved.low, saved.high))).max()
    if apart <= _STEPS * float(volume.spacing.max()):
        return None
    size = " × ".join(map(str, scan["size"]))
    return f"{name}: a session of another scan, of {size} voxels in another place; use it with its own scan"


def _middles(size: Any, world_from_index: Any) -> Box:
    """Return the box around the centres of the voxels of a grid."""
    ends = np.array(np.meshgrid(*((0, n - 1) for n in size))).reshape(3, -1).T
    affine = np.asarray(world_from_index, np.float64)
    return Box.around(ends @ affine[:3, :3].T + affine[:3, 3])
