"""Files written by VTK in every mode are read exactly as VTK defined them."""

from pathlib import Path

import numpy as np
import pytest

from lumencut import _lumencut
from lumencut.files.centerlines import inspect_centerlines, read_centerlines

vtk = pytest.importorskip("vtk", reason="the vtk package writes the files of these tests")
numpy_support = pytest.importorskip("vtk.util.numpy_support")

XML_MODES = ["ascii", "binary", "appended", "appended raw"]
COMPRESSORS = ["none", "zlib", "lz4", "lzma"]


def helix(count: int, radius: float) -> np.ndarray:
    t = np.linspace(0.0, 12.0, count)
    return np.stack([radius * np.cos(t), radius * np.sin(t), 10.0 * t], axis=1)


LINES = [helix(2000, 30.0), helix(500, 12.0)]
RADII = [np.linspace(3.0, 1.0, 2000), np.linspace(2.0, 0.5, 500)]


def poly_data(dtype: type, *, space: str | None = None, others: bool = False):
    """Return poly data with LINES; `others` adds vertices, a triangle and arrays that are not radii."""
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetData(numpy_support.numpy_to_vtk(np.concatenate(LINES).astype(dtype), deep=True))
    data.SetPoints(points)
    lines, begin = vtk.vtkCellArray(), 0
    for line in LINES:
        lines.InsertNextCell(len(line), range(begin, begin + len(line)))
        begin += len(line)
    data.SetLines(lines)
    groups = [7, 8]
    if others:
        for cells, ids in ((vtk.vtkCellArray(), [0]), (vtk.vtkCellArray(), [0, 5, 9])):
            cells.InsertNextCell(len(ids), ids)
            data.SetVerts(cells) if len(ids) == 1 else data.SetPolys(cells)
        groups = [1, 7, 8, 2]
        normals = np.zeros((begin, 3), np.float32)
        add(data.GetPointData(), "Frenet normal [mm]", normals)
        add(data.GetPointData(), "flags", (np.arange(begin) % 2).astype(np.uint8))
    add(data.GetPointData(), "MaximumInscribedSphereRadius", np.concatenate(RADII))
    add(data.GetCellData(), "GroupIds", np.array(groups, np.int32))
    if space:
        text = vtk.vtkStringArray()
        text.SetName("SPACE")
        text.InsertNextValue(space)
        data.GetFieldData().AddArray(text)
    return data


def add(attributes, name: str, values: np.ndarray) -> None:
    array = numpy_support.numpy_to_vtk(values, deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def write_xml(path: Path, data, mode: str, compressor: str, *, big: bool = False, wide: bool = False) -> Path:
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary}.get(
        mode, writer.SetDataModeToAppended
    )()
    writer.SetEncodeAppendedData(mode == "appended")
    writer.SetCompressorType(COMPRESSORS.index(compressor))
    writer.SetBlockSize(4096)
    writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
    writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
    assert writer.Write()
    return path


def write_legacy(path: Path, data, *, binary: bool, version: int) -> Path:
    writer = vtk.vtkPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.SetFileVersion(version)
    writer.SetHeader("3D Slicer output. SPACE=RAS")
    writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
    assert writer.Write()
    return path


def assert_is_helices(path: Path, dtype: type, tolerance: float = 0.0) -> None:
    vessels, _ = _lumencut.CenterlineFile(path.read_bytes(), path.name).vessels(1.0, reorder=False)
    assert len(vessels) == len(LINES)
    for (points, radius, name), line, expected in zip(vessels, LINES, RADII, strict=True):
        np.testing.assert_allclose(points, line.astype(dtype).astype(np.float64), rtol=0, atol=tolerance)
        np.testing.assert_allclose(radius, expected, rtol=0, atol=tolerance)
        assert name is None


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("compressor", COMPRESSORS)
@pytest.mark.parametrize("mode", XML_MODES)
def test_every_mode_of_the_xml_writer_is_read_exactly(mode, compressor, dtype, tmp_path):
    for big in (False, True):
        path = write_xml(tmp_path / "a.vtp", poly_data(dtype), mode, compressor, big=big, wide=big)
        assert_is_helices(path, dtype, 1e-9 if mode == "ascii" else 0.0)


@pytest.mark.parametrize("others", [False, True])
@pytest.mark.parametrize("version", [42, 51])
@pytest.mark.parametrize("binary", [False, True])
def test_every_mode_of_the_legacy_writer_is_read(binary, version, others, tmp_path):
    data = poly_data(np.float64, space="LPS", others=others)
    path = write_legacy(tmp_path / "a.vtk", data, binary=binary, version=version)
    assert_is_helices(path, np.float64, 0.0 if binary else 1e-3)
    assert (inspect_centerlines(path).space, inspect_centerlines(path).space_from) == ("ras", "stated"), (
        "the title comes before the field"
    )


@pytest.mark.parametrize("mode", XML_MODES)
def test_other_cells_arrays_and_the_space_do_not_disturb(mode, tmp_path):
    data = poly_data(np.float64, space="RAS", others=True)
    path = write_xml(tmp_path / "a.vtp", data, mode, "zlib")
    assert (inspect_centerlines(path).space, inspect_centerlines(path).space_from) == ("ras", "stated")
    tree = read_centerlines(path)
    assert len(tree) == 2
    tolerance = 1e-9 if mode == "ascii" else 0.0
    np.testing.assert_allclose(tree[1].points, LINES[1] * [-1, -1, 1], rtol=0, atol=tolerance)
