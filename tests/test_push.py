"""``lumencut push`` with a PACS that fails on purpose."""

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
    assert "cannot be removed" in done.output
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
    assert "cannot be removed" in no.output
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
    assert f"{paths[5]}: the PACS does not accept this kind of object (0122)" in done.output
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
    assert "accepted, but not found by a search afterwards" in done.output


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


def changed(path, folder, **values):
    """Write an object with other values and another UID into a file."""
    data = pydicom.dcmread(path)
    for keyword, value in values.items():
        setattr(data, keyword, value)
    data.SOPInstanceUID = data.file_meta.MediaStorageSOPInstanceUID = f"{data.SOPInstanceUID}.7"
    folder.mkdir(exist_ok=True)
    data.save_as(folder / f"{len(list(folder.iterdir()))}.dcm")
    return folder / f"{len(list(folder.iterdir())) - 1}.dcm"


def holds(pacs, path, folder, **values):
    """Store an image of the study with other values in the PACS."""
    pacs.take(changed(path, folder / "held", **values).read_bytes())


@pytest.mark.parametrize("options", [("--yes",), ("--yes", "--new-study")])
@pytest.mark.parametrize(
    "values",
    [
        {"PatientID": "B-2"},
        {"PatientID": "B-2", "PatientName": "Phantom^Vessel", "IssuerOfPatientID": "Here"},
    ],
)
def test_objects_of_another_patient_than_that_of_the_study_are_refused(pacs, scan, tmp_path, options, values):
    first, *others = sorted(scan.iterdir())
    holds(pacs, first, tmp_path, **values)
    refused = run(*others[:3], pacs.base, *options)
    assert refused.exit_code == 1
    assert "'B-2'" in refused.output
    assert "PatientID 'phantom', as the objects have it" in refused.output
    assert "Vessel" not in refused.output
    assert not pacs.batches
    assert len(pacs.held) == 1


def test_an_issuer_tells_patients_apart_where_both_state_it(pacs, scan, tmp_path):
    first, second, *_ = sorted(scan.iterdir())
    holds(pacs, first, tmp_path, IssuerOfPatientID="Here")
    there = changed(second, tmp_path / "sent", IssuerOfPatientID="There")
    refused = run(there, pacs.base, "--yes")
    assert refused.exit_code == 1
    assert "'Here'" in refused.output
    assert "'There'" in refused.output
    bare = run(second, pacs.base, "--yes")
    assert bare.exit_code == 0
    assert "only one issuer is stated" in bare.output


@pytest.mark.parametrize("values", [{"PatientID": " phantom "}, {"PatientName": "Another^Spelling"}])
def test_padding_and_names_tell_nobody_apart(pacs, scan, tmp_path, values):
    first, second, *_ = sorted(scan.iterdir())
    holds(pacs, first, tmp_path, **values)
    done = run(second, pacs.base, "--yes")
    assert done.exit_code == 0, done.output
    assert "warning" not in done.output


def test_a_study_without_a_patient_cannot_be_compared(pacs, scan, tmp_path):
    first, second, third, *_ = sorted(scan.iterdir())
    holds(pacs, first, tmp_path, PatientID="")
    done = run(second, pacs.base, "--yes")
    assert done.exit_code == 0, done.output
    assert "patients cannot be compared" in done.output
    bare = run(second, changed(third, tmp_path / "sent", PatientID=""), pacs.base, "--yes")
    assert bare.exit_code == 0, bare.output
    assert "no PatientID to compare with PatientID 'phantom'" in bare.output


@pytest.mark.parametrize("options", [("--dry-run",), ("--yes", "--new-study")])
def test_two_patients_in_one_study_are_refused(pacs, scan, tmp_path, options):
    first, second, *_ = sorted(scan.iterdir())
    other = changed(second, tmp_path / "sent", PatientID="B-2")
    refused = run(first, other, pacs.base, *options)
    assert refused.exit_code == 1
    assert "'B-2'" in refused.output
    assert "one patient in one study" in refused.output
    assert not pacs.headers
    alone = changed(second, tmp_path / "sent", PatientID="B-2", StudyInstanceUID="1.2.3")
    assert run(first, alone, pacs.base, *options).exit_code == 0


def test_a_dry_run_lists_patients(pacs, scan):
    done = run(sorted(scan.iterdir())[0], pacs.base, "--dry-run")
    assert "PatientID 'phantom'" in done.output
    assert not pacs.headers
