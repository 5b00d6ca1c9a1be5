"""``lumencut push``, against a PACS that fails on purpose."""

import zipfile

import pydicom
import pytest

from pacs_scenes import forget_user, write_scan
from pacs_scenes import run as run_any
from pacs_stub import Pacs, running


@pytest.fixture(autouse=True)
def nobody_known(monkeypatch, tmp_path):
    forget_user(monkeypatch, tmp_path)


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """40 slices, more than one batch holds."""
    return write_scan(tmp_path_factory.mktemp("ct"), 40)


@pytest.fixture
def pacs():
    with running(Pacs()) as one:
        yield one


def run(*arguments, **more):
    return run_any("push", *arguments, **more)


def uid_of(path):
    return str(pydicom.dcmread(path, stop_before_pixels=True).SOPInstanceUID)


def test_objects_are_sent_in_batches_and_found_again(pacs, scan):
    done = run(scan, pacs.base, "--yes", "--new-study")
    assert done.exit_code == 0, done.output
    assert "40 of 40 objects are in" in done.output
    assert "cannot be taken back" in done.output
    assert pacs.batches == [32, 8]
    assert set(pacs.held.values()) == {path.read_bytes() for path in scan.iterdir()}


def test_archives_are_sent_and_other_files_are_left_out(pacs, scan, tmp_path):
    with zipfile.ZipFile(tmp_path / "case.zip", "w") as archive:
        archive.writestr("README.txt", "no DICOM")
        for path in sorted(scan.iterdir())[:3]:
            archive.write(path, f"dicom/{path.name}")
    done = run(tmp_path / "case.zip", pacs.base, "--yes", "--new-study")
    assert done.exit_code == 0, done.output
    assert "left out, no DICOM: 1 files" in done.output
    assert len(pacs.held) == 3


def test_a_dry_run_lists_everything_and_asks_nobody(pacs, scan):
    done = run(scan, pacs.base, "--dry-run")
    assert done.exit_code == 0, done.output
    assert f"40 objects, 0.3 MB, to {pacs.base}" in done.output
    assert done.output.count("CT Image Storage") == 40
    assert not pacs.headers


def test_studies_that_the_pacs_does_not_have_are_refused(pacs, scan):
    refused = run(scan, pacs.base, "--yes")
    assert refused.exit_code == 1
    assert "1 studies that it does not have" in refused.output
    assert "--new-study" in refused.output
    assert not pacs.batches
    first = sorted(scan.iterdir())[0]
    pacs.take(first.read_bytes())
    assert run(scan, pacs.base, "--yes").exit_code == 0


def test_the_first_push_to_an_address_is_asked_for(pacs, scan, monkeypatch):
    unasked = run(scan, pacs.base, "--new-study")
    assert unasked.exit_code == 1
    assert "--yes" in unasked.output
    monkeypatch.setattr("click.testing._NamedTextIOWrapper.isatty", lambda self: True)
    no = run(scan, pacs.base, "--new-study", input="n\n")
    assert no.exit_code == 1
    assert "cannot be taken back" in no.output
    assert not pacs.batches
    assert run(scan, pacs.base, "--new-study", input="y\n").exit_code == 0
    again = run(scan, pacs.base)
    assert again.exit_code == 0
    assert "40 of them were there before" in again.output


def test_what_is_refused_is_named_and_only_that_is_sent_again(pacs, scan):
    paths = sorted(scan.iterdir())
    pacs.refused = {uid_of(paths[3]): (0xA700, 1), uid_of(paths[5]): (0x0122, 9)}
    done = run(scan, pacs.base, "--yes", "--new-study")
    assert done.exit_code == 3
    assert "39 of 40 objects are in" in done.output
    assert f"{paths[5]}: the PACS does not take this kind of object (0122)" in done.output
    assert str(paths[3]) not in done.output
    assert pacs.batches == [32, 8, 1]
    pacs.refused.clear()
    assert run(paths[5], pacs.base, "--yes").exit_code == 0


@pytest.mark.parametrize(
    ("status", "words"), [(500, "status 500"), (413, "status 413"), (401, "credentials")]
)
def test_a_batch_that_is_refused_whole_says_why(pacs, scan, status, words):
    def refuse(handler, path):
        if handler.command == "POST":
            handler.send(status, b"")
        return handler.command == "POST"

    pacs.fault = refuse
    done = run(scan, pacs.base, "--yes", "--new-study")
    assert done.exit_code == (1 if status == 401 else 3)
    assert words in done.output


def test_an_object_that_is_taken_and_lost_is_told(pacs, scan):
    def lose(handler, path):
        if handler.command == "POST":
            handler.send_json(200, {})
        return handler.command == "POST"

    pacs.fault = lose
    done = run(scan, pacs.base, "--yes", "--new-study")
    assert done.exit_code == 3
    assert "taken, but not found by a search afterwards" in done.output


def test_bad_objects_are_refused_before_anything_is_sent(pacs, scan, tmp_path):
    data = pydicom.dcmread(sorted(scan.iterdir())[0])
    del data.StudyInstanceUID
    data.save_as(tmp_path / "none.dcm")
    refused = run(tmp_path / "none.dcm", pacs.base, "--yes")
    assert refused.exit_code == 1
    assert "without the UIDs" in refused.output
    data = pydicom.dcmread(sorted(scan.iterdir())[0])
    data.PatientName = "Other"
    data.save_as(tmp_path / "twin.dcm")
    refused = run(scan, tmp_path / "twin.dcm", pacs.base, "--yes")
    assert refused.exit_code == 1
    assert "the same UID in" in refused.output
    (tmp_path / "text.txt").write_text("no DICOM")
    assert "found no DICOM" in run(tmp_path / "text.txt", pacs.base).output
    assert run(scan).exit_code == 2
    assert run(scan, f"{pacs.base}/studies/1.2").exit_code == 2
    assert not pacs.headers


def test_what_was_written_twice_is_sent_once(pacs, scan, tmp_path):
    data = pydicom.dcmread(sorted(scan.iterdir())[0])
    data.ContentTime = "235959"
    data.save_as(tmp_path / "again.dcm")
    done = run(scan, tmp_path / "again.dcm", pacs.base, "--yes", "--new-study")
    assert done.exit_code == 0, done.output
    assert "40 of 40 objects are in" in done.output
