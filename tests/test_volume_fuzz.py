"""Damaged volume files: a volume or a LumencutError, no other exception, no memory that a header invents."""

from __future__ import annotations

import gzip
import tracemalloc

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lumencut.errors import FormatError, LumencutError
from lumencut.volume import Volume
from lumencut.volume_files import inspect_volume, read_volume
from test_dicom import transcode
from test_volume_files import save_meta, save_nifti, save_nrrd
from volume_samples import coded, oblique, save, slice_of

LIMIT = 64 << 20
WRITERS = {
    "x.nii": lambda path: save_nifti(path, coded(), oblique()),
    "x.nii.gz": lambda path: save_nifti(path, coded(), oblique()),
    "raw.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="raw"),
    "gzip.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="gzip"),
    "bzip2.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="bzip2"),
    "ascii.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="ascii"),
    "raw.mha": lambda path: save_meta(path, coded(), oblique()),
    "x.dcm": lambda path: save(slice_of(coded(), oblique(), 0), path),
}


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """The bytes of one sound file per kind."""
    folder = tmp_path_factory.mktemp("sound")
    return {name: write(folder / name).read_bytes() for name, write in WRITERS.items()}


def volume_or_refusal(path):
    """Read a file in every way, watching the memory."""
    tracemalloc.start()
    try:
        report = inspect_volume(path)
        volume = read_volume(path)
        assert isinstance(volume, Volume)
        assert volume.size == report.size
        assert np.isfinite(volume.corners).all()
    except LumencutError:
        return
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < LIMIT


@pytest.mark.parametrize("name", WRITERS)
def test_every_truncation(tmp_path, sound, name):
    whole, path = sound[name], tmp_path / name
    step = max(len(whole) // 150, 1)
    for length in range(0, len(whole), step):
        path.write_bytes(whole[:length])
        volume_or_refusal(path)
    path.write_bytes(whole[:-4])
    with pytest.raises(FormatError, match=name):
        read_volume(path)


edits = st.lists(st.tuples(st.floats(0, 1), st.integers(0, 255)), min_size=1, max_size=8)
FUZZ = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.mark.parametrize("name", WRITERS)
@FUZZ
@given(edits=edits)
def test_changed_bytes(tmp_path, sound, name, edits):
    data = bytearray(sound[name])
    for place, value in edits:
        data[min(int(place * len(data)), len(data) - 1)] = value
    path = tmp_path / name
    path.write_bytes(data)
    volume_or_refusal(path)


@pytest.mark.parametrize("name", ["x.nii", "raw.nrrd", "raw.mha", "x.dcm"])
@FUZZ
@given(
    place=st.integers(0, 700),
    patch=st.binary(min_size=1, max_size=12) | st.integers(0, 10**12).map(b"%d".__mod__),
)
def test_overwritten_header(tmp_path, sound, name, place, patch):
    data = bytearray(sound[name])
    data[place : place + len(patch)] = patch
    path = tmp_path / name
    path.write_bytes(data)
    volume_or_refusal(path)


@FUZZ
@given(
    data=st.binary(max_size=800),
    prefix=st.sampled_from([b"", b"NRRD0004\n", b"\x5c\x01\0\0", bytes(128) + b"DICM"]),
)
def test_any_bytes(tmp_path, data, prefix):
    for name in ("x", "x.mha", "x.nii", "x.nii.gz"):
        path = tmp_path / name
        path.write_bytes(prefix + data)
        volume_or_refusal(path)


@pytest.mark.parametrize("shape", [(32767, 32767, 32767), (4, 3, 30000)])
@pytest.mark.parametrize("name", ["x.nii", "x.nii.gz"])
def test_nifti_that_lies_about_its_size(tmp_path, name, shape):
    path = save_nifti(tmp_path / "x.nii", coded(), oblique(), dim=[[3, *shape, 1, 1, 1, 1]])
    if name.endswith("gz"):
        (tmp_path / name).write_bytes(gzip.compress(path.read_bytes()))
    with pytest.raises(FormatError, match="bytes of voxels"):
        read_volume(tmp_path / name)
    volume_or_refusal(tmp_path / name)


def test_nrrd_and_dicom_that_lie_about_their_size(tmp_path, sound):
    path = tmp_path / "x.nrrd"
    for kind in ("raw.nrrd", "gzip.nrrd", "bzip2.nrrd", "ascii.nrrd"):
        path.write_bytes(sound[kind].replace(b"sizes: 4 3 5", b"sizes: 40000 30000 50000"))
        with pytest.raises(FormatError, match=r"as the header says"):
            read_volume(path)
        volume_or_refusal(path)
    path = save(slice_of(coded(), oblique(), 0, Rows=65535, Columns=65535), tmp_path / "x.dcm")
    with pytest.raises(FormatError, match="65535 × 65535 pixels as the header says"):
        read_volume(path)


@pytest.fixture(scope="module")
def compressed(tmp_path_factory):
    """The bytes of one sound compressed slice per codec."""
    folder, array = tmp_path_factory.mktemp("compressed"), coded((20, 24, 1), np.uint16)
    result = {}
    for syntax in ("RLELossless", "JPEG2000Lossless", "JPEGLosslessProcess14_1", "JPEGLSLossless"):
        path = save(slice_of(array, oblique(), 0), folder / f"{syntax}.dcm")
        transcode(path, syntax)
        result[syntax] = path.read_bytes()
    return result


def damage(data, seed):
    """Change a few bytes of the pixels."""
    random, start = np.random.default_rng(seed), data.index(b"\xe0\x7f\x10\x00") + 8
    changed = bytearray(data)
    for place in random.integers(start, min(start + 150, len(data)), random.integers(1, 7)):
        changed[place] = random.choice([0, 1, 127, 128, 255])
    return changed


@pytest.mark.parametrize(
    ("syntax", "count"),
    [
        ("RLELossless", 100),
        ("JPEG2000Lossless", 100),
        ("JPEGLosslessProcess14_1", 12),
        ("JPEGLSLossless", 12),
    ],
)
def test_damaged_compressed_pixels(tmp_path, compressed, syntax, count):
    path = tmp_path / "x.dcm"
    for seed in range(count):
        path.write_bytes(damage(compressed[syntax], seed))
        volume_or_refusal(path)


def test_codestream_that_lies_about_its_size(tmp_path, compressed):
    data = bytearray(compressed["JPEG2000Lossless"])
    start = data.index(b"\xff\x4f\xff\x51") + 8
    data[start : start + 8] = (30000).to_bytes(4, "big") * 2
    path = tmp_path / "x.dcm"
    path.write_bytes(data)
    with pytest.raises(FormatError, match=r"x\.dcm: found a codestream of 30000 × 30000 pixels"):
        read_volume(path)
