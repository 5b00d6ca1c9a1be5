"""``lumencut info``: its report on files, and what it calls unusual."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut.cli import main
from scene_files import LUMEN, SIZE, TISSUE, bent_line, write_lines, write_volume


@pytest.fixture
def files(tmp_path):
    return [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]


def one_line(result):
    """Return the error message, which must be a single line."""
    assert result.stderr.count("\n") == 1, result.stderr
    assert "Traceback" not in result.output
    return result.stderr.rstrip("\n")


def info(*words):
    return CliRunner().invoke(main, ["info", *map(str, words)])


def test_info_of_a_volume_and_centerlines(files):
    result = info(*files)
    assert result.exit_code == 0, result.output
    for fact in (
        "NIfTI",
        "24, 20, 32",
        "int16",
        "40, 300",
        "LPS",
        "lps (the volume fits it)",
        "mm (the volume fits it)",
    ):
        assert fact in result.stdout
    assert re.search(r"inside +25\n", result.stdout)


def test_info_as_json(files):
    found = json.loads(info("--json", *files).stdout)
    volume, lines = found["files"]
    assert (volume["size"], volume["value_range"]) == (list(SIZE), [TISSUE, LUMEN])
    assert (lines["vessels"], lines["points"], lines["radius_mm"], lines["loose_ends"]) == (1, 25, [3, 3], 2)
    length = np.linalg.norm(np.diff(bent_line(), axis=0), axis=1).sum()
    assert lines["vessel_lengths_mm"] == [pytest.approx(length, abs=1e-3)]
    assert found["compared"][0]["inside"] == 25


def test_info_goes_on_after_a_file_that_cannot_be_read(files, tmp_path):
    (tmp_path / "odd.nii").write_bytes(b"nothing of the kind")
    result = info(tmp_path / "odd.nii", files[0], tmp_path / "nowhere.vtp")
    assert result.exit_code == 1
    assert result.stderr.count("lumencut: error: ") == result.stderr.count("\n") == 2
    assert "24, 20, 32" in result.stdout
    found = json.loads(info("--json", tmp_path / "odd.nii", files[0]).stdout)
    assert [one["kind"] for one in found["files"]] == ["unreadable", "volume"]


def test_info_tells_what_is_odd(files, tmp_path):
    gap = np.vstack([bent_line(), bent_line()[-1] + np.array([0, 0, 400])])
    found = info(
        write_lines(tmp_path / "bare.vtk", gap, radius=None),
        write_lines(tmp_path / "cm.vtk", bent_line() / 10),
    )
    assert "1 of 1 vessels have no radius" in found.stdout
    assert "lies far from all others, 400.0 mm" in found.stdout
    assert "perhaps its unit is not mm" in found.stdout
    assert "a spacing of exactly 1 mm" in info(files[0]).stdout


def test_info_decides_by_the_volume_and_says_so(files):
    write_lines(Path(files[1]), bent_line() * (-1, -1, 1))
    result = info(*files)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "ras (the volume fits it)" in result.stdout
    assert "  > the file states no space and no unit; 0 of 25 points" in result.stdout
    assert re.search(r"inside +25\n", result.stdout)
    found = json.loads(info("--json", *files).stdout)["files"][1]
    assert found["decisions"][0].endswith("read so; --coordinates ras confirms it")
    alone = json.loads(info("--json", files[1]).stdout)["files"][0]
    assert alone["decisions"] == ["the file states no space and no unit; lps in mm is assumed"]


def test_info_counts_points_with_both_signs_and_warns(files):
    write_lines(Path(files[1]), bent_line() * (-1, -1, 1), title="SPACE=LPS")
    result = info(*files)
    assert "no point lies inside the volume" in result.stdout
    assert re.search(r"inside with x and y negated +25\n", result.stdout)
    assert one_line(result).startswith("lumencut: warning: lines.vtk: 0 of 25 points")


def test_info_says_what_it_cannot_decide(files, tmp_path):
    lines = write_lines(tmp_path / "beside.vtk", bent_line() + 1000)
    result = info(files[0], lines)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "  ! no point inside the volume, in lps or ras" in result.stdout
