"""`read_centerlines` and VTK read back what `write_centerlines` wrote, `read_centerlines` bit-identically."""

import json
import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import lumencut
from conftest import odd_lines
from lumencut import FileError, FormatError, Vessel, VesselTree, VesselTreeError, write_centerlines
from lumencut.files.centerlines import inspect_centerlines

pytestmark = odd_lines

ENDINGS = (".vtp", ".mrk.json")
OTHER_ENDINGS = (".vtk", ".csv", ".swc")

coordinate = st.floats(-1e6, 1e6) | st.sampled_from([0.0, -0.0, 1e-300, 5e-324, 1e6, 0.1])
point = st.tuples(coordinate, coordinate, coordinate)
names = (
    st.none()
    | st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"))
    | st.sampled_from(["LAD", "línea 静脈 🩸", "a \"b\" 'c' <d> & e", "two\nlines", "", " "])
)


@st.composite
def trees(draw) -> VesselTree:
    """Return random trees, in which many vessels begin at a point of another one."""
    vessels: list[Vessel] = []
    for _ in range(draw(st.integers(1, 4))):
        points = draw(st.lists(point, min_size=2, max_size=8))
        if vessels and draw(st.booleans()):
            other = vessels[draw(st.integers(0, len(vessels) - 1))].points
            points[0] = tuple(other[draw(st.integers(0, len(other) - 1))])
        kept = [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]
        if len(kept) < 2:
            kept.append((kept[0][0] / 2 + 1.5, 7.0, 7.0))
        radius = st.lists(st.floats(0.0, 1e6), min_size=len(kept), max_size=len(kept))
        vessels.append(Vessel(kept, draw(st.none() | radius), draw(names)))
    return VesselTree(vessels)


def parts(tree: VesselTree) -> list[tuple[bytes, bytes | None, str | None]]:
    return [(v.points.tobytes(), None if v.radius is None else v.radius.tobytes(), v.name) for v in tree]


def small_tree() -> VesselTree:
    trunk = Vessel([[0, 0, 0], [0, 0, 0.1], [0, 0, 1 / 3]], [3.0, 2.5, 1e-7], "trunk <&> ")
    left = Vessel([[0, 0, 1 / 3], [1, 0, 5e-324]], [0.1, 0.2], "ramus línea")
    return VesselTree([trunk, left, Vessel([[0, 0, 1 / 3], [-1, 0, 2]], 1.0)])


@pytest.mark.parametrize("ending", ENDINGS)
@settings(deadline=None, max_examples=150)
@given(tree=trees())
def test_trees_come_back_to_the_bit(tmp_path_factory, ending, tree):
    path = tmp_path_factory.getbasetemp() / f"tree{ending}"
    write_centerlines(tree, path)
    assert parts(lumencut.read_centerlines(path)) == parts(tree)


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_report_finds_nothing_odd(tmp_path, ending):
    path = tmp_path / f"TREE{ending.upper()}"
    write_centerlines(small_tree(), str(path))
    report = inspect_centerlines(path)
    assert (report.stated, report.vessels, report.points, report.radius) == ("lps", 3, 7, True)
    assert len(report.notes) == 1
    assert "radius" in report.notes[0]
    assert os.listdir(tmp_path) == [path.name]


@pytest.mark.parametrize("ending", ENDINGS)
def test_vessels_that_run_side_by_side_stay_two(tmp_path, ending):
    steps = np.linspace(0.0, 30.0, 61)
    near = [Vessel(np.stack([steps, y * steps, 0 * steps], axis=1), 2.0) for y in (0.0, 0.001)]
    write_centerlines(VesselTree(near), tmp_path / f"near{ending}")
    assert parts(lumencut.read_centerlines(tmp_path / f"near{ending}")) == parts(VesselTree(near))


def test_vtk_reads_the_vtp(tmp_path):
    vtk = pytest.importorskip("vtk", reason="the vtk package reads the file of this test")
    from vtk.util.numpy_support import vtk_to_numpy

    tree = small_tree()
    write_centerlines(tree, tmp_path / "tree.vtp")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "tree.vtp"))
    reader.Update()
    assert reader.GetErrorCode() == 0
    data = reader.GetOutput()
    assert vtk_to_numpy(data.GetPoints().GetData()).tobytes() == tree.points.tobytes()
    ids = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    ends = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    assert (ids.tolist(), ends.tolist()) == (list(range(7)), [0, 3, 5, 7])
    radius = vtk_to_numpy(data.GetPointData().GetArray("MaximumInscribedSphereRadius"))
    assert radius.tobytes() == np.concatenate([vessel.radius for vessel in tree]).tobytes()
    texts = data.GetCellData().GetAbstractArray("Name")
    assert [texts.GetValue(i) for i in range(3)] == ["trunk <&> ", "ramus línea", ""]
    assert vtk_to_numpy(data.GetCellData().GetArray("HasName")).tolist() == [1, 1, 0]
    assert data.GetFieldData().GetAbstractArray("SPACE").GetValue(0) == "LPS"


@pytest.mark.parametrize("mode", ["Ascii", "Binary", "Appended"])
def test_names_and_the_mark_survive_vtk(tmp_path, mode):
    vtk = pytest.importorskip("vtk", reason="the vtk package writes the file of this test")
    tree = small_tree()
    write_centerlines(tree, tmp_path / "tree.vtp")
    reader, writer = vtk.vtkXMLPolyDataReader(), vtk.vtkXMLPolyDataWriter()
    reader.SetFileName(str(tmp_path / "tree.vtp"))
    writer.SetInputConnection(reader.GetOutputPort())
    writer.SetFileName(str(tmp_path / "again.vtp"))
    getattr(writer, f"SetDataModeTo{mode}")()
    assert writer.Write() == 1
    back = lumencut.read_centerlines(tmp_path / "again.vtp")
    assert [vessel.name for vessel in back] == [vessel.name for vessel in tree]
    assert [len(vessel) for vessel in back] == [3, 2, 2]


def test_markups_are_those_of_3d_slicer(tmp_path):
    write_centerlines(small_tree(), tmp_path / "tree.mrk.json")
    content = json.loads((tmp_path / "tree.mrk.json").read_text("utf-8"))
    assert content["@schema"].endswith("/markups-schema-v1.0.3.json#")
    curve = content["markups"][0]
    assert (curve["type"], curve["coordinateSystem"], curve["coordinateUnits"]) == ("Curve", "LPS", "mm")
    assert curve["name"] == "trunk <&> "
    assert [c["id"] for c in curve["controlPoints"]] == ["1", "2", "3"]
    assert {c["positionStatus"] for c in curve["controlPoints"]} == {"defined"}
    assert curve["measurements"][0]["controlPointValues"] == [3.0, 2.5, 1e-7]
    assert "name" not in content["markups"][2]


@pytest.mark.parametrize("name", ["tree.npy", "tree.json", "tree", "vtp"])
def test_other_endings_are_refused(tmp_path, name):
    with pytest.raises(FormatError, match=r"expected '\.vtp', '\.vtk', '\.mrk\.json', '\.swc' or '\.csv'"):
        write_centerlines(small_tree(), tmp_path / name)
    assert os.listdir(tmp_path) == []


def test_what_is_no_tree_is_refused(tmp_path):
    with pytest.raises(VesselTreeError, match="found list; expected a VesselTree"):
        write_centerlines([], tmp_path / "tree.vtp")
    repeated = VesselTree([Vessel([[0, 0, 0], [0, 0, 0], [0, 0, 1]])])
    with pytest.raises(VesselTreeError, match="point 1 equal to the one before"):
        write_centerlines(repeated, tmp_path / "tree.vtp")
    for name, found in (("a\0b", "null character"), ("a\ud800", "ud800")):
        with pytest.raises(VesselTreeError, match=found):
            write_centerlines(VesselTree([Vessel([[0, 0, 0], [0, 0, 1]], name=name)]), tmp_path / "tree.vtp")
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_place_that_cannot_be_written_keeps_what_it_has(tmp_path, ending):
    with pytest.raises(FileError):
        write_centerlines(small_tree(), tmp_path / "missing" / f"tree{ending}")
    folder = tmp_path / f"folder{ending}"
    folder.mkdir()
    with pytest.raises(FileError):
        write_centerlines(small_tree(), folder)
    assert sorted(p.name for p in tmp_path.rglob("*")) == [folder.name]


def fork(radius=2.0):
    """A trunk with two branches that begin at its end."""
    steps = np.linspace(0, 1, 9)[:, None]
    end = np.array([0.0, 0.0, 20.0])
    branches = [(np.zeros(3), end), (end, np.array([9.0, 0, 30])), (end, np.array([-9.0, 0, 31]))]
    return VesselTree([Vessel(a + steps * (b - a), radius) for a, b in branches])


@pytest.mark.parametrize("radius", [2.1, None])
@pytest.mark.parametrize("ending", OTHER_ENDINGS)
def test_a_fork_comes_back_from_the_other_formats(tmp_path, ending, radius):
    write_centerlines(fork(radius), tmp_path / f"tree{ending}")
    assert lumencut.read_centerlines(tmp_path / f"tree{ending}", "lps", unit="mm") == fork(radius)
    report = inspect_centerlines(tmp_path / f"tree{ending}")
    assert (report.stated, report.stated_unit) == ((None, None) if ending == ".swc" else ("lps", "mm"))


def test_vtk_reads_the_legacy_file(tmp_path):
    vtk = pytest.importorskip("vtk", reason="the vtk package reads the file of this test")
    from vtk.util.numpy_support import vtk_to_numpy

    tree = small_tree()
    write_centerlines(tree, tmp_path / "tree.vtk")
    reader = vtk.vtkPolyDataReader()
    reader.ReadAllFieldsOn()
    reader.SetFileName(str(tmp_path / "tree.vtk"))
    reader.Update()
    data = reader.GetOutput()
    assert vtk_to_numpy(data.GetPoints().GetData()).tobytes() == tree.points.tobytes()
    assert vtk_to_numpy(data.GetLines().GetOffsetsArray()).tolist() == [0, 3, 5, 7]
    radius = vtk_to_numpy(data.GetPointData().GetArray("MaximumInscribedSphereRadius"))
    assert radius.tobytes() == np.concatenate([vessel.radius for vessel in tree]).tobytes()
    texts = data.GetCellData().GetAbstractArray("Name")
    assert [texts.GetValue(i) for i in range(3)] == ["trunk <&> ", "ramus línea", ""]


def test_rows_and_nodes(tmp_path):
    trunk = Vessel([[0, 0, 0], [0, 0, 1]], [3.0, 2.5], 'a, "b"')
    tree = VesselTree([Vessel([[0, 0, 1], [1, 0, 2]]), trunk])
    write_centerlines(tree, tmp_path / "tree.csv")
    assert (tmp_path / "tree.csv").read_text("utf-8").splitlines() == [
        "line,name,l (mm),p (mm),s (mm),radius (mm)",
        "0,,0.0,0.0,1.0,0.0",
        "0,,1.0,0.0,2.0,0.0",
        '1,"a, ""b""",0.0,0.0,0.0,3.0',
        '1,"a, ""b""",0.0,0.0,1.0,2.5',
    ]
    write_centerlines(tree, tmp_path / "tree.swc")
    assert (tmp_path / "tree.swc").read_text("utf-8").splitlines()[2:] == [
        "1 0 0.0 0.0 0.0 3.0 -1",
        "2 0 0.0 0.0 1.0 2.5 1",
        "3 0 1.0 0.0 2.0 0.0 2",
    ]
    two_lines = VesselTree([Vessel([[0, 0, 0], [0, 0, 1]], name="two\nlines")])
    with pytest.raises(VesselTreeError, match="name of line 0: found a line break"):
        write_centerlines(two_lines, tmp_path / "two.csv")


@pytest.mark.parametrize("ending", OTHER_ENDINGS)
@settings(deadline=None, max_examples=100)
@given(tree=trees())
def test_the_points_of_any_tree_come_back_from_the_other_formats(tmp_path_factory, ending, tree):
    path = tmp_path_factory.getbasetemp() / f"tree{ending}"
    if ending == ".csv":
        # A table cannot hold names with line breaks, and names in tables are not read.
        tree = VesselTree(Vessel(vessel.points, vessel.radius) for vessel in tree)
    write_centerlines(tree, path)
    found = lumencut.read_centerlines(path, "lps", unit="mm")
    read, written = ({tuple(point) for point in one.points} for one in (found, tree))
    # Lines of a table that meet within some hundredths of a millimetre are joined at a point of one of them.
    assert (read <= written) if ending == ".csv" else (read == written)


@pytest.mark.parametrize("ending", [*ENDINGS, *OTHER_ENDINGS])
def test_a_large_tree_is_written_and_read(tmp_path, ending):
    along = np.arange(200_000.0)
    line = np.stack([along / 1000, np.sin(along / 500), np.cos(along / 500)], axis=1)
    tree = VesselTree([Vessel(line + np.array([0, 5 * n, 0]), 1.5) for n in range(2)])
    write_centerlines(tree, tmp_path / f"tree{ending}")
    found = lumencut.read_centerlines(tmp_path / f"tree{ending}", "lps", unit="mm")
    assert [len(vessel) for vessel in found] == [200_000, 200_000]
    for vessel, other in zip(found, tree, strict=True):
        np.testing.assert_array_equal(vessel.points, other.points)
