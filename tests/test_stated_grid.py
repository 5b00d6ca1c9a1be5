"""Whether a volume's source states spacing and orientation: otherwise labels have no sides or no mm."""

from __future__ import annotations

import copy
import pickle
import sys
import types

import nibabel as nib
import numpy as np
import pytest

from lumencut import Renderer, Volume, VolumeError, phantom, read_volume
from lumencut.files.volumes import as_volume

VOXELS = np.zeros((3, 4, 5), np.int16)


def stated(volume):
    return volume.states_spacing, volume.states_orientation


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({}, (False, False)),
        ({"origin": (1, 2, 3)}, (False, False)),
        ({"spacing": (1, 1, 1)}, (True, False)),
        ({"direction": np.eye(3)}, (False, True)),
        ({"spacing": (1, 2, 3), "direction": np.eye(3)}, (True, True)),
        ({"world_from_index": np.eye(4)}, (True, True)),
        ({"states_spacing": True}, (True, False)),
        ({"states_orientation": True}, (False, True)),
        ({"world_from_index": np.eye(4), "states_spacing": False}, (False, True)),
        ({"world_from_index": np.eye(4), "states_orientation": False}, (True, False)),
    ],
)
def test_arrays_state_what_their_caller_gives(given, expected):
    volume = Volume(VOXELS, **given)
    assert stated(volume) == expected
    for again in (pickle.loads(pickle.dumps(volume)), copy.copy(volume), copy.deepcopy(volume)):
        assert stated(again) == expected


def test_the_words_for_a_volume_say_what_is_assumed():
    assert (
        repr(Volume(VOXELS))
        == "Volume(5 × 4 × 3 int16, spacing 1 × 1 × 1 mm (assumed), orientation not stated)"
    )
    assert repr(Volume(VOXELS, (1, 1, 1))).endswith("spacing 1 × 1 × 1 mm, orientation not stated)")
    assert repr(Volume(VOXELS, world_from_index=np.eye(4))).endswith("spacing 1 × 1 × 1 mm)")


@pytest.mark.parametrize("name", ["states_spacing", "states_orientation"])
def test_flags_are_true_or_false(name):
    with pytest.raises(VolumeError, match=f"{name} of the volume: found 1; expected True or False"):
        Volume(VOXELS, **{name: 1})


def test_phantoms_state_both():
    assert stated(phantom.calcified_wall().volume) == (True, True)


FLIPPED = np.diag([-1.0, 1.0, 1.0, 1.0])


@pytest.mark.parametrize(
    ("sform", "qform", "unit", "expected"),
    [
        (2, 0, "mm", (True, True)),
        (0, 1, "mm", (True, True)),
        # A position without a unit: mm by convention.
        (2, 0, "unknown", (True, True)),
        (0, 0, "mm", (True, False)),
        (0, 0, "unknown", (False, False)),
    ],
)
def test_nifti(tmp_path, sform, qform, unit, expected):
    image = nib.Nifti1Image(VOXELS.T, None)
    image.header.set_zooms((1.5, 1.5, 2.0))
    image.set_sform(np.diag([1.5, 1.5, 2.0, 1.0]), sform)
    image.set_qform(np.diag([1.5, 1.5, 2.0, 1.0]), qform)
    image.header.set_xyzt_units(unit)
    nib.save(image, tmp_path / "image.nii")
    assert stated(read_volume(tmp_path / "image.nii")) == expected
    assert stated(as_volume(nib.load(tmp_path / "image.nii"))) == expected


def test_two_placements_in_nifti_that_name_other_sides_state_none(tmp_path):
    image = nib.Nifti1Image(VOXELS.T, np.eye(4))
    image.set_sform(np.eye(4), 1)
    image.set_qform(FLIPPED, 1)
    nib.save(image, tmp_path / "image.nii")
    assert stated(read_volume(tmp_path / "image.nii")) == (True, False)
    image.set_qform(np.diag([1.0, 1.0, 1.01, 1.0]), 1)
    nib.save(image, tmp_path / "image.nii")
    assert stated(read_volume(tmp_path / "image.nii")) == (True, True)


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ("", (False, False)),
        ("spacings: 1 1 1", (True, False)),
        ("spacings: 1 nan 1", (False, False)),
        ("space: left-posterior-superior\nspacings: 1 1 1", (True, False)),
        ("space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)", (True, True)),
        ("space: RAS\nspace directions: (2,0,0) (0,1,0) (0,0,1)", (True, True)),
        ("space: scanner-xyz\nspace directions: (1,0,0) (0,1,0) (0,0,1)", (True, False)),
        ("space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)", (True, False)),
        ('space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace units: "mm" "mm" "mm"', (True, True)),
        (
            'space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace units: "ells" "ells" "ells"',
            (False, True),
        ),
    ],
)
def test_nrrd(tmp_path, fields, expected):
    header = f"NRRD0005\ntype: short\ndimension: 3\nsizes: 5 4 3\nencoding: raw\nendian: little\n{fields}"
    (tmp_path / "image.nrrd").write_bytes(header.strip().encode() + b"\n\n" + VOXELS.tobytes())
    assert stated(read_volume(tmp_path / "image.nrrd")) == expected


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ("", (False, False)),
        ("ElementSpacing = 1 1 1", (True, False)),
        ("ElementSize = 1 1 2", (True, False)),
        ("Offset = 1 2 3", (False, False)),
        ("TransformMatrix = 1 0 0 0 1 0 0 0 1", (False, True)),
        ("AnatomicalOrientation = RAI", (False, True)),
        (
            "AnatomicalOrientation = RAI\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 1 1 1",
            (True, True),
        ),
        ("AnatomicalOrientation = ???\nTransformMatrix = 1 0 0 0 1 0 0 0 1", (False, True)),
        # Two different orientations are unreliable.
        ("AnatomicalOrientation = LAI\nTransformMatrix = 1 0 0 0 1 0 0 0 1", (False, False)),
        ("AnatomicalOrientation = LAI", (False, False)),
    ],
)
def test_metaimage(tmp_path, fields, expected):
    header = f"ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_SHORT\n{fields}"
    header = header.strip() + "\nElementDataFile = LOCAL\n"
    (tmp_path / "image.mha").write_bytes(header.encode() + VOXELS.tobytes())
    assert stated(read_volume(tmp_path / "image.mha")) == expected


GRIDS = [
    ({}, (False, False)),
    ({"spacing": (1, 1, 2)}, (True, False)),
    ({"origin": (5, 0, 0)}, (False, True)),
    ({"direction": (0, 1, 0, 1, 0, 0, 0, 0, 1)}, (False, True)),
    ({"spacing": (2, 2, 2), "origin": (5, 0, 0)}, (True, True)),
]


@pytest.mark.parametrize(("grid", "expected"), GRIDS)
def test_simpleitk(grid, expected):
    sitk = pytest.importorskip("SimpleITK")
    image = sitk.GetImageFromArray(VOXELS)
    for name, values in grid.items():
        getattr(image, f"Set{name.capitalize()}")(tuple(map(float, values)))
    assert stated(as_volume(image)) == expected


class StandInImage:
    """A class with the used part of an itk image, for machines without that package."""

    __module__ = "itk.itkImagePython"

    def __init__(self, spacing=(1, 1, 1), origin=(0, 0, 0), direction=(1, 0, 0, 0, 1, 0, 0, 0, 1)):
        self.GetSpacing, self.GetOrigin = lambda: spacing, lambda: origin
        self.GetDirection = lambda: direction
        self.GetImageDimension, self.GetNumberOfComponentsPerPixel = lambda: 3, lambda: 1
        self.GetBufferedRegion = lambda: types.SimpleNamespace(GetIndex=lambda: (0, 0, 0))


@pytest.mark.parametrize(("grid", "expected"), GRIDS)
def test_itk_by_a_stand_in(monkeypatch, grid, expected):
    package = types.SimpleNamespace(array_view_from_image=lambda _: VOXELS, array_from_matrix=np.asarray)
    monkeypatch.setitem(sys.modules, "itk", package)
    assert stated(as_volume(StandInImage(**grid))) == expected


@pytest.mark.parametrize(("grid", "expected"), GRIDS)
def test_vtk_knows_no_patient(grid, expected):
    pytest.importorskip("vtkmodules")
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData

    image = vtkImageData()
    image.SetDimensions(5, 4, 3)
    for name, values in grid.items():
        getattr(image, f"Set{name.capitalize()}" + ("Matrix" if name == "direction" else ""))(
            *map(float, values)
        )
    image.GetPointData().SetScalars(numpy_to_vtk(VOXELS.ravel()))
    assert stated(as_volume(image)) == (expected[0], False)


def test_datasets_of_dicom_state_both():
    from dicom_phantom import axial, images, single

    sets = [single(image, number) for number, image in enumerate(images(axial()), 1)]
    assert "pydicom" in sys.modules
    assert stated(as_volume(sets)) == (True, True)


def test_frames_know_what_the_volume_states():
    for given in ({}, {"spacing": (1, 1, 1)}, {"direction": np.eye(3)}):
        volume = Volume(VOXELS, **given)
        source = Renderer(volume).render()._source
        assert (source.states_spacing, source.states_orientation) == stated(volume)
