"""Vessel trees as centerline files: VTK `.vtp` and `.vtk`, 3D Slicer `.mrk.json`, tables and SWC."""

from __future__ import annotations

import os

from lumencut import _lumencut
from lumencut.base.file_kinds import extensions
from lumencut.base.paths import WRITABLE, checked_path, replace_whole
from lumencut.errors import FormatError, VesselTreeError
from lumencut.scene.vessel_tree import VesselTree


def write_centerlines(tree: VesselTree, path: str | os.PathLike[str]) -> None:
    """Write a tree as a centerline file (mm, LPS), which appears only when complete.

    From ``.vtp`` and ``.mrk.json``, `read_centerlines` returns bit-identical vessels in the same order and
    direction, with their names: a mark in the file prevents joining. The other formats are for other
    programs and hold less:

    * ``.vtk`` (legacy): the same, but only VTK reads the names, `read_centerlines` does not.
    * ``.csv``: a row per point with the columns ``line`` (the vessel's id), ``name``, ``l (mm)``, ``p (mm)``,
      ``s (mm)`` and ``radius (mm)``; name and radius if any vessel has one. Unknown radii among known
      ones are 0. Names are not read back, and lines that meet are joined again.
    * ``.swc``: a node per point. Vessels that begin at a point of another one become its branches; there are
    no names, and a reader returns one branch from each fork to the next. Unknown radii are 0. The format
      states no space: read it with ``coordinates="lps"``.

    The confidence of traced vessels is written too, for other programs: as the array of points
    ``Confidence``, the measurement ``Confidence`` or the column ``confidence``. In such a tree, points of
    vessels without a confidence get 1, bridged points get 0. ``.swc`` cannot hold the confidence, and
    `read_centerlines` ignores it.

    Parameters
    ----------
    tree : VesselTree
        Neighbouring points of its vessels must differ.
    path : path-like
        The extension selects the format: ``.vtp``, ``.vtk`` (one polyline per vessel), ``.mrk.json`` (one
        curve each), ``.csv`` or ``.swc``.

    Raises
    ------
    FormatError
        For another extension.
    VesselTreeError
        For a tree with equal neighbouring points, or a name that the format cannot hold.
    FileError
        If the file cannot be written.
    """
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("vessel tree", type(tree).__name__, "a VesselTree")
    place = checked_path(path, WRITABLE)
    known = extensions("centerlines", written=True)
    kind = next((one for one in known if place.name.lower().endswith(one)), None)
    if kind is None:
        *first, last = map(repr, known)
        raise FormatError(str(place), f"the extension {place.suffix!r}", f"{', '.join(first)} or {last}")
    content = centerline_content(tree, kind.removeprefix("."))
    replace_whole(place, lambda temporary: temporary.write_bytes(content))


def centerline_content(tree: VesselTree, kind: str) -> bytes:
    """Return the content that `write_centerlines` would write into a file of a format, such as ``vtp``."""
    try:
        return _lumencut.write_centerlines(
            [(vessel.points, vessel.radius, vessel.name, vessel.confidence) for vessel in tree], kind
        )
    except UnicodeEncodeError as error:
        found = ascii(error.object)
        raise VesselTreeError("name of a vessel", found, "characters that a file can hold") from error
