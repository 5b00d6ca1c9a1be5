"""Damaged volume files: a volume or a LumencutError, no other exception, no memory only because of a header.

LUMENCUT_FUZZ_EXAMPLES=100 makes each test try a hundred times as many inputs; `make test-long` tries ten
times as many. With -s figures are printed.
"""

from __future__ import annotations

import bz2
import faulthandler
import gzip
import os
import sys
import time
import tracemalloc
import zlib

import nibabel
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from dicom_codecs import gdcm_does
from lumencut.errors import FormatError, LumencutError
from lumencut.files.volumes import inspect_volume, read_volume
from lumencut.scene.volume import Volume
from test_volume_files import LPS_FROM_RAS, save_meta, save_nifti, save_nrrd
from volume_samples import coded, oblique, save, slice_of

SCALE = int(os.environ.get("LUMENCUT_FUZZ_EXAMPLES", "1"))
MEMORY = 10
"""Memory per byte of a file of 1 MiB or more; smaller ones may use as much as that one."""
HANG = 120
FUZZ = settings(
    max_examples=20 * SCALE,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    **({"database": None} if SCALE > 1 else {}),
)


def save_big_endian(path):
    header = nibabel.Nifti1Header(endianness=">")
    header.set_data_dtype(">i2")
    nibabel.save(nibabel.Nifti1Image(coded().T, LPS_FROM_RAS @ oblique(), header), path)
    return path


def save_meta_pair(path, zipped):
    data = coded().tobytes()
    (path.parent / "x.bin").write_bytes(zlib.compress(data) if zipped else data)
    return save_meta(path, coded(), oblique(), b"", ElementDataFile="x.bin", CompressedData=zipped)


WRITERS = {
    "x.nii": lambda path: save_nifti(path, coded(), oblique()),
    "x.nii.gz": lambda path: save_nifti(path, coded(), oblique()),
    "big.nii": save_big_endian,
    "two.nii": lambda path: save_nifti(path, coded(), oblique(), nibabel.Nifti2Image),
    "pair.hdr": lambda path: save_nifti(path, coded(), oblique(), nibabel.Nifti1Pair),
    "pair2.hdr": lambda path: save_nifti(path, coded(), oblique(), nibabel.Nifti2Pair),
    "raw.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="raw"),
    "big.nrrd": lambda path: save_nrrd(path, coded(dtype=">i2"), oblique(), encoding="raw"),
    "gzip.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="gzip"),
    "bzip2.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="bzip2"),
    "ascii.nrrd": lambda path: save_nrrd(path, coded(), oblique(), encoding="ascii"),
    "raw.nhdr": lambda path: save_nrrd(path, coded(), oblique(), True, encoding="raw"),
    "gzip.nhdr": lambda path: save_nrrd(path, coded(), oblique(), True, encoding="gzip"),
    "raw.mha": lambda path: save_meta(path, coded(), oblique()),
    "zip.mha": lambda path: save_meta(
        path, coded(), oblique(), zlib.compress(coded().tobytes()), CompressedData=True
    ),
    "raw.mhd": lambda path: save_meta_pair(path, zipped=False),
    "zip.mhd": lambda path: save_meta_pair(path, zipped=True),
    "x.dcm": lambda path: save(slice_of(coded(), oblique(), 0), path),
}


class Tally:
    """Counts and times of the run."""

    inputs = volumes = peak = 0
    slowest = (0.0, "")


@pytest.fixture(scope="module", autouse=True)
def figures():
    """Print the counts at the end of the run."""
    yield
    sys.stdout.write(
        f"\n{Tally.inputs} inputs, {Tally.volumes} volumes, slowest {Tally.slowest[0]:.3f} s "
        f"({Tally.slowest[1]}), highest peak {Tally.peak / 2**20:.1f} MiB\n"
    )


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """The bytes of one valid volume per kind, by file name, the file to open first."""
    result = {}
    for name, write in WRITERS.items():
        folder = tmp_path_factory.mktemp("sound")
        # Imports everything that the format needs, so that this memory is not counted.
        read_volume(write(folder / name))
        files = sorted(folder.iterdir(), key=lambda path: path.name != name)
        result[name] = {path.name: path.read_bytes() for path in files}
    return result


def put(folder, files):
    for name, data in files.items():
        (folder / name).write_bytes(data)
    return folder / next(iter(files))


def volume_or_refusal(path, needed=0):
    """Read a file in all ways with limits of memory and time; `needed` is the size of its voxels in bytes."""
    length = sum(file.stat().st_size for file in path.parent.iterdir() if file.is_file())
    tracemalloc.start()
    faulthandler.dump_traceback_later(HANG, exit=True, file=sys.__stderr__)
    begin, text = time.perf_counter(), ""
    try:
        report = inspect_volume(path)
        volume = read_volume(path)
        assert isinstance(volume, Volume)
        assert volume.size == report.size
        assert np.isfinite(volume.corners).all()
        Tally.volumes += 1
    except LumencutError as error:
        text = str(error)
    finally:
        faulthandler.cancel_dump_traceback_later()
        Tally.slowest = max(Tally.slowest, (time.perf_counter() - begin, path.name))
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    Tally.inputs += 1
    Tally.peak = max(Tally.peak, peak)
    assert peak <= needed + MEMORY * max(length, 1 << 20)
    assert text.isprintable()
    assert len(text) < 1000


@pytest.mark.parametrize("name", WRITERS)
def test_every_truncation(tmp_path, sound, name):
    for which, whole in sound[name].items():
        step = max(len(whole) // (15 * SCALE), 1)
        for length in range(0, len(whole), step):
            volume_or_refusal(put(tmp_path, sound[name] | {which: whole[:length]}))
    path = put(tmp_path, sound[name] | {which: whole[:-4]})
    with pytest.raises(FormatError, match=which):
        read_volume(path)


WORDS = (
    b"0 -1 1 2 255 32767 -32768 65536 2147483647 2147483648 4294967296 1000000000000000000 nan inf -inf "
    b"1e308 1e-320 0.5 LIST %d ../x / (1,0,0) none hex gzip raw ascii bzip2 True"
)
NUMBERS = st.sampled_from([*WORDS.split(), b"9" * 40])
PATCHES = st.binary(min_size=1, max_size=12) | NUMBERS
PLACES = st.floats(0, 1) | st.integers(0, 700)
EDITS = st.lists(
    st.tuples(
        st.sampled_from(["set", "set", "insert", "delete", "word", "word", "twice", "cut"]), PLACES, PATCHES
    ),
    min_size=1,
    max_size=6,
)


def edited(data, edits):
    """Change a file: set, insert, remove or repeat bytes, replace a word, cut the end off."""
    data = bytearray(data)
    for kind, place, patch in edits:
        start = min(int(place * len(data)) if isinstance(place, float) else place, max(len(data) - 1, 0))
        if kind == "set":
            data[start : start + len(patch)] = patch
        elif kind == "insert":
            data[start:start] = patch
        elif kind == "delete":
            del data[start : start + len(patch)]
        elif kind == "twice":
            data[start:start] = data[start : start + 40]
        elif kind == "cut":
            del data[start + len(data) // 2 :]
        else:
            while start < len(data) and not data[start : start + 1].isspace():
                start += 1
            stop = start + 1
            while stop < len(data) and not data[stop : stop + 1].isspace():
                stop += 1
            data[start + 1 : stop] = patch
    return bytes(data)


@pytest.mark.parametrize("name", WRITERS)
@FUZZ
@given(edits=EDITS, which=st.integers(0, 1))
def test_changed_files(tmp_path, sound, name, edits, which):
    files = sound[name]
    changed = list(files)[which % len(files)]
    volume_or_refusal(put(tmp_path, files | {changed: edited(files[changed], edits)}))


@pytest.mark.parametrize("name", ["x.nii.gz", "gzip.nrrd", "zip.mha"])
@FUZZ
@given(edits=EDITS)
def test_changed_files_compressed_anew(tmp_path, sound, name, edits):
    """The damage is inside the compressed data; the checksum is valid."""
    if name == "x.nii.gz":
        data = gzip.compress(edited(gzip.decompress(sound[name][name]), edits), 1)
    else:
        start = sound[name][name].index(b"\n\n" if name == "gzip.nrrd" else b"LOCAL\n")
        start += 2 if name == "gzip.nrrd" else 6
        pack = gzip.compress if name == "gzip.nrrd" else zlib.compress
        data = sound[name][name][:start] + pack(edited(coded().tobytes(), edits), 1)
    volume_or_refusal(put(tmp_path, {name: data}))


@pytest.mark.parametrize("name", ["x.nii", "big.nii", "two.nii", "pair.hdr", "raw.nrrd", "raw.mha", "x.dcm"])
@FUZZ
@given(place=st.integers(0, 700), patch=PATCHES)
def test_overwritten_header(tmp_path, sound, name, place, patch):
    volume_or_refusal(put(tmp_path, sound[name] | {name: edited(sound[name][name], [("set", place, patch)])}))


@FUZZ
@given(
    data=st.binary(max_size=800),
    prefix=st.sampled_from(
        [b"", b"NRRD0004\n", b"\x5c\x01\0\0", b"\0\0\2\x1c", b"\x1f\x8b\x08", bytes(128) + b"DICM"]
    ),
)
def test_any_bytes(tmp_path, data, prefix):
    for name in ("x", "x.mha", "x.nii", "x.nii.gz"):
        volume_or_refusal(put(tmp_path, {name: prefix + data}))


@pytest.mark.parametrize("pack", [gzip.compress, bz2.compress, zlib.compress])
@FUZZ
@given(
    sizes=st.lists(st.sampled_from([1, 3, 10, 100, 128, 1000, 10**4, 10**6, 10**9]), min_size=3, max_size=3),
    held=st.sampled_from([0, 1, 1000, 10**5, 10**6, 4 * 10**6]),
    parts=st.sampled_from([1, 1, 2, 50]),
)
def test_claims_and_bombs(tmp_path, pack, sizes, held, parts):
    """A stream of zeros in a file that claims some size: no more memory than the real content."""
    encoding = "bzip2" if pack is bz2.compress else "gzip"
    head = (
        f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {' '.join(map(str, sizes))}\nencoding: {encoding}\n\n"
    )
    data = pack(bytes(held // parts)) * parts
    claimed = sizes[0] * sizes[1] * sizes[2]
    path = put(tmp_path, {"x.nrrd": head.encode() + data})
    volume_or_refusal(path, 2 * claimed if claimed <= held else 0)


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
        path.write_bytes(sound[kind][kind].replace(b"sizes: 4 3 5", b"sizes: 40000 30000 50000"))
        # A codec without its own limit is rejected because of the memory that it would need.
        with pytest.raises(FormatError, match=r"as the header says|voxels that need .* of memory"):
            read_volume(path)
        volume_or_refusal(path)
    path = save(slice_of(coded(), oblique(), 0, Rows=65535, Columns=65535), tmp_path / "x.dcm")
    with pytest.raises(FormatError, match="65535 × 65535 pixels as the header says"):
        read_volume(path)


@pytest.fixture(scope="module")
def compressed(tmp_path_factory):
    """The bytes of one valid compressed slice per codec."""
    folder, array = tmp_path_factory.mktemp("compressed"), coded((20, 24, 1), np.uint16)
    result = {}
    for syntax in ("RLELossless", "JPEG2000Lossless", "JPEGLosslessProcess14_1", "JPEGLSLossless"):
        path = save(slice_of(array, oblique(), 0), folder / f"{syntax}.dcm")
        gdcm_does(syntax)(path)
        result[syntax] = path.read_bytes()
    return result


def damage(data, seed):
    """Change some bytes of the pixels."""
    random, start = np.random.default_rng(seed), data.index(b"\xe0\x7f\x10\x00") + 8
    changed = bytearray(data)
    for place in random.integers(start, min(start + 150, len(data)), random.integers(1, 7)):
        changed[place] = random.choice([0, 1, 127, 128, 255])
    return changed


@pytest.mark.parametrize(
    ("syntax", "count"),
    [
        ("RLELossless", 20),
        ("JPEG2000Lossless", 20),
        ("JPEGLosslessProcess14_1", 4),
        ("JPEGLSLossless", 4),
    ],
)
def test_damaged_compressed_pixels(tmp_path, compressed, syntax, count):
    path = tmp_path / "x.dcm"
    for seed in range(count * min(SCALE, 10)):
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
