"""Images of a known phantom as DICOM: the position and the values of every pixel are known.

The phantom is a function of the position in the body. If a reader puts an image elsewhere, its values do not
match the function: a straight vessel becomes crooked.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pydicom
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian

Array = npt.NDArray[Any]
Affine = npt.NDArray[np.float64]

CENTER = np.array([12.0, -20.0, 140.0])
SIZE = (64, 48, 24)
SPACING = (0.8, 0.8, 2.0)
ROOT = "1.2.826.0.1.3680043.10.1000"


def field(world: Array, contrast: float = 300.0) -> Array:
    """Return the phantom at positions [..., 3] (mm, LPS): a vessel along z, a sphere, varying tissue."""
    off = world - CENTER
    vessel = contrast * np.exp(-((off[..., 0] + 4) ** 2 + (off[..., 1] - 3) ** 2) / (2 * 3.0**2))
    sphere = 250 * np.exp(-((off - (8, -6, 5)) ** 2).sum(-1) / (2 * 5.0**2))
    return np.asarray(40 + off @ (0.7, 1.1, 1.5) + vessel + sphere)


def grid(size: tuple[int, int, int], directions: Array, spacing: Iterable[float]) -> Affine:
    """A grid of voxels about the middle of the phantom; the columns of `directions` are those of i, j, k."""
    affine = np.eye(4)
    affine[:3, :3] = directions @ np.diag(list(spacing))
    affine[:3, 3] = CENTER - affine[:3, :3] @ (np.array(size) - 1) / 2
    return affine


def axial(size: tuple[int, int, int] = SIZE, spacing: Iterable[float] = SPACING) -> Affine:
    """The plain grid."""
    return grid(size, np.eye(3), spacing)


def oblique() -> Affine:
    """A grid turned about two axes."""
    (a, b), rotation = (0.4, -0.7), np.eye(3)
    rotation[:2, :2] = [[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]
    rotation = rotation @ [[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]]
    return grid(SIZE, rotation, SPACING)


def tilted(degrees: float) -> Affine:
    """A gantry tilt: the slices lean, the table moves along z."""
    angle = np.radians(degrees)
    return grid(SIZE, np.array([[1, 0, 0], [0, np.cos(angle), 0], [0, np.sin(angle), 1]]), SPACING)


@dataclass(frozen=True, eq=False)
class Image:
    """One image, with its true position and values.

    Attributes
    ----------
    values : ndarray [j, i]
        The values of the pixels after rescaling.
    plane : ndarray, shape (4, 4)
        Affine from (i, j, 0) to world (mm, LPS).
    part : str
        The stack of the image: a series, or a phase of a series.
    """

    values: Array
    plane: Affine
    part: str = "only"


def images(
    world_from_index: Affine,
    size: tuple[int, int, int] = SIZE,
    part: str = "only",
    contrast: float = 300.0,
    lowest: int = -1024,
) -> list[Image]:
    """The phantom on a grid, as one image for each k."""
    planes = []
    for k in range(size[2]):
        plane = world_from_index.copy()
        plane[:3, 3] += k * world_from_index[:3, 2]
        planes.append(plane)
    return [Image(sampled(plane, size, contrast, lowest), plane, part) for plane in planes]


def sampled(
    plane: Affine, size: tuple[int, ...] = SIZE, contrast: float = 300.0, lowest: int = -1024
) -> Array:
    """The phantom, rounded, at the pixels of one image."""
    j, i = np.indices((size[1], size[0]))
    world = plane[:3, 3] + i[..., None] * plane[:3, 0] + j[..., None] * plane[:3, 1]
    return np.rint(field(world, contrast)).clip(lowest).astype(np.int32)


def textured(stack: list[Image], low: int, high: int) -> list[Image]:
    """The same positions with values that use the whole range; a reader must return each of them."""
    random = np.random.default_rng(7)
    return [replace(one, values=random.integers(low, high + 1, one.values.shape)) for one in stack]


@dataclass(frozen=True)
class Stored:
    """How values are converted to stored numbers."""

    dtype: str = "i2"
    bits: int = 16
    slope: float = 1.0
    intercept: float = 0.0

    def numbers(self, values: Array) -> Array:
        """Return the stored numbers of these values."""
        stored = np.rint((values - self.intercept) / self.slope)
        low = -(1 << (self.bits - 1)) if self.dtype[0] == "i" else 0
        assert stored.min() >= low, "the values fit what is stored"
        assert stored.max() < low + (1 << self.bits), "the values fit what is stored"
        return stored.astype(self.dtype)


PLAIN = Stored()
HOUNSFIELD = Stored("u2", 12, 1.0, -1024.0)


def cosines(plane: Affine) -> list[str]:
    """ImageOrientationPatient of an image."""
    return [f"{v:.12f}" for v in (plane[:3, :2] / np.linalg.norm(plane[:3, :2], axis=0)).T.ravel()]


def corner(plane: Affine) -> list[str]:
    """ImagePositionPatient of an image."""
    return [f"{v:.9f}" for v in plane[:3, 3]]


def pixel_spacing(plane: Affine) -> list[str]:
    """PixelSpacing of an image: between rows, then between columns."""
    lengths = np.linalg.norm(plane[:3, :2], axis=0)
    return [f"{lengths[1]:.10g}", f"{lengths[0]:.10g}"]


def instance(number: int, series: int, sop_class: str = CTImageStorage, modality: str = "CT") -> Dataset:
    """Return an object with the attributes that several programs need; UIDs depend only on the numbers."""
    data = Dataset()
    data.file_meta = FileMetaDataset()
    data.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
    data.SOPClassUID, data.SOPInstanceUID = sop_class, f"{ROOT}.{series}.{number}"
    data.file_meta.MediaStorageSOPClassUID = data.SOPClassUID
    data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID
    data.StudyInstanceUID, data.SeriesInstanceUID = f"{ROOT}.1", f"{ROOT}.1.{series}"
    data.FrameOfReferenceUID = f"{ROOT}.2"
    data.PatientName, data.PatientID = "Phantom^Vessel", "phantom"
    data.PatientBirthDate, data.PatientSex, data.AccessionNumber = "", "", ""
    data.StudyDate = data.SeriesDate = data.AcquisitionDate = data.ContentDate = "20260101"
    data.StudyTime = data.SeriesTime = data.AcquisitionTime = data.ContentTime = "120000"
    data.StudyID, data.ReferringPhysicianName = "1", ""
    data.Manufacturer, data.Modality, data.PatientPosition = "made for a test", modality, "HFS"
    data.PositionReferenceIndicator = ""
    data.SeriesNumber, data.InstanceNumber, data.SeriesDescription = series, number, "made for a test"
    data.AcquisitionNumber = 1
    return data


def pixels(data: Dataset, numbers: Array, stored: Stored) -> None:
    """Set the pixels of an object, [j, i] or [frame, j, i]."""
    data.Rows, data.Columns = numbers.shape[-2:]
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated, data.BitsStored = 8 * numbers.dtype.itemsize, stored.bits
    data.HighBit = stored.bits - 1
    data.PixelRepresentation = int(numbers.dtype.kind == "i")
    data.PixelData = np.ascontiguousarray(numbers).tobytes()
    data["PixelData"].VR = "OW" if numbers.dtype.itemsize > 1 else "OB"


def single(
    image: Image, number: int, series: int = 3, stored: Stored = PLAIN, thickness: float = 2.0
) -> Dataset:
    """A single-frame CT image."""
    data = instance(number, series)
    data.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL"]
    data.SliceThickness = f"{thickness:g}"
    data.PixelSpacing = pixel_spacing(image.plane)
    data.ImageOrientationPatient, data.ImagePositionPatient = cosines(image.plane), corner(image.plane)
    data.RescaleSlope, data.RescaleIntercept = f"{stored.slope:g}", f"{stored.intercept:g}"
    data.RescaleType = "HU"
    pixels(data, stored.numbers(image.values), stored)
    return data


def save_bare(data: Dataset, path: Path) -> None:
    """Write one object without preamble and file meta information, as old programs did."""
    del data.file_meta
    pydicom.dcmwrite(path, data, implicit_vr=True, little_endian=True)


def save(data: Dataset, path: Path) -> Path:
    """Write one object as a file."""
    pydicom.dcmwrite(path, data, enforce_file_format=True)
    return path
