"""For the browser test of "Save for PACS": serves a built page, and reads saved archives.

python tests/pacs_page.py web/dist [scan]

prints a line of JSON, and serves until its input ends. Each line of the input names an archive; what its
objects contain is printed as a line of JSON.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pydicom

from dicom_judges import faults
from dicom_phantom import instance, save
from dicom_scenes import LINE, scan, series
from lumencut import Vessel, VesselTree, Volume, write_centerlines
from lumencut.files.volumes import open_volume
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.page import Page
from lumencut.viewer.server import ViewerServer
from pacs_requests import NAME, members
from segmentation_files import segmentation
from test_dicom_reports import child, code, groups, numbers


def serve(page: Path, shows_scan: bool) -> None:
    """Serve the page, empty or with the phantom and its vessel; print address, file names and archives."""
    tree = VesselTree([Vessel(LINE[0].points, 3.0, NAME)])
    scene = ArrivingScene(open_volume(series()), lambda _: tree) if shows_scan else None
    with tempfile.TemporaryDirectory() as folder, ViewerServer(Page.of(page), scene) as server:
        names = ("lines.vtp", "tube.dcm", "contours.dcm", "other.dcm")
        lines, tube, contours, other = (Path(folder) / name for name in names)
        _write_other_patient(other)
        write_centerlines(tree, lines)
        save(segmentation({5: _tube()}, {5: NAME}), tube)
        save(instance(1, 1, pydicom.uid.RTStructureSetStorage, "RTSTRUCT"), contours)
        files = [str(path) for path in sorted(series().iterdir())]
        beside = {"lines": str(lines), "segmentation": str(tube), "contours": str(contours)}
        beside["other"] = str(other)
        print(json.dumps({"address": server.place.address, "files": files, **beside}), flush=True)
        for archive in sys.stdin:
            print(json.dumps(read(Path(archive.strip()))), flush=True)


def _write_other_patient(path: Path) -> None:
    """Write a slice of the scan under the name of another patient."""
    data = pydicom.dcmread(next(iter(sorted(series().iterdir()))))
    data.PatientID, data.PatientName = "B-2", "Roe^Mary"
    data.save_as(path)


def _tube() -> Volume:
    """Return the lumen of the phantom's vessel as a mask on the grid of the scan."""
    volume = scan()
    index = np.stack(np.meshgrid(*map(np.arange, volume.size), indexing="ij"), -1).reshape(-1, 3)
    places = index @ volume.world_from_index[:3, :3].T + volume.world_from_index[:3, 3]
    x, y = (places - LINE[0].points[0])[:, :2].T
    inside = (np.hypot(x, y) < 3) & (index[:, 2] > 3) & (index[:, 2] < volume.size[2] - 4)
    mask = inside.reshape(volume.size).transpose(2, 1, 0).astype(np.uint8)
    return Volume(mask, world_from_index=volume.world_from_index)


def read(archive: Path) -> dict[str, Any]:
    """Return the content of the objects by their names."""
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
        told["words"] = [one.value for one in data.iterall() if one.keyword == "TextValue"]
        told["diameters"] = [numbers(one)[0][1] for one in groups(path)]
    return told


if __name__ == "__main__":
    serve(Path(sys.argv[1]), sys.argv[2:] == ["scan"])
