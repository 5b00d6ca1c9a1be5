"""Centerline files of every format that `lumencut-io` reads, as vessel trees in world space."""

from __future__ import annotations

import os
from typing import Any

from lumencut.centerline_file import CenterlineFile, CenterlineReport
from lumencut.placement import Coordinates, Unit
from lumencut.several_centerlines import CenterlineFiles
from lumencut.vessel_tree import VesselTree
from lumencut.volume_files.memory import as_volume


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

    The vessels of several files follow each other in the order of the files. Space and unit are decided for
    each file by itself, and vessels of several files are kept as they were read: none is joined to one of
    another file, and those with the same name keep it. A vessel without a name that is the only one of its
    file gets the name of the file, as 3D Slicer shows it.

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
        Where given, its extent decides what the file leaves open. Where both spaces fit the extent, the
        values along the lines decide if at least three times as many points look like lumen in the one space
        as in the other, and at least half of all and twenty of them. What the file states is compared with
        both.
    reorder : bool, default False
        Whether the points of each line are put into their order along the vessel, with their radii. A log
        message says how many points moved.

    Raises
    ------
    FileError
        Where the file cannot be read.
    FormatError
        Where its content is not what its format promises, or holds no centerline; where several spaces or
        units fit the volume and its values do not tell which, or none does; with `reorder` where the order
        of a line is doubtful and no other is found without doubt.
    VolumeError
        For anything that is not a volume.

    Warns
    -----
    LineWarning
        Where the points of a line seem to be in another order, a point lies far from all others, a part
        seems to be missing, or two lines lie side by side in one vessel.
    SpaceWarning
        Where the volume decides against LPS or the usual unit, or the space by its values; where what the
        file states fits the volume clearly worse than another space or unit, or makes lines of no size of
        vessels, which is not repaired. The text names both counts.
        What else was assumed (without a volume) or decided is logged.
    """
    volume = None if volume is None else as_volume(volume)
    if isinstance(path, (list, tuple)):
        files, read = CenterlineFiles(path), []
        # No further function between here and the warnings: they name the line of the caller.
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
