"""NIfTI, NRRD and MetaImage: every voxel at its stated position, or an error with file and reason."""

from __future__ import annotations

import gzip
import zlib

import nibabel
import nrrd
import numpy as np
import pytest
import SimpleITK

from lumencut.errors import FileError, FormatError
from lumencut.files.volumes import inspect_volume, read_volume
from volume_samples import SIZE, assert_maps, coded, oblique

LPS_FROM_RAS = np.diag([-1.0, -1.0, 1.0, 1.0])


def save_nifti(path, array, affine, kind=nibabel.Nifti1Image, **fields):
    """Write voxels [k, j, i] on an LPS grid; afterwards `fields` are set in the header."""
    image = kind(array.T, LPS_FROM_RAS @ affine, dtype=array.dtype)
    image.header.set_xyzt_units("mm")
    nibabel.save(image, path)
    if fields:
        raw = bytearray(path.read_bytes())
        header = np.frombuffer(raw, nibabel.nifti1.header_dtype, 1)
        for name, value in fields.items():
            header[name] = value
        path.write_bytes(raw)
    return path


NIFTI = {
    "x.nii": nibabel.Nifti1Image,
    "x.nii.gz": nibabel.Nifti1Image,
    "two.nii.gz": nibabel.Nifti2Image,
    "pair.hdr": nibabel.Nifti1Pair,
    "pair.img": nibabel.Nifti1Pair,
    "pair.img.gz": nibabel.Nifti1Pair,
    "pair2.hdr": nibabel.Nifti2Pair,
}


@pytest.mark.parametrize("name", NIFTI)
@pytest.mark.parametrize("dtype", ["u1", "i2", ">i2", "u2", "i4", "f4", "f8", "i8"])
def test_nifti(tmp_path, name, dtype):
    array = coded(dtype=dtype) if dtype != "u1" else (coded() % 251).astype("u1")
    volume = read_volume(save_nifti(tmp_path / name, array, oblique(), NIFTI[name]))
    assert volume.array.dtype == np.dtype(dtype).newbyteorder("=")
    assert_maps(volume, oblique(), lambda i, j, k: array[k, j, i])


def test_nifti_is_recognised_without_its_name(tmp_path):
    save_nifti(tmp_path / "x.nii.gz", coded(), oblique())
    (tmp_path / "download").write_bytes((tmp_path / "x.nii.gz").read_bytes())
    assert_maps(read_volume(tmp_path / "download"), oblique())


SCALINGS = {
    "stays int16": (1.0, -1024.0, coded(), np.int16),
    "needs int32": (1000.0, 7.0, coded(), np.int32),
    "needs uint16": (100.0, 7.0, coded(), np.uint16),
    "unsigned to int16": (1.0, -1000.0, coded(dtype="u2"), np.int16),
    "fraction": (0.5, 0.0, coded(), np.float32),
    "double": (0.5, 1.0, coded(dtype="f8"), np.float64),
    "no slope": (0.0, 5.0, coded(), np.int16),
}


@pytest.mark.parametrize(("slope", "intercept", "stored", "dtype"), SCALINGS.values(), ids=SCALINGS)
def test_nifti_scaling(tmp_path, slope, intercept, stored, dtype):
    path = save_nifti(tmp_path / "x.nii", stored, oblique(), scl_slope=slope, scl_inter=intercept)
    volume = read_volume(path)
    assert volume.array.dtype == dtype
    np.testing.assert_array_equal(volume.array, np.asanyarray(nibabel.load(path).dataobj).T)
    assert any("scaled by" in note for note in inspect_volume(path).notes) == (slope != 0)


@pytest.mark.parametrize(
    ("stored", "slope", "kind"), [("i2", 0.5, "float32"), ("f4", 2, "float32"), ("f8", 0.5, "float64")]
)
def test_a_scaled_nifti_warns_nobody_and_is_told_to_who_asks(tmp_path, caplog, stored, slope, kind):
    path = save_nifti(
        tmp_path / "x.nii", coded(dtype=stored), oblique(), scl_slope=slope, scl_inter=3, xyzt_units=2
    )
    with caplog.at_level("WARNING", "lumencut"):
        assert read_volume(path).dtype == kind
    assert not caplog.records
    assert f"values are scaled by {slope:g} and shifted by 3: read as {kind}" in inspect_volume(path).notes


def test_nifti_units_forms_and_trailing_axis(tmp_path):
    metres = oblique()
    metres[:3] /= 1000
    path = save_nifti(tmp_path / "m.nii", coded()[None], metres, xyzt_units=1)
    assert_maps(read_volume(path), oblique())
    assert "lengths are in meters: converted to mm" in inspect_volume(path).notes
    bare = save_nifti(tmp_path / "bare.nii", coded(), np.diag([2.0, 2, 2, 1]), sform_code=0, qform_code=0)
    report = inspect_volume(bare)
    assert report.space == "none stated"
    assert any("no placement" in note for note in report.notes)
    np.testing.assert_allclose(LPS_FROM_RAS @ report.world_from_index, nibabel.load(bare).affine)
    both = save_nifti(tmp_path / "both.nii", coded(), oblique(), qform_code=1, qoffset_x=3.0)
    assert any("sform and qform" in note for note in inspect_volume(both).notes)


def bad_nifti(tmp_path, array, **fields):
    return save_nifti(tmp_path / "bad.nii", array, oblique(), **fields)


def test_nifti_refusals(tmp_path):
    with pytest.raises(FormatError, match=r"bad\.nii: found 2 time points; expected one; write one"):
        read_volume(bad_nifti(tmp_path, np.stack([coded()] * 2)))
    with pytest.raises(FormatError, match="several components"):
        read_volume(bad_nifti(tmp_path, np.stack([coded()[None]] * 3)))
    with pytest.raises(FormatError, match="complex"):
        read_volume(bad_nifti(tmp_path, coded(dtype="c8")))
    with pytest.raises(FormatError, match="colour"):
        read_volume(bad_nifti(tmp_path, coded(dtype=[("R", "u1"), ("G", "u1"), ("B", "u1")])))
    with pytest.raises(FormatError, match="3 axes"):
        read_volume(bad_nifti(tmp_path, coded()[0]))
    with pytest.raises(FormatError, match="invertible"):
        read_volume(bad_nifti(tmp_path, coded(), srow_x=[[0, 0, 0, 0]]))
    nibabel.AnalyzeImage(coded().T, np.eye(4)).to_filename(tmp_path / "old.hdr")
    with pytest.raises(FormatError, match=r"Analyze 7\.5"):
        read_volume(tmp_path / "old.hdr")
    pair = save_nifti(tmp_path / "pair.hdr", coded(), oblique(), nibabel.Nifti1Pair)
    pair.rename(tmp_path / "lone.hdr")
    with pytest.raises(FileError, match=r"lone\.img"):
        read_volume(tmp_path / "lone.hdr")


def test_dark_values_that_were_cut_off_are_noted_with_their_share(tmp_path):
    tissue = np.random.default_rng(0).normal(20, 40, (20, 20, 20))
    whole = inspect_volume(save_nifti(tmp_path / "whole.nii", tissue.astype("i2"), oblique()))
    assert not any("cut off" in note for note in whole.notes)
    cut = tissue.clip(20).astype("i2")
    report = inspect_volume(save_nifti(tmp_path / "cut.nii", cut, oblique()))
    share = f"{100 * (cut == 20).mean():.0f} % of the voxels have the smallest value, 20: darker values"
    assert [note for note in report.notes if note.startswith(share)]


def test_nan_voxels_are_noted(tmp_path):
    array = coded(dtype="f4")
    array[1, 1, 1] = np.nan
    report = inspect_volume(save_nifti(tmp_path / "nan.nii", array, oblique()))
    assert "1 of 60 voxels are not finite (NaN or infinite)" in report.notes
    assert report.value_range == (0.0, 423.0)
    array[:] = np.nan
    assert inspect_volume(save_nifti(tmp_path / "nan.nii", array, oblique())).value_range is None


def save_nrrd(path, array, affine, detached=False, **fields):
    """Write voxels [k, j, i]; `affine` is in the space that the fields name, LPS by default."""
    header = {"space": "left-posterior-superior", "kinds": ["domain"] * 3, "encoding": "gzip"}
    header |= {"space directions": affine[:3, :3].T, "space origin": affine[:3, 3]} | fields
    header = {name: value for name, value in header.items() if value is not None}
    nrrd.write(str(path), array, header, index_order="C", detached_header=detached)
    return path


@pytest.mark.parametrize("encoding", ["raw", "gzip", "bzip2", "ascii"])
@pytest.mark.parametrize("dtype", ["i2", ">i2", "u1", "f4", ">f8"])
def test_nrrd(tmp_path, encoding, dtype):
    array = coded(dtype=dtype) if dtype != "u1" else (coded() % 251).astype("u1")
    for name, detached in (("x.nrrd", False), ("y.nhdr", True)):
        path = save_nrrd(tmp_path / name, array, oblique(), detached, encoding=encoding)
        volume = read_volume(path)
        assert volume.array.dtype == np.dtype(dtype).newbyteorder("=")
        assert_maps(volume, oblique(), lambda i, j, k: array[k, j, i])


@pytest.mark.parametrize(
    ("space", "signs"),
    [("right-anterior-superior", [-1, -1, 1]), ("RAS", [-1, -1, 1]), ("left-anterior-superior", [1, -1, 1])],
)
def test_nrrd_spaces(tmp_path, space, signs):
    path = save_nrrd(tmp_path / "x.nrrd", coded(), np.diag([*signs, 1]) @ oblique(), space=space)
    assert_maps(read_volume(path), oblique())
    assert inspect_volume(path).space == space


def test_nrrd_without_a_space(tmp_path, caplog):
    fields = {"space": None, "space directions": None, "space origin": None, "spacings": [0.5, 0.6, 2.0]}
    path = save_nrrd(tmp_path / "x.nrrd", coded(), oblique(), **fields)
    assert_maps(read_volume(path), np.diag([0.5, 0.6, 2.0, 1.0]))
    assert "no space stated: LPS assumed" in caplog.text
    path = save_nrrd(tmp_path / "x.nrrd", coded(), oblique(), **fields | {"spacings": None})
    assert "no spacing stated: 1 mm assumed" in inspect_volume(path).notes


def test_nrrd_units(tmp_path):
    metres = oblique()
    metres[:3] /= 1000
    path = save_nrrd(tmp_path / "x.nrrd", coded(), metres, **{"space units": ["m", "m", "m"]})
    assert_maps(read_volume(path), oblique())
    path = save_nrrd(tmp_path / "x.nrrd", coded(), oblique(), **{"space units": ["ell", "ell", "ell"]})
    assert any("'ell'" in note for note in inspect_volume(path).notes)


def test_nrrd_skips(tmp_path):
    head = "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 5\nencoding: raw\nendian: little\n"
    for skip, junk in (("byte skip: 3", b"abc"), ("line skip: 2", b"one\ntwo\n"), ("byte skip: -1", b"any")):
        path = tmp_path / "x.nrrd"
        path.write_bytes(f"{head}{skip}\n\n".encode() + junk + coded(dtype="<i2").tobytes())
        assert_maps(read_volume(path), np.eye(4))


def test_nrrd_refusals(tmp_path):
    vectors = np.stack([coded()] * 3, axis=-1)
    directions = np.vstack([[np.nan] * 3, oblique()[:3, :3].T])
    fields = {"kinds": ["vector", "domain", "domain", "domain"], "space directions": directions}
    with pytest.raises(FormatError, match=r"several values per voxel or time points .*kinds: vector"):
        read_volume(save_nrrd(tmp_path / "x.nrrd", vectors, oblique(), **fields))
    one = save_nrrd(tmp_path / "x.nrrd", vectors[..., :1], oblique(), **fields)
    assert_maps(read_volume(one), oblique())
    with pytest.raises(FormatError, match="kind RGB-color"):
        read_volume(
            save_nrrd(
                tmp_path / "x.nrrd", coded((3, 4, 5)), oblique(), kinds=["RGB-color", "domain", "domain"]
            )
        )
    path = save_nrrd(tmp_path / "y.nhdr", coded(), oblique(), detached=True, encoding="raw")
    (tmp_path / "y.raw").unlink()
    with pytest.raises(FileError, match=r"y\.raw"):
        read_volume(path)


def save_meta(path, array, affine, data=None, **fields):
    """Write voxels [k, j, i] on an LPS grid; `data` replaces the uncompressed voxels."""
    lengths = np.linalg.norm(affine[:3, :3], axis=0)
    types = {
        "i1": "CHAR",
        "u1": "UCHAR",
        "i2": "SHORT",
        "u2": "USHORT",
        "i4": "INT",
        "f4": "FLOAT",
        "f8": "DOUBLE",
    }
    header = {
        "ObjectType": "Image",
        "NDims": 3,
        "TransformMatrix": " ".join(map(repr, (affine[:3, :3] / lengths).T.ravel().tolist())),
        "Offset": " ".join(map(repr, affine[:3, 3].tolist())),
        "ElementSpacing": " ".join(map(repr, lengths.tolist())),
        "DimSize": " ".join(map(str, array.shape[::-1])),
        "ElementType": f"MET_{types[array.dtype.str[1:]]}",
    } | fields
    header = {name: value for name, value in header.items() if value is not None}
    header["ElementDataFile"] = header.pop("ElementDataFile", "LOCAL")
    text = "".join(f"{name} = {value}\n" for name, value in header.items())
    path.write_bytes(text.encode() + (array.tobytes() if data is None else data))
    return path


@pytest.mark.parametrize("dtype", ["i1", "u1", "i2", ">i2", "u2", ">u2", "i4", "f4", ">f4", "f8"])
def test_metaimage(tmp_path, dtype):
    array = coded(dtype="i4").astype(dtype) if dtype[-1] != "1" else (coded() % 100).astype(dtype)
    order = {"BinaryDataByteOrderMSB": dtype.startswith(">")}
    zipped = zlib.compress(array.tobytes())
    text = b" ".join(str(value).encode() for value in array.ravel().tolist())
    (tmp_path / "x.raw").write_bytes(b"head" + array.tobytes())
    paths = [
        save_meta(tmp_path / "raw.mha", array, oblique(), **order),
        save_meta(tmp_path / "zip.mha", array, oblique(), zipped, CompressedData=True, **order),
        save_meta(
            tmp_path / "gz.mha",
            array,
            oblique(),
            gzip.compress(array.tobytes()),
            CompressedData=True,
            **order,
        ),
        save_meta(tmp_path / "text.mha", array, oblique(), text, BinaryData=False, **order),
        save_meta(tmp_path / "x.mhd", array, oblique(), b"", ElementDataFile="x.raw", HeaderSize=-1, **order),
        save_meta(tmp_path / "y.mhd", array, oblique(), b"", ElementDataFile="x.raw", HeaderSize=4, **order),
    ]
    for path in paths:
        volume = read_volume(path)
        assert volume.array.dtype == np.dtype(dtype).newbyteorder("=")
        assert_maps(volume, oblique(), lambda i, j, k: array[k, j, i])


def test_metaimage_notes(tmp_path):
    path = save_meta(tmp_path / "x.mha", coded(), oblique(), AnatomicalOrientation="LPS")
    assert any(
        "AnatomicalOrientation = LPS, the matrix says RPI" in note for note in inspect_volume(path).notes
    )
    path = save_meta(tmp_path / "x.mha", coded(), np.eye(4), ElementSpacing=None)
    assert "no ElementSpacing: 1 mm assumed" in inspect_volume(path).notes
    four = {"NDims": 4, "DimSize": "4 3 5 1", "ElementSpacing": "1 1 1 1", "Offset": "1 2 3 0"}
    path = save_meta(tmp_path / "x.mha", coded(), np.eye(4), TransformMatrix=None, **four)
    np.testing.assert_array_equal(read_volume(path).origin, [1, 2, 3])


META_REFUSALS = {
    "channels": ({"ElementNumberOfChannels": 3}, "3 channels"),
    "time": ({"NDims": 4, "DimSize": "4 3 1 5"}, "DimSize"),
    "flat": ({"NDims": 2, "DimSize": "4 3"}, "NDims = 2"),
    "empty": ({"DimSize": "4 0 5"}, "DimSize"),
    "type": ({"ElementType": "MET_OTHER"}, "MET_OTHER"),
    "list": ({"ElementDataFile": "LIST"}, "LIST"),
    "words": ({"ElementSpacing": "one 1 1"}, "one 1 1"),
    "infinite": ({"Offset": "inf 0 0"}, "Offset"),
    "zero": ({"ElementSpacing": "1 0 1"}, "ElementSpacing"),
    "singular": ({"TransformMatrix": "1 0 0 1 0 0 0 0 1"}, "invertible"),
    "lying": ({"DimSize": "40000 30000 50000"}, "bytes of voxels"),
    "lying zip": ({"DimSize": "40000 30000 50000", "CompressedData": True}, r"x\.mha"),
}


@pytest.mark.parametrize(("fields", "text"), META_REFUSALS.values(), ids=META_REFUSALS)
def test_metaimage_refusals(tmp_path, fields, text):
    with pytest.raises(FormatError, match=text) as caught:
        read_volume(save_meta(tmp_path / "x.mha", coded(), np.eye(4), **fields))
    assert "x.mha" in str(caught.value)


def test_unknown_and_missing(tmp_path):
    with pytest.raises(FileError, match="nothing"):
        read_volume(tmp_path / "nothing.nii")
    (tmp_path / "readme.txt").write_text("hello")
    (tmp_path / "odd.bin").write_bytes(bytes(9))
    for path in (tmp_path / "readme.txt", tmp_path / "odd.bin"):
        with pytest.raises(FormatError, match=r"unknown format; expected .*NIfTI.*NRRD.*MetaImage"):
            read_volume(path)


def test_progress_and_headers_only(tmp_path):
    path, calls = save_nifti(tmp_path / "x.nii", coded(), oblique()), []
    read_volume(path, progress=lambda done, total: calls.append((done, total)))
    assert calls == [(5, 5)]
    report = inspect_volume(path, values=False)
    assert (report.size, report.dtype, report.value_range) == (SIZE, np.int16, None)
    np.testing.assert_allclose(report.spacing, [0.7, 0.9, 2.5], atol=1e-6)


@pytest.mark.parametrize("name", ["x.nii", "x.nii.gz", "x.nrrd", "x.nhdr", "x.mha", "x.mhd"])
def test_agrees_with_simpleitk(tmp_path, name):
    image = SimpleITK.GetImageFromArray(coded())
    affine = oblique()
    lengths = np.linalg.norm(affine[:3, :3], axis=0)
    direction = affine[:3, :3] / lengths
    image.SetDirection(direction.ravel().tolist())
    image.SetSpacing(lengths.tolist())
    image.SetOrigin(affine[:3, 3].tolist())
    SimpleITK.WriteImage(image, str(tmp_path / name), useCompression=name.endswith("a"))
    volume = read_volume(tmp_path / name)
    for index in np.ndindex(SIZE):
        np.testing.assert_allclose(
            volume.world_from_index @ [*index, 1.0],
            [*image.TransformIndexToPhysicalPoint(index), 1.0],
            atol=2e-4,
        )
    np.testing.assert_array_equal(volume.array, coded())
