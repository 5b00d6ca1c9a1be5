"""Tables of control points as written by 3D Slicer, read by Python: undefined points are ignored."""

import json

import numpy as np
import pytest

from lumencut.errors import FormatError
from lumencut.files.centerlines import inspect_centerlines, read_centerlines

HEAD = "label,r,a,s,defined,selected,visible,locked,description"
POINTS = np.array([[30 + 6 * np.sin(t / 12), -40 + 5 * np.cos(t / 15), 100.0 + t] for t in range(0, 40, 2)])
LENGTH = np.linalg.norm(np.diff(POINTS, axis=0), axis=1).sum()


def table(last: str = "", left_out: tuple[int, ...] = (), end: str = "\n") -> str:
    rows = [
        f"C-{i},0,0,0,0,1,1,0,{last}" if i in left_out else f"C-{i},{r!r},{a!r},{s!r},1,1,1,0,{last}"
        for i, (r, a, s) in enumerate(POINTS.tolist())
    ]
    return end.join([HEAD, *rows, ""])


@pytest.mark.parametrize("last", ["", '""', "x", '"two, words"', '"two\nlines"'])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_a_table_of_slicer_is_read(last, end, mark, tmp_path):
    path = tmp_path / "points.csv"
    path.write_bytes((mark + table(last, end=end)).encode())
    (vessel,) = read_centerlines(path)
    np.testing.assert_allclose(vessel.points, POINTS * [-1, -1, 1])
    assert vessel.length == pytest.approx(LENGTH)


@pytest.mark.parametrize("ending", [".csv", ".tsv", ".mrk.json"])
def test_points_that_are_not_defined_are_left_out(ending, tmp_path):
    path = tmp_path / f"points{ending}"
    left_out = (5, 19)
    text = table("x", left_out)
    if ending == ".mrk.json":
        status = ["undefined" if i in left_out else "defined" for i in range(len(POINTS))]
        controls = [
            {"position": (0.0, 0.0, 0.0) if one == "undefined" else point.tolist(), "positionStatus": one}
            for point, one in zip(POINTS, status, strict=True)
        ]
        curve = {"type": "Curve", "coordinateSystem": "RAS", "controlPoints": controls}
        text = json.dumps({"markups": [curve]})
    path.write_text(text.replace(",", "\t") if ending == ".tsv" else text)
    (vessel,) = read_centerlines(path)
    np.testing.assert_allclose(vessel.points, np.delete(POINTS, left_out, axis=0) * [-1, -1, 1])
    assert any("2 " in note and "left out" in note for note in inspect_centerlines(path).notes)


def test_a_table_of_points_that_are_not_defined_is_refused(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text(table("", tuple(range(20))))
    with pytest.raises(FormatError, match=r"points: found 20 undefined point\(s\); expected at least 2"):
        read_centerlines(path)


def test_empty_radii_are_unknown(tmp_path):
    path = tmp_path / "points.csv"
    rows = [",".join(map(str, point)) + ("," if i % 2 else ",2.5") for i, point in enumerate(POINTS.tolist())]
    path.write_text("\n".join(["r,a,s,radius", *rows, ""]))
    (vessel,) = read_centerlines(path)
    np.testing.assert_array_equal(vessel.radius, np.where(np.arange(len(POINTS)) % 2, 0.0, 2.5))
    assert "10 of 20 radii are missing" in inspect_centerlines(path).notes
