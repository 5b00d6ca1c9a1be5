"""Requests for "Save for PACS" as the page sends them, about vessels that Python measured."""

from __future__ import annotations

import base64
import io
import json
import zipfile
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

import lumencut
from dicom_scenes import LINE, scan, series
from lumencut import Camera, Renderer, Vessel, VesselTree, _lumencut
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
from lumencut.pictures.picture_file import picture_as_png
from lumencut.reports.measure_report import report

NAME = "left renal artery"
MARKED = Marked(12.0, (24.0,))
#: The options of `lumencut measure` that its JSON and its report repeat.
ASKED: dict[str, Any] = {
    "step": 0.5,
    "fwhm": None,
    "at": 12.0,
    "reference": [24.0],
    **dict.fromkeys(("method", "original", "comparison", "group")),
}


@cache
def profile(name: str | None) -> lumencut.Profile:
    """The measured vessel of the phantom."""
    return lumencut.measure(scan(), Vessel(LINE[0].points, 3.0, name))


@cache
def measured(marked: Marked = MARKED, name: str | None = NAME) -> MeasuredVessel:
    """The vessel of the phantom, with marks."""
    vessel = Vessel(LINE[0].points, 3.0, name)
    return MeasuredVessel.of("0", vessel, profile(name), marked)


@cache
def renderer() -> Renderer:
    """A renderer of the phantom."""
    return Renderer(scan(), VesselTree([Vessel(LINE[0].points, 3.0, NAME)]))


def camera() -> Camera:
    """The view of the picture."""
    return Camera.anterior(renderer().scene, (96, 64))


@cache
def frame() -> lumencut.Frame:
    """The picture as Python renders it."""
    return renderer().render(camera())


def encoded(content: bytes) -> str:
    """Bytes as the page sends them."""
    return base64.b64encode(content).decode()


@cache
def html(marked: Marked = MARKED, name: str | None = NAME) -> str:
    """The report that Python writes."""
    return report(renderer(), scan(), [measured(marked, name)], ASKED)


def header() -> bytes:
    """Return the part of a slice's file before the pixels."""
    content = next(iter(sorted(series().iterdir()))).read_bytes()
    return content[: content.rindex(b"\xe0\x7f\x10\x00") + 12]


def view_part() -> dict[str, Any]:
    """The part of the request about the turning view."""
    shown = camera()
    vectors = {name: [float(one) for one in getattr(shown, name)] for name in ("center", "direction", "up")}
    return {
        "picture": encoded(picture_as_png(frame().image)),
        "camera": {**vectors, "pixel_spacing": shown.pixel_spacing},
        "method": "csr",
        "settings": {"window": [300, 900]},
        "has_cut": True,
    }


def finding_part(one: MeasuredVessel, marked: Marked = MARKED) -> dict[str, Any]:
    """A finding with its key image."""
    return {
        "picture": encoded(picture_as_png(frame().image)),
        "name": one.vessel.name or "",
        "points": one.vessel.points.tolist(),
        "profile": _lumencut.profile_record(one.profile._core),
        "marks": {**asdict(marked), "stretch": None, "secondStretch": None},
    }


def request(choice: str = "scan", marked: Marked = MARKED, name: str | None = NAME) -> dict[str, Any]:
    """A request for all objects of a scan that the server shows."""
    one = measured(marked, name)
    return {
        "version": 2,
        "study": {"choice": choice, "is_served": True, "header": None, "instances": [], "study_count": 1},
        "fingerprint": "a scan",
        "stated": {"spacing": True, "orientation": True},
        "view": view_part(),
        "pane": {"picture": encoded(picture_as_png(frame().image)), "axes": "Rows run along the vessel."},
        "findings": [finding_part(one, marked)],
        "report": html(marked, name),
    }


def dropped(choice: str = "scan", **study: Any) -> dict[str, Any]:
    """The same request for a DICOM folder that was dropped into the page."""
    asked = request(choice)
    uids = [data.SOPInstanceUID for data in slices()]
    given = {"choice": choice, "is_served": False, "header": encoded(header()), "instances": uids}
    return {**asked, "study": {**given, "study_count": 1, **study}}


@cache
def slices() -> list[Any]:
    """Return the headers of all slices of the scan."""
    import pydicom

    return [pydicom.dcmread(path, stop_before_pixels=True) for path in sorted(series().iterdir())]


def sent(asked: dict[str, Any]) -> bytes:
    """Return a request as bytes."""
    return json.dumps(asked).encode()


def members(archive: bytes, folder: Path) -> dict[str, Path]:
    """Return the files of an archive, unpacked."""
    with zipfile.ZipFile(io.BytesIO(archive)) as opened:
        assert opened.testzip() is None
        opened.extractall(folder)
        return {name: folder / name for name in opened.namelist()}
