"""Real centerline files of every format and encoding give the expected vessels, compared with VTK."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from conftest import SHARED_DATA, needs_shared_data
from lumencut import _lumencut
from lumencut.errors import FileError, FormatError, SettingsError
from lumencut.files.centerlines import inspect_centerlines, read_centerlines
from lumencut.scene.vessel_tree import VesselTree

VARIANTS = sorted((SHARED_DATA / "formats" / "vtp_variants").glob("*.vt[pk]"))

# File, vessels, points of all vessels, places where vessels meet.
TREES = [
    ("stent-cta/centerlines.vtp", 9, 1821, 4),
    ("aorta-mra/aorta-centerline.vtp", 3, 347, 1),
    ("aorta-mra/aorta-centerline-branches.vtp", 3, 351, 1),
    ("aorta-mra/aorta_full_centerlines_LPS.vtp", 11, 1649, 5),
    ("dissection-cta/aorta_arch_centerlines_LPS.vtp", 7, 1346, 3),
    ("dissection-cta/aorta_centerline_LPS.vtp", 1, 866, 0),
    ("dissection-cta/true_lumen_centerline_LPS.vtp", 1, 861, 0),
    ("dissection-cta/false_lumen_centerline_LPS.vtp", 1, 813, 0),
    ("centerlines/multimodars/ao_cl.vtp", 1, 152, 0),
    ("centerlines/multimodars/lca_cl.vtp", 9, 1771, 4),
    ("centerlines/multimodars/rca_cl.vtp", 7, 1168, 3),
    ("centerlines/vmtk-attributes/test_vmtkbranchextractor_test_centerline_surface_distance.vtp", 3, 351, 1),
    ("centerlines/vmtk-attributes/test_vmtkcenterlineattributes_test_abscissas.vtp", 3, 347, 1),
    ("centerlines/vmtk-attributes/test_vmtkcenterlinegeometry_test_default_parameters.vtp", 3, 347, 1),
]

NAMES = [name for name, *_ in TREES] + [f"formats/vtp_variants/{path.name}" for path in VARIANTS]


def vessels_of(tree: VesselTree) -> list:
    return [tree[i] for i in range(len(tree))]


def shared_ends(tree: VesselTree) -> int:
    """Return the number of bit-identical end points that several vessels share."""
    ends = [tuple(p) for v in vessels_of(tree) for p in (v.points[0], v.points[-1])]
    return len({p for p in ends if ends.count(p) > 1})


@needs_shared_data
@pytest.mark.parametrize(("name", "vessels", "points", "meetings"), TREES)
def test_lines_that_repeat_a_trunk_become_vessels_that_meet(name, vessels, points, meetings, shared_data):
    tree = read_centerlines(shared_data / name)
    assert len(tree) == vessels
    assert sum(len(v.points) for v in vessels_of(tree)) == points
    assert shared_ends(tree) == meetings
    for vessel in vessels_of(tree):
        assert vessel.radius.shape == (len(vessel.points),)
        assert (np.linalg.norm(np.diff(vessel.points, axis=0), axis=1) > 0).all()
    report = inspect_centerlines(shared_data / name)
    assert (report.space, report.stated, report.vessels, report.points) == ("lps", None, vessels, points)
    assert report.radius
    assert report.decision == "the file states no space and no unit; lps in mm is assumed"


@needs_shared_data
@pytest.mark.parametrize("path", VARIANTS, ids=lambda path: path.name)
def test_every_encoding_gives_the_same_vessels(path, shared_data):
    assert len(VARIANTS) == 11
    reference = read_centerlines(shared_data / "aorta-mra" / "aorta_full_centerlines_LPS.vtp")
    # ASCII files of VTK's legacy writer have only 6 digits; the others are exact.
    tolerance = 1e-3 if path.suffix == ".vtk" and "ascii" in path.name else 0.0
    tree = read_centerlines(path)
    assert len(tree) == len(reference)
    for vessel, expected in zip(vessels_of(tree), vessels_of(reference), strict=True):
        np.testing.assert_allclose(vessel.points, expected.points, rtol=0, atol=tolerance)
        np.testing.assert_allclose(vessel.radius, expected.radius, rtol=0, atol=tolerance)


def vtk_lines(path: Path) -> list[tuple[np.ndarray, np.ndarray]]:
    """Points and radii of every line, as VTK reads them."""
    vtk = pytest.importorskip("vtk", reason="the vtk package is the oracle of this test")
    numpy_support = pytest.importorskip("vtk.util.numpy_support")
    reader = vtk.vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtk.vtkPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    points = numpy_support.vtk_to_numpy(data.GetPoints().GetData()).astype(np.float64)
    radius = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("MaximumInscribedSphereRadius"))
    ids = [point_ids(data.GetCell(i).GetPointIds()) for i in range(data.GetNumberOfCells())]
    return [(points[i], radius[i]) for i in ids]


def point_ids(ids) -> list[int]:
    return [ids.GetId(k) for k in range(ids.GetNumberOfIds())]


@needs_shared_data
@pytest.mark.parametrize("name", NAMES)
def test_the_vessels_cover_exactly_what_vtk_reads(name, shared_data):
    expected = vtk_lines(shared_data / name)
    tree = read_centerlines(shared_data / name)
    steps_read = {step for v in vessels_of(tree) for step in steps(v.points, v.radius)}
    steps_of_vtk = {step for points, radius in expected for step in steps(points, radius)}
    # A line within the weld distance (1/1000 of the spacing) of an earlier line uses its points.
    assert len(steps_read ^ steps_of_vtk) <= 0.025 * len(steps_of_vtk)
    places = np.concatenate([v.points for v in vessels_of(tree)])
    for points, _ in expected:
        nearest = min_distances(points, places)
        assert nearest.max() < 1e-3
    for vessel in vessels_of(tree):
        assert min_distances(vessel.points, np.concatenate([p for p, _ in expected])).max() == 0.0


def steps(points: np.ndarray, radius: np.ndarray) -> set:
    """Return the steps between different neighbouring points with both radii, in no particular direction."""
    rows = [(*p, r) for p, r in zip(points.tolist(), radius.tolist(), strict=True)]
    return {frozenset(pair) for pair in pairwise(rows) if pair[0][:3] != pair[1][:3]}


def min_distances(points: np.ndarray, others: np.ndarray) -> np.ndarray:
    there = set(map(tuple, others.tolist()))
    return np.array(
        [0.0 if p in there else np.linalg.norm(others - p, axis=1).min() for p in map(tuple, points.tolist())]
    )


@needs_shared_data
def test_slicer_curves_are_read_with_their_radius(shared_data):
    files = sorted((shared_data / "centerlines" / "slicer").glob("*.mrk.json"))
    assert len(files) == 6
    for path in files:
        markup = json.loads(path.read_text())["markups"][0]
        expected = np.array([control["position"] for control in markup["controlPoints"]])
        expected = expected[np.r_[True, (np.diff(expected, axis=0) != 0).any(axis=1)]]
        tree = read_centerlines(path)
        assert len(tree) == 1
        np.testing.assert_array_equal(tree[0].points, expected)
        assert tree[0].radius.shape == (len(expected),)
        assert inspect_centerlines(path).stated == "lps"


@needs_shared_data
def test_a_file_with_points_but_no_line_is_named(shared_data):
    path = shared_data / "aorta-mra" / "aorta-centerline-referencesystem.vtp"
    with pytest.raises(FormatError, match=r"referencesystem\.vtp: lines: found 1 point\(s\).*but no line"):
        read_centerlines(path)


SMALL_VTK = """# vtk DataFile Version 3.0
made by hand
ASCII
DATASET POLYDATA
POINTS 4 float
0 0 0  0 0 1  0 1 2  0 -1 2
LINES 2 8
3 0 1 2
3 0 1 3
POINT_DATA 4
SCALARS Radius double
LOOKUP_TABLE default
3 2 1 0.5
"""


def test_a_small_file_made_here_is_read_and_joined(tmp_path):
    path = tmp_path / "y.vtk"
    path.write_text(SMALL_VTK)
    tree = read_centerlines(path)
    assert [v.points.tolist() for v in vessels_of(tree)] == [
        [[0, 0, 0], [0, 0, 1]],
        [[0, 0, 1], [0, 1, 2]],
        [[0, 0, 1], [0, -1, 2]],
    ]
    assert [v.radius.tolist() for v in vessels_of(tree)] == [[3, 2], [2, 1], [2, 0.5]]
    assert "2 line(s) form 3 vessel(s) that meet at shared end points" in inspect_centerlines(path).notes


def test_files_that_cannot_be_read_and_bad_options_are_named(tmp_path):
    with pytest.raises(FileError, match=r"missing\.vtp: found No such file") as caught:
        read_centerlines(tmp_path / "missing.vtp")
    assert isinstance(caught.value, OSError)
    with pytest.raises(FileError, match="directory"):
        read_centerlines(tmp_path)
    path = tmp_path / "y.vtk"
    path.write_text(SMALL_VTK)
    with pytest.raises(SettingsError, match="coordinates: found 'ijk'"):
        read_centerlines(path, "ijk")
    path.write_text(SMALL_VTK.replace("3 0 1 3", "3 0 1 4"))
    with pytest.raises(FormatError, match=r"y\.vtk: point ids of the lines: found 4"):
        read_centerlines(path)


def test_the_extension_gives_plain_arrays():
    file = _lumencut.CenterlineFile(SMALL_VTK.encode(), "y.vtk")
    assert (file.format, file.space, file.unit) == ("legacy VTK", None, None)
    vessels, notes = file.vessels(1.0, reorder=False)
    assert notes[-1] == "2 line(s) form 3 vessel(s) that meet at shared end points"
    for points, radius, name in vessels:
        assert (points.dtype, points.shape, radius.dtype) == (np.float64, (2, 3), np.float64)
        assert name is None
