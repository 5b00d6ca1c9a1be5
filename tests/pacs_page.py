"""For the browser's test of "Save for PACS": serves a built page, and reads the archive that it saves.

python tests/pacs_page.py serve web/dist [scan]    prints a line of JSON, and serves until its input ends
python tests/pacs_page.py read archive.zip         prints what the objects of an archive say, as JSON
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import pydicom

from dicom_judges import faults
from dicom_scenes import LINE, series
from lumencut import Vessel, VesselTree, write_centerlines
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.page import Page
from lumencut.viewer.server import ViewerServer
from lumencut.volume_files import open_volume
from pacs_requests import NAME, members
from test_dicom_reports import child, code, groups, numbers


def serve(page: Path, shows_scan: bool) -> None:
    """Serve the page, empty or with the phantom and its vessel, and tell where, and which files there are."""
    tree = VesselTree([Vessel(LINE[0].points, 3.0, NAME)])
    scene = ArrivingScene(open_volume(series()), lambda _: tree) if shows_scan else None
    with tempfile.TemporaryDirectory() as folder, ViewerServer(Page.of(page), scene) as server:
        lines = Path(folder) / "lines.vtp"
        write_centerlines(tree, lines)
        files = [str(path) for path in sorted(series().iterdir())]
        print(json.dumps({"address": server.place.address, "files": files, "lines": str(lines)}), flush=True)
        sys.stdin.read()


def read(archive: Path) -> dict[str, Any]:
    """What the objects say, by their names."""
    with tempfile.TemporaryDirectory() as folder:
        found = members(archive.read_bytes(), Path(folder))
        return {name: _told(path) for name, path in found.items()}


def _told(path: Path) -> dict[str, Any]:
    data = pydicom.dcmread(path)
    told = {
        "errors": faults(path),
        "patient": str(data.PatientName),
        "description": data.SeriesDescription,
        "sources": len(data.get("SourceImageSequence", ())),
        "size": [data.get("Columns"), data.get("Rows")],
    }
    if path.name == "report.dcm":
        told["findings"] = [code(child(one, "Finding")[0].ConceptCodeSequence)[2] for one in groups(path)]
        told["names"] = sorted({child(one, "Tracking Identifier")[0].TextValue for one in groups(path)})
        told["diameters"] = [numbers(one)[0][1] for one in groups(path)]
    return told


if __name__ == "__main__":
    if sys.argv[1] == "serve":
        serve(Path(sys.argv[2]), sys.argv[3:] == ["scan"])
    else:
        print(json.dumps(read(Path(sys.argv[2]))))
