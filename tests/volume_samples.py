"""Volumes whose voxels encode their indices, and functions that write them to small files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pydicom
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian, generate_uid

SIZE = (4, 3, 5)
DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


def coded(size=SIZE, dtype=np.int16):
    """Voxels [k, j, i] whose value is i + 10 j + 100 k."""
    k, j, i = np.indices(size[::-1])
    return (i + 10 * j + 100 * k).astype(dtype)


def oblique():
    """A rotated, left-handed, anisotropic grid far from the origin."""
    a, b = 0.4, -0.7
    rotation = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    rotation = rotation @ np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    affine = np.eye(4)
    affine[:3, :3] = rotation @ np.diag([0.7, -0.9, 2.5])
    affine[:3, 3] = [-120.5, 33.25, 710.0]
    return affine


def value_at(volume, world):
    """The value of the voxel nearest to a world point, which must be a voxel's centre."""
    index = np.linalg.solve(volume.world_from_index, [*world, 1.0])[:3]
    nearest = np.rint(index).astype(int)
    np.testing.assert_allclose(index, nearest, atol=1e-3)
    i, j, k = nearest
    return volume.array[k, j, i]


def assert_maps(volume, world_from_index, value=lambda i, j, k: i + 10 * j + 100 * k, size=SIZE):
    """Every voxel centre of the expected grid holds the expected value."""
    for k, j, i in np.ndindex(size[::-1]):
        world = world_from_index[:3, :3] @ [i, j, k] + world_from_index[:3, 3]
        assert value_at(volume, world) == value(i, j, k)


def slice_of(array, affine, k, series="1.2.3.4", **extra):
    """A DICOM dataset of slice k of an array on a grid (LPS)."""
    data = Dataset()
    data.file_meta = FileMetaDataset()
    data.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
    data.file_meta.MediaStorageSOPClassUID = data.SOPClassUID = CTImageStorage
    data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID = generate_uid()
    data.SeriesInstanceUID, data.SeriesNumber, data.Modality = series, 7, "CT"
    data.SeriesDescription = "made for a test"
    data.Rows, data.Columns = array.shape[1:]
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated = data.BitsStored = 8 * array.dtype.itemsize
    data.HighBit = data.BitsStored - 1
    data.PixelRepresentation = int(array.dtype.kind == "i")
    lengths = np.linalg.norm(affine[:3, :3], axis=0)
    data.PixelSpacing = [f"{lengths[1]:.10g}", f"{lengths[0]:.10g}"]
    cosines = (affine[:3, :2] / lengths[:2]).T.ravel()
    data.ImageOrientationPatient = [f"{value:.12f}" for value in cosines]
    data.ImagePositionPatient = [f"{value:.9f}" for value in affine[:3, 3] + k * affine[:3, 2]]
    data.SliceThickness = f"{lengths[2]:.6g}"
    data.PixelData = np.ascontiguousarray(array[k]).tobytes()
    for keyword, value in extra.items():
        setattr(data, keyword, value)
    return data


def save(data, path):
    pydicom.dcmwrite(path, data, enforce_file_format=True)
    return path


def write_stack(folder, array, affine, change=lambda k, data: None, order=None):
    """Write a stack; `order` gives the file number of each slice."""
    folder.mkdir(exist_ok=True)
    for k in range(len(array)):
        data = slice_of(array, affine, k)
        change(k, data)
        save(data, folder / f"IM{k if order is None else order[k]:04}.dcm")
    return folder
