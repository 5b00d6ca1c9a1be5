"""The interface to the core's DICOM decisions: values as plain records, JSON in and out."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest
from pydicom._uid_dict import UID_dictionary
from pydicom.multival import MultiValue
from pydicom.sequence import Sequence
from pydicom.uid import EnhancedCTImageStorage
from pydicom.valuerep import IS, TM, DSdecimal, DSfloat, PersonName

import dicom_answers
from dicom_cases import CASES
from dicom_enhanced import enhanced
from dicom_phantom import save
from dicom_series import PLAIN_STACK, Stack
from lumencut import FormatError, list_series, read_volume
from lumencut._lumencut import DICOM_ATTRIBUTES, describe_dicom, judge_dicom
from lumencut.dicom.reading.files import read_files
from lumencut.dicom.reading.headers import header_tags
from lumencut.dicom.reading.records import plain

NAMED = {case.name: case for case in CASES}
BOTH_DOORS = (
    *("axial", "3 of 24 slices missing", "several volumes", "enhanced"),
    "slices 2 to 3 mm apart, on a grid",
)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (None, None),
        ("", ""),
        (512, 512),
        (40.5, 40.5),
        (float("nan"), "nan"),
        (float("-inf"), "-inf"),
        (DSfloat("1.50"), "1.50"),
        (DSdecimal("2.0"), "2.0"),
        (IS("007"), "007"),
        (TM("120000"), "120000"),
        (MultiValue(DSfloat, ["1.0", "2"]), ["1.0", "2"]),
        (np.array([0.5, 2.0]), [0.5, 2.0]),
        (Sequence([]), 0),
        (b"DOE^JOHN", True),
        (PersonName("DOE^JOHN"), True),
    ],
)
def test_values_are_plain(value, expected):
    found = plain(value)
    assert found == expected
    assert type(found) is type(expected)
    json.dumps(found, allow_nan=False)


def test_every_attribute_that_is_judged_by_is_read():
    from pydicom.datadict import tag_for_keyword

    assert len(DICOM_ATTRIBUTES) > 40
    names = [*DICOM_ATTRIBUTES, *(name for groups in DICOM_ATTRIBUTES.values() for name in groups)]
    assert all(tag_for_keyword(name) is not None for name in names)
    assert {tag_for_keyword(name) for name in DICOM_ATTRIBUTES} <= set(header_tags())


def test_names_of_kinds_and_syntaxes_are_those_of_pydicom():
    listed = Path(__file__).resolve().parents[1] / "crates/lumencut-dicom/src/uids.txt"
    names = dict(line.split(" ", 1) for line in listed.read_text("utf-8").splitlines())
    wanted = {"SOP Class", "Transfer Syntax"}
    assert names == {uid: told[0] for uid, told in UID_dictionary.items() if told[1] in wanted}


def test_records_hold_frames_as_they_are(tmp_path):
    data = enhanced(PLAIN_STACK)
    data.PerFrameFunctionalGroupsSequence[3].PlanePositionSequence[0].ImagePositionPatient = None
    save(data, tmp_path / "all.dcm")
    (tmp_path / "note.txt").write_text("hello")
    found = {file.source.name: file.record for file in read_files(tmp_path, [])}
    assert found["note.txt"] == {"name": "note.txt", "kind": "no DICOM"}
    record = found["all.dcm"]
    assert record["header"]["sop_class"] == EnhancedCTImageStorage
    frames = record["header"]["frames"]
    assert len(frames) == len(PLAIN_STACK)
    assert [frame["ImagePositionPatient"] is None for frame in frames].index(True) == 3
    position = [float(number) for number in frames[0]["ImagePositionPatient"]]
    np.testing.assert_allclose(position, PLAIN_STACK[0].plane[:3, 3])
    assert "PixelSpacing" in record["header"]["shared"]


def test_a_damaged_frame_is_named_and_spoils_no_other_series(tmp_path):
    save(enhanced(PLAIN_STACK), tmp_path / "all.dcm")
    whole = (tmp_path / "all.dcm").read_bytes()
    height = b"%.9f" % PLAIN_STACK[3].plane[2, 3]
    assert whole.count(height) == 1
    (tmp_path / "all.dcm").write_bytes(whole.replace(height, b"DOE^JOHN".ljust(len(height))))
    with pytest.raises(FormatError) as caught:
        read_volume(tmp_path)
    words = "found damaged values in ImagePositionPatient; expected 3 finite numbers"
    assert str(caught.value) == f"{tmp_path / 'all.dcm'}: {words}"
    Stack(PLAIN_STACK, series=4)(tmp_path)
    assert read_volume(tmp_path, series=4).size[2] == len(PLAIN_STACK)
    troubles = {one.number: one.trouble for one in list_series(tmp_path)}
    assert troubles["4"] == ""
    assert "damaged values in ImagePositionPatient" in troubles.values()


def test_letters_that_no_text_can_have_break_nothing(tmp_path):
    Stack(PLAIN_STACK)(tmp_path)
    for wanted in ("\udc80", "a\0b"):
        with pytest.raises(Exception, match="one series with the number or UID"):
            read_volume(tmp_path, series=wanted)


def test_documents_of_another_form_are_refused():
    for answer in (judge_dicom(b"{}", b"{}"), describe_dicom(b"DOE^JOHN"), judge_dicom(b"\xff", b"")):
        error = json.loads(answer)["error"]
        assert error["found"].startswith("headers in an unexpected form at line 1")
        assert "DOE" not in answer


@pytest.mark.parametrize("name", BOTH_DOORS)
def test_cases_are_written_for_other_hosts(tmp_path, name):
    case = NAMED[name]
    dicom_answers.write(case, tmp_path / "case")
    told = json.loads((tmp_path / "case.json").read_text("utf-8"))
    assert (tmp_path / told["path"]).exists()
    headers, wanted = (json.dumps(told[key]).encode() for key in ("headers", "wanted"))
    assert json.loads(judge_dicom(headers, wanted)) == told["answer"]
    assert ("error" in told["answer"]) == bool(case.words)
    assert ("error" in told) == bool(case.words)
    for part in ("found", "expected", "advice", "mends") if case.words else ():
        assert told["error"][part] == told["answer"]["error"][part]
    if not case.words:
        volume = read_volume(tmp_path / told["path"], resample_slices=case.resample_slices)
        assert told["volume"]["size"] == list(volume.size)
        voxels = volume.array.astype("<f4").tobytes()
        assert told["volume"]["sha256"] == hashlib.sha256(voxels).hexdigest()
