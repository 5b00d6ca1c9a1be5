"""``lumencut measure``: outputs, messages, and mistakes."""

import csv
import importlib
import json
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import Vessel, VesselTree, measure, phantom, read_centerlines, read_volume, write_centerlines
from lumencut.cli import main
from lumencut.measuring.measured_vessel import GROUPS
from lumencut.measuring.stenosis import METHODS
from report_reading import Page
from scene_files import write_volume_of


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A vessel with a stenosis of 60 % in its middle, 60 mm long."""
    folder, scene = tmp_path_factory.mktemp("scene"), phantom.stenosis(60)
    write_centerlines(scene.tree, folder / "Doe^John.vtp")
    return write_volume_of(scene.volume, folder / "Doe^John.nii.gz"), folder / "Doe^John.vtp"


@pytest.fixture(scope="module")
def branches(tmp_path_factory):
    """Three vessels that meet."""
    folder, scene = tmp_path_factory.mktemp("branches"), phantom.y_junction()
    write_centerlines(scene.tree, folder / "lines.vtp")
    return write_volume_of(scene.volume, folder / "ct.nii.gz"), folder / "lines.vtp"


#: Options of tests whose fact is neither the point spread nor the distance of sections; later words win.
QUICK = ("--step", 2, "--fwhm", 0.9)


def run(*words):
    return CliRunner().invoke(main, ["measure", *map(str, words)])


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_the_names_are_those_of_the_library():
    command = importlib.import_module("lumencut.cli.measure")
    assert (command.METHODS, command.GROUPS) == (METHODS, GROUPS)


def test_a_table_of_all_vessels(branches, tmp_path):
    result = run(*branches, "-o", tmp_path / "all.csv", *QUICK)
    assert (result.exit_code, result.stderr) == (0, "")
    rows = rows_of(tmp_path / "all.csv")
    tree = read_centerlines(branches[1])
    assert sorted({row["vessel"] for row in rows}) == ["0", "1", "2"]
    assert {row["name"] for row in rows} == {vessel.name or "" for vessel in tree}
    profile = measure(read_volume(branches[0]), tree[1], 2.0, 0.9, tree=tree)
    read = [float(row["area_mm2"] or "nan") for row in rows if row["vessel"] == "1"]
    np.testing.assert_allclose(read, profile.area, rtol=1e-6)
    assert "%" not in result.stdout
    assert "all.csv: 3 vessels" in result.stdout


def test_vessels_are_chosen_by_id_name_and_path(branches, tmp_path):
    result = run(*branches, "-o", tmp_path / "one.csv", "--vessel", 2, *QUICK)
    assert result.exit_code == 0
    assert {row["vessel"] for row in rows_of(tmp_path / "one.csv")} == {"2"}
    tree = read_centerlines(branches[1])
    result = run(*branches, "-o", tmp_path / "path.csv", "--path", "0,1", *QUICK)
    assert result.exit_code == 0
    rows = rows_of(tmp_path / "path.csv")
    assert {row["vessel"] for row in rows} == {"0,1"}
    assert float(rows[-1]["arc_length_mm"]) == pytest.approx(tree[0].length + tree[1].length, rel=1e-6)


def test_suggestions_are_called_so_and_have_no_percentage(files, tmp_path):
    result = run(*files, "-o", tmp_path / "profile.csv")
    assert result.exit_code == 0
    assert "narrowest place (suggestion): 3." in result.stdout
    assert result.stdout.count("reference (suggestion): 8.") == 2
    assert "%" not in result.stdout


def test_a_marked_stenosis_with_all_outputs(files, tmp_path):
    names = {"--plot": "plot.png", "--sections": "sheet.png", "--report": "report.html"}
    outputs = [word for name, file in names.items() for word in (name, tmp_path / file)]
    result = run(
        *(*files, "-o", tmp_path / "p.csv", "-o", tmp_path / "p.json", *outputs),
        *("--at", 30, "--reference", "10,50", "--group", "carotid", "--step", 2),
    )
    assert (result.exit_code, result.stderr) == (0, "")
    (line,) = (line for line in result.stdout.splitlines() if "% of" in line)
    assert "(NASCET): 3." in line
    assert "mm at 30.0 mm, reference 8." in line
    assert "mm at 10.0 mm, 50.0 mm" in line
    assert "severity group: 50 to 69 %" in result.stdout
    read = json.loads((tmp_path / "p.json").read_text("utf-8"))
    assert read["settings"]["at_mm"] == 30
    assert read["vessels"][0]["stenosis"]["percent"] == pytest.approx(60, abs=5)
    for name in ("plot.png", "sheet.png"):
        with Image.open(tmp_path / name) as image:
            assert np.asarray(image.convert("L")).std() > 10
    page = Page.read(tmp_path / "report.html")
    assert page.count("section") == 1
    assert "(NASCET): 3." in page.text
    # The name of the patient is in the names of the files, but not in the report.
    assert "Doe^John" not in page.source


@pytest.mark.parametrize("words", [["--reference", "10,50"], ["--reference", "10", "--reference", "50"]])
def test_two_references_are_joined_by_a_comma_or_given_one_by_one(files, tmp_path, words):
    result = run(*files, "-o", tmp_path / "p.json", "--at", 30, *words, *QUICK)
    assert result.exit_code == 0
    read = json.loads((tmp_path / "p.json").read_text("utf-8"))
    assert read["settings"]["reference_mm"] == [10, 50]
    references = read["vessels"][0]["stenosis"]["references"]
    assert [spot["arc_length_mm"] for spot in references] == [10, 50]


def test_beside_one_reference_another_one_is_offered_and_not_graded_with(files, tmp_path):
    report = tmp_path / "report.html"
    result = run(
        *(*files, "-o", tmp_path / "p.json", "--report", report, "--at", 30, "--reference", 50, *QUICK),
    )
    assert result.exit_code == 0
    graded = json.loads((tmp_path / "p.json").read_text("utf-8"))["vessels"][0]["stenosis"]
    assert [spot["arc_length_mm"] for spot in graded["references"]] == [50]
    _, offered = report.read_text("utf-8").split("<h2>Suggestions, not confirmed</h2>")
    assert "reference before (suggestion)</td>" in offered
    assert "narrowest place" not in offered


def test_ecst_states_the_original_diameter(files, tmp_path):
    result = run(*files, "-o", tmp_path / "p.json", "--at", 30, "--method", "ecst", "--original", 8, *QUICK)
    assert result.exit_code == 0
    assert "(ECST)" in result.stdout
    assert "assumed original 8.00 mm" in result.stdout


def test_a_place_alone_has_its_diameter_and_no_percentage(files, tmp_path):
    result = run(*files, "-o", tmp_path / "p.csv", "--at", 30, *QUICK)
    assert result.exit_code == 0
    assert "marked place: 3." in result.stdout
    assert "%" not in result.stdout


def test_the_point_spread_is_the_given_one(files, tmp_path):
    result = run(*files, "-o", tmp_path / "p.csv", *QUICK)
    assert "FWHM 0.90 mm given" in result.stdout
    assert {row["fwhm_mm"] for row in rows_of(tmp_path / "p.csv")} == {"0.9"}


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (["--fwhm", "0"], 2, "0.0 is not in the range 0<x<=20"),
        (["--fwhm", "30"], 2, "30.0 is not in the range 0<x<=20"),
        (["--step", "0"], 2, "0.0 is not in the range x>0"),
        (["--vessel", "LAD"], 1, "vessel 'LAD'"),
        (["--at", "300", "--reference", "50"], 1, "found 300 mm; expected an arc length from 0 to 60"),
        (["--at", "-1"], 1, "found -1 mm; expected an arc length from 0 to 60"),
        (["--at", "30", "--reference", "90"], 1, "found 90 mm; expected an arc length from 0 to 60"),
        (["--at", "30", "--reference", "40,50"], 1, "one place before it and one after it"),
        (["--at", "10", "--reference", "30"], 1, "not below that of the stenosis"),
        (["--at", "30", "--reference", "30"], 1, "30.0 mm, 0.0 mm from the stenosis at 30.0 mm"),
        (["--at", "30", "--reference", "1,2,3"], 2, "not of the form MM[,MM]"),
        (
            ["--at", "30", "--reference", "1,2", "--reference", "3"],
            2,
            "found 3 places (1, 2, 3); give one or two, such as --reference 12.5 or --reference 3,40",
        ),
        (["--at", "30", "--reference", "x"], 2, "not of the form MM[,MM]"),
        (["--reference", "50"], 2, "--reference without --at does nothing"),
        (["--method", "area"], 2, "--method without --at does nothing"),
        (["--at", "30", "--method", "area"], 2, "--method grades nothing without a reference"),
        (["--at", "30", "--group", "carotid"], 2, "--group grades nothing without a reference"),
        (["--at", "30", "--method", "ecst"], 1, "original diameter"),
        (["--at", "30", "--reference", "50", "--original", "8"], 1, "original diameter"),
        (["--at", "30", "--reference", "50", "--method", "area", "--group", "carotid"], 1, "'nascet'"),
        (["--at", "30", "--reference", "50", "--comparison", "20"], 1, "near-occlusion"),
        (["--plot", "{}/p.jpg"], 2, "found the extension '.jpg'; expected .png or .svg"),
        (["--report", "{}/p.pdf"], 2, "expected .html or .htm"),
        (["--sections", "{}/p.npz"], 2, "expected a picture format"),
        (["--sections", "{}/p.txt"], 2, "found the extension '.txt'"),
        (["--plot", "{}/nowhere/p.png"], 1, "no folder"),
        (["--plot", "{}/p.png", "--sections", "{}/p.png"], 2, "would be written twice"),
        (["-o", "{}/p.xlsx"], 2, "expected .csv or .json"),
        (["--device", "cpu"], 2, "--device only affects --report and --dicom"),
        (["--series", "3"], 2, "--series does nothing"),
    ],
)
def test_mistakes(files, tmp_path, words, code, message):
    result = run(*files, "-o", tmp_path / "p.csv", *QUICK, *(word.format(tmp_path) for word in words))
    assert result.exit_code == code, result.output
    assert message in result.stderr
    assert "Traceback" not in result.output
    assert list(tmp_path.iterdir()) == []


def test_a_place_is_on_one_vessel(branches, tmp_path):
    result = run(*branches, "-o", tmp_path / "p.csv", "--at", 5)
    assert result.exit_code == 2
    assert "--at is a place on one vessel; found 3; choose one by --vessel or --path" in result.stderr


def test_lines_in_another_space_are_refused_with_what_mends_it(files, tmp_path):
    vessel, far = read_centerlines(files[1])[0], 2 * read_volume(files[0]).corners.max(axis=0)
    points = np.add(vessel.points, [*far[:2], 0])
    write_centerlines(VesselTree([Vessel(points)]), tmp_path / "lines.vtp")
    result = run(files[0], tmp_path / "lines.vtp", "-o", tmp_path / "p.csv")
    assert result.exit_code == 1
    assert "inside the volume" in result.stderr
    assert not (tmp_path / "p.csv").exists()


def test_a_vessel_that_cannot_be_measured_is_named_and_the_others_are_measured(files, tmp_path):
    volume = read_volume(files[0])
    outside = np.add(volume.corners.max(axis=0), [[50, 0, 0], [80, 0, 0]])
    vessels = [read_centerlines(files[1])[0], Vessel(outside, name="far")]
    write_centerlines(VesselTree(vessels), tmp_path / "lines.vtp")
    words = (files[0], tmp_path / "lines.vtp", "-o", tmp_path / "p.csv", "--coordinates", "lps", *QUICK)
    result = run(*words)
    assert result.exit_code == 0, result.output
    assert "warning: vessel 1 is not measured: " in result.stderr
    assert {row["vessel"] for row in rows_of(tmp_path / "p.csv")} == {"0"}
    alone = run(*words, "--vessel", "far")
    assert alone.exit_code == 1
    assert "Traceback" not in alone.output


def test_without_matplotlib_nothing_is_measured_and_the_extra_is_named(files, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    result = run(*files, "-o", tmp_path / "p.csv", "--plot", tmp_path / "p.png")
    assert result.exit_code == 1
    assert 'pip install "lumencut[plot]"' in result.stderr
    assert list(tmp_path.iterdir()) == []
    # Sections and the report need no matplotlib, and the numbers do not change.
    assert run(*files, *QUICK, "-o", tmp_path / "p.csv", "--sections", tmp_path / "s.png").exit_code == 0
    alone = (tmp_path / "p.csv").read_text("utf-8")
    assert run(*files, *QUICK, "-o", tmp_path / "p.csv", "--report", tmp_path / "r.html").exit_code == 0
    assert (tmp_path / "p.csv").read_text("utf-8") == alone
    assert {row["vessel"] for row in rows_of(tmp_path / "p.csv")} == {"0"}
    with Image.open(tmp_path / "s.png") as image:
        assert np.asarray(image.convert("L")).std() > 10
    assert "<table" in (tmp_path / "r.html").read_text("utf-8")
