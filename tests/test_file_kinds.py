"""Files given in place of others: the error says what kind of file it is."""

from __future__ import annotations

import gzip
import os
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import _lumencut, read_centerlines, read_volume
from lumencut.base.file_kinds import extensions as extensions_of
from lumencut.base.file_kinds import kind_of
from lumencut.cli import main
from lumencut.errors import FileError, FormatError
from scene_files import bent_line, write_lines, write_volume
from volume_samples import coded, save, slice_of, write_stack

ROOT = Path(__file__).resolve().parent.parent
IMAGE_XML = b'<?xml version="1.0"?>\n<VTKFile type="ImageData"><ImageData/></VTKFile>'
IMAGE_JSON = b'{"vtkClass": "vtkImageData", "spacing": [1, 1, 1], "extent": [0, 1, 0, 1, 0, 1]}'
IMAGE_LEGACY = b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
LINES_JSON = b'{"vtkClass": "vtkPolyData", "points": {"vtkClass": "vtkPoints", "values": [0, 0, 0]}}'
LINES_XML = b'<VTKFile type="PolyData"><PolyData/></VTKFile>'
MARKUPS = b'{"@schema": "", "markups": []}'
KINDS = {
    "a.vti": (IMAGE_XML, "volume", "a VTK image, which is not read"),
    "b.vtk": (IMAGE_LEGACY, "volume", "a VTK image, which is not read"),
    "c.json": (IMAGE_JSON, "volume", "an image in the JSON of vtk.js, which is not read"),
    "d.vtp": (LINES_JSON, "centerlines", "PolyData in the JSON of vtk.js, which is not read"),
    "e.vtp": (LINES_XML, "centerlines", "VTK PolyData"),
    "f.mrk.json": (MARKUPS, "centerlines", "3D Slicer markups"),
    "g.swc": (b"1 2 0 0 0 1 -1", "centerlines", "a .swc file"),
    "h.nrrd": (b"NRRD0004\n", "volume", "an NRRD volume"),
    "i.mhd": (b"ObjectType = Image\nNDims = 3\n", "volume", "a MetaImage volume"),
    "j.zip": (b"PK\3\4", "volume", "a zip archive"),
    "k.vtp.gz": (gzip.compress(LINES_XML), "centerlines", "VTK PolyData"),
}


@pytest.mark.parametrize(("name", "held"), KINDS.items(), ids=KINDS)
def test_kinds(tmp_path, name, held):
    content, role, words = held
    (tmp_path / name).write_bytes(content)
    kind = kind_of(tmp_path / name)
    assert (kind.role, kind.name) == (role, words)


def test_kinds_of_volumes_and_of_nothing(tmp_path):
    assert kind_of(write_volume(tmp_path / "ct.nii.gz")).name == "a NIfTI volume"
    image = save(slice_of(coded(), np.eye(4), 0), tmp_path / "IM1")
    assert (kind_of(image).name, kind_of(image).is_dicom, kind_of(tmp_path).is_dicom) == (
        "a DICOM image",
        True,
        True,
    )
    (tmp_path / "readme.txt").write_text("hello")
    (tmp_path / "empty.vtp").touch()
    (tmp_path / "broken.gz").write_bytes(b"\x1f\x8bnothing")
    for name in ("readme.txt", "empty.vtp", "broken.gz", "nowhere.vtp"):
        assert kind_of(tmp_path / name) is None
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe.vtp")
        assert kind_of(tmp_path / "pipe.vtp") is None


def test_every_row_of_the_table_is_named_and_documented(tmp_path):
    page = (ROOT / "docs/files.md").read_text("utf-8")
    for name, role, title, extensions, written in _lumencut.FILE_KINDS:
        assert set(written) <= set(extensions)
        assert all(f"`{extension}`" in page for extension in extensions)
        words = _lumencut.VOLUME_FILES if role == "volume" else _lumencut.CENTERLINE_FILES
        if title and name not in ("text table", "numpy"):
            assert all(extension in words for extension in extensions)
            path = tmp_path / f"a{extensions[0]}"
            path.write_text("content that states nothing")
            known = kind_of(path)
            assert (known.role, known.mend) == (role, "") if known else name == "nrrd"


def test_centerlines_and_foreign_images_as_a_volume(tmp_path):
    lines = write_lines(tmp_path / "lines.vtk")
    with pytest.raises(FormatError, match=r"found VTK PolyData; expected a DICOM.*; read centerlines with"):
        read_volume(lines)
    for name in ("a.vti", "b.vtk", "c.json"):
        (tmp_path / name).write_bytes(KINDS[name][0])
        with pytest.raises(
            FormatError, match=r"which is not read; .*; convert it to NIfTI, NRRD or MetaImage"
        ):
            read_volume(tmp_path / name)


def test_volumes_and_foreign_lines_as_centerlines(tmp_path):
    with pytest.raises(FormatError, match=r"found a NIfTI volume; expected .*; read volumes with"):
        read_centerlines(write_volume(tmp_path / "ct.nii.gz"))
    with pytest.raises(FileError):
        read_centerlines(tmp_path)
    (tmp_path / "d.vtp").write_bytes(LINES_JSON)
    with pytest.raises(FormatError, match=r"JSON of vtk\.js, which is not read; .*; write it as XML"):
        read_centerlines(tmp_path / "d.vtp")


@pytest.mark.parametrize("content", [b"", gzip.compress(b"")], ids=["nothing", "nothing, gzipped"])
def test_an_empty_volume_is_called_empty(tmp_path, content):
    path = tmp_path / "empty.nii.gz"
    path.write_bytes(content)
    with pytest.raises(
        FormatError, match=r"empty\.nii\.gz: found an empty file; .*; copy or export it again"
    ):
        read_volume(path)


def info(*words):
    return CliRunner().invoke(main, ["info", *map(str, words)])


def test_info_reads_every_file_as_what_it_holds(tmp_path):
    (tmp_path / "image.json").write_bytes(IMAGE_JSON)
    (tmp_path / "d.vtp").write_bytes(LINES_JSON)
    result = info(tmp_path / "image.json", tmp_path / "d.vtp", write_lines(tmp_path / "lines"))
    assert result.exit_code == 1
    assert "an image in the JSON of vtk.js" in result.stderr
    assert "PolyData in the JSON of vtk.js" in result.stderr
    assert "legacy VTK" in result.stdout
    assert result.stderr.count("\n") == 2


def test_info_judges_lines_by_the_volume_that_they_fit_best(tmp_path):
    first = far_volume(tmp_path / "far")
    second = write_volume(tmp_path / "ct.nii.gz")
    lines = write_lines(tmp_path / "lines.vtk", bent_line() * (-1, -1, 1))
    result = info(first, second, lines)
    assert (result.exit_code, result.stderr) == (0, "")
    assert (
        f"> decided by {second}, which it fits best: 25 of 25 points lie in {second}; 0 of 25"
        in result.stdout
    )
    assert "ras (the volume fits it)" in result.stdout
    assert "no point lies inside the volume" not in result.stdout
    result = info(second, write_volume(tmp_path / "again.nii"), lines)
    assert f"> decided by the first volume, {second}: all volumes fit equally (25 of 25" in result.stdout
    assert "decided by the" not in info(second, lines).stdout


def test_info_warns_by_the_best_volume_alone(tmp_path):
    near, far = write_volume(tmp_path / "ct.nii.gz"), far_volume(tmp_path / "far")
    stated = write_lines(tmp_path / "lines.vtk", bent_line() * (-1, -1, 1), title="SPACE=LPS")
    result = info(far, near, stated)
    assert result.stderr.count("\n") == 1
    assert "lines.vtk: 0 of 25 points" in result.stderr
    good = write_lines(tmp_path / "good.vtk", title="SPACE=LPS")
    assert info(far, near, good).stderr == ""


def far_volume(folder):
    """A volume far away from the lines."""
    affine = np.diag([2.0, 2.0, 3.0, 1.0])
    affine[:3, 3] = (500, 500, 500)
    return write_stack(folder, coded((8, 8, 8)), affine)


@pytest.mark.parametrize("command", ["render", "view"])
def test_help_lists_all_centerline_files(command):
    *first, last = extensions_of("centerlines")
    shown = " ".join(CliRunner().invoke(main, [command, "--help"]).output.split())
    assert f"{', '.join(first)} or {last} files" in shown
