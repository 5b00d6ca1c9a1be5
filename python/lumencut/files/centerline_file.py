"""A centerline file of any supported format, and its conversion to a tree in world space."""

from __future__ import annotations

import importlib
import logging
import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from lumencut import _lumencut
from lumencut.base.file_kinds import kind_of
from lumencut.base.mends import Told
from lumencut.base.paths import checked_path
from lumencut.errors import FileError, FormatError, SettingsError, SpaceWarning, StudyWarning
from lumencut.files.session_scan import other_scan
from lumencut.scene.images import as_volume
from lumencut.scene.line_doubts import LineDoubt, line_doubts, settle, warn_of, worded
from lumencut.scene.placement import (
    MILLIMETRES,
    Coordinates,
    Lines,
    Placement,
    Stated,
    Unit,
    check_choice,
    check_space_once,
    fits_nowhere,
    placement,
)
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

_log = logging.getLogger("lumencut")


@dataclass(frozen=True)
class CenterlineReport:
    """How a centerline file was read.

    Attributes
    ----------
    format : str
        The format, such as ``VTK XML PolyData``.
    space, unit : str
        The space and unit in which its coordinates were read.
    stated, stated_unit : str or None
        The space and unit that the file itself states.
    space_from, unit_from : "asked", "stated", "volume", "values" or "assumed"
        What decided: the caller, the file, the extent of the volume, its values along the lines, or nothing.
    vessels, points : int
        The number of vessels, and of their points.
    radius : bool
        Whether every vessel has radii.
    decision : Told
        What was assumed or decided about space and unit, and why; empty if file or caller stated it.
    is_unusual : bool
        Whether the volume decided against LPS or the format's usual unit, or its values decided the space.
    notes : tuple of str
        Notes on the file, one sentence each, including those of `doubts`.
    doubts : tuple of LineDoubt
        Doubts about its lines.
    fits_also : tuple of str
        Other units that would also fit the volume, if the usual one was chosen.
    doubt : Told
        Reasons against the stated or assumed unit; empty if there are none.
    """

    format: str
    space: Coordinates
    unit: Unit
    stated: Coordinates | None
    stated_unit: Unit | None
    space_from: str
    unit_from: str
    vessels: int
    points: int
    radius: bool
    decision: Told
    is_unusual: bool
    notes: tuple[str, ...]
    doubts: tuple[LineDoubt, ...] = ()
    fits_also: tuple[Unit, ...] = ()
    doubt: Told = Told()  # noqa: RUF009 - it never changes

    @property
    def reordered(self) -> tuple[str, ...]:
        """Return the notes on lines whose points were sorted."""
        return tuple(note for note in self.notes if note.endswith(_lumencut.REORDERED))


class CenterlineFile:
    """A centerline file with checked content, before its space and unit are decided.

    Parameters
    ----------
    source : path or vtkPolyData
        The file, or lines in memory.

    Raises
    ------
    FileError
        If the file cannot be read.
    FormatError
        If its content does not match its format, or holds no centerline.
    """

    def __init__(self, source: str | os.PathLike[str] | Any) -> None:
        expected = "a readable centerline file"
        if is_poly_data(source):
            self.path = Path("vtkPolyData")
            self._content, self._session = _lumencut.CenterlineFile(file_of(source), self.path.name), b""
            return
        self.path = checked_path(source, expected)
        try:
            content = self.path.read_bytes()
        except OSError as error:
            raise FileError(str(self.path), error.strerror or str(error), expected) from error
        kind = kind_of(self.path)
        if kind is not None and (kind.mend or (kind.role == "volume" and not kind.is_dicom)):
            mend = kind.mend if kind.role == "centerlines" else "read volumes with read_volume"
            raise FormatError(str(self.path), kind.name, "a file of centerlines", mend)
        self._content = _lumencut.CenterlineFile(content, self.path.name)
        self._session = content if _lumencut.is_session_file(content) else b""

    def placed(
        self,
        coordinates: Coordinates | None = None,
        unit: Unit | None = None,
        volume: Any = None,
        *,
        reorder: bool = False,
    ) -> tuple[VesselTree, CenterlineReport]:
        """Return the vessels in world space, and a report; parameters as for `read_centerlines`."""
        check_choice(coordinates, unit)
        if not isinstance(reorder, bool):
            raise SettingsError("reorder", repr(reorder), "True or False")
        volume = None if volume is None else as_volume(volume)
        content = self._content
        stated = Stated(
            cast(Coordinates | None, content.space),
            cast(Unit | None, content.unit),
            cast(Unit, content.conventional_unit),
        )
        likely = unit or stated.unit or stated.usual_unit
        vessels, notes = content.vessels(MILLIMETRES[likely], reorder)
        in_mm = Lines.of((points, radius) for points, radius, _ in vessels)
        lines = Lines(in_mm.points / MILLIMETRES[likely], in_mm.radii / MILLIMETRES[likely])
        place = placement(self.path.name, lines, stated, coordinates, unit, volume)
        if place.unit != likely:
            # After conversion to mm, because lines are joined by distances in mm.
            vessels, notes = content.vessels(MILLIMETRES[place.unit], reorder)
        tree = VesselTree([Vessel(points * place.signs, radius, name) for points, radius, name in vessels])
        is_told = place.is_unusual or (volume is not None and bool(place.doubt))
        tree._space_settled = place.space_from == "asked" or is_told
        doubts = line_doubts(tree, parallel=True)
        if not reorder:
            doubts += worded(content.parted_doubts())
        return tree, self._report(tree, stated, place, notes, doubts)

    def tree(
        self,
        coordinates: Coordinates | None = None,
        unit: Unit | None = None,
        volume: Any = None,
        *,
        reorder: bool = False,
    ) -> VesselTree:
        """Return the vessels in world space, with the warnings of `read_centerlines`."""
        return self.tree_and_report(coordinates, unit, volume, reorder=reorder)[0]

    def tree_and_report(
        self,
        coordinates: Coordinates | None = None,
        unit: Unit | None = None,
        volume: Any = None,
        *,
        reorder: bool = False,
        are_lines: bool = True,
    ) -> tuple[VesselTree, CenterlineReport]:
        """Like `tree`, with a report on reading; lists of loose points may be in any order."""
        tree, report = self.placed(coordinates, unit, volume, reorder=reorder)
        if are_lines:
            warn_of(report.doubts, self.path.name)
            settle(tree)
        for note in report.reordered:
            _log.warning("%s: %s", self.path, note)
        if volume is not None and (words := other_scan(self._session, self.path.name, as_volume(volume))):
            warnings.warn(StudyWarning(words), stacklevel=4)
        if report.is_unusual:
            decision = report.decision.after(f"{self.path.name}: ")
            warnings.warn(SpaceWarning(decision), stacklevel=4)
        elif report.decision:
            weak = report.space_from == "volume" and _mostly_outside(tree, volume)
            is_open = weak or report.fits_also or report.space_from == "assumed"
            _log.log(logging.WARNING if is_open else logging.INFO, "%s: %s", self.path, report.decision)
        if report.doubt and volume is not None:
            warnings.warn(SpaceWarning(report.doubt.after(f"{self.path.name}: ")), stacklevel=4)
        elif report.doubt:
            _log.warning("%s: %s", self.path, report.doubt)
        for note in report.notes:
            _log.info("%s: %s", self.path, note)
        return tree, report

    def within(
        self,
        volume: Volume | None,
        coordinates: Coordinates | None = None,
        unit: Unit | None = None,
        **how: bool,
    ) -> tuple[VesselTree, CenterlineReport]:
        """Like `tree_and_report` for the caller's caller, with a warning if vessels miss the volume."""
        tree, report = self.tree_and_report(coordinates, unit, volume, **how)
        if volume is not None:
            check_space_once(tree, volume, self.path.name, stacklevel=4)
            if fits_nowhere(tree.points, volume):
                missed = "no point lies inside the volume; perhaps the centerlines are of another scan"
                _log.warning("%s: %s", self.path, missed)
        return tree, report

    def _report(
        self,
        tree: VesselTree,
        stated: Stated,
        place: Placement,
        notes: list[str],
        doubts: list[LineDoubt],
    ) -> CenterlineReport:
        return CenterlineReport(
            format=self._content.format,
            space=place.space,
            unit=place.unit,
            stated=stated.space,
            stated_unit=stated.unit,
            space_from=place.space_from,
            unit_from=place.unit_from,
            vessels=len(tree),
            points=sum(len(vessel) for vessel in tree),
            radius=all(vessel.radius is not None for vessel in tree),
            decision=place.decision,
            is_unusual=place.is_unusual,
            notes=(*notes, *(doubt.text for doubt in doubts)),
            doubts=tuple(doubts),
            fits_also=place.also,
            doubt=place.doubt,
        )


def _mostly_outside(tree: VesselTree, volume: Volume | None) -> bool:
    return volume is not None and 2 * int(volume.contains(tree.points).sum()) < len(tree.points)


def is_poly_data(source: Any) -> bool:
    """Return whether an object is a vtkPolyData, which requires that VTK is loaded."""
    of_vtk = any(cls.__module__.partition(".")[0] == "vtkmodules" for cls in type(source).__mro__)
    return of_vtk and hasattr(source, "GetLines") and hasattr(source, "GetPolys")


def file_of(poly_data: Any) -> bytes:
    """Return the content of the `.vtp` file that VTK writes of poly data, with exact numbers."""
    writer = importlib.import_module("vtkmodules.vtkIOXML").vtkXMLPolyDataWriter()
    writer.SetInputData(poly_data)
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToNone()
    writer.WriteToOutputStringOn()
    writer.Write()
    content: str = writer.GetOutputString()
    return content.encode()
