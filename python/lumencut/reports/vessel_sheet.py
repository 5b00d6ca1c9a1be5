"""A sheet of a whole tree: the tree in the body, the tree untangled, and each vessel along its length."""

from __future__ import annotations

import base64
import io
import os
from collections.abc import Callable, Iterable
from html import escape
from pathlib import Path
from typing import Any, Literal, SupportsIndex

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback
from lumencut.base.paths import WRITABLE, checked_path, replace_whole, write_text
from lumencut.errors import FormatError, LumencutError, VesselTreeError
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
from lumencut.measuring.measurements import Measurements
from lumencut.measuring.profile_plot import check_matplotlib
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.lumen_mapping import LumenMapRequest
from lumencut.reformations.planar_reformation import CprRequest
from lumencut.reformations.untangling import untangled
from lumencut.reports.sheet_layout import Strip, sheet_figure
from lumencut.scene.camera import Camera
from lumencut.scene.images import as_volume
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

_ENDINGS = (".pdf", ".png", ".html", ".htm")
#: Most vessels on a sheet; each takes a row of its page.
MOST_VESSELS = 12
#: Pixels of a side of the two pictures of the tree.
_TREE_PIXELS = 900
#: Width of a straightened CPR: lumen diameters, and at least this many mm.
_DIAMETERS, _LEAST_WIDTH = 3.0, 16.0
_DPI = 150


def sheet(
    volume: Volume | Any,
    tree: VesselTree,
    path: str | os.PathLike[str],
    *,
    vessels: Iterable[SupportsIndex | str] | None = None,
    device: Literal["auto", "cpu", "gpu"] = "auto",
    progress: Callable[[int, int], object] | None = None,
) -> list[str]:
    """Write one page that shows a whole tree, and every vessel along its length.

    At its top stand the tree from the front in the look ``focus``, and the untangled tree. Below them each
    vessel has a row: a straightened CPR that always cuts the narrowest side, the lumen map, and the diameter
    with its uncertainty. They share one axis of arc length, which has the same scale for all vessels. Red
    lines mark the places that :func:`lumencut.measure` suggests.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography.
    tree : VesselTree
        Its vessels.
    path : str or path
        The file: ``.pdf``, ``.png``, or ``.html`` with the findings as text.
    vessels : iterable of int or str, optional
        Ids or names of the vessels with a row, at most 12; by default the longest ones.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that computes, as for :class:`Renderer`.
    progress : callable, optional
        Called with (done, total), the numbers of finished rows and of all.

    Returns
    -------
    list of str
        The findings: a line for each.

    Raises
    ------
    VesselTreeError
        For another kind of tree, more than 12 vessels, or an id or name that no vessel has.
    FormatError
        For another extension.
    FileError
        If the file cannot be written.
    MissingPackageError
        Without matplotlib.
    """
    place = checked_path(path, WRITABLE)
    if place.suffix.lower() not in _ENDINGS:
        raise FormatError(str(path), f"the extension {place.suffix!r}", " or ".join(_ENDINGS))
    check_matplotlib()
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("tree of the sheet", type(tree).__name__, "a VesselTree")
    callback(VesselTreeError, "progress", progress)
    ids = _chosen(tree, vessels)
    scene = _Scene(as_volume(volume), tree, device)
    rows = []
    for done, number in enumerate(ids):
        if progress is not None:
            progress(done, len(ids))
        rows.append(scene.strip(number))
    left = len(tree) - len(ids)
    figure = sheet_figure(scene.in_the_body(), scene.untangled(), rows, _left_out(left))
    findings = [f"{row.title}: {line}" for row in rows for line in row.findings]
    _write(figure, place, findings)
    if progress is not None:
        progress(len(ids), len(ids))
    return findings


def _chosen(tree: VesselTree, vessels: Iterable[SupportsIndex | str] | None) -> list[int]:
    """Return the ids of the vessels with a row, in the order of the tree."""
    if vessels is None:
        longest = sorted(range(len(tree)), key=lambda number: (-tree[number].length, number))
        return sorted(longest[:MOST_VESSELS])
    if not isinstance(vessels, Iterable):
        raise VesselTreeError("vessels of the sheet", type(vessels).__name__, "ids or names")
    ids = sorted(set(tree.ids(*vessels)))
    if not 1 <= len(ids) <= MOST_VESSELS:
        raise VesselTreeError("vessels of the sheet", f"{len(ids)} vessels", f"1 to {MOST_VESSELS} of them")
    return ids


def _left_out(count: int) -> str:
    if count == 0:
        return ""
    return f"{count} shorter or unchosen {'vessel has' if count == 1 else 'vessels have'} no row."


class _Scene:
    """The volume and the tree of a sheet, with what renders and measures them."""

    def __init__(self, volume: Volume, tree: VesselTree, device: Literal["auto", "cpu", "gpu"]) -> None:
        self.volume, self.tree, self.device = volume, tree, device
        self.renderer = Renderer(volume, tree, device)
        self.measurements = Measurements(volume, tree)

    def in_the_body(self) -> npt.NDArray[np.uint8]:
        """Return the tree from the front, with its surroundings."""
        camera = Camera.anterior(self.tree, (_TREE_PIXELS, _TREE_PIXELS))
        return self.renderer.render(camera, Settings.focused(), images=["image"]).annotated()

    def untangled(self) -> npt.NDArray[np.uint8] | str:
        """Return the untangled tree, or why it cannot be laid out."""
        camera = Camera.anterior(self.tree, (_TREE_PIXELS, _TREE_PIXELS))
        try:
            return untangled(self.volume, self.tree, camera, device=self.device).annotated()
        except LumencutError as error:
            return str(error)

    def strip(self, number: int) -> Strip:
        """Return the row of a vessel; without a measured lumen, only its CPR."""
        vessel = self.tree[number]
        title = f"vessel {number}" if vessel.name is None else f"vessel {number} {vessel.name}"
        try:
            profile = self.measurements.profile(number)
        except LumencutError as error:
            made = CprRequest("straightened", _LEAST_WIDTH).of(self.renderer, vessel)
            cut = np.rot90(made.image)
            return Strip(title, vessel.length, cut, _LEAST_WIDTH, None, None, (), (str(error),))
        measured = MeasuredVessel.of(str(number), vessel, profile, Marked())
        width = max(_LEAST_WIDTH, _DIAMETERS * float(np.nanmedian(profile.diameter_equivalent)))
        narrow = CprRequest("straightened", width, roll="narrowest", profile=profile).of(
            self.renderer, vessel
        )
        wall = LumenMapRequest("wall", profile=profile).of(self.renderer, vessel)
        pictures = np.rot90(narrow.image), width, np.rot90(wall.image)
        return Strip(title, vessel.length, *pictures, profile, measured.marks, tuple(measured.lines))


def _write(figure: Any, path: Path, findings: list[str]) -> None:
    """Write the figure in the format of the extension; equal sheets give equal bytes."""
    kind = path.suffix.lower().removeprefix(".")
    if kind in ("html", "htm"):
        content = io.BytesIO()
        figure.savefig(content, format="png", dpi=_DPI, metadata={"Software": None})
        write_text(path, _html(content.getvalue(), findings))
        return
    software = f"Lumencut {_lumencut.__version__}"
    about: dict[str, Any] = {"Software": software}
    if kind == "pdf":
        about = {"Title": "Lumencut: sheet of vessels", "Creator": software, "CreationDate": None}
    replace_whole(path, lambda whole: figure.savefig(whole, format=kind, dpi=_DPI, metadata=about))


def _html(picture: bytes, findings: list[str]) -> str:
    listed = "".join(f"<li>{escape(line)}</li>" for line in findings)
    shown = base64.b64encode(picture).decode("ascii")
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Sheet of vessels</title>'
        "<style>body { font: 16px/1.5 system-ui, sans-serif; margin: 2em } img { max-width: 100% }</style>"
        f'</head><body><h1>Sheet of vessels</h1><img alt="The tree, and each vessel along its length" '
        f'src="data:image/png;base64,{shown}"><ul>{listed}</ul>'
        "<p>Lumencut is not a medical device (research, not for diagnosis).</p></body></html>\n"
    )
