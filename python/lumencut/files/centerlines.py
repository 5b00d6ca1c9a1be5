"""Centerline files of every format that `lumencut-io` reads, as vessel trees in world space."""

from __future__ import annotations

import os
from typing import Any

from lumencut.files.centerline_file import CenterlineFile, CenterlineReport
from lumencut.files.several_centerlines import CenterlineFiles
from lumencut.scene.images import as_volume
from lumencut.scene.placement import Coordinates, Unit
from lumencut.scene.vessel_tree import VesselTree


def read_centerlines(
    path: str | os.PathLike[str] | Any,
    coordinates: Coordinates | None = None,
    *,
    unit: Unit | None = None,
    volume: Any = None,
    reorder: bool = False,
) -> VesselTree:
    """Read centerline files, or lines of VTK in memory, as vessels that meet at shared end points (mm, LPS).

    Lines of one file that repeat a trunk are joined. Coordinates in RAS get x and y negated.

    Several files give one tree, in the order of the files. Space and unit are decided for each file
    separately; vessels of different files are not joined, and may share a name. A single vessel without a
    name gets the name of its file, as 3D Slicer shows it.

    Parameters
    ----------
    path : path or vtkPolyData, or a list or tuple of them
        VTK `.vtp` or legacy `.vtk`, 3D Slicer `.mrk.json` or `.fcsv`, SimVascular `.pth`, SWC, ITK `.tre`,
        a Rotterdam reference, a text table (`.csv`, `.txt`) or NumPy `.npy`. Poly data is read
        as its `.vtp` file would be: its lines, with their array ``MaximumInscribedSphereRadius`` or
        ``Radius`` of points, their names and the space that its field data states.
    coordinates : "lps" or "ras", optional
        The space of the file's coordinates. Default: as stated in the file, otherwise the one that fits
        the volume, otherwise LPS.
    unit : "um", "mm", "cm", "dm" or "m", optional
        The unit of the file's coordinates and radii. Default: as stated in the file, otherwise the one that
        fits the volume, otherwise that of its format: cm for `.pth`, mm for all others.
    volume : Volume, or anything :func:`lumencut.render` takes as one, optional
        Its extent decides what the file does not state. If both spaces fit the extent, the values along the
        lines decide, if one space has three times as many points that look like lumen as the other, half of
        all points and twenty at least. Statements of the file are checked against extent and values.
    reorder : bool, default False
        Whether to sort the points of each line along the vessel, with their radii. A log
        message says how many points moved.

    Raises
    ------
    FileError
        If the file cannot be read.
    FormatError
        If its content does not match its format, or holds no centerline; if several spaces or units fit the
        volume and its values cannot decide, or if none fits; with `reorder`, if the order of a line is
        doubtful and no certain order is found.
    VolumeError
        For anything that is not a volume.

    Warns
    -----
    LineWarning
        If the points of a line seem to be in another order, a point lies far from all others, a part seems to
        be missing, or two lines lie side by side in one vessel.
    SpaceWarning
        If the volume decides against LPS or the usual unit, or its values decide the space; if the statements
        of the file fit the volume clearly worse than another space or unit, or give lines of an impossible
        size for vessels. Such statements are not corrected. The text names both counts. Other assumptions
        (without a volume) and decisions are logged.
    """
    volume = None if volume is None else as_volume(volume)
    if isinstance(path, (list, tuple)):
        files, read = CenterlineFiles(path), []
        # Each warning must name the caller's line, so no further function may be added in between.
        for file in files:
            read.append(file.within(volume, coordinates, unit, reorder=reorder))  # noqa: PERF401
        return files.joined(read)
    return CenterlineFile(path).within(volume, coordinates, unit, reorder=reorder)[0]


def inspect_centerlines(
    path: str | os.PathLike[str] | Any,
    coordinates: Coordinates | None = None,
    *,
    unit: Unit | None = None,
    volume: Any = None,
    reorder: bool = False,
) -> CenterlineReport:
    """Report how `read_centerlines` reads a file, with the same parameters and errors."""
    return CenterlineFile(path).placed(coordinates, unit, volume, reorder=reorder)[1]
