"""``lumencut summarize``: distributions over a cohort, and the agreement of two runs at the same places."""

from __future__ import annotations

import csv

import numpy as np
import pytest

from cohort_scenes import run_here
from lumencut.cohort.agreement import agreements
from lumencut.cohort.distributions import distributions, states_of
from lumencut.cohort.result_tables import ResultTable
from lumencut.cohort.study_tables import VESSEL_COLUMNS
from lumencut.errors import FileError, FormatError

SECTION_COLUMNS = (
    *("id", "vessel", "name", "counts", "diameter_equivalent_mm", "uncertainty_mm", "diameter_min_mm"),
    *("area_mm2", "center_x_lps_mm", "center_y_lps_mm", "center_z_lps_mm"),
)


def write(path, columns, rows):
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(rows)


def write_run(folder, error=0.0, shift=0.0, renumbered=False):
    """Write two studies of two vessels: diameters differ by `error`, middles of sections by `shift`."""
    folder.mkdir()
    vessels, sections = [], []
    for study in ("p1", "p2"):
        for number, name in enumerate(("aorta", "")):
            vessel = str(1 - number if renumbered and name else number)
            base = {"id": study, "vessel": vessel, "name": name}
            vessels.append({**base, "length_mm": 30, "diameter_median_mm": 8 + number + error})
            for z in range(20):
                diameter = 8 + number + 0.1 * (z % 3) + error * (-1) ** z
                sections.append(
                    {
                        **base,
                        "counts": "no" if z == 7 else "yes",
                        "diameter_equivalent_mm": diameter,
                        "diameter_min_mm": diameter - 0.5,
                        "area_mm2": np.pi * diameter**2 / 4,
                        "uncertainty_mm": 0.1,
                        "center_x_lps_mm": 50 * number + shift,
                        "center_y_lps_mm": 0,
                        "center_z_lps_mm": 2 * z,
                    }
                )
    write(folder / "vessels.csv", VESSEL_COLUMNS, vessels)
    write(folder / "sections.csv", SECTION_COLUMNS, sections)
    rows = [{"id": "p1", "state": "done"}, {"id": "p2", "state": "done"}]
    rows += [{"id": "p3", "state": "failed", "reason": "crashed: SIGABRT"}]
    write(folder / "studies.csv", ("id", "state", "reason"), rows)
    return folder


def test_distributions_over_all_vessels_and_those_of_each_name(tmp_path):
    run = write_run(tmp_path / "run")
    found = {(one.vessels, one.quantity): one for one in distributions(run)}
    every, aorta = found["all", "diameter_median_mm"], found["aorta", "diameter_median_mm"]
    assert (every.count, aorta.count) == (4, 2)
    assert (every.mean, aorta.mean) == (8.5, 8.0)
    assert every.sd == pytest.approx(np.std([8, 8, 9, 9], ddof=1))
    assert every.quartiles == (8, 8, 8.5, 9, 9)
    assert ("all", "suggested_narrowest_mm") not in found
    states, reasons = states_of(run)
    assert states == {"done": 2, "failed": 1}
    assert reasons == {"crashed: SIGABRT": 1}


def test_the_agreement_of_two_runs_is_that_of_bland_and_altman(tmp_path):
    first = write_run(tmp_path / "first")
    second = write_run(tmp_path / "second", error=0.2, shift=0.5)
    found = {(one.over, one.quantity): one for one in agreements(first, second)}
    vessels = found["vessels", "diameter_median_mm"]
    assert len(vessels.first) == 4
    assert vessels.bias == pytest.approx(0.2)
    assert vessels.sd == pytest.approx(0, abs=1e-12)
    sections = found["sections", "diameter_equivalent_mm"]
    assert len(sections.first) == 4 * 19
    expected = [0.2 * (-1) ** z for z in range(20) if z != 7] * 4
    assert sections.bias == pytest.approx(np.mean(expected))
    assert sections.sd == pytest.approx(np.std(expected, ddof=1))
    low, high = sections.limits
    assert (low + high) / 2 == pytest.approx(sections.bias)
    assert high - low == pytest.approx(2 * 1.96 * sections.sd)
    # Both diameters have an uncertainty of 0.1 mm, so 0.2 mm is within 1.96 · 0.14 mm.
    assert sections.within_uncertainty == 1
    assert set(sections.studies) == {"p1", "p2"}
    third = write_run(tmp_path / "third", error=0.3)
    assert agreements(first, third)[-3].within_uncertainty == 0


def test_vessels_are_matched_by_name_whatever_their_number(tmp_path):
    first, second = write_run(tmp_path / "first"), write_run(tmp_path / "second", renumbered=True)
    found = {(one.over, one.quantity): one for one in agreements(first, second)}
    assert len(found["vessels", "diameter_median_mm"].first) == 4
    assert found["sections", "diameter_equivalent_mm"].sd == 0


def test_places_far_apart_are_not_compared(tmp_path):
    first, second = write_run(tmp_path / "first"), write_run(tmp_path / "second", shift=1.5)
    assert {one.over for one in agreements(first, second)} == {"vessels"}


def test_what_is_no_result_is_named(tmp_path):
    with pytest.raises(FileError, match="lumencut batch -o"):
        distributions(tmp_path)
    (tmp_path / "vessels.csv").write_text("id,name\np1,a\n", "utf-8")
    with pytest.raises(FormatError, match="no column 'length_mm'"):
        distributions(tmp_path)
    (tmp_path / "vessels.csv").write_text("id,name\np1\n", "utf-8")
    with pytest.raises(FormatError, match="1 fields in a line"):
        ResultTable(tmp_path, "vessels", ("id",))
    (tmp_path / "vessels.csv").write_text("id,name\np1,wide\n", "utf-8")
    with pytest.raises(FormatError, match="wide"):
        ResultTable(tmp_path, "vessels", ("name",)).numbers("name")


def summarize(*words):
    return run_here("summarize", *map(str, words))


def test_the_command_tells_and_writes_them(tmp_path):
    first, second = write_run(tmp_path / "first"), write_run(tmp_path / "second", error=0.2)
    told = summarize(first).stdout
    assert "2 done, 1 failed" in told
    assert "1 × crashed: SIGABRT" in told
    ended = summarize(first, second, "-o", tmp_path / "a.csv", "--plot", tmp_path / "a.svg")
    assert ended.returncode == 0, ended.stderr
    with (tmp_path / "a.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["over"] for row in rows] == ["vessels"] * 2 + ["sections"] * 3
    assert float(rows[0]["mean_difference"]) == 0.2
    assert b"<svg" in (tmp_path / "a.svg").read_bytes()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--plot", "a.png"), "--plot without SECOND does nothing"),
        (("-o", "a.txt"), "expected .csv"),
        (("none",), "none"),
    ],
)
def test_the_command_refuses_what_does_nothing(tmp_path, words, told):
    ended = summarize(write_run(tmp_path / "first"), *words)
    assert ended.returncode in (1, 2)
    assert told in ended.stderr
