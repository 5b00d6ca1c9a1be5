"""For any bytes, the readers return valid vessels or raise a FormatError."""

import base64
import json
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lumencut import _lumencut
from lumencut.errors import FormatError


def block(values: bytes) -> str:
    packed = zlib.compress(values)
    header = struct.pack("<4I", 1, len(values), 0, len(packed))
    return base64.b64encode(header).decode() + base64.b64encode(packed).decode()


def small_vtp() -> bytes:
    points = block(np.array([[0, 0, 0], [0, 0, 1], [0, 1, 2], [0, -1, 2]], "<f4").tobytes())
    ids = block(np.array([0, 1, 2, 0, 1, 3], "<i4").tobytes())
    ends = block(np.array([3, 6], "<i4").tobytes())
    array = '<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">{}</DataArray>'
    return (
        '<VTKFile type="PolyData" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><PolyData>'
        '<Piece NumberOfPoints="4" NumberOfLines="2"><Points>' + array.format("Float32", "Points", 3, points)
        + "</Points><Lines>" + array.format("Int32", "connectivity", 1, ids)
        + array.format("Int32", "offsets", 1, ends) + "</Lines></Piece></PolyData></VTKFile>"
    ).encode()  # fmt: skip


def small_vtk() -> bytes:
    points = np.array([[0, 0, 0], [0, 0, 1], [0, 1, 2]], ">f4").tobytes()
    return (
        b"# vtk DataFile Version 5.1\nmade by hand\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" + points
        + b"\nLINES 2 3\nOFFSETS vtktypeint64\n" + np.array([0, 3], ">i8").tobytes()
        + b"\nCONNECTIVITY vtktypeint64\n" + np.array([0, 1, 2], ">i8").tobytes()
        + b"\nPOINT_DATA 3\nSCALARS Radius double\nLOOKUP_TABLE default\n" + np.ones(3, ">f8").tobytes()
    )  # fmt: skip


def small_markup() -> bytes:
    controls = [{"position": [0.0, 0.5, float(z)], "positionStatus": "defined"} for z in range(3)]
    radius = {"name": "Radius", "units": "mm", "controlPointValues": [1.0, 1.0, 2.0]}
    markup = {"type": "Curve", "coordinateSystem": "LPS", "controlPoints": controls, "measurements": [radius]}
    return json.dumps({"markups": [markup]}).encode()


SMALL = {"a.vtp": small_vtp(), "a.vtk": small_vtk(), "a.mrk.json": small_markup()}


def read_soundly(content: bytes, name: str) -> int:
    """Return the number of vessels, 0 for a FormatError."""
    try:
        file = _lumencut.CenterlineFile(content, name)
        vessels, space = file.vessels(1.0, reorder=False)[0], file.space
    except FormatError:
        return 0
    assert space in (None, "lps", "ras")
    for points, radius, _ in vessels:
        assert points.shape[0] >= 2
        assert points.shape[1:] == (3,)
        assert np.isfinite(points).all()
        assert radius is None or (radius.shape == points.shape[:1] and (radius >= 0).all())
    return len(vessels)


@pytest.mark.parametrize(("name", "vessels"), [("a.vtp", 3), ("a.vtk", 1), ("a.mrk.json", 1)])
def test_the_small_files_are_read_whole_and_fail_when_cut_short(name, vessels):
    content = SMALL[name]
    assert read_soundly(content, name) == vessels
    assert all(read_soundly(content[:length], name) == 0 for length in range(len(content) // 2))
    for length in range(len(content) // 2, len(content)):
        read_soundly(content[:length], name)


@settings(deadline=None, max_examples=100)
@given(
    name=st.sampled_from(sorted(SMALL)),
    edits=st.lists(st.tuples(st.integers(0, 10_000), st.integers(0, 8), st.binary(max_size=8)), max_size=4),
)
def test_edited_files_are_read_soundly_or_refused(name, edits):
    content = bytearray(SMALL[name])
    for place, removed, inserted in edits:
        at = place % (len(content) + 1)
        content[at : at + removed] = inserted
    read_soundly(bytes(content), name)


@settings(deadline=None, max_examples=100)
@given(
    name=st.sampled_from(sorted(SMALL)),
    start=st.sampled_from([b"", b"# vtk\n", b"<VTKFile", b"{"]),
    rest=st.binary(),
)
def test_any_bytes_are_read_soundly_or_refused(name, start, rest):
    read_soundly(start + rest, name)


def test_a_decompression_bomb_is_refused():
    packed = zlib.compress(bytes(200 << 20), 9)
    header = struct.pack("<4I", 1, 200 << 20, 0, len(packed))
    bomb = base64.b64encode(header).decode() + base64.b64encode(packed).decode()
    good = small_vtp().decode()
    points = good.split('format="binary">')[1].split("<")[0]
    with pytest.raises(FormatError, match="bytes to unpack"):
        _lumencut.CenterlineFile(good.replace(points, bomb).encode(), "bomb.vtp")
