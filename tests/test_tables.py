"""Cells of CSV made from names: no spreadsheet runs them, and reading gives the original names."""

from __future__ import annotations

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

import lumencut
from cohort_scenes import RECIPE, run
from lumencut import phantom
from lumencut.base.csv_cells import read_rows, written
from lumencut.cohort.result_tables import ResultTable
from scene_files import bent_line, write_volume

FORMULAS = ["=1+1", "+1+1", "-1-1", "@SUM(1)", "\t=1", "\r=1", '=HYPERLINK("x","y")', "--1", "-", "+inf"]
PLAIN = ["", "LAD", "-1", "+2.5", "-1.5e-3", "a=b", "'LAD", "'", " =1", "Arteria 50 %"]


def cells(text):
    """Return the cells as a spreadsheet shows them."""
    return list(csv.reader(io.StringIO(text, newline="")))


@pytest.mark.parametrize("text", [*FORMULAS, "'=1", "''@"])
def test_what_begins_as_a_formula_stands_behind_an_apostrophe(text):
    whole = written([["name"], [text]])
    assert cells(whole) == [["name"], [f"'{text}"]]
    assert list(read_rows(io.StringIO(whole, newline=""))) == [["name"], [text]]


@pytest.mark.parametrize("text", PLAIN)
def test_other_texts_and_numbers_are_written_as_they_are(text):
    assert cells(written([["a", text]])) == [["a", text]]


def test_numbers_keep_their_sign():
    assert written([[-1.5, -3, None, float("-inf"), True]]) == "-1.5,-3,,-inf,True\n"


@given(st.lists(st.text(alphabet=st.sampled_from("=+-@\t\r\n'\",;a1 .e")), min_size=2))
def test_every_row_is_read_back(row):
    assert list(read_rows(io.StringIO(written([row]), newline=""))) == [row]


@pytest.mark.parametrize("name", [*FORMULAS[:4], *FORMULAS[6:], *PLAIN[1:]])
def test_the_core_marks_the_same_names(name, tmp_path):
    tube = phantom.straight_tube()
    vessel = lumencut.Vessel(tube.tree[0].points, tube.tree[0].radius, name=name)
    lumencut.write_centerlines(lumencut.VesselTree([vessel]), tmp_path / "a.csv")
    (row,) = cells(written([[name]]))
    assert cells((tmp_path / "a.csv").read_text("utf-8"))[1][1] == row[0]


def test_the_tables_of_a_cohort_give_names_and_further_columns_back(tmp_path):
    write_volume(tmp_path / "a.nii.gz")
    vessel = lumencut.Vessel(bent_line(), 3.0, name="=1+1")
    lumencut.write_centerlines(lumencut.VesselTree([vessel]), tmp_path / "lines.vtp")
    rows = [
        ["id", "volume", "centerlines", "note", "shift"],
        ["a", "a.nii.gz", "lines.vtp", "@SUM(1)", "-4.5"],
    ]
    rows.append(["b", "=b.nii.gz", "lines.vtp", "+x", "'=1"])
    (tmp_path / "studies.csv").write_text(written(rows), "utf-8")
    (tmp_path / "recipe.toml").write_text(RECIPE, "utf-8")
    (tmp_path / "site").mkdir()
    ended = run(tmp_path / "studies.csv", tmp_path / "out")
    assert "1 done, 1 failed" in ended.stdout, ended.stdout + ended.stderr
    studies = cells((tmp_path / "out/studies.csv").read_text("utf-8"))
    assert [row[-2:] for row in studies[1:]] == [["'@SUM(1)", "-4.5"], ["'+x", "''=1"]]
    table = ResultTable(tmp_path / "out", "studies", ("note", "shift", "reason"))
    assert table.words("note") == ["@SUM(1)", "+x"]
    assert table.words("shift") == ["-4.5", "'=1"]
    for name in ("vessels", "sections"):
        found = cells((tmp_path / f"out/{name}.csv").read_text("utf-8"))
        assert {row[found[0].index("name")] for row in found[1:]} == {"'=1+1"}
        assert set(ResultTable(tmp_path / "out", name, ("name",)).words("name")) == {"=1+1"}
