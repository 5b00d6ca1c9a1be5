"""The command line with unusual files: several series, doubtful spaces, pipes, views beside the volume."""

import json
import os

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut.cli import main
from scene_files import bent_line, write_lines, write_volume
from volume_samples import save, slice_of

POINTS = [[3.0, 2.0, 2.0], [3.0, 3.0, 4.0], [4.0, 3.0, 8.0]]


def one_line(result):
    """Return the only line on stderr."""
    assert result.stderr.count("\n") == 1, result.stderr
    assert "Traceback" not in result.output
    return result.stderr.rstrip("\n")


def invoke(*words):
    return CliRunner().invoke(main, [str(word) for word in words])


@pytest.fixture
def two_series(tmp_path):
    """A folder of DICOM files of the series 7 and 9."""
    folder = tmp_path / "dicom"
    folder.mkdir()
    random = np.random.default_rng(1)
    for number, size in ((7, (6, 8, 8)), (9, (12, 8, 8))):
        array = random.integers(0, 900, size, dtype=np.int16)
        for k in range(len(array)):
            data = slice_of(array, np.eye(4), k, series=f"1.2.{number}", SeriesNumber=number)
            save(data, folder / f"{number}-{k}.dcm")
    return folder


@pytest.mark.parametrize("command", ["render", "turntable"])
@pytest.mark.parametrize("series", ["9", "1.2.9"])
def test_pictures_of_one_series(two_series, tmp_path, command, series):
    lines, folder = write_lines(tmp_path / "lines.vtk", POINTS, 1.0), tmp_path / "out"
    folder.mkdir()
    words = [command, two_series, lines, "--size", "24x20", "-o", folder / "view.png"]
    words += ["--frames", "2"] if command == "turntable" else []
    result = invoke(*words)
    assert result.exit_code == 1
    assert one_line(result).endswith(
        "give the folder of one series, or its number or UID as --series NUMBER|UID"
    )
    assert invoke(*words, "--series", series).exit_code == 0
    assert [path.name for path in folder.iterdir()] == ["view.png"]
    with Image.open(folder / "view.png") as picture:
        assert picture.size == (24, 20)
        asked = picture.convert("RGB").tobytes()
    for path in two_series.glob("7-*.dcm"):
        path.unlink()
    assert invoke(*words).exit_code == 0
    with Image.open(folder / "view.png") as picture:
        assert picture.convert("RGB").tobytes() == asked


def test_info_lists_the_series(two_series):
    result = invoke("info", two_series)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "number 7 (made for a test, CT, 8 × 8 × 6, 1 × 1 × 1 mm, UID 1.2.7)" in result.stdout
    assert "--series NUMBER|UID" in result.stdout
    (found,) = json.loads(invoke("info", "--json", two_series).stdout)["files"]
    assert found["kind"] == "series"
    assert [(one["number"], one["size"]) for one in found["series"]] == [("7", [8, 8, 6]), ("9", [8, 8, 12])]
    result = invoke("info", two_series, "--series", "9")
    assert result.exit_code == 0
    assert "8, 8, 12" in result.stdout
    assert "number 9, made for a test" in result.stdout


def test_a_series_that_is_not_there_is_not_replaced_by_another(two_series, tmp_path):
    for path in two_series.glob("9-*.dcm"):
        path.unlink()
    command = ["render", two_series, "-o", tmp_path / "out.png", "--size", "8x8"]
    assert invoke(*command, "--series", "7").exit_code == 0
    result = invoke(*command, "--series", "9")
    assert result.exit_code == 1
    assert "expected one series with the number or UID '9'" in one_line(result)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
@pytest.mark.parametrize("name", ["ct.nii", "lines.vtp"])
def test_info_does_not_wait_for_a_pipe(tmp_path, name):
    os.mkfifo(tmp_path / name)
    result = invoke("info", tmp_path / name)
    assert result.exit_code == 1
    assert f"{name}: found a pipe or a device; expected a" in one_line(result)


def test_a_duration_that_no_file_can_hold_is_a_usage_error(tmp_path):
    result = invoke("turntable", "a", "b", "-o", tmp_path / "spin.png", "--frames", 2, "--seconds", 3600)
    assert result.exit_code == 2
    assert "fps: found 0.000555556; expected between 0.0167 and 1000" in result.stderr


@pytest.mark.parametrize("command", ["render", "turntable", "info"])
def test_a_doubtful_space_is_told_once_and_can_be_answered(tmp_path, command):
    points = np.concatenate([[[0, 0, 1]], bent_line() * (-1, -1, 1)])
    lines = write_lines(tmp_path / "lines.vtk", points, title="SPACE=LPS")
    words = [command, write_volume(tmp_path / "ct.nii"), lines]
    if command == "info":
        words.append(write_volume(tmp_path / "again.nii"))
    else:
        # The unit is given, so only the space is doubtful.
        words += ["-o", tmp_path / "view.png", "--size", "16x16", "--unit", "mm"]
    words += ["--frames", "2"] if command == "turntable" else []
    result = invoke(*words)
    assert result.exit_code == 0
    assert one_line(result).startswith("lumencut: warning: ")
    warned = result.stdout if command == "info" else (tmp_path / "view.png").read_bytes()
    result = invoke(*words, "--coordinates", "lps")
    assert (result.exit_code, result.stderr) == (0, "")
    # The answer gives what was assumed before; only the source of the decision changes.
    if command == "info":
        assert "lps (as asked)" in result.stdout
        assert result.stdout.replace("as asked", "stated in the file") == warned
    else:
        assert (tmp_path / "view.png").read_bytes() == warned


@pytest.mark.parametrize(("command", "who"), [("render", "the view"), ("turntable", "any frame")])
def test_a_view_that_misses_the_volume_is_a_warning(tmp_path, command, who):
    words = [command, write_volume(tmp_path / "ct.nii"), write_lines(tmp_path / "lines.vtk")]
    words += ["-o", tmp_path / "view.png", "--size", "16x16"]
    words += ["--frames", "3"] if command == "turntable" else []
    result = invoke(*words)
    assert (result.exit_code, result.stderr) == (0, "")
    result = invoke(*words, "--center", "1e5,0,-0.5")
    assert result.exit_code == 0
    assert one_line(result) == (
        f"lumencut: warning: no pixel of {who} shows the volume: the center is 100000,0,-0.5, "
        "the volume reaches from -0.5,-0.5,-0.5 to 23.5,19.5,31.5 (mm, LPS)"
    )
    with Image.open(tmp_path / "view.png") as picture:
        assert picture.convert("RGB").getcolors() == [(16 * 16, (0, 0, 0))]


def test_frames_that_miss_the_volume_are_counted(tmp_path):
    words = ["turntable", write_volume(tmp_path / "ct.nii"), write_lines(tmp_path / "lines.vtk")]
    words += ["-o", tmp_path / "view.png", "--size", "16x16", "--frames", "4", "--center", "10,100,16"]
    result = invoke(*words)
    assert result.exit_code == 0
    assert one_line(result).startswith("lumencut: warning: no pixel of 2 frames shows the volume: the center")
