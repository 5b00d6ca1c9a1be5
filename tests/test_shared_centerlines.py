"""Every centerline file of the shared data, compared with a simple parser of its text or with VTK."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from conftest import SHARED_DATA, needs_shared_data
from lumencut import read_centerlines
from lumencut.files.centerlines import inspect_centerlines

pytestmark = needs_shared_data

#: Format, unit, number of vessels and points of the tree, and whether all vessels have radii.
FILES = {
    "centerlines/simvascular/aorta.pth": ("SimVascular path", "cm", 1, 316, False),
    "centerlines/simvascular/left-iliac.pth": ("SimVascular path", "cm", 1, 90, False),
    "centerlines/simvascular/seeds.pth": ("SimVascular path", "cm", 1, 100, False),
    "centerlines/multimodars/centerline_aorta.csv": ("text table", "mm", 1, 75, False),
    "centerlines/multimodars/centerline_raw.csv": ("text table", "mm", 1, 188, False),
    "centerlines/multimodars/centerline_lca.csv": ("text table", "mm", None, None, False),
    "centerlines/multimodars/centerline_rca.csv": ("text table", "mm", None, None, False),
    "centerlines/multimodars/centerline_rca_short.csv": ("text table", "mm", None, None, False),
    "formats/aorta.swc": ("SWC", "mm", 11, 825, True),
    "formats/aorta_x_y_z_r.csv": ("text table", "mm", 11, 1649, True),
    "formats/rotterdam/vessel0/reference.txt": ("Rotterdam reference", "mm", 1, 774, True),
    "formats/rotterdam/vessel1/reference.txt": ("Rotterdam reference", "mm", 1, 773, True),
    "formats/aorta_curve_LPS.mrk.json": ("3D Slicer markups", "mm", 1, 97, True),
    "formats/aorta_curve_RAS.mrk.json": ("3D Slicer markups", "mm", 1, 97, True),
    **{
        f"centerlines/slicer/Centerline curve {name}.mrk.json": ("3D Slicer markups", "mm", 1, count, True)
        for name, count in {
            "(0)": 30,
            "(10)": 11,
            "- LCCA": 252,
            "- LVA": 208,
            "- RCCA": 235,
            "- RVA": 224,
        }.items()
    },
}
#: One point and no line: `test_centerline_files.py` checks that it is rejected.
NO_CENTERLINE = "aorta-mra/aorta-centerline-referencesystem.vtp"
POLY_DATA = sorted(
    name
    for path in SHARED_DATA.rglob("*.vt[pk]")
    if (name := path.relative_to(SHARED_DATA).as_posix()) != NO_CENTERLINE
)


def stated_points(path: Path) -> np.ndarray:
    """Return all points of a file in mm and LPS, read in the simplest way for its format."""
    if path.suffix == ".pth":
        places = re.findall(r'<pos x="([^"]+)" y="([^"]+)" z="([^"]+)"', path.read_text())
        return 10.0 * np.array(places, float)
    if path.suffix == ".json":
        (markup,) = json.loads(path.read_text())["markups"]
        points = np.array([control["position"] for control in markup["controlPoints"]])
        return points * ((-1, -1, 1) if markup["coordinateSystem"] == "RAS" else (1, 1, 1))
    if path.suffix == ".swc":
        return np.loadtxt(path)[:, 2:5]
    if path.suffix == ".csv":
        named = "X" in path.read_text()[:40]
        return (
            np.loadtxt(path, delimiter=",", skiprows=int(named))[:, 1:4]
            if named
            else np.loadtxt(path, delimiter=",")
        )
    return np.loadtxt(path)[:, :3]


def distances(points: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return the distance from each point to the nearest of the others."""
    there = set(map(tuple, others.tolist()))
    return np.array(
        [
            0.0 if point in there else np.linalg.norm(others - point, axis=1).min()
            for point in map(tuple, points.tolist())
        ]
    )


@pytest.mark.parametrize("name", FILES)
def test_a_file_holds_what_stands_in_its_text(name, caplog):
    path = SHARED_DATA / name
    form, unit, vessels, count, radius = FILES[name]
    tree, report = read_centerlines(path), inspect_centerlines(path)
    assert (report.format, report.unit, report.radius) == (form, unit, radius)
    assert (len(tree), len(tree.points)) == (report.vessels, report.points)
    if vessels is not None:
        assert (report.vessels, report.points) == (vessels, count)
    # Ends that run closely along another line are moved onto it; all other points are those in the file.
    stated = stated_points(path)
    assert np.quantile(distances(tree.points, stated), 0.99) < 1e-9
    assert distances(tree.points, stated).max() < 0.5
    assert distances(stated, tree.points).max() < 0.5


def points_by_vtk(path: Path) -> np.ndarray:
    """The points of all lines (mm) as VTK reads them."""
    reader = vtk.vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtk.vtkPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    ids = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    return vtk_to_numpy(data.GetPoints().GetData()).astype(np.float64)[ids]


@pytest.mark.parametrize("name", POLY_DATA)
def test_poly_data_hold_what_vtk_reads(name):
    tree, stated = read_centerlines(SHARED_DATA / name, "lps"), points_by_vtk(SHARED_DATA / name)
    assert all(vessel.radius is not None and (vessel.radius > 0).all() for vessel in tree)
    assert np.quantile(distances(tree.points, stated), 0.99) < 1e-9
    assert distances(tree.points, stated).max() < 0.5
    # Points that ran along another line are within a tenth of its radius, or half of it in one group.
    assert distances(stated, tree.points).max() < 5.0
    assert np.quantile(distances(stated, tree.points), 0.9) < 0.5


@pytest.mark.parametrize(("name", "vessels"), [("lca", 5), ("rca", 4), ("rca_short", 4)])
def test_coronary_tables_have_no_vessel_across_the_heart(name, vessels):
    """Branches in these tables follow one after the other, with gaps of up to 112 mm."""
    tree = read_centerlines(SHARED_DATA / f"centerlines/multimodars/centerline_{name}.csv")
    steps = np.concatenate([np.linalg.norm(np.diff(vessel.points, axis=0), axis=1) for vessel in tree])
    assert steps.max() < 2.0
    assert len(tree) >= vessels


def test_every_file_is_tested():
    folders = ("formats", "centerlines", "stent-cta", "dissection-cta", "aorta-mra")
    files = [path for folder in folders for path in (SHARED_DATA / folder).rglob("*") if path.is_file()]
    names = {path.relative_to(SHARED_DATA).as_posix() for path in files}
    lines = {name for name in names if not name.endswith(("LICENSE", ".nii.gz", ".mha"))}
    assert lines == {*FILES, *POLY_DATA, NO_CENTERLINE}
