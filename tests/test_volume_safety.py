"""Untrusted files: none may name files elsewhere, reserve memory, or put text into messages."""

from __future__ import annotations

import bz2
import gzip
import logging
import traceback
import tracemalloc
import warnings
from pathlib import Path

import nibabel
import numpy as np
import pytest

from lumencut.base.foreign_errors import impersonal, refusing
from lumencut.errors import FileError, FormatError, LumencutError
from lumencut.files.volumes import inspect_volume, read_volume
from test_volume_files import save_meta, save_nifti
from test_volume_variants import RAW, save_by_hand
from volume_samples import assert_maps, coded, oblique

NAME = "Erika-Mustermann"
ENCODINGS = {"raw": "raw", "zlib": "gzip", "bzip2": "bzip2"}
NAMES = {"u1": "uint8", "i8": "int64"}


def read_voxels(path, shape, dtype, *, codec="raw", skip=0, encoding=None):
    """The voxels of a file, by the header of an NRRD beside it."""
    sizes = [*reversed(shape), 1, 1][:3] if len(shape) < 3 else shape[::-1]
    lines = [
        "NRRD0004",
        f"type: {NAMES[dtype.str[1:]]}",
        f"dimension: {len(sizes)}",
        "sizes: " + " ".join(map(str, sizes)),
        "endian: little",
        f"encoding: {encoding or ENCODINGS[codec]}",
        f"byte skip: {skip}",
        f"data file: {path.name}",
    ]
    header = path.with_name("header.nhdr")
    header.write_text("\n".join(lines) + "\n")
    return read_volume(header).array.reshape(shape)


def read_numbers(path, shape, dtype):
    """The voxels of a text."""
    return read_voxels(path, shape, dtype, encoding="ascii")


def detached(folder, kind, name):
    """Write a header that says its voxels are in another file."""
    if kind == "mhd":
        return save_meta(folder / "x.mhd", coded(), np.eye(4), b"", ElementDataFile=name)
    return save_by_hand(folder / "x.nhdr", b"", lines=f"data file: {name}\n")


@pytest.fixture
def folder(tmp_path):
    """A folder with untrusted files, and next to it a file of the user."""
    (tmp_path / "given" / "sub").mkdir(parents=True)
    (tmp_path / "private.raw").write_bytes(RAW)
    (tmp_path / "given" / "sub" / "x.raw").write_bytes(RAW)
    return tmp_path / "given"


OUTSIDE = [
    "../private.raw",
    "sub/../../private.raw",
    "sub/../x.raw",
    "..\\private.raw",
    "/etc/passwd",
    "\\windows\\x.raw",
    "C:\\x.raw",
    "C:x.raw",
    "\\\\server\\share\\x.raw",
    "//server/share/x.raw",
    "~/x.raw",
    "..",
    "/",
]


@pytest.mark.parametrize("kind", ["mhd", "nhdr"])
@pytest.mark.parametrize("name", OUTSIDE)
def test_paths_out_of_the_folder_are_refused(folder, kind, name):
    text = r"a path that leaves the folder \(.*expected a file in the folder of the header.*; copy it there"
    for read in (read_volume, lambda path: inspect_volume(path, values=False)):
        with pytest.raises(FormatError, match=text):
            read(detached(folder, kind, name))


@pytest.mark.parametrize("kind", ["mhd", "nhdr"])
def test_absolute_path_to_a_file_of_the_folder_is_refused(folder, kind):
    with pytest.raises(FormatError, match="leaves the folder"):
        read_volume(detached(folder, kind, str(folder / "sub" / "x.raw")))


@pytest.mark.parametrize("kind", ["mhd", "nhdr"])
def test_links_out_of_the_folder_are_refused(folder, kind):
    (folder / "x.raw").symlink_to(folder.parent / "private.raw")
    (folder / "way").symlink_to(folder.parent)
    (folder / "in.raw").symlink_to(folder / "sub" / "x.raw")
    for name in ("x.raw", "way/private.raw"):
        with pytest.raises(FormatError, match="leaves the folder"):
            read_volume(detached(folder, kind, name))
    assert_maps(read_volume(detached(folder, kind, "in.raw")), np.eye(4))


@pytest.mark.parametrize("kind", ["mhd", "nhdr"])
@pytest.mark.parametrize("name", ["sub/x.raw", "./sub/x.raw", "sub\\x.raw", "sub//x.raw"])
def test_folders_below_are_read(folder, kind, name, monkeypatch):
    path = detached(folder, kind, name)
    assert_maps(read_volume(path), np.eye(4))
    monkeypatch.chdir(folder)
    assert_maps(read_volume(path.name), np.eye(4))
    (folder.parent / "way").symlink_to(folder)
    assert_maps(read_volume(folder.parent / "way" / path.name), np.eye(4))


@pytest.mark.parametrize("kind", ["mhd", "nhdr"])
def test_names_that_are_no_voxels(folder, kind):
    for name in ("sub", "missing.raw", "x.raw/more"):
        with pytest.raises(FileError):
            read_volume(detached(folder, kind, name))
    with pytest.raises(LumencutError):
        read_volume(detached(folder, kind, "a\0b"))


def test_a_pair_may_be_links_of_the_user(folder):
    save_nifti(folder.parent / "x.hdr", coded(), oblique(), nibabel.Nifti1Pair)
    for end in ("hdr", "img"):
        (folder / f"x.{end}").symlink_to(folder.parent / f"x.{end}")
    assert_maps(read_volume(folder / "x.hdr"), oblique())
    assert_maps(read_volume(folder / "x.img"), oblique())


BOMBS = {
    "zeros in gzip, too few": ("zlib", gzip.compress(bytes(20 << 20)), (1 << 10, 1 << 10, 1 << 10)),
    "zeros in bzip2, too few": ("bzip2", bz2.compress(bytes(20 << 20)), (1 << 10, 1 << 10, 1 << 10)),
    "no machine holds": ("bzip2", bz2.compress(bytes(20 << 20)), (1 << 20, 1 << 20, 1 << 20)),
    "empty parts of gzip": ("zlib", gzip.compress(b"") * 50_000, (10, 10, 10)),
    "empty parts of bzip2": ("bzip2", bz2.compress(b"") * 50_000, (10, 10, 10)),
    "small parts of gzip": ("zlib", gzip.compress(b"a") * 20_000, (100, 100, 10)),
    "small parts of bzip2": ("bzip2", bz2.compress(b"a") * 5_000, (100, 100, 10)),
}


@pytest.mark.parametrize(("codec", "data", "shape"), BOMBS.values(), ids=BOMBS)
def test_bombs_are_refused_in_little_memory(tmp_path, codec, data, shape):
    path = tmp_path / "x"
    path.write_bytes(data)
    tracemalloc.start()
    words = r"bytes of voxels.* as the header says|GB of memory; expected at most the available "
    with pytest.raises(FormatError, match=words):
        read_voxels(path, shape, np.dtype("u1"), codec=codec)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4 << 20


@pytest.mark.parametrize(("codec", "pack"), [("zlib", gzip.compress), ("bzip2", bz2.compress)])
def test_of_a_bomb_only_what_the_header_says_is_taken(tmp_path, codec, pack):
    path = tmp_path / "x"
    path.write_bytes(pack(bytes(20 << 20)))
    for skip, count, limit in (
        (0, 1000, 1 << 20),
        ((20 << 20) - 1000, 1000, 4 << 20),
        (0, 20 << 20, 24 << 20),
    ):
        tracemalloc.start()
        assert not read_voxels(path, (count,), np.dtype("u1"), codec=codec, skip=skip).any()
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < limit
    with pytest.raises(FormatError, match="bytes of voxels"):
        read_voxels(path, (1001,), np.dtype("u1"), codec=codec, skip=(20 << 20) - 1000)


@pytest.mark.parametrize(("codec", "pack"), [("zlib", gzip.compress), ("bzip2", bz2.compress)])
def test_ends_of_compressed_streams(tmp_path, codec, pack):
    random = np.random.default_rng(3).integers(0, 256, 70_000, np.uint8).tobytes()
    path, whole = tmp_path / "x", pack(random)

    def read(data, count=70_000):
        path.write_bytes(data)
        return read_voxels(path, (count,), np.dtype("u1"), codec=codec).tobytes()

    assert read(whole) == random
    assert read(whole + b"anything") == random
    assert read(whole + whole, 140_000) == random * 2
    assert read(whole, 69_999) == random[:-1]
    for cut in (1, 2, 5, 9):
        with pytest.raises(FormatError, match=r"breaks off|bytes of voxels"):
            read(whole[:-cut])
    with pytest.raises(FormatError, match="damaged"):
        read(whole[:-6] + bytes(6))
    for count in (70_000, 69_999, 60_000):
        with pytest.raises(FormatError, match=r"breaks off|bytes of voxels"):
            read(whole[:-1], count)


def test_text_takes_no_more_memory_than_its_file(tmp_path):
    path = tmp_path / "x"
    path.write_bytes(b"1 " * 1_000_000)
    tracemalloc.start()
    assert read_numbers(path, (1_000_000,), np.dtype("i8")).all()
    with pytest.raises(FormatError, match="1000000 numbers; expected 60"):
        read_numbers(path, (60,), np.dtype("i8"))
    with pytest.raises(FormatError, match="as the header says"):
        read_numbers(path, (10**15,), np.dtype("i8"))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10 * path.stat().st_size


def texts_of(path, caplog, capfd):
    """Return all texts that describe a file to the user."""
    found = [*capfd.readouterr()]
    try:
        found += inspect_volume(path).notes
        read_volume(path)
    except LumencutError as error:
        found += traceback.format_exception(error)
    return " ".join([*found, *(record.getMessage() for record in caplog.records), *capfd.readouterr()])


NIFTI_TEXTS = {"descrip": NAME, "aux_file": NAME, "db_name": NAME, "intent_name": NAME, "data_type": NAME[:9]}


@pytest.mark.parametrize(
    "fields", [{}, {"datatype": 77}, {"vox_offset": 3}, {"qform_code": 9}, {"sform_code": 0}]
)
def test_texts_of_a_nifti_file_are_not_told(tmp_path, fields, caplog, capfd):
    stated = NIFTI_TEXTS | fields
    path = save_nifti(tmp_path / "x.nii", coded(), oblique(), **stated)
    assert NAME[:9] not in texts_of(path, caplog, capfd)


@pytest.mark.parametrize(
    "lines",
    [
        f"PatientName:={NAME}\nPatientName:={NAME}\n",
        f"content: {NAME}\ncontent: {NAME}\n",
        f'labels: "{NAME}\n# {NAME}\n',
        f"space origin: ({NAME},0,0)\n",
        f"line skip: {NAME}\n",
        f"{NAME}\n",
        f"old min: {NAME}\nunits: {NAME} {NAME}\n",
    ],
)
def test_texts_of_a_nrrd_file_are_not_told(tmp_path, lines, caplog, capfd):
    path = save_by_hand(tmp_path / "x.nrrd", lines=lines)
    assert NAME not in texts_of(path, caplog, capfd)


@pytest.mark.parametrize(
    "fields", [{}, {"DimSize": "4 3 500"}, {"CompressedData": True}, {"BinaryData": False}]
)
def test_texts_of_a_metaimage_are_not_told(tmp_path, fields, caplog, capfd):
    stated = {"Comment": NAME, "Name": NAME, "PatientName": NAME, "Modality": NAME} | fields
    path = save_meta(tmp_path / "x.mha", coded(), oblique(), **stated)
    assert NAME not in texts_of(path, caplog, capfd)


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (
            ValueError(f"could not convert string to float: '{NAME}'"),
            "could not convert string to float (ValueError)",
        ),
        (KeyError(NAME), "damaged or unknown content (KeyError)"),
        (ValueError(f"invalid value {NAME!r} for the patient"), "damaged or unknown content (ValueError)"),
        (ValueError(f"the name of the patient is ({NAME})"), "the name of the patient is (ValueError)"),
        (ValueError("19470101 is no date"), "damaged or unknown content (ValueError)"),
        (
            UnicodeDecodeError("ascii", b"Erika\xff", 0, 1, "odd"),
            "damaged or unknown content (UnicodeDecodeError)",
        ),
    ],
)
def test_foreign_errors_and_warnings_are_cut_before_values(error, text):
    assert impersonal(error) == text
    notes = []
    with pytest.raises(FormatError) as caught, refusing(Path("x.dcm"), "DICOM", notes):
        raise error
    assert str(caught.value) == f"x.dcm: found {text}; expected a sound DICOM file"
    assert caught.value.__suppress_context__
    with refusing(Path("x.dcm"), "DICOM", notes):
        warnings.warn(str(error), stacklevel=1)
    assert len(notes) == 1
    assert NAME not in notes[0]


def test_the_log_of_pydicom_is_not_told_while_reading(caplog):
    log = logging.getLogger("pydicom")
    with refusing(Path("x.dcm"), "DICOM", []):
        log.warning(NAME)
    assert NAME not in caplog.text
    log.warning("of somebody else's reading")
    assert "somebody else" in caplog.text


@pytest.mark.parametrize("value", ["\x1b[31m\0\n", "ü\u202e" * 300])
def test_binary_values_are_not_told(tmp_path, value):
    for fields in ({"ElementType": value}, {"DimSize": value}, {"ElementNumberOfChannels": value}):
        path = save_meta(tmp_path / "x.mha", coded(), oblique(), **fields)
        with pytest.raises(FormatError) as caught:
            read_volume(path)
        assert str(caught.value).removeprefix(str(tmp_path)).isprintable()
        assert len(str(caught.value)) < 400
