"""Marks of a reader in the viewer: whatever the page saved, ``lumencut measure`` measures all vessels."""

import csv
import json

import pytest
from click.testing import CliRunner

from lumencut import measure, phantom, read_volume
from lumencut.cli import main
from scene_files import write_volume_of
from test_session_file import MARKS, write_session

ECST = "ECST needs the assumed original diameter at that place."

#: States that the page may save, by name: a place at 30 mm that was graded one way and then another.
STATES = {
    "ECST, the original still empty": {"method": "ecst"},
    "an original given, then back to NASCET": {"original_mm": 8.0},
    "a group with area": {"method": "area", "group": "carotid"},
    "a group with ECST": {"method": "ecst", "original_mm": 8.0, "group": "carotid"},
    "no reference yet": {"references_mm": []},
    "a reference beyond the vessel": {"references_mm": [500.0]},
    "a place beyond the vessel": {"at_mm": 500.0},
    "a reference and no place": {"at_mm": None},
    "both references on one side": {"references_mm": [45.0, 50.0]},
    "a reference at the place": {"references_mm": [30.0]},
    "a reference within a diameter": {"references_mm": [12.0, 36.0]},
}


#: The distance of sections and the point spread (mm); other tests measure with the defaults.
STEP, FWHM = 2.0, 0.9


def run(*words):
    return CliRunner().invoke(main, ["measure", *map(str, words), "--step", str(STEP)])


def profile_of(scene, volume):
    return measure(read_volume(volume), scene.tree[0], STEP, FWHM, tree=scene.tree)


@pytest.fixture(scope="module")
def narrow(tmp_path_factory):
    """A vessel of 60 mm with a stenosis of 60 % in its middle, and its volume as a file."""
    scene = phantom.stenosis(60)
    folder = tmp_path_factory.mktemp("narrow")
    return scene, write_volume_of(scene.volume, folder / "ct.nii.gz")


@pytest.fixture(scope="module")
def graded(narrow, tmp_path_factory):
    """Return the results for the vessel in each state: JSON, rows of the table, and messages."""
    scene, volume = narrow
    told = {}
    for name, changes in STATES.items():
        folder = tmp_path_factory.mktemp("state")
        session = write_session(folder / "s.mrk.json", scene.tree, marks=MARKS | changes, fwhm=FWHM)
        result = run(volume, session, "-o", folder / "p.json", "-o", folder / "p.csv")
        assert (result.exit_code, result.stderr) == (0, ""), f"{name}: {result.output}"
        (vessel,) = json.loads((folder / "p.json").read_text("utf-8"))["vessels"]
        with (folder / "p.csv").open(encoding="utf-8", newline="") as file:
            told[name] = vessel, list(csv.DictReader(file)), result.stdout
    return told


def test_no_state_costs_the_vessel_its_rows(graded, narrow):
    scene, volume = narrow
    expected = profile_of(scene, volume)
    for name, (vessel, rows, _) in graded.items():
        assert vessel["sections"]["area_mm2"] == expected.area.tolist(), name
        assert len(rows) == len(expected), name


@pytest.mark.parametrize("name", ["an original given, then back to NASCET", "a group with area"])
def test_what_another_method_was_given_is_left_aside(graded, narrow, name):
    scene, volume = narrow
    vessel, rows, words = graded[name]
    expected = profile_of(scene, volume).stenosis(30.0, 50.0, vessel["stenosis"]["method"])
    assert vessel["stenosis"]["percent"] == expected.percent
    assert vessel["stenosis"]["group"] is None
    assert vessel["not_graded"] is None
    assert {row["not_graded"] for row in rows} == {""}
    (told,) = {row["stenosis"] for row in rows}
    assert told
    assert f"  {told}\n" in words
    assert str(expected).startswith(told)


def test_ecst_has_no_group_and_no_references(graded):
    vessel, _, words = graded["a group with ECST"]
    assert vessel["stenosis"]["reference_mm"] == 8.0
    assert (vessel["stenosis"]["group"], vessel["stenosis"]["references"]) == (None, [])
    assert "assumed original 8.00 mm" in words


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        (
            "ECST, the original still empty",
            ECST,
        ),
        ("no reference yet", "mark a reference where the vessel is normal."),
        ("a reference and no place", "mark the place of the stenosis."),
        (
            "a reference beyond the vessel",
            "reference of the stenosis: found 500 mm; expected an arc length",
        ),
        (
            "a place beyond the vessel",
            "place on the vessel: found 500 mm; expected an arc length",
        ),
        ("both references on one side", "one place before it and one after it"),
        ("a reference at the place", "found 30.0 mm, 0.0 mm from the stenosis at 30.0 mm; expected a place"),
        ("a reference within a diameter", "mark the reference farther from the stenosis, where the vessel"),
    ],
)
def test_the_reason_stands_where_the_percentage_would(graded, name, reason):
    vessel, rows, words = graded[name]
    assert vessel["stenosis"] is None
    assert reason in vessel["not_graded"]
    assert {row["not_graded"] for row in rows} == {vessel["not_graded"]}
    assert {row["stenosis"] for row in rows} == {""}
    assert f"  no percentage: {vessel['not_graded']}\n" in words


def test_where_nothing_is_marked_there_is_no_reason(narrow, tmp_path):
    scene, volume = narrow
    marks = MARKS | {"at_mm": None, "references_mm": []}
    session = write_session(tmp_path / "s.mrk.json", scene.tree, marks=marks, fwhm=FWHM)
    result = run(volume, session, "-o", tmp_path / "p.json")
    (vessel,) = json.loads((tmp_path / "p.json").read_text("utf-8"))["vessels"]
    assert (vessel["stenosis"], vessel["not_graded"]) == (None, None)
    assert "no percentage" not in result.stdout


def test_the_other_vessels_are_measured_too(tmp_path):
    scene = phantom.y_junction()
    volume = write_volume_of(scene.volume, tmp_path / "ct.nii.gz")
    marks = MARKS | {"at_mm": 500.0, "method": "ecst"}
    session = write_session(tmp_path / "s.mrk.json", scene.tree, marks=marks, fwhm=FWHM)
    result = run(volume, session, "-o", tmp_path / "p.json")
    assert (result.exit_code, result.stderr) == (0, "")
    vessels = json.loads((tmp_path / "p.json").read_text("utf-8"))["vessels"]
    assert [vessel["not_graded"] is None for vessel in vessels] == [False, True, True]


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"method": "ecst"}, ECST),
        ({"references_mm": [30.0]}, "reference of the stenosis: found 30.0 mm, 0.0 mm from the stenosis"),
    ],
)
def test_a_report_says_why_there_is_no_percentage(narrow, tmp_path, changes, reason):
    scene, volume = narrow
    session = write_session(tmp_path / "s.mrk.json", scene.tree, marks=MARKS | changes, fwhm=FWHM)
    result = run(volume, session, "-o", tmp_path / "p.csv", "--report", tmp_path / "r.html")
    assert result.exit_code == 0, result.output
    page = (tmp_path / "r.html").read_text("utf-8")
    assert f"No percentage: {reason}" in page
