"""Centerline files: VTK `.vtp` and legacy `.vtk`, 3D Slicer `.mrk.json`."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut._files import checked_path
from lumencut.errors import FileError, SettingsError, SpaceWarning
from lumencut.vessel_tree import Vessel, VesselTree
from lumencut.volume import Volume

Coordinates: TypeAlias = Literal["lps", "ras"]

_OTHER_SPACE: dict[Coordinates, Coordinates] = {"lps": "ras", "ras": "lps"}
_FLIP = np.array([-1.0, -1.0, 1.0])


@dataclass(frozen=True)
class CenterlineReport:
    """How a centerline file was read.

    Attributes
    ----------
    space : "lps" or "ras"
        The space in which its coordinates were read.
    stated : "lps", "ras" or None
        The space that the file itself states.
    vessels, points : int
        How many vessels it forms, and how many points they have.
    radius : bool
        Whether every vessel has radii.
    notes : tuple of str
        What was odd about the file, one sentence each.
    """

    space: Coordinates
    stated: Coordinates | None
    vessels: int
    points: int
    radius: bool
    notes: tuple[str, ...]


def read_centerlines(
    path: str | os.PathLike[str], coordinates: Coordinates | None = None, *, volume: Volume | None = None
) -> VesselTree:
    """Read a centerline file as vessels that meet at shared end points (mm, LPS).

    Lines that repeat a trunk are joined. Coordinates in RAS get x and y negated.

    Parameters
    ----------
    path : path
        A `.vtp`, legacy `.vtk` or `.mrk.json` file.
    coordinates : "lps" or "ras", optional
        The space of the file's coordinates. By default the one that the file states, else LPS.
    volume : Volume, optional
        Where given, the coordinates are compared with its extent.

    Raises
    ------
    FileError
        Where the file cannot be read.
    FormatError
        Where its content is not what its format promises, or holds no centerline.

    Warns
    -----
    SpaceWarning
        Without `coordinates`, where the other space clearly fits the volume better. Nothing is repaired.
    """
    tree, report = _read(path, coordinates)
    if volume is not None and coordinates is None:
        mend = f'read the file with coordinates="{_OTHER_SPACE[report.space]}" if that is its space'
        tree._space_settled = _warn_if_flipped_fits(tree, volume, Path(path).name, mend)
    return tree


def inspect_centerlines(
    path: str | os.PathLike[str], coordinates: Coordinates | None = None
) -> CenterlineReport:
    """Tell how `read_centerlines` reads a file, with the same parameters and errors."""
    return _read(path, coordinates)[1]


def check_space(tree: VesselTree, volume: Volume, subject: str = "vessel tree") -> None:
    """Compare a tree with the extent of a volume.

    Warns
    -----
    SpaceWarning
        Where clearly more points lie inside the volume with x and y negated, as when RAS was read as LPS or
        the other way round. The text names both counts and the option that mends it.
    """
    mend = 'read the centerlines with coordinates="ras", or "lps" where they were read as RAS'
    # Whoever was warned once knows.
    tree._space_settled |= _warn_if_flipped_fits(tree, volume, subject, mend)


def check_space_once(tree: VesselTree, volume: Volume, subject: str = "vessel tree") -> None:
    """Do as `check_space`, unless the tree's space was asked for or already warned about."""
    if not tree._space_settled:
        check_space(tree, volume, subject)


def _read(
    path: str | os.PathLike[str], coordinates: Coordinates | None
) -> tuple[VesselTree, CenterlineReport]:
    if coordinates not in (None, "lps", "ras"):
        raise SettingsError("coordinates", repr(coordinates), '"lps", "ras" or None')
    expected = "a readable centerline file"
    checked = checked_path(path, expected)
    try:
        content = checked.read_bytes()
    except OSError as error:
        raise FileError(str(checked), error.strerror or str(error), expected) from error
    vessels, stated, notes = _lumencut.read_centerlines(content, checked.name)
    space = coordinates or _known(stated) or "lps"
    if stated is None and coordinates is None:
        notes.append("the file names no space; LPS is assumed")
    if coordinates is not None and stated not in (None, coordinates):
        notes.append(f"the file states {stated}; read as {coordinates} as asked")
    tree = VesselTree([Vessel(_lps(points, space), radius, name) for points, radius, name in vessels])
    tree._space_settled = coordinates is not None
    report = CenterlineReport(
        space=space,
        stated=_known(stated),
        vessels=len(vessels),
        points=sum(len(points) for points, _, _ in vessels),
        radius=all(radius is not None for _, radius, _ in vessels),
        notes=tuple(notes),
    )
    return tree, report


def _known(space: str | None) -> Coordinates | None:
    return "ras" if space == "ras" else "lps" if space == "lps" else None


def _lps(points: npt.NDArray[np.float64], space: Coordinates) -> npt.NDArray[np.float64]:
    return points * _FLIP if space == "ras" else points


def _warn_if_flipped_fits(tree: VesselTree, volume: Volume, subject: str, mend: str) -> bool:
    """Warn where negating x and y brings twice as many points into the volume, and a tenth of all more.

    Returns whether it warned.
    """
    points = np.concatenate([tree[i].points for i in range(len(tree))])
    as_read = int(volume.contains(points).sum())
    flipped = int(volume.contains(points * _FLIP).sum())
    doubtful = flipped >= 2 * as_read and flipped - as_read >= max(1, len(points) // 10)
    if doubtful:
        counts = f"{as_read} of {len(points)} points lie inside the volume as read, but {flipped}"
        text = f"{subject}: {counts} with x and y negated (LPS and RAS mixed up?); {mend}"
        warnings.warn(text, SpaceWarning, stacklevel=3)
    return doubtful
