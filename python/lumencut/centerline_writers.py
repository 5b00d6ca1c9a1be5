"""Vessel trees as centerline files: VTK `.vtp` and 3D Slicer `.mrk.json`."""

from __future__ import annotations

import os

from lumencut import _lumencut
from lumencut._files import WRITABLE, checked_path, replace_whole
from lumencut.errors import FormatError, VesselTreeError
from lumencut.vessel_tree import VesselTree

_FORMATS = ("vtp", "mrk.json")


def write_centerlines(tree: VesselTree, path: str | os.PathLike[str]) -> None:
    """Write a tree as a centerline file (mm, LPS), which appears only once it is whole.

    `read_centerlines` gives the same vessels back to the bit, in their order and direction and with their
    names: the file is marked as vessels, so that none is joined to another.

    Parameters
    ----------
    tree : VesselTree
        Neighbouring points of its vessels must differ.
    path : path-like
        The ending names the format: ``.vtp`` (one polyline per vessel) or ``.mrk.json`` (one curve each).

    Raises
    ------
    FormatError
        For an ending that names neither format.
    VesselTreeError
        For a tree with equal neighbouring points, or a name that the format cannot hold.
    FileError
        Where the file cannot be written.
    """
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("vessel tree", type(tree).__name__, "a VesselTree")
    place = checked_path(path, WRITABLE)
    kind = next((kind for kind in _FORMATS if place.name.lower().endswith(f".{kind}")), None)
    if kind is None:
        raise FormatError(str(place), f"the ending {place.suffix!r}", "'.vtp' or '.mrk.json'")
    try:
        content = _lumencut.write_centerlines(
            [(vessel.points, vessel.radius, vessel.name) for vessel in tree], kind
        )
    except UnicodeEncodeError as error:
        found = ascii(error.object)
        raise VesselTreeError("name of a vessel", found, "letters that a file can hold") from error
    replace_whole(place, lambda temporary: temporary.write_bytes(content))
