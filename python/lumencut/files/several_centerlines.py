"""Several centerline files as one tree; for example, 3D Slicer writes a file for each curve."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from lumencut.base.mends import Option, Told
from lumencut.errors import FormatError
from lumencut.files.centerline_file import CenterlineFile, CenterlineReport, is_poly_data
from lumencut.scene.images import as_volume
from lumencut.scene.line_doubts import LineDoubt, line_doubts, settle, warn_of
from lumencut.scene.placement import Coordinates, Unit
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

_log = logging.getLogger("lumencut")


class CenterlineFiles:
    """Centerline files with checked content, before their spaces and units are decided.

    Parameters
    ----------
    sources : list or tuple of paths or vtkPolyData
        At least one, none of them twice.

    Raises
    ------
    FileError, FormatError
        As `CenterlineFile`, and for no file, or the same one twice.
    """

    def __init__(self, sources: Sequence[Any]) -> None:
        if not sources:
            raise FormatError("centerline files", "none", "at least one file")
        self._files = [CenterlineFile(source) for source in sources]
        self._named = [not is_poly_data(source) for source in sources]
        paths = [file.path for file, named in zip(self._files, self._named, strict=True) if named]
        twice = next((path for n, path in enumerate(paths) if path.resolve() in _resolved(paths[:n])), None)
        if twice is not None:
            raise FormatError(str(twice), "a file that is named twice", "each file once")

    def tree(
        self,
        coordinates: Coordinates | None = None,
        unit: Unit | None = None,
        volume: Any = None,
        *,
        reorder: bool = False,
    ) -> VesselTree:
        """Give the vessels of all files in world space, as `read_centerlines` does."""
        volume = None if volume is None else as_volume(volume)
        return self.joined([file.within(volume, coordinates, unit, reorder=reorder) for file in self._files])

    def __iter__(self) -> Iterator[CenterlineFile]:
        return iter(self._files)

    def joined(self, read: Sequence[tuple[VesselTree, CenterlineReport]]) -> VesselTree:
        """Return one tree of all files."""
        self._compare([report for _, report in read])
        tree = VesselTree(
            vessel
            for file, named, (part, _) in zip(self._files, self._named, read, strict=True)
            for vessel in (_called(part, file.path) if named else part)
        )
        tree._space_settled = all(part._space_settled for part, _ in read)
        settle(tree)
        owner = [number for number, (part, _) in enumerate(read) for _ in part]
        across = [doubt for doubt in line_doubts(tree, parallel=True) if _is_across(doubt, owner)]
        warn_of(across, "centerline files")
        return tree

    def _compare(self, reports: Sequence[CenterlineReport]) -> None:
        """Warn if a file was assumed to be LPS while others are not LPS."""
        pairs = list(zip(self._files, reports, strict=True))
        assumed = [file for file, report in pairs if report.space_from == "assumed"]
        for other, report in pairs:
            if assumed and report.space != "lps":
                either = Option("coordinates", "lps"), " or ", Option("coordinates", "ras", "again")
                mend = Told("give a volume, or read them with ", *either)
                found = f"read as LPS, since no space is stated, while {other.path.name} is in {report.space}"
                _log.warning("%s: %s; %s", assumed[0].path, found, mend)
                return


def _called(part: VesselTree, path: Path) -> Iterable[Vessel]:
    """Return the vessels of a file; if there is only one and it has no name, it gets the name of the file."""
    if len(part) > 1 or part[0].name is not None:
        return part
    name = path.name.removesuffix(path.suffix)
    name = name.removesuffix(".mrk") if path.suffix.lower() == ".json" else name
    return [Vessel(part[0].points, part[0].radius, name)]


def _is_across(doubt: LineDoubt, owner: Sequence[int]) -> bool:
    """Return whether a doubt is about vessels of two files."""
    return doubt.other is not None and owner[doubt.vessel] != owner[doubt.other]


def _resolved(paths: Iterable[Path]) -> set[Path]:
    return {path.resolve() for path in paths}
