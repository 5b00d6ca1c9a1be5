"""``lumencut bids``: participants and sessions of a data set of BIDS, one job each, and the tables of all."""

from __future__ import annotations

import subprocess
import sys

import pytest

from cohort_scenes import RECIPE, table
from lumencut.cohort.bids import read_bids
from lumencut.errors import FileError, FormatError
from scene_files import write_volume


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """Two participants, of whom the second has two sessions, and other pictures beside the angiographies."""
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
    command = [sys.executable, "-m", "lumencut", "bids", str(data), str(data / "out"), *words]
    recipe = ["--recipe", str(data / "recipe.toml")]
    return subprocess.run([*command, *recipe], capture_output=True, text=True)


def test_each_session_is_a_study(data):
    manifest = read_bids(data)
    assert [one.id for one in manifest.studies] == ["sub-01", "sub-02_ses-a", "sub-02_ses-b"]
    assert [str(one.folder) for one in manifest.studies] == ["sub-01", "sub-02/ses-a", "sub-02/ses-b"]
    assert [one.volume.name for one in manifest.studies][:2] == [
        "sub-01_angio.nii.gz",
        "sub-02_ses-a_CT.nii.gz",
    ]
    assert [one.id for one in read_bids(data, labels=["02"]).studies] == ["sub-02_ses-a", "sub-02_ses-b"]
    assert [one.volume.name for one in read_bids(data, ["T1w"]).studies] == ["sub-01_T1w.nii.gz"]


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
    # Those that are done are not done again.
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
