"""Unusual DICOM files: damaged attributes, archives and links, hostile folders."""

from __future__ import annotations

import json
import logging
import os
import zipfile

import pydicom
import pytest
from click.testing import CliRunner
from pydicom.datadict import tag_for_keyword

from dicom_enhanced import enhanced
from dicom_phantom import save
from dicom_series import PLAIN_STACK, Stack, sets
from lumencut.cli import main
from lumencut.errors import FormatError, SeriesError
from lumencut.files.volumes import inspect_volume, list_series, read_volume

NAME = "DOE^JOHN"
STACK = Stack(PLAIN_STACK)
needs_posix = pytest.mark.skipif(os.name == "nt", reason="no pipes and no such names here")


def spoil(path, keyword, vr, value):
    """Replace type and bytes of an element in a file."""
    data, tag = path.read_bytes(), tag_for_keyword(keyword)
    at = data.find(bytes([tag >> 16 & 255, tag >> 24, tag & 255, tag >> 8 & 255]), 300)
    length = int.from_bytes(data[at + 6 : at + 8], "little")
    head = data[: at + 4] + vr.encode() + len(value).to_bytes(2, "little") + value.encode()
    path.write_bytes(head + data[at + 8 + length :])


@pytest.mark.parametrize("vr", ["LO", "PN"])
@pytest.mark.parametrize(
    "keyword",
    [
        *("ImagePositionPatient", "PixelSpacing", "ImageOrientationPatient", "Rows", "BitsAllocated"),
        *(
            "BitsStored",
            "PixelRepresentation",
            "SamplesPerPixel",
            "PhotometricInterpretation",
            "RescaleSlope",
        ),
    ],
)
def test_a_damaged_attribute_names_its_file_and_not_its_value(tmp_path, keyword, vr):
    STACK(tmp_path)
    spoil(tmp_path / "IM0005.dcm", keyword, vr, NAME)
    with pytest.raises(FormatError, match=r"IM0005\.dcm: found") as caught:
        read_volume(tmp_path)
    assert NAME not in str(caught.value)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (sets(RescaleSlope="0"), "RescaleSlope 0"),
        (sets(RescaleSlope=["1", "2"]), r"IM0001\.dcm"),
        (sets(PixelRepresentation=None), "PixelRepresentation not stated"),
        (sets(BitsStored=None), "BitsStored not stated; expected 1 to 16"),
        (sets(BitsStored=17), "BitsStored 17"),
        (sets(NumberOfFrames=[1, 2]), r"IM0001\.dcm"),
    ],
)
def test_values_that_cannot_be_known_are_refused(tmp_path, change, words):
    Stack(PLAIN_STACK, change=change)(tmp_path)
    with pytest.raises(FormatError, match=words):
        read_volume(tmp_path)


def test_an_odd_high_bit_is_noted(tmp_path):
    Stack(PLAIN_STACK, change=sets(BitsStored=12, HighBit=14))(tmp_path)
    assert any("HighBit" in note for note in inspect_volume(tmp_path).notes)


def test_many_claimed_frames_take_no_time(tmp_path):
    Stack(PLAIN_STACK, series=4)(tmp_path)
    data = enhanced(PLAIN_STACK)
    data.NumberOfFrames = 2_000_000_000
    save(data, tmp_path / "enhanced.dcm")
    assert sorted(one.images for one in list_series(tmp_path)) == [len(PLAIN_STACK), 2_000_000_000]


def test_unknown_kinds_and_codecs_are_named_with_their_file(tmp_path):
    STACK(tmp_path)
    for path in tmp_path.iterdir():
        path.write_bytes(path.read_bytes().replace(b"1.2.840.10008.1.2.1\0", b"DOE^JOHN".ljust(20, b"\0")))
    with pytest.raises(
        FormatError, match=r"IM0001\.dcm: found pixels in an unknown transfer syntax"
    ) as caught:
        read_volume(tmp_path)
    assert NAME not in str(caught.value)
    assert "unknown transfer syntax" in list_series(tmp_path)[0].trouble


@pytest.mark.parametrize("number", ["3", 3, "003", "1.2.826.0.1.3680043.10.1000.1.3"])
def test_numbers_of_series_with_zeros(tmp_path, number):
    Stack(PLAIN_STACK, change=sets(SeriesNumber="0003"))(tmp_path)
    assert read_volume(tmp_path, series=number).size[2] == len(PLAIN_STACK)


def test_a_series_asked_for_in_vain_is_an_error_of_info(tmp_path):
    STACK(tmp_path)
    found = CliRunner().invoke(main, ["info", "--json", "--series", "99", str(tmp_path)])
    assert found.exit_code == 1
    assert "number or UID '99'" in found.stderr
    assert json.loads(found.stdout)["files"][0]["kind"] == "series"
    found = CliRunner().invoke(main, ["info", "--json", str(tmp_path)])
    assert (found.exit_code, found.stderr) == (0, "")
    (described,) = json.loads(found.stdout)["files"]
    assert described["size"] == [*read_volume(tmp_path).size]


@pytest.mark.parametrize("name", ["/etc/{}.dcm", "../../{}.dcm", "a/b/c/{}", "\x1b[31m\n{}"])
def test_members_of_archives_are_never_unpacked_to_their_places(tmp_path, name):
    STACK(tmp_path)
    with zipfile.ZipFile(tmp_path / "x.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for k, path in enumerate(sorted(tmp_path.glob("*.dcm"))):
            archive.write(path, name.format(k))
    before = sorted(tmp_path.rglob("*"))
    assert read_volume(tmp_path / "x.zip").array.tobytes() == read_volume(tmp_path).array.tobytes()
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", ["x.zip", "x.nii.zip"])
def test_archives_without_dicom_and_damaged_ones_are_refused(tmp_path, name):
    with zipfile.ZipFile(tmp_path / name, "w") as archive:
        archive.writestr("x.nii", bytes(400))
        archive.writestr("y.zip", b"PK\3\4" + bytes(40))
    words = r"no image: x\.nii \(no DICOM\), y\.zip \(zip archive; unpack it first\)"
    with pytest.raises(FormatError, match=words):
        read_volume(tmp_path / name)
    (tmp_path / name).write_bytes((tmp_path / name).read_bytes()[:-60])
    with pytest.raises(FormatError, match="expected a sound zip archive"):
        read_volume(tmp_path / name)


@needs_posix
def test_links_to_folders_are_followed_once(tmp_path):
    for name in ("real", "given"):
        (tmp_path / name).mkdir()
    STACK(tmp_path / "real")
    (tmp_path / "given" / "there").symlink_to(tmp_path / "real")
    (tmp_path / "given" / "again").symlink_to(tmp_path / "real")
    (tmp_path / "given" / "round").symlink_to(tmp_path / "given")
    (tmp_path / "given" / "nowhere").symlink_to(tmp_path / "missing")
    os.mkfifo(tmp_path / "real" / "pipe")
    assert read_volume(tmp_path / "given").size[2] == len(PLAIN_STACK)


def test_gaps_too_wide_are_not_said_to_be_mended(tmp_path):
    STACK(tmp_path)
    for k in range(3, 23):
        (tmp_path / f"IM{k:04}.dcm").unlink()
    with pytest.raises(FormatError, match="20 missing slices") as caught:
        read_volume(tmp_path, fill_gaps=True)
    assert caught.value.mend == "add the missing files"


@needs_posix
def test_names_of_files_are_told_on_one_printable_line(tmp_path):
    long = "1.2.840.113619." * 5
    Stack(PLAIN_STACK, name=lambda k: f"{long}\x1b[31m\n{k:02}.dcm")(tmp_path)
    sorted(tmp_path.iterdir())[5].unlink()
    found = CliRunner().invoke(main, ["info", str(tmp_path)])
    assert f"between {long}�[31m�04.dcm and {long}�[31m�06.dcm" in found.stderr
    (tmp_path / "ready\x1b[31m").mkdir()
    found = CliRunner().invoke(main, ["info", str(tmp_path / "ready\x1b[31m")])
    assert found.stderr.count("\n") == 1
    assert "\x1b" not in found.stderr


def test_a_directory_record_is_sent_to_its_folder(tmp_path):
    data = pydicom.dcmread(STACK(tmp_path).path / "IM0001.dcm")
    for keyword in ("PixelData", "Rows", "Columns"):
        delattr(data, keyword)
    data.file_meta.MediaStorageSOPClassUID = data.SOPClassUID = "1.2.840.10008.1.3.10"
    data.save_as(tmp_path / "DICOMDIR")
    with pytest.raises(FormatError, match="give the folder that it is in"):
        read_volume(tmp_path / "DICOMDIR")


def test_one_of_three_series_lacks_a_slice(tmp_path, caplog):
    for number in (3, 4, 5):
        (tmp_path / str(number)).mkdir()
        Stack(PLAIN_STACK, series=number)(tmp_path / str(number))
    (tmp_path / "4" / "IM0010.dcm").unlink()
    with pytest.raises(SeriesError) as caught:
        read_volume(tmp_path)
    assert [one.trouble for one in caught.value.series] == ["", "1 missing slice", ""]
    caplog.set_level(logging.WARNING, "lumencut")
    volume = read_volume(tmp_path, series=4, fill_gaps=True)
    assert volume.filled_slices == (9,)
    assert "1 missing slice interpolated: k = 9" in caplog.text
