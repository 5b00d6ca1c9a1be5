"""Rare variants of NIfTI, NRRD and MetaImage: read as by SimpleITK and nibabel, or rejected with a reason."""

from __future__ import annotations

import bz2
import gzip
import logging
import lzma
import zlib

import nibabel
import numpy as np
import pytest
import SimpleITK

from lumencut.base.rescale import slabs
from lumencut.errors import FormatError
from lumencut.files.volumes import inspect_volume, read_volume
from test_volume_files import LPS_FROM_RAS, save_meta, save_nifti, save_nrrd
from volume_samples import SIZE, assert_maps, coded, oblique

RAW = coded(dtype="<i2").tobytes()


def sheared():
    affine = oblique()
    affine[:3, 2] += 0.3 * affine[:3, 1]
    return affine


def assert_as_simpleitk(path):
    """Check that SimpleITK reads the same voxels at the same positions."""
    image, volume = SimpleITK.ReadImage(str(path)), read_volume(path)
    np.testing.assert_array_equal(
        volume.array, SimpleITK.GetArrayFromImage(image).reshape(volume.array.shape)
    )
    for index in np.ndindex(volume.size):
        corner = [*index, *[0] * (image.GetDimension() - 3)]
        place = image.TransformIndexToPhysicalPoint(corner)[:3]
        np.testing.assert_allclose(volume.world_from_index @ [*index, 1.0], [*place, 1.0], atol=2e-4)


@pytest.mark.parametrize("kind", [nibabel.Nifti1Image, nibabel.Nifti2Image, nibabel.Nifti1Pair])
@pytest.mark.parametrize("order", ["<", ">"])
def test_byte_order_of_the_whole_nifti_file(tmp_path, kind, order):
    header = kind.header_class(endianness=order)
    header.set_data_dtype(np.dtype("i2").newbyteorder(order))
    header.set_xyzt_units("mm")
    path = tmp_path / ("x.hdr" if kind is nibabel.Nifti1Pair else "x.nii")
    nibabel.save(kind(coded().T, LPS_FROM_RAS @ oblique(), header), path)
    expected = (540 if kind is nibabel.Nifti2Image else 348).to_bytes(4, "little" if order == "<" else "big")
    assert path.read_bytes()[:4] == expected
    assert_maps(read_volume(path), oblique())
    if kind is not nibabel.Nifti2Image:  # SimpleITK reads no NIfTI-2.
        assert_as_simpleitk(path)


def test_sheared_sform_is_kept_exactly(tmp_path):
    path = save_nifti(tmp_path / "x.nii.gz", coded(), sheared())
    stored = LPS_FROM_RAS @ nibabel.load(path).affine
    np.testing.assert_array_equal(read_volume(path).world_from_index, stored)
    assert_maps(read_volume(path), sheared())


def test_gzip_of_several_parts_and_with_a_tail(tmp_path):
    plain = save_nifti(tmp_path / "x.nii", coded(), oblique()).read_bytes()
    path = tmp_path / "x.nii.gz"
    for size in (1, 7, 100, 352, 400):
        parts = [gzip.compress(plain[i : i + size]) for i in range(0, len(plain), size)]
        path.write_bytes(gzip.compress(b"") + b"".join(parts) + gzip.compress(b"") + b"padding")
        assert_maps(read_volume(path), oblique())


PACKERS = {
    "bzip2": bz2.compress,
    "xz": lzma.compress,
    "zstd": lambda data: b"\x28\xb5\x2f\xfd" + data,
}


@pytest.mark.parametrize(("name", "pack"), PACKERS.items())
def test_other_compressions_are_refused_by_name(tmp_path, name, pack):
    path = tmp_path / "x.nii.bz2"
    path.write_bytes(pack(save_nifti(tmp_path / "x.nii", coded(), oblique()).read_bytes()))
    with pytest.raises(FormatError, match=f"compressed with {name}; expected a plain or gzipped file"):
        read_volume(path)


NIFTI_REFUSALS = {
    "types 0": ({"datatype": 0}, "no stated type"),
    "bits": ({"datatype": 1}, "one bit; .*; write bytes"),
    "long floats": ({"datatype": 1536}, "128-bit floats; .*; write 64-bit"),
    "long complex": ({"datatype": 2048}, "complex voxels; .*; write their magnitude"),
    "complex": ({"datatype": 32}, "complex voxels; .*; write their magnitude"),
    "RGB": ({"datatype": 128}, "colour voxels; .*; write one channel"),
    "RGBA": ({"datatype": 2304}, "colour voxels; .*; write one channel"),
    "unknown": ({"datatype": 77}, "unknown type 77"),
    "voxels in the header": ({"vox_offset": 100}, "vox_offset 100; expected a whole number from 352"),
    "half a byte": ({"vox_offset": 352.5}, r"vox_offset 352\.5"),
    "no offset": ({"vox_offset": np.nan}, "vox_offset nan"),
    "intercept": ({"scl_slope": 1, "scl_inter": np.nan}, "scl_inter nan"),
    "negative": ({"dim": [[3, -4, 3, 5, 1, 1, 1, 1]]}, "none empty"),
    "qform": ({"quatern_b": 3, "qform_code": 1, "sform_code": 0}, "qform that is no rotation"),
}


@pytest.mark.parametrize(("fields", "text"), NIFTI_REFUSALS.values(), ids=NIFTI_REFUSALS)
def test_nifti_headers_refused_by_name(tmp_path, fields, text, capfd):
    path = save_nifti(tmp_path / "x.nii", coded(), oblique(), **fields)
    with pytest.raises(FormatError, match=text) as caught:
        read_volume(path)
    assert "x.nii" in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_nifti_oddities_become_notes(tmp_path, capfd, caplog):
    for fields in ({}, {"magic": b"ni1"}):  # Half of a pair that is a whole file.
        path = save_nifti(tmp_path / "x.nii", coded(), oblique(), vox_offset=0, **fields)
        assert "vox_offset is 0: 352 assumed, where the header ends" in inspect_volume(path).notes
        assert_maps(read_volume(path), oblique())
    path = save_nifti(tmp_path / "x.nii", coded(), oblique(), quatern_b=3, qform_code=1)
    assert "the qform is no rotation: the sform is used" in inspect_volume(path).notes
    assert_maps(read_volume(path), oblique())
    path = save_nifti(tmp_path / "x.nii", coded(), oblique(), sform_code=77)
    assert any("sform_code 77 not valid" in note for note in inspect_volume(path).notes)
    assert capfd.readouterr() == ("", "")
    assert {record.name for record in caplog.records} <= {"lumencut"}


def test_many_slices_of_one_voxel(tmp_path):
    array = np.arange(30_000, dtype="i2").reshape(30_000, 1, 1)
    path = save_nifti(tmp_path / "x.nii", array, oblique(), scl_slope=2, scl_inter=1)
    np.testing.assert_array_equal(read_volume(path).array, 2 * array.astype("i4") + 1)
    pieces = list(slabs(np.zeros((1_000_000, 1, 1))))
    assert len(pieces) == 4
    assert sum(len(piece) for piece in pieces) == 1_000_000


def test_capital_names_of_a_pair(tmp_path):
    save_nifti(tmp_path / "x.hdr", coded(), oblique(), nibabel.Nifti1Pair)
    for end in ("hdr", "img"):
        (tmp_path / f"x.{end}").rename(tmp_path / f"X.{end.upper()}")
    for name in ("X.HDR", "X.IMG"):
        assert_maps(read_volume(tmp_path / name), oblique())


def save_by_hand(path, data=RAW, encoding="raw", lines="", **fields):
    stated = {"type": "short", "dimension": 3, "sizes": "4 3 5", "encoding": encoding, "endian": "little"}
    text = "".join(f"{name}: {value}\n" for name, value in (stated | fields).items())
    path.write_bytes(f"NRRD0004\n{text}{lines}\n".encode() + data)
    return path


DETACHED = {
    "raw": (RAW, "raw", ""),
    "below": (RAW, "raw", ""),
    "gzip": (gzip.compress(RAW), "gzip", ""),
    "bzip2": (bz2.compress(RAW), "bzip2", ""),
    "text": (" ".join(map(str, coded().ravel())).encode(), "ascii", ""),
    "line skip": (b"one\ntwo\n" + RAW, "raw", "line skip: 2\n"),
    "byte skip": (b"abc" + RAW, "raw", "byte skip: 3\n"),
    "both": (b"one\nabc" + RAW, "raw", "line skip: 1\nbyte skip: 3\n"),
    "last": (b"abc" + RAW, "raw", "byte skip: -1\n"),
    "skip in gzip": (gzip.compress(b"abc" + RAW), "gzip", "byte skip: 3\n"),
    "line before gzip": (b"one\n" + gzip.compress(RAW), "gzip", "line skip: 1\n"),
}


@pytest.mark.parametrize("name", DETACHED)
@pytest.mark.parametrize("attached", [True, False])
def test_nrrd_encodings_and_skips(tmp_path, name, attached):
    data, encoding, lines = DETACHED[name]
    if attached:
        path = save_by_hand(tmp_path / "x.nrrd", data, encoding, lines)
    else:
        place = "sub/dir/x.bin" if name == "below" else "./x.bin"
        (tmp_path / "sub" / "dir").mkdir(parents=True)
        (tmp_path / place).write_bytes(data)
        path = save_by_hand(tmp_path / "x.nhdr", b"", encoding, f"{lines}data file: {place}\n")
    assert_maps(read_volume(path), np.eye(4))
    if encoding != "bzip2":  # SimpleITK reads none.
        assert_as_simpleitk(path)


@pytest.mark.parametrize("code", ["utf-8", "latin-1"])
def test_names_of_data_files_in_either_code(tmp_path, code):
    (tmp_path / "Größe.raw").write_bytes(RAW)
    path = save_by_hand(tmp_path / "x.nhdr", b"", lines="data file: NAME\n")
    path.write_bytes(path.read_bytes().replace(b"NAME", "Größe.raw".encode(code)))
    assert_maps(read_volume(path), np.eye(4))
    path = save_meta(tmp_path / "x.mhd", coded(), np.eye(4), b"", ElementDataFile="NAME")
    path.write_bytes(path.read_bytes().replace(b"NAME", "Größe.raw".encode(code)))
    assert_maps(read_volume(path), np.eye(4))


def test_nrrd_fields_in_any_case(tmp_path):
    lines = "Space: LPS\nSPACE DIRECTIONS: (2,0,0) (0,3,0) (0,0,4)\nSpaceOrigin: (1,2,3)\n"
    path = save_by_hand(tmp_path / "x.nrrd", lines=lines, encoding="RAW", type="SHORT")
    expected = np.diag([2.0, 3, 4, 1])
    expected[:3, 3] = 1, 2, 3
    assert_maps(read_volume(path), expected)
    assert_as_simpleitk(path)


def test_nrrd_with_key_value_pairs_comments_and_two_line_ends(tmp_path):
    lines = 'Name:=x\nName:=y\nsizes:=many\n# sizes: 1\nlabels: "a b" "c\nnot a field\n'
    path = save_by_hand(tmp_path / "x.nrrd", lines=lines)
    assert_maps(read_volume(path), np.eye(4))
    head, data = path.read_bytes()[: -len(RAW)], RAW
    path.write_bytes(head.replace(b"\n", b"\r\n") + data)
    assert_maps(read_volume(path), np.eye(4))


NRRD_REFUSALS = {
    "hex": ({"encoding": "hex"}, "", "encoding: hex; .*; write it with encoding gzip or raw"),
    "zstd": ({"encoding": "zstd"}, "", "encoding: zstd; .*; write it with encoding gzip or raw"),
    "block": ({"type": "block"}, "", "type: block"),
    "list": ({}, "data file: LIST 2\na.raw\n", "data file: LIST 2; .*; write a single"),
    "pattern": ({}, "data file: x%d.raw 1 5 1\n", "x%d.raw 1 5 1; .*; write a single"),
    "twice": ({}, "sizes: 1 2 3\n", "two fields 'sizes'"),
    "lines": ({}, "line skip: -2\n", "line skip: -2"),
    "bytes": ({}, "byte skip: -5\n", "byte skip: -5"),
    "gzip from the end": ({"encoding": "gzip"}, "byte skip: -1\n", "byte skip: -1; .* with encoding raw"),
    "endian": ({"endian": "middle"}, "", "endian: middle"),
    "vectors": ({"dimension": 4, "sizes": "3 4 5 1"}, "kinds: vector domain domain domain\n", "kind vector"),
    "time": ({"dimension": 4, "sizes": "4 3 5 2"}, "", "several values per voxel or time points"),
    "colour": ({}, "kinds: domain domain RGBA-color\n", "kind RGBA-color"),
    "words": ({}, "space origin: here\n", "a field of the header that cannot be read"),
    "two numbers": ({}, "space origin: (1,2)\n", "2 numbers; expected 3"),
    "long": ({}, f'space units: "{"m" * 5000}\n', "letters in the field 'space units'"),
    "text": ({"encoding": "ascii"}, "", "no numbers|as the header says"),
}


@pytest.mark.parametrize(("fields", "lines", "text"), NRRD_REFUSALS.values(), ids=NRRD_REFUSALS)
def test_nrrd_headers_refused_by_name(tmp_path, fields, lines, text):
    path = save_by_hand(tmp_path / "x.nrrd", lines=lines, **fields)
    with pytest.raises(FormatError, match=text) as caught:
        read_volume(path)
    assert "x.nrrd" in str(caught.value)


def test_newer_and_compressed_nrrd(tmp_path):
    path = save_by_hand(tmp_path / "x.nrrd")
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b"NRRD0004", b"NRRD0006"))
    with pytest.raises(FormatError, match="newer or no NRRD version; expected NRRD0001 to NRRD0005"):
        read_volume(path)
    path.write_bytes(gzip.compress(whole))
    with pytest.raises(FormatError, match="a compressed NRRD file; expected a plain one; decompress"):
        read_volume(path)


def test_nrrd_axis_mins_are_noted(tmp_path):
    path = save_by_hand(tmp_path / "x.nrrd", lines="spacings: 2 2 2\naxis mins: 1 2 3\n")
    assert any("axis mins are not used" in note for note in inspect_volume(path).notes)


@pytest.mark.parametrize("text", ["1 2 x", "1e400 " * 60, "70000 " * 60, "7" * 500, "1.5 " * 60, "1 " * 61])
def test_text_that_is_no_voxels(tmp_path, text):
    path = save_by_hand(tmp_path / "x.nrrd", (text + " 0" * 60).encode(), "ascii")
    with pytest.raises(FormatError, match=r"x\.nrrd"):
        read_volume(path)


def test_text_keeps_all_digits(tmp_path):
    array = coded(dtype="i8") + 2**62 + 1
    raw = save_nrrd(tmp_path / "x.nrrd", array, oblique(), encoding="raw")
    np.testing.assert_array_equal(read_volume(raw).array, array)
    text = " ".join(map(str, array.ravel())).encode()
    path = save_by_hand(tmp_path / "y.nrrd", text, "ascii", type="int64")
    np.testing.assert_array_equal(read_volume(path).array, array)


def test_metaimage_variants_as_simpleitk_reads_them(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "x.zraw").write_bytes(zlib.compress(RAW))
    (tmp_path / "sub" / "Größe.raw").write_bytes(b"head" + RAW)
    big = coded(dtype=">i2").tobytes()
    four = {"NDims": 4, "DimSize": "4 3 5 1", "ElementSpacing": "1 2 3 1", "Offset": "1 2 3 0"}
    variants = [
        {"data": zlib.compress(RAW), "CompressedData": "T", "CompressedDataSize": len(zlib.compress(RAW))},
        {"data": b"", "CompressedData": "True", "ElementDataFile": "x.zraw"},
        {"data": b"", "HeaderSize": 4, "ElementDataFile": "sub/Größe.raw"},
        {"data": b"", "HeaderSize": -1, "ElementDataFile": "./sub/Größe.raw"},
        {"data": big, "BinaryDataByteOrderMSB": "True"},
        {"data": big, "ElementByteOrderMSB": "1"},
        {"data": b"abc" + RAW, "HeaderSize": -1},
        {"data": RAW, "ElementSize": "9 9 9", "Comment": "a = b: c"},
        {"data": RAW, "ElementSpacing": None, "ElementSize": "2 3 4"},
        {"data": RAW, "TransformMatrix": None, **four},
    ]
    for number, fields in enumerate(variants):
        path = save_meta(tmp_path / f"{number}.mhd", coded(), oblique(), **fields)
        assert_as_simpleitk(path)
        if "=" not in fields.get("Comment", ""):
            path.write_bytes(
                path.read_bytes().replace(b" = ", b": ").replace(b"Type: Image", b"Type = Image")
            )
            assert_as_simpleitk(path)


@pytest.mark.parametrize(("kind", "dtype"), [("LONG", "i4"), ("ULONG", "u4"), ("LONG_LONG", "i8")])
def test_metaimage_long_types(tmp_path, kind, dtype):
    path = save_meta(
        tmp_path / "x.mha", coded(), oblique(), coded(dtype=dtype).tobytes(), ElementType=f"MET_{kind}"
    )
    assert_as_simpleitk(path)


META_REFUSALS = {
    "pattern": ({"ElementDataFile": "x%03d.raw 1 5 1"}, "x%03d.raw 1 5 1; .*; write a single"),
    "list": ({"ElementDataFile": "LIST 2"}, "LIST 2; .*; write a single"),
    "nothing": ({"ElementDataFile": ""}, "no file name in ElementDataFile"),
    "half voxels": ({"DimSize": "4.5 3 5"}, r"DimSize = 4\.5 3 5; expected whole"),
    "dimensions": ({"NDims": 30000}, "NDims = 30000"),
    "header in itself": ({"HeaderSize": 4}, "HeaderSize = 4"),
    "end of zlib": ({"HeaderSize": -1, "CompressedData": True}, "HeaderSize = -1"),
    "end": ({"HeaderSize": -2}, "HeaderSize = -2"),
}


@pytest.mark.parametrize(("fields", "text"), META_REFUSALS.values(), ids=META_REFUSALS)
def test_metaimage_headers_refused_by_name(tmp_path, fields, text):
    with pytest.raises(FormatError, match=text):
        read_volume(save_meta(tmp_path / "x.mha", coded(), np.eye(4), **fields))


def test_metaimage_intensities_are_not_scaled(tmp_path):
    path = save_meta(tmp_path / "x.mha", coded(), oblique(), ElementToIntensityFunctionSlope=2)
    assert "ElementToIntensityFunctionSlope is not applied, as ITK does not" in inspect_volume(path).notes
    assert_as_simpleitk(path)


SIMPLEITK_TYPES = [
    "uint8",
    "int8",
    "int16",
    "uint16",
    "int32",
    "uint32",
    "int64",
    "uint64",
    "float32",
    "float64",
]


@pytest.mark.parametrize("dtype", SIMPLEITK_TYPES)
@pytest.mark.parametrize("name", ["x.nii", "x.nii.gz", "x.hdr", "x.nrrd", "x.nhdr", "x.mha", "x.mhd"])
@pytest.mark.parametrize("compressed", [False, True])
def test_what_simpleitk_writes(tmp_path, name, dtype, compressed):
    image = SimpleITK.GetImageFromArray((coded() % 100).astype(dtype))
    lengths = np.linalg.norm(oblique()[:3, :3], axis=0)
    image.SetDirection((oblique()[:3, :3] / lengths).ravel().tolist())
    image.SetSpacing(lengths.tolist())
    image.SetOrigin(oblique()[:3, 3].tolist())
    SimpleITK.WriteImage(image, str(tmp_path / name), useCompression=compressed)
    assert read_volume(tmp_path / name).array.dtype == dtype
    assert read_volume(tmp_path / name).size == SIZE
    assert_as_simpleitk(tmp_path / name)


ODD_IMAGES = {
    "vectors": lambda: SimpleITK.GetImageFromArray(np.zeros((5, 3, 4, 3), "f4"), isVector=True),
    "colour": lambda: SimpleITK.GetImageFromArray(np.zeros((5, 3, 4, 3), "u1"), isVector=True),
    "two": lambda: SimpleITK.GetImageFromArray(np.zeros((5, 3, 4, 2), "i2"), isVector=True),
    "complex": lambda: SimpleITK.GetImageFromArray(np.zeros((5, 3, 4), "c8")),
    "time": lambda: SimpleITK.GetImageFromArray(np.zeros((2, 5, 3, 4), "i2"), isVector=False),
    "flat": lambda: SimpleITK.GetImageFromArray(np.zeros((3, 4), "i2")),
}


@pytest.mark.parametrize("name", ["x.nii", "x.nrrd", "x.mha"])
@pytest.mark.parametrize("kind", ODD_IMAGES)
def test_what_simpleitk_writes_and_no_volume_holds(tmp_path, name, kind):
    SimpleITK.WriteImage(ODD_IMAGES[kind](), str(tmp_path / name))
    mend = "3 axes" if kind == "flat" else "; write (one|their)"
    with pytest.raises(FormatError, match=mend):
        inspect_volume(tmp_path / name, values=False)


def test_nibabel_stays_silent(tmp_path, caplog):
    caplog.set_level(logging.DEBUG)
    read_volume(save_nifti(tmp_path / "x.nii", coded(), oblique(), qform_code=9))
    assert {record.name for record in caplog.records} <= {"lumencut"}
