"""Images of other packages in memory → volumes, without an import and, where the package permits, a copy.

An image only exists if its package is loaded, so the package is found in `sys.modules`.
"""

from __future__ import annotations

import importlib
import logging
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.errors import FormatError, SeriesError, VolumeError
from lumencut.scene.volume import Volume

_log = logging.getLogger("lumencut")
_ACCEPTED = "a lumencut.Volume, SimpleITK, itk, nibabel or vtkImageData image, or datasets of pydicom"


def as_volume(image: Any) -> Volume:
    """Return a volume with the voxels and the grid of an image in memory.

    Parameters
    ----------
    image : Volume, SimpleITK.Image, itk.Image, nibabel image, vtkImageData or datasets of pydicom
        A 3-dimensional image of one number per voxel, oblique or flipped as it may be. Datasets, a list or
        tuple of them or a single one, become a volume by the rules for DICOM folders.

    Returns
    -------
    Volume
        Shares the image's voxels where its package permits. A SimpleITK image that is changed later leaves
        the volume as it was.

    Raises
    ------
    VolumeError
        For anything else, bare arrays (which have no grid), colour, vectors or several time points; for
        datasets that are not one stack of grey slices.
    """
    if isinstance(image, Volume):
        return image
    if isinstance(image, np.ndarray):
        mend = "give Volume(array, spacing=…)"
        raise VolumeError("image", f"a bare array of shape {image.shape}", _ACCEPTED, mend)
    convert = _room(image)
    if convert is None:
        raise VolumeError("image", f"{type(image).__module__}.{type(image).__name__}", _ACCEPTED)
    volume = convert(image)
    doubt = _lumencut.doubted_grid(volume.size, volume.world_from_index[:3].tolist())
    if doubt and convert is not _from_pydicom:
        _log.warning("%s: %s", type(image).__name__, doubt)
    return volume


def is_image(image: Any) -> bool:
    """Return whether `as_volume` accepts objects of this kind."""
    return isinstance(image, Volume) or _room(image) is not None


def _room(image: Any) -> Callable[[Any], Volume] | None:
    """The converter of images of this kind; None for other objects."""
    members = image if isinstance(image, (list, tuple)) else [image]
    if members and all(_is_of(member, "pydicom") and hasattr(member, "walk") for member in members):
        return _from_pydicom
    for package, accepts, convert in _ROOMS:
        if _is_of(image, package) and accepts(image):
            return convert
    return None


def _is_of(thing: Any, package: str) -> bool:
    """Whether a class of the thing comes from the package."""
    return any(cls.__module__.partition(".")[0] == package for cls in type(thing).__mro__)


def _affine(spacing: Any, origin: Any, direction: Any, first: Any) -> npt.NDArray[np.float64]:
    """World from index, where `first` is the first voxel's index on the grid that the origin belongs to."""
    affine = np.eye(4)
    affine[:3, :3] = np.asarray(direction, dtype=np.float64).reshape(3, 3) * np.asarray(
        spacing, dtype=np.float64
    )
    affine[:3, 3] = np.asarray(origin, dtype=np.float64) + affine[:3, :3] @ np.asarray(
        first, dtype=np.float64
    )
    return affine


def _stated(spacing: Any, origin: Any, direction: Any) -> dict[str, bool]:
    """The parts of the grid that an image states: none if it has the default grid of new images.

    Such an image was made from bare voxels, or read from a file without a grid.
    """
    sides = np.asarray(direction, dtype=np.float64).reshape(3, 3)
    return {
        "states_spacing": bool((np.asarray(spacing, dtype=np.float64) != 1).any()),
        "states_orientation": bool((sides != np.eye(3)).any() or np.any(np.asarray(origin) != 0)),
    }


def _require(name: str, dimension: int, components: int) -> None:
    if dimension != 3:
        mend = "pass a 3D image; of a time series, pass a single time point"
        raise VolumeError(name, f"{dimension} dimensions", "3", mend)
    if components != 1:
        raise VolumeError(name, f"{components} components per voxel", "one", "pass an image of one component")


class _Kept:
    """Lends memory to numpy and keeps its owner alive."""

    def __init__(self, array: npt.NDArray[Any], owner: object) -> None:
        self.__array_interface__ = array.__array_interface__
        self.owner = owner


def _from_simpleitk(image: Any) -> Volume:
    _require("SimpleITK image", image.GetDimension(), image.GetNumberOfComponentsPerPixel())
    package = sys.modules["SimpleITK"]
    if "complex" in image.GetPixelIDTypeAsString() or "label" in image.GetPixelIDTypeAsString():
        raise VolumeError("SimpleITK image", image.GetPixelIDTypeAsString(), "one number per voxel")
    view = package.GetArrayViewFromImage(image)
    # The second image shares the voxels, copy-on-write: they survive changes to the caller's image.
    voxels = np.asarray(_Kept(view, package.Image(image)))
    spacing, origin, direction = image.GetSpacing(), image.GetOrigin(), image.GetDirection()
    affine = _affine(spacing, origin, direction, (0, 0, 0))
    return Volume(voxels, world_from_index=affine, **_stated(spacing, origin, direction))


def _from_itk(image: Any) -> Volume:
    _require("itk image", image.GetImageDimension(), image.GetNumberOfComponentsPerPixel())
    package = sys.modules["itk"]
    view = package.array_view_from_image(image)
    first = [int(image.GetBufferedRegion().GetIndex()[axis]) for axis in range(3)]
    direction = package.array_from_matrix(image.GetDirection())
    spacing, origin = ([float(v[axis]) for axis in range(3)] for v in (image.GetSpacing(), image.GetOrigin()))
    voxels = np.asarray(_Kept(view, (view, image)))
    affine = _affine(spacing, origin, direction, first)
    return Volume(voxels, world_from_index=affine, **_stated(spacing, origin, direction))


def _from_nibabel(image: Any) -> Volume:
    shape = tuple(image.shape)
    _require("nibabel image", 3 if all(length == 1 for length in shape[3:]) else len(shape), 1)
    _require("nibabel image", min(len(shape), 3), 1)
    if image.affine is None:
        raise VolumeError("nibabel image", "no affine", "an affine", "give Volume(array, world_from_index=…)")
    voxels = np.asanyarray(image.dataobj).reshape(shape[:3], order="A")
    # Other headers than those of NIfTI always place the voxels.
    is_nifti = hasattr(image.header, "get_sform")
    stated = _lumencut.nifti_units(image.header.binaryblock) if is_nifti else None
    millimetres, spacing, orientation = stated or (1.0, True, True)
    affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ np.asarray(image.affine, dtype=np.float64)
    affine[:3] *= millimetres
    return Volume(
        np.asarray(voxels).T,
        world_from_index=affine,
        states_spacing=spacing,
        states_orientation=orientation,
    )


def _from_vtk(image: Any) -> Volume:
    scalars = image.GetPointData().GetScalars()
    if scalars is None:
        raise VolumeError(
            "vtkImageData", "no point scalars", "one number per point", "set the active scalars"
        )
    _require("vtkImageData", 3, scalars.GetNumberOfComponents())
    ni, nj, nk = image.GetDimensions()
    numpy_support = importlib.import_module("vtkmodules.util.numpy_support")
    voxels = numpy_support.vtk_to_numpy(scalars)
    if voxels.size != ni * nj * nk:
        raise VolumeError("vtkImageData", f"{voxels.size} scalars", f"{ni} × {nj} × {nk}")
    matrix = image.GetDirectionMatrix()
    direction = [[matrix.GetElement(row, column) for column in range(3)] for row in range(3)]
    affine = _affine(image.GetSpacing(), image.GetOrigin(), direction, image.GetExtent()[::2])
    # The world of VTK is not a patient: its axes do not define where left is.
    stated = _stated(image.GetSpacing(), image.GetOrigin(), direction)
    return Volume(
        voxels.reshape(nk, nj, ni), world_from_index=affine, **{**stated, "states_orientation": False}
    )


def _from_pydicom(datasets: Any) -> Volume:
    from lumencut.dicom.reading.datasets import open_datasets

    try:
        file = open_datasets(datasets if isinstance(datasets, (list, tuple)) else [datasets]).checked()
        volume = file.volume(lambda done, total: None)
    except FormatError as error:
        mend = "give the datasets of one series" if isinstance(error, SeriesError) else error.mend
        raise VolumeError(error.subject, error.found, error.expected, mend) from error
    for note in file.notes:
        _log.warning("%s: %s", file.path, note)
    return volume


def _has(*names: str) -> Callable[[Any], bool]:
    return lambda image: all(hasattr(image, name) for name in names)


_ROOMS: tuple[tuple[str, Callable[[Any], bool], Callable[[Any], Volume]], ...] = (
    ("SimpleITK", _has("GetPixelIDTypeAsString", "GetDirection"), _from_simpleitk),
    ("itk", _has("GetBufferedRegion", "GetDirection"), _from_itk),
    ("nibabel", _has("affine", "dataobj"), _from_nibabel),
    ("vtkmodules", _has("GetDirectionMatrix", "GetPointData", "GetExtent"), _from_vtk),
)
