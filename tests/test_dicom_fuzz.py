"""Odd DICOM files: for any attribute values and damage, the result is a volume or an error with a reason.

LUMENCUT_FUZZ_EXAMPLES=100 makes each test try a hundred times as many inputs.
"""

from __future__ import annotations

import struct
import zipfile

import numpy as np
import pydicom
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dicom_cases import CASES
from test_volume_fuzz import FUZZ, put, volume_or_refusal
from volume_samples import coded, oblique, save, slice_of

BY_NAME = {case.name: case for case in CASES}
ATTRIBUTES = (
    "Rows", "Columns", "NumberOfFrames", "SamplesPerPixel", "PhotometricInterpretation", "BitsAllocated",
    "BitsStored", "PixelRepresentation", "RescaleSlope", "RescaleIntercept", "PixelSpacing", "SliceThickness",
    "ImagePositionPatient", "ImageOrientationPatient", "SeriesInstanceUID", "SeriesNumber", "Modality",
    "ImageType", "SOPClassUID", "TriggerTime", "GantryDetectorTilt",
)  # fmt: skip
NUMBERS = st.sampled_from(
    ["0", "-1", "1e300", "-1e300", "nan", "inf", "65535", "0.1", "", "1e-300", "x", "3"]
)
EDITS = st.lists(st.tuples(st.floats(0, 1), st.integers(0, 255)), min_size=1, max_size=8)
TEXTS = st.sampled_from(
    ["", "LOCALIZER", "RGB", "MONOCHROME1", "1.2.840.10008.5.1.4.1.1.2.1", "7" * 80, "Doe^J"]
)


@pytest.fixture(scope="module")
def enhanced(tmp_path_factory):
    """The bytes of a valid enhanced multi-frame image."""
    folder = tmp_path_factory.mktemp("enhanced")
    BY_NAME["enhanced"].write(folder)
    (path,) = (path for path in folder.rglob("*") if path.is_file())
    return path.read_bytes()


def zipped(path, names):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for k, name in enumerate(names):
            data = save(slice_of(coded(), oblique(), k), path.parent / "slice").read_bytes()
            archive.writestr(name, data)
    (path.parent / "slice").unlink()
    return path.read_bytes()


def edited(data, changes):
    data = bytearray(data)
    for place, value in changes:
        data[min(int(place * len(data)), len(data) - 1)] = value
    return bytes(data)


@FUZZ
@given(changes=EDITS, header=st.floats(0.01, 1))
def test_changed_bytes_of_frames(tmp_path, enhanced, changes, header):
    """Mostly changes in the header, which contains the functional groups."""
    changes = [(place * header, value) for place, value in changes]
    volume_or_refusal(put(tmp_path, {"x.dcm": edited(enhanced, changes)}), needed=64 << 20)


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    """The bytes of a valid archive."""
    return zipped(tmp_path_factory.mktemp("zip") / "x.zip", ["a/1", "a/2", "../3"])


@FUZZ
@given(changes=EDITS)
def test_changed_bytes_of_an_archive(tmp_path, archive, changes):
    volume_or_refusal(put(tmp_path, {"x.zip": edited(archive, changes)}))


def spliced(data, keyword, text):
    """Return a file (explicit, little-endian) with one attribute replaced by another text, or removed."""
    tag = pydicom.datadict.tag_for_keyword(keyword)
    vr = pydicom.datadict.dictionary_VR(tag).split(" or ")[0].encode()
    start = data.find(struct.pack("<HH", tag >> 16, tag & 0xFFFF) + vr)
    if start < 0:
        return data
    length = struct.unpack("<H", data[start + 6 : start + 8])[0]
    value = b"" if text is None else text.encode().ljust(len(text) + len(text) % 2)
    if vr == b"US" and text:
        value = (len(text) * b"\1\0")[:4]
    element = b"" if text is None else data[start : start + 6] + struct.pack("<H", len(value)) + value
    return data[:start] + element + data[start + 8 + length :]


@FUZZ
@given(
    changes=st.lists(
        st.tuples(st.integers(0, 3), st.sampled_from(ATTRIBUTES), st.none() | NUMBERS | TEXTS),
        min_size=1,
        max_size=4,
    )
)
def test_odd_attributes_of_a_stack(tmp_path, changes):
    slices = [save(slice_of(coded((4, 3, 4)), np.eye(4), k), tmp_path / f"{k}.dcm") for k in range(4)]
    for k, keyword, text in changes:
        slices[k].write_bytes(spliced(slices[k].read_bytes(), keyword, text))
    volume_or_refusal(slices[0])
    volume_or_refusal(tmp_path)
