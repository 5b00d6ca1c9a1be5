"""Memory of volume files: only the pixels are unpacked, and too large volumes are rejected before that."""

import gzip
import io
import json
import struct
import subprocess
import sys
import zipfile
import zlib
from functools import cache

import numpy as np
import pydicom
import pytest

from dicom_phantom import Image, save, single
from lumencut import Volume
from lumencut.base import memory as room
from lumencut.errors import FormatError
from lumencut.files.volume_writers import write_volume
from lumencut.files.volumes import read_volume
from test_volume_files import save_meta, save_nifti, save_nrrd

#: Zeros after the pixels (bytes); each MB is compressed to some kilobytes.
TRAILING = 100 << 20
SIZE = (20, 24, 10)

#: Prints of each file the sum of its volume or the error, and the increase of peak memory so far in MB.
PROBE = """
import json, resource, sys
import lumencut, numpy, nibabel, nrrd, pydicom, pydicom.pixels, lumencut.files.volumes
limit = int(sys.argv[1])
if limit:
    used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + limit, used + limit))
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for path in sys.argv[2:]:
    try:
        words = str(int(lumencut.read_volume(path).array.sum(dtype="i8")))
    except lumencut.LumencutError as error:
        words = str(error)
    print(json.dumps([words, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) >> 10]))
"""


def probed(*paths, limit=0):
    """Read files in a new process; return what it prints of each."""
    words = [sys.executable, "-c", PROBE, str(limit), *map(str, paths)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()[-len(paths) :]]


def values():
    return np.arange(np.prod(SIZE), dtype=np.int16).reshape(SIZE[::-1]) % 700


def slices():
    """Return each slice of a CT as the bytes of its file."""
    for k, plane in enumerate(values()):
        target = io.BytesIO()
        affine = np.eye(4)
        affine[2, 3] = k
        save(single(Image(plane, affine), k + 1), target)
        yield target.getvalue()


def deflated(content):
    """A DICOM file whose dataset is deflated."""
    data = pydicom.dcmread(io.BytesIO(content))
    data.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.1.99"
    target = io.BytesIO()
    save(data, target)
    return target.getvalue()


def inflated_with(content, more):
    """Return a deflated file with more zeros after its pixels."""
    start = 144 + struct.unpack("<I", content[140:144])[0]
    inside = zlib.decompress(content[start:], -zlib.MAX_WBITS)
    packer = zlib.compressobj(1, zlib.DEFLATED, -zlib.MAX_WBITS)
    packed = packer.compress(inside) + b"".join(packer.compress(bytes(1 << 20)) for _ in range(more >> 20))
    return content[:start] + packed + packer.flush()


def rle(content):
    """A DICOM file with compressed pixels."""
    data = pydicom.dcmread(io.BytesIO(content))
    data.compress(pydicom.uid.RLELossless, generate_instance_uid=False)
    target = io.BytesIO()
    save(data, target)
    return target.getvalue()


def archive_of(path, contents, more):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for number, content in enumerate(contents):
            archive.writestr(f"IM{number}", content + bytes(more if number == 4 else 0))
    return path


def folder_of(path, contents):
    path.mkdir()
    for number, content in enumerate(contents):
        (path / f"IM{number}").write_bytes(content)
    return path


def with_zeros(path):
    """Return a gzipped file with more zeros after its end."""
    content = gzip.decompress(path.read_bytes())
    path.write_bytes(gzip.compress(content + bytes(TRAILING), 1))
    return path


def _plain_zip(folder):
    return archive_of(folder / "x.zip", slices(), TRAILING)


def _compressed_zip(folder):
    return archive_of(folder / "x.zip", map(rle, slices()), TRAILING)


@cache
def _deflated():
    return [inflated_with(deflated(one), TRAILING if k == 4 else 0) for k, one in enumerate(slices())]


def _deflated_zip(folder):
    return archive_of(folder / "x.zip", _deflated(), 0)


def _deflated_folder(folder):
    return folder_of(folder / "x", _deflated())


def _nifti(folder):
    return with_zeros(save_nifti(folder / "x.nii.gz", values(), np.eye(4)))


def _nrrd(folder):
    packed = gzip.compress(values().tobytes() + bytes(TRAILING), 1)
    path = save_nrrd(folder / "x.nhdr", values(), np.eye(4), detached=True)
    next(folder.glob("*.raw.gz")).write_bytes(packed)
    return path


def _metaimage(folder):
    packed = zlib.compress(values().tobytes() + bytes(TRAILING), 1)
    return save_meta(folder / "x.mha", values(), np.eye(4), packed, CompressedData=True)


def _before(folder):
    """A slice with a large element before the pixels that nobody asks for."""
    data = pydicom.dcmread(io.BytesIO(next(slices())))
    data.add_new(0x00091001, "OB", bytes(TRAILING))
    target = io.BytesIO()
    save(data, target)
    (folder / "x.dcm").write_bytes(deflated(target.getvalue()))
    return folder / "x.dcm"


BEFORE = "element before the pixels"
PADDED = {
    "zip": _plain_zip,
    "zip of compressed pixels": _compressed_zip,
    "zip of deflated files": _deflated_zip,
    "deflated files": _deflated_folder,
    "nii.gz": _nifti,
    "nrrd": _nrrd,
    "mha": _metaimage,
    BEFORE: _before,
}


def test_what_surrounds_the_pixels_takes_no_memory(tmp_path):
    """Read in one process, so the last increase is the largest."""
    paths = []
    for number, make in enumerate(PADDED.values()):
        (tmp_path / str(number)).mkdir()
        paths.append(make(tmp_path / str(number)))
    whole, first = (str(int(one.sum(dtype=np.int64))) for one in (values(), values()[0]))
    for name, (words, grown) in zip(PADDED, probed(*paths), strict=True):
        assert words == (first if name == BEFORE else whole), name
        assert grown < 60, f"{name}: {grown} MB for a volume of 10 kB"


#: Voxels of 2.6 MB, more than is available below.
LARGE = np.zeros((20, 256, 256), np.int16)


def _large_slices():
    for k, plane in enumerate(LARGE):
        affine = np.eye(4)
        affine[2, 3] = k
        target = io.BytesIO()
        save(single(Image(plane, affine), k + 1), target)
        yield target.getvalue()


def _scaled(folder):
    """A NIfTI file of bytes, which fit into memory; its values are floats, which do not fit."""
    path = save_nifti(folder / "x.nii.gz", LARGE[:10].astype(np.uint8), np.eye(4))
    content = bytearray(gzip.decompress(path.read_bytes()))
    content[112:120] = struct.pack("<2f", 0.5, 1)
    path.write_bytes(gzip.compress(bytes(content), 1))
    return path


def _text(folder):
    """A slice of numbers as text, and those of the others; the nrrd package writes many numbers slowly."""
    path = save_nrrd(folder / "x.nrrd", LARGE[:1].astype("u1"), np.eye(4), encoding="ascii")
    content = path.read_bytes().replace(b"sizes: 256 256 1\n", b"sizes: 256 256 20\n")
    path.write_bytes(content + b"0\n" * LARGE[1:].size)
    return path


TOO_LARGE = {
    "nii": lambda folder: save_nifti(folder / "x.nii", LARGE, np.eye(4)),
    "nii.gz": lambda folder: save_nifti(folder / "x.nii.gz", LARGE, np.eye(4)),
    "scaled nii.gz": _scaled,
    "raw nrrd": lambda folder: save_nrrd(folder / "x.nrrd", LARGE, np.eye(4), encoding="raw"),
    "gzip nrrd": lambda folder: save_nrrd(folder / "x.nrrd", LARGE, np.eye(4)),
    "bzip2 nrrd": lambda folder: save_nrrd(folder / "x.nrrd", LARGE, np.eye(4), encoding="bzip2"),
    "text nrrd": _text,
    "mha": lambda folder: save_meta(folder / "x.mha", LARGE, np.eye(4)),
    "big-endian mha": lambda folder: save_meta(
        folder / "x.mha", LARGE.astype(">i2"), np.eye(4), BinaryDataByteOrderMSB=True
    ),
    "DICOM folder": lambda folder: folder_of(folder / "x", _large_slices()),
    "DICOM zip": lambda folder: archive_of(folder / "x.zip", _large_slices(), 0),
}


@pytest.mark.parametrize("make", TOO_LARGE.values(), ids=TOO_LARGE)
def test_more_than_the_available_memory_is_refused_before_it_is_taken(tmp_path, make, monkeypatch):
    path = make(tmp_path)
    monkeypatch.setattr(room, "_SMALL", 500_000)
    monkeypatch.setattr(room, "available_memory", lambda: 1_000_000)
    words = r"voxels that need [\d.]+ MB of memory; expected at most the available 1 MB; crop"
    with pytest.raises(FormatError, match=words) as caught:
        read_volume(path)
    assert caught.value.subject.startswith(str(path.with_suffix("")))
    monkeypatch.undo()
    assert read_volume(path).array.size >= 1 << 19


def test_a_limit_of_the_process_counts(tmp_path):
    path = write_large(tmp_path / "x.nii.gz")
    [(words, grown)] = probed(path, limit=150 << 20)
    assert "voxels that need 209.7 MB of memory; expected at most the available 1" in words
    assert grown < 60


def write_large(path):
    write_volume(Volume(np.zeros((100, 1024, 1024), np.int16)), path)
    return path


def test_fast_compression(tmp_path):
    for name in ("x.nrrd", "x.nii.gz"):
        write_volume(Volume(values()), tmp_path / name)
        content = (tmp_path / name).read_bytes()
        start = content.index(b"\x1f\x8b\x08")
        # The byte of a gzip header that states the fastest level (RFC 1952, XFL).
        assert content[start + 8] == 4
        np.testing.assert_array_equal(read_volume(tmp_path / name).array, values())


def test_the_limits_of_control_groups_are_read(tmp_path, monkeypatch):
    """For both versions, on every level above the process; reclaimable files count as free."""
    inner = tmp_path / "job" / "task"
    inner.mkdir(parents=True)
    (tmp_path / "job" / "memory.max").write_text("5000000\n")
    (tmp_path / "job" / "memory.current").write_text("3000000\n")
    (tmp_path / "job" / "memory.stat").write_text("anon 2000000\ninactive_file 1000000\n")
    (inner / "memory.max").write_text("max\n")
    assert list(room._left(tmp_path, "/job/task", "memory.max", "memory.current")) == [3_000_000]
    assert 0 < room.available_memory() < room._UNKNOWN
    monkeypatch.setattr(room, "_of_control_groups", lambda: iter([-5]))
    assert room.available_memory() == 0
