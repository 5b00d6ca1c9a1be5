"""``lumencut cpr`` as users call it."""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import lumencut
from lumencut import cpr, read_centerlines, read_volume
from lumencut.cli import main
from lumencut.reformations.planar_reformation import ALL_MODES
from scene_files import bent_line, write_lines, write_volume


def invoke(*words):
    return CliRunner().invoke(main, ["cpr", *(str(word) for word in words)])


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A volume, a line, and two lines that meet in its middle."""
    folder = tmp_path_factory.mktemp("scene")
    volume, line = write_volume(folder / "ct.nii"), write_lines(folder / "line.vtk")
    points = bent_line()
    halves = [
        write_lines(folder / f"{name}.vtk", part)
        for name, part in (("up", points[12:]), ("down", points[:13]))
    ]
    return volume, line, halves


def picture(path):
    return np.asarray(Image.open(path))


def test_the_modes_are_those_of_the_library():
    assert importlib.import_module("lumencut.cli.laid_out.cpr").MODES == ALL_MODES


def test_one_vessel(files, tmp_path):
    volume, line, _ = files
    result = invoke(
        volume, line, "-o", tmp_path / "one.png", "--no-annotate", "--angle", 30, "--window", "500/150"
    )
    assert (result.exit_code, result.stderr) == (0, "")
    said = "straightened CPR of 1 vessel, pixels of 0.25 mm, window 500/150"
    assert result.stdout == f"{tmp_path / 'one.png'}: {said}\n"
    settings = lumencut.Settings(window=lumencut.Window(150, 500))
    vessel = read_centerlines(line, "lps")[0]
    made = cpr(read_volume(volume), vessel, "straightened", pixel_spacing=0.25, degrees=30, settings=settings)
    np.testing.assert_array_equal(picture(tmp_path / "one.png"), made.image)


def test_arrays_and_the_straightened_volume(files, tmp_path):
    volume, line, _ = files
    words = (
        "--mode",
        "stretched",
        "--width",
        12,
        "--pixel-spacing",
        0.5,
        "--slab",
        "2mm:mean",
        "--smoothing",
        1,
    )
    result = invoke(volume, line, "-o", tmp_path / "one.npz", "--volume-out", tmp_path / "one.nrrd", *words)
    assert (result.exit_code, result.stderr) == (0, "")
    with np.load(tmp_path / "one.npz") as file:
        arrays = dict(file)
    vessel = read_centerlines(line, "lps")[0]
    made = cpr(read_volume(volume), vessel, "stretched", 12, 0.5, slab=(2, "mean"), smoothing=1)
    np.testing.assert_array_equal(arrays["value"], made.value)
    assert read_volume(tmp_path / "one.nrrd").size[:2] == (25, 25)


def test_a_contact_sheet_of_all_vessels(files, tmp_path):
    volume, _, halves = files
    result = invoke(volume, *halves, "-o", tmp_path / "all.png")
    assert (result.exit_code, result.stderr) == (0, "")
    assert "straightened CPR of 2 vessels" in result.stdout
    height, width = picture(tmp_path / "all.png").shape[:2]
    one = invoke(volume, *halves, "-o", tmp_path / "one.png", "--vessel", "up")
    assert "straightened CPR of 1 vessel" in one.stdout
    single = picture(tmp_path / "one.png").shape
    assert width > single[1]
    assert height > 2 * single[0]


def test_a_path_is_one_vessel(files, tmp_path):
    volume, line, halves = files
    result = invoke(volume, *halves, "-o", tmp_path / "path.png", "--path", "down,up", "--no-annotate")
    assert (result.exit_code, result.stderr) == (0, "")
    whole = invoke(volume, line, "-o", tmp_path / "line.png", "--no-annotate", "--window", "600/300")
    assert whole.exit_code == 0
    invoke(
        volume, *halves, "-o", tmp_path / "path.png", "--path", "1,0", "--no-annotate", "--window", "600/300"
    )
    assert picture(tmp_path / "path.png").shape == picture(tmp_path / "line.png").shape
    apart = np.abs(picture(tmp_path / "path.png").astype(int) - picture(tmp_path / "line.png"))
    assert (apart > 1).mean() < 0.01


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (["-o", "{}/one.txt"], 2, "found the extension '.txt'"),
        (["-o", "{}/nowhere/one.png"], 1, "no folder"),
        (["-o", "{}/one.png", "--volume-out", "{}/one.mha"], 2, "expected .nrrd, .nii or .nii.gz"),
        (["-o", "{}/one.png", "--width", "0"], 1, "width of the CPR: found 0 mm"),
        (["-o", "{}/one.png", "--width", "900"], 1, "the diagonal of the volume"),
        (["-o", "{}/one.png", "--slab", "-1"], 2, "slab thickness: found -1"),
        (["-o", "{}/one.png", "--vessel", "LAD"], 1, "vessel 'LAD'"),
        (["-o", "{}/one.png", "--path", "0,7"], 1, "vessel of the tree"),
        (["-o", "{}/one.png", "--up", "0,0,0"], 1, "up of the CPR"),
        (["-o", "{}/one.png", "--mode", "curled"], 2, "'curled' is not one of"),
        (["-o", "{}/one.png", "--series", "3"], 2, "--series does nothing"),
        ([], 2, "Missing option '-o'"),
    ],
)
def test_mistakes(files, tmp_path, words, code, message):
    volume, line, _ = files
    result = invoke(volume, line, *(word.format(tmp_path) for word in words))
    assert result.exit_code == code, result.output
    assert message in result.stderr
    assert "Traceback" not in result.output
    assert list(tmp_path.iterdir()) == []


def test_files_of_one_vessel_are_not_made_of_two(files, tmp_path):
    volume, _, halves = files
    for words in (
        ["-o", tmp_path / "all.npz"],
        ["-o", tmp_path / "all.png", "--volume-out", tmp_path / "all.nii"],
    ):
        result = invoke(volume, *halves, *words)
        assert result.exit_code == 2
        assert "holds one vessel; found 2; choose one by --vessel or --path" in result.stderr
    assert list(tmp_path.iterdir()) == []
