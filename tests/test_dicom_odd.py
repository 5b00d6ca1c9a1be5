"""DICOM from the wild: damaged attributes, archives and links, hostile folders, several readers at once."""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
import threading
import warnings
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pydicom
import pytest
from click.testing import CliRunner
from pydicom.datadict import tag_for_keyword
from pydicom.uid import JPEG2000Lossless, RLELossless

import lumencut
from dicom_codecs import gdcm_does, pydicom_does
from dicom_enhanced import enhanced
from dicom_phantom import axial, images, save
from dicom_series import PLAIN_STACK, Stack, sets
from lumencut.cli import main
from lumencut.errors import FormatError, SeriesError
from lumencut.volume_files import inspect_volume, list_series, read_volume
from lumencut.volume_files.opened import refusing

NAME = "DOE^JOHN"
STACK = Stack(PLAIN_STACK)
jpeg = gdcm_does("JPEGLosslessProcess14_1")


def spoil(path, keyword, vr, value):
    """Give an element of a file another type and any bytes."""
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
        (sets(PixelRepresentation=None), "no word on whether its values have a sign"),
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
    assert CliRunner().invoke(main, ["info", str(tmp_path)]).exit_code == 0


@pytest.mark.parametrize("name", ["/etc/{}.dcm", "../../{}.dcm", "a/b/c/{}", "\x1b[31m\n{}"])
def test_members_of_archives_are_never_unpacked_to_their_places(tmp_path, name):
    STACK(tmp_path)
    with zipfile.ZipFile(tmp_path / "x.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for k, path in enumerate(sorted(tmp_path.glob("*.dcm"))):
            archive.write(path, name.format(k))
    before = sorted(tmp_path.rglob("*"))
    assert read_volume(tmp_path / "x.zip").array.tobytes() == read_volume(tmp_path).array.tobytes()
    assert sorted(tmp_path.rglob("*")) == before


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


@pytest.mark.parametrize("encoder", [pydicom_does(JPEG2000Lossless), pydicom_does(RLELossless), jpeg])
@pytest.mark.parametrize("count", [20, 60])
def test_damaged_pixels_are_named_alike_and_leave_no_process(tmp_path, encoder, count):
    Stack(images(axial(), (64, 48, count)), encoder=encoder)(tmp_path)
    path = tmp_path / "IM0018.dcm"
    data = bytearray(path.read_bytes())
    start = data.rfind(b"\xe0\x7f\x10\x00") + 100
    data[start:-10] = np.random.default_rng(1).bytes(len(data) - 10 - start)
    path.write_bytes(data)
    with pytest.raises(FormatError, match=r"IM0018\.dcm: found .*pixels.*; copy the file again") as caught:
        read_volume(tmp_path)
    assert "object has no attribute" not in str(caught.value)
    children = Path(f"/proc/self/task/{threading.get_native_id()}/children")
    assert not children.exists() or "worker" not in "".join(map(_command, children.read_text().split()))


def _command(process):
    return Path(f"/proc/{process}/cmdline").read_text()


@pytest.mark.parametrize("codec", ["JPEGLSLossless", "JPEG2000Lossless"])
def test_empty_slices_may_be_packed_to_nearly_nothing(tmp_path, codec):
    empty = [replace(one, values=np.zeros((1024, 1024), np.int32)) for one in PLAIN_STACK[:3]]
    Stack(empty, encoder=gdcm_does(codec))(tmp_path)
    assert (tmp_path / "IM0001.dcm").stat().st_size < 2000
    assert not read_volume(tmp_path).array.any()


def test_what_progress_raises_is_the_callers(tmp_path):
    class StoppedError(Exception):
        pass

    def progress(done, total):
        if done == 3:
            raise StoppedError

    Stack(PLAIN_STACK, encoder=jpeg)(tmp_path)
    with pytest.raises(StoppedError):
        read_volume(tmp_path, progress=progress)


def test_too_little_memory_is_no_damage():
    with pytest.raises(FormatError, match="more than the free memory holds"), refusing("x", "DICOM", []):
        np.empty(1 << 60, np.uint8)


def test_three_codecs_in_one_series(tmp_path):
    stack = images(axial(), (64, 48, 50))
    encoders = [pydicom_does(JPEG2000Lossless), lambda path: None, pydicom_does(RLELossless), jpeg]
    Stack(stack)(tmp_path)
    for k, path in enumerate(sorted(tmp_path.iterdir())):
        encoders[k % 4](path)
    np.testing.assert_array_equal(read_volume(tmp_path).array, np.stack([one.values for one in stack]))


def test_the_decoders_take_no_module_from_the_current_folder(tmp_path):
    (tmp_path / "scan").mkdir()
    Stack(PLAIN_STACK, encoder=jpeg)(tmp_path / "scan")
    for name in ("json", "numpy", "pydicom", "lumencut"):
        (tmp_path / f"{name}.py").write_text("open('was-here', 'w')")
    home = str(Path(lumencut.__file__).parents[1])
    code = f"import sys; sys.path[0] = {home!r}; import lumencut; print(lumencut.read_volume('scan').size)"
    run = [sys.executable, "-c", code]
    # The reader itself must not look there either, hence its own first entry is replaced above.
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["(64,", "48,", "24)"]
    assert not (tmp_path / "was-here").exists()


def test_readers_in_two_threads_leave_warnings_as_they_were():
    before = warnings.showwarning, list(warnings.filters)
    entered, left = threading.Barrier(2), threading.Event()
    found = {"a": [], "b": []}

    def reads(name):
        with refusing(Path(name), "DICOM", found[name]):
            entered.wait()
            warnings.warn(f"of the file {name}", stacklevel=1)
            if name == "b":
                left.wait()
        left.set()

    threads = [threading.Thread(target=reads, args=(name,)) for name in found]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (warnings.showwarning, list(warnings.filters)) == before
    assert found == {"a": ["of the file a"], "b": ["of the file b"]}


def test_warnings_of_others_pass_by_a_reader():
    notes = []
    entered, said = threading.Event(), threading.Event()

    def reads():
        with refusing(Path("x"), "DICOM", notes):
            warnings.warn("an old function of somebody", DeprecationWarning, stacklevel=1)
            entered.set()
            said.wait()

    thread = threading.Thread(target=reads)
    with warnings.catch_warnings(record=True) as told:
        thread.start()
        entered.wait()
        warnings.warn("said outside of readers", stacklevel=1)
        said.set()
        thread.join()
    assert [str(one.message) for one in told] == ["said outside of readers"]
    assert notes == []


def test_gaps_too_wide_are_not_said_to_be_mended(tmp_path):
    STACK(tmp_path)
    for k in range(3, 23):
        (tmp_path / f"IM{k:04}.dcm").unlink()
    with pytest.raises(FormatError, match="20 missing slices") as caught:
        read_volume(tmp_path, fill_gaps=True)
    assert caught.value.mend == "add the missing files"


def test_names_of_files_are_told_on_one_printable_line(tmp_path):
    long = "1.2.840.113619." * 5
    Stack(PLAIN_STACK, name=lambda k: f"{long}\x1b[31m\n{k:02}\udcdc.dcm")(tmp_path)
    sorted(tmp_path.iterdir())[5].unlink()
    found = CliRunner().invoke(main, ["info", str(tmp_path)])
    assert f"between {long}�[31m�04�.dcm and {long}�[31m�06�.dcm" in found.stderr
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
