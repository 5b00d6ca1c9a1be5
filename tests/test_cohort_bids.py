"""``lumencut bids``: participants and sessions of a BIDS data set, one job each, and the tables of all."""

from __future__ import annotations

import pytest

from cohort_scenes import RECIPE, run_here, table
from lumencut.cohort.bids import read_bids
from lumencut.cohort.distributions import states_of
from lumencut.errors import FileError, FormatError
from scene_files import write_volume


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """Two participants, the second one with two sessions, and further images next to the angiographies."""
    home = tmp_path_factory.mktemp("bids")
    names = [
        "sub-01/anat/sub-01_angio",
        "sub-02/ses-a/ct/sub-02_ses-a_CT",
        "sub-02/ses-b/anat/sub-02_ses-b_angio",
    ]
    for name in [*names, "sub-01/anat/sub-01_T1w"]:
        path = home / f"{name}.nii.gz"
        path.parent.mkdir(parents=True, exist_ok=True)
        write_volume(path)
    (home / "recipe.toml").write_text(RECIPE, "utf-8")
    return home


def run(data, *words):
    return run_here("bids", str(data), str(data / "out"), *words, "--recipe", str(data / "recipe.toml"))


def test_each_session_is_a_study(data):
    manifest = read_bids(data)
    assert [one.id for one in manifest.studies] == ["sub-01", "sub-02_ses-a", "sub-02_ses-b"]
    assert [str(one.folder) for one in manifest.studies] == ["sub-01", "sub-02/ses-a", "sub-02/ses-b"]
    assert [one.volume.name for one in manifest.studies][:2] == [
        "sub-01_angio.nii.gz",
        "sub-02_ses-a_CT.nii.gz",
    ]
    assert [one.id for one in read_bids(data, labels=["02"]).studies] == ["sub-02_ses-a", "sub-02_ses-b"]
    taken = [one for one in read_bids(data, ["T1w"]).studies if not one.left_out]
    assert [one.volume.name for one in taken] == ["sub-01_T1w.nii.gz"]


def test_what_cannot_be_told_apart_or_found_is_refused(data, tmp_path):
    with pytest.raises(FormatError, match="2 angiographies: sub-01_T1w"):
        read_bids(data, ["angio", "T1w"])
    with pytest.raises(FormatError, match="found no sub-03; expected some of its 2"):
        read_bids(data, labels=["01", "sub-03"])
    with pytest.raises(FormatError, match="no angiography"):
        read_bids(tmp_path)
    with pytest.raises(FileError, match="no such folder"):
        read_bids(tmp_path / "none")


def test_participants_and_then_the_group(data):
    first = run(data, "participant", "--participant-label", "02")
    assert first.returncode == 0, first.stderr
    assert first.stdout.splitlines() == ["sub-02_ses-a: done", "sub-02_ses-b: done"]
    group = run(data, "group")
    assert "2 done, 0 failed, 1 not done yet" in group.stdout
    assert run(data, "participant").stdout.splitlines() == ["sub-01: done"]
    assert run(data, "group").returncode == 0
    out = data / "out"
    rows = table(out / "studies.csv")
    assert [(row["id"], row["state"]) for row in rows] == [
        ("sub-01", "done"),
        ("sub-02_ses-a", "done"),
        ("sub-02_ses-b", "done"),
    ]
    assert (out / "sub-02/ses-a/sub-02_ses-a_vessels.csv").is_file()
    assert {row["id"] for row in table(out / "vessels.csv")} == {row["id"] for row in rows}
    refused = run(data, "group", "--participant-label", "01")
    assert refused.returncode == 2
    assert "does nothing" in refused.stderr


@pytest.fixture
def ragged(tmp_path):
    """Five participants, of which only one has an angiography, and a session without one."""
    names = [
        "sub-01/anat/sub-01_angio",
        "sub-02/anat/sub-02_TOF",
        "sub-04/ses-a/anat/sub-04_ses-a_T1w",
        "sub-04/ses-b/anat/sub-04_ses-b_angio",
    ]
    for name in names:
        path = tmp_path / f"{name}.nii.gz"
        path.parent.mkdir(parents=True, exist_ok=True)
        write_volume(path)
    (tmp_path / "sub-03").mkdir()
    (tmp_path / "sub-04/sub-04_sessions.tsv").write_text("session_id\nses-a\nses-c\n", "utf-8")
    rows = [f"sub-0{number}\t60" for number in (5, 4, 3, 2, 1)]
    (tmp_path / "participants.tsv").write_text("\n".join(["participant_id\tage", *rows]), "utf-8")
    (tmp_path / "recipe.toml").write_text(RECIPE, "utf-8")
    return tmp_path


#: The reason stated for each study of that data set without an angiography.
LEFT_OUT = {
    "sub-02": "no name that ends with _angio.nii.gz, _cta.nii.gz, _ct.nii.gz; found sub-02_TOF.nii.gz",
    "sub-03": "no name that ends with _angio.nii.gz, _cta.nii.gz, _ct.nii.gz; found no image",
    "sub-04_ses-a": "no name that ends with _angio.nii.gz, _cta.nii.gz, _ct.nii.gz; "
    "found sub-04_ses-a_T1w.nii.gz",
    "sub-04_ses-c": "no folder ses-c of this session of the table of sessions",
    "sub-05": "participants.tsv lists it, but there is no folder",
}


def test_participants_without_an_angiography_are_rows_with_their_reason(ragged):
    done = run(ragged, "participant")
    assert done.returncode == 0, done.stderr
    said = [f"{name}: skipped: {reason}" for name, reason in LEFT_OUT.items()]
    assert done.stdout.splitlines() == [*said, "sub-01: done", "sub-04_ses-b: done"]
    group = run(ragged, "group")
    assert group.stdout.splitlines() == [
        *said,
        f"{ragged / 'out'}: 2 done, 0 failed, 5 without an angiography",
    ]
    rows = table(ragged / "out/studies.csv")
    ids = ["sub-01", "sub-02", "sub-03", "sub-04_ses-a", "sub-04_ses-b", "sub-04_ses-c", "sub-05"]
    assert [row["id"] for row in rows] == ids
    skipped = {row["id"]: row["reason"] for row in rows if row["state"] == "skipped"}
    assert skipped == LEFT_OUT
    page = (ragged / "out/index.html").read_text("utf-8")
    assert "found sub-02_TOF.nii.gz" in page
    states, reasons = states_of(ragged / "out")
    assert (states["done"], states["skipped"]) == (2, 5)
    assert reasons[LEFT_OUT["sub-05"]] == 1


def test_the_suffix_that_a_reason_asks_for_takes_the_study_in(ragged):
    studies = read_bids(ragged, ["TOF", "angio", "T1w"], ["02", "04"]).studies
    assert [one.id for one in studies if not one.left_out] == ["sub-02", "sub-04_ses-a", "sub-04_ses-b"]
    with pytest.raises(FormatError, match=r"sub-02: no name .* found sub-02_TOF\.nii\.gz"):
        read_bids(ragged, labels=["02"])


def test_an_angiography_outside_of_the_sessions_is_named(ragged):
    write_volume(ragged / "sub-04/sub-04_angio.nii.gz")
    found = {one.id: one.left_out for one in read_bids(ragged).studies}
    assert "outside of the sessions: sub-04_angio.nii.gz; move it" in found["sub-04"]
    assert found["sub-04_ses-b"] == ""


def test_a_table_of_participants_that_cannot_be_read_is_a_note(ragged):
    (ragged / "participants.tsv").write_text("name\nx\n", "utf-8")
    (ragged / "sub-04/sub-04_sessions.tsv").write_text("session_id\ta\nses-c\n", "utf-8")
    manifest = read_bids(ragged)
    assert "found no column participant_id" in manifest.notes[0]
    assert "1 fields in line 2" in manifest.notes[1]
    assert "sub-05" not in [one.id for one in manifest.studies]
