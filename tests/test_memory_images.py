"""Images of other packages in memory: the same world coordinates, shared voxels, errors with reasons."""

from __future__ import annotations

import gc
import subprocess
import sys
import types

import nibabel
import numpy as np
import pytest
import SimpleITK
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from lumencut.errors import VolumeError
from lumencut.files.volumes import as_volume, read_volume
from lumencut.scene.volume import Volume
from volume_samples import SIZE, assert_maps, coded, oblique

LENGTHS = np.linalg.norm(oblique()[:3, :3], axis=0)
DIRECTION = oblique()[:3, :3] / LENGTHS
ORIGIN = oblique()[:3, 3]


def simpleitk_image(array):
    image = SimpleITK.GetImageFromArray(array)
    image.SetSpacing(LENGTHS.tolist())
    image.SetOrigin(ORIGIN.tolist())
    image.SetDirection(DIRECTION.ravel().tolist())
    return image


def vtk_image(array, first=(0, 0, 0)):
    image = vtk.vtkImageData()
    last = np.add(first, array.shape[::-1]) - 1
    image.SetExtent(*np.stack([first, last], axis=1).ravel().tolist())
    image.SetSpacing(*LENGTHS)
    image.SetDirectionMatrix(*DIRECTION.ravel())
    image.SetOrigin(*(ORIGIN - oblique()[:3, :3] @ first))
    image.GetPointData().SetScalars(numpy_to_vtk(array.ravel(), deep=True))
    return image


def test_volume_passes_through():
    volume = Volume(coded())
    assert as_volume(volume) is volume


@pytest.mark.parametrize("dtype", ["u1", "i2", "u2", "i4", "f4", "f8"])
def test_simpleitk(dtype):
    array = (coded() % 251).astype(dtype)
    volume = as_volume(simpleitk_image(array))
    assert volume.array.dtype == array.dtype
    assert_maps(volume, oblique(), lambda i, j, k: array[k, j, i])


def test_simpleitk_is_shared_and_safe():
    image = simpleitk_image(coded())
    before = SimpleITK.GetArrayViewFromImage(image).__array_interface__["data"][0]
    volume = as_volume(image)
    assert volume.array.__array_interface__["data"][0] == before
    image[0, 0, 0] = 99
    image += 7
    assert_maps(volume, oblique())
    del image
    gc.collect()
    fillers = [np.full(coded().shape, -1, np.int16) for _ in range(100)]
    assert_maps(volume, oblique())
    assert len(fillers) == 100


def test_simpleitk_refusals():
    with pytest.raises(VolumeError, match="SimpleITK image: found 3 components"):
        as_volume(SimpleITK.Image([4, 4, 4], SimpleITK.sitkVectorFloat32, 3))
    with pytest.raises(VolumeError, match="2 dimensions"):
        as_volume(SimpleITK.Image([4, 4], SimpleITK.sitkFloat32))
    with pytest.raises(VolumeError, match="complex"):
        as_volume(SimpleITK.Image([4, 4, 4], SimpleITK.sitkComplexFloat32))


def test_nibabel():
    affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ oblique()
    array = coded()
    volume = as_volume(nibabel.Nifti1Image(array.T, affine))
    assert_maps(volume, oblique())
    assert np.shares_memory(volume.array, array)
    assert_maps(as_volume(nibabel.Nifti1Image(array.T[..., None], affine)), oblique())
    with pytest.raises(VolumeError, match="nibabel image: found 4 dimensions"):
        as_volume(nibabel.Nifti1Image(np.stack([array.T] * 2, axis=-1), affine))
    with pytest.raises(VolumeError, match="2 dimensions"):
        as_volume(nibabel.Nifti1Image(array[0], affine))
    with pytest.raises(VolumeError, match="no affine"):
        as_volume(nibabel.Nifti1Image(array.T, None))


@pytest.mark.parametrize(("unit", "length"), [("meter", 1000), ("mm", 1), ("micron", 0.001), (None, 1)])
def test_nibabel_has_the_unit_that_its_file_has(tmp_path, unit, length):
    image = nibabel.Nifti1Image(coded().T, np.diag([-0.02, -0.02, 0.04, 1.0]))
    image.header.set_xyzt_units(unit)
    nibabel.save(image, tmp_path / "image.nii")
    expected = length * np.array([0.02, 0.02, 0.04])
    for volume in (as_volume(image), read_volume(tmp_path / "image.nii")):
        np.testing.assert_allclose(volume.spacing, expected, rtol=1e-6)
    for kind in (nibabel.MGHImage, nibabel.Spm99AnalyzeImage):
        bare = kind(coded().T, np.diag([-1.0, -1.0, 1.0, 1.0]))
        np.testing.assert_allclose(as_volume(bare).spacing, 1)


def test_nibabel_on_disk(tmp_path):
    path = tmp_path / "x.nii.gz"
    nibabel.save(nibabel.Nifti1Image(coded().T, np.diag([-1.0, -1.0, 1.0, 1.0]) @ oblique()), path)
    assert_maps(as_volume(nibabel.load(path)), oblique())


@pytest.mark.parametrize("first", [(0, 0, 0), (3, -2, 7)])
def test_vtk(first):
    image = vtk_image(coded(), first)
    volume = as_volume(image)
    assert np.shares_memory(volume.array, vtk_to_numpy(image.GetPointData().GetScalars()))
    del image
    gc.collect()
    assert_maps(volume, oblique())


def test_vtk_agrees_with_itself():
    image, volume = vtk_image(coded(), (1, 2, 3)), as_volume(vtk_image(coded(), (1, 2, 3)))
    for number, (k, j, i) in enumerate(np.ndindex(SIZE[::-1])):
        world = volume.world_from_index @ [i, j, k, 1.0]
        np.testing.assert_allclose(world[:3], image.GetPoint(number), atol=1e-9)


def test_vtk_refusals():
    image = vtk.vtkImageData()
    image.SetDimensions(2, 2, 2)
    with pytest.raises(VolumeError, match="no point scalars"):
        as_volume(image)
    image.AllocateScalars(vtk.VTK_FLOAT, 3)
    with pytest.raises(VolumeError, match="3 components"):
        as_volume(image)


def test_others_are_refused():
    with pytest.raises(VolumeError, match=r"bare array of shape \(5, 3, 4\).*Volume\(array, spacing=…\)"):
        as_volume(coded())
    for thing in (None, "path.nii", 3, vtk.vtkPolyData(), SimpleITK.Transform()):
        with pytest.raises(VolumeError, match="image: found"):
            as_volume(thing)


class StandInRegion:
    def GetIndex(self):  # noqa: N802
        return (2, 0, -1)


class StandInImage:
    """A class with the used part of an itk image, for machines without that package."""

    __module__ = "itk.itkImagePython"

    GetImageDimension = staticmethod(lambda: 3)
    GetNumberOfComponentsPerPixel = staticmethod(lambda: 1)
    GetBufferedRegion = staticmethod(StandInRegion)
    GetSpacing = staticmethod(LENGTHS.tolist)
    GetDirection = staticmethod(lambda: DIRECTION)
    GetOrigin = staticmethod((ORIGIN - oblique()[:3, :3] @ [2, 0, -1]).tolist)


def test_itk_by_a_stand_in(monkeypatch):
    array = coded()
    package = types.SimpleNamespace(array_view_from_image=lambda image: array, array_from_matrix=np.asarray)
    monkeypatch.setitem(sys.modules, "itk", package)
    volume = as_volume(StandInImage())
    assert_maps(volume, oblique())
    assert np.shares_memory(volume.array, array)


def test_nothing_heavy_is_imported():
    code = (
        "import sys, numpy, lumencut.files.volumes as v, lumencut.scene.volume\n"
        "try: v.as_volume(numpy.zeros((2, 2, 2)))\n"
        "except lumencut.errors.VolumeError: pass\n"
        "heavy = {'SimpleITK', 'itk', 'nibabel', 'vtkmodules', 'vtk', 'pydicom', 'nrrd', 'gdcm', 'PIL'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout == "[]\n"
