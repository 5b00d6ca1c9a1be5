"""Every public function accepts the same kinds of volumes as `render`, and sees the same voxels."""

from __future__ import annotations

import nibabel
import numpy as np
import pydicom
import pytest
import SimpleITK
import vtkmodules.all as vtk
from pydicom.dataset import Dataset
from vtkmodules.util.numpy_support import numpy_to_vtk

import lumencut
from dicom_phantom import axial, images, single
from lumencut import Camera, CameraError, Vessel, VesselTree, Volume, VolumeError, Window
from lumencut.files.centerlines import inspect_centerlines
from lumencut.files.volumes import as_volume

STACK = [single(image, number + 1) for number, image in enumerate(images(axial()))]
VOLUME = as_volume(STACK)
MIDDLE = VOLUME.corners.mean(axis=0)
TREE = VesselTree([Vessel(MIDDLE + np.outer([-5.0, 0.0, 5.0], [0.2, 0.3, 1.0]), 2.0)])
LPS_FROM_RAS = np.diag([-1.0, -1.0, 1.0, 1.0])


def simpleitk_image():
    image = SimpleITK.GetImageFromArray(VOLUME.array)
    image.SetSpacing(VOLUME.spacing.tolist())
    image.SetOrigin(VOLUME.origin.tolist())
    image.SetDirection(VOLUME.direction.ravel().tolist())
    return image


def nibabel_image():
    image = nibabel.Nifti1Image(VOLUME.array.T, LPS_FROM_RAS @ VOLUME.world_from_index)
    image.header.set_xyzt_units("mm")
    return image


def vtk_image():
    image = vtk.vtkImageData()
    image.SetDimensions(*VOLUME.size)
    image.SetSpacing(*VOLUME.spacing)
    image.SetOrigin(*VOLUME.origin)
    image.SetDirectionMatrix(*VOLUME.direction.ravel())
    image.GetPointData().SetScalars(numpy_to_vtk(VOLUME.array.ravel(), deep=True))
    return image


MAKERS = [simpleitk_image, nibabel_image, vtk_image, lambda: STACK, lambda: tuple(STACK[::-1])]
every_kind = pytest.mark.parametrize(
    "make", MAKERS, ids=["SimpleITK", "nibabel", "vtk", "pydicom", "pydicom, reversed"]
)


@every_kind
@pytest.mark.parametrize("name", sorted(lumencut.VIEWS))
def test_named_views(make, name):
    found, expected = getattr(Camera, name)(make(), (40, 30)), getattr(Camera, name)(VOLUME, (40, 30))
    np.testing.assert_allclose(found.center, expected.center, atol=1e-4)
    assert found.pixel_spacing == pytest.approx(expected.pixel_spacing, rel=1e-6)


@every_kind
def test_fitted_views_and_turns(make):
    view = Camera.fitted(make(), (1, 1, 0), (0, 0, 1), (40, 30))
    for scene, camera in ((VOLUME, Camera.fitted(VOLUME, (1, 1, 0), (0, 0, 1), (40, 30))), (make(), view)):
        np.testing.assert_allclose(camera.center, MIDDLE, atol=1e-4)
        turn = lumencut.fitted_turn(camera, scene)
        np.testing.assert_allclose(turn.center, MIDDLE, atol=1e-4)


@every_kind
def test_windows(make):
    for tree in (None, TREE):
        found, expected = Window.from_data(make(), tree), Window.from_data(VOLUME, tree)
        assert (found.level, found.width) == pytest.approx((expected.level, expected.width), rel=1e-4)
    assert Window.whole(make()) == Window.whole(VOLUME)


@every_kind
def test_the_space_of_centerlines(make, tmp_path, caplog):
    (tmp_path / "line.csv").write_text(
        "\n".join(",".join(map(str, point * (-0.1, -0.1, 0.1))) for point in TREE.points)
    )
    with pytest.warns(lumencut.SpaceWarning):
        tree = lumencut.read_centerlines(tmp_path / "line.csv", volume=make())
    np.testing.assert_allclose(tree.points, TREE.points, atol=1e-9)
    report = inspect_centerlines(tmp_path / "line.csv", volume=make())
    assert (report.space, report.unit) == ("ras", "cm")


@every_kind
def test_renderers(make):
    camera = Camera.anterior(TREE, (40, 30))
    shown = lumencut.Renderer(make(), TREE, "cpu").render(camera, images=["value"]).value
    expected = lumencut.Renderer(VOLUME, TREE, "cpu").render(camera, images=["value"]).value
    np.testing.assert_allclose(shown, expected, atol=0.01)


def test_what_is_no_volume_is_refused_as_such(tmp_path):
    (tmp_path / "line.csv").write_text("0,0,0\n1,2,3\n")
    for thing in ("ct.nii", np.zeros((3, 3, 3)), [], [1, 2], [*STACK, None]):
        with pytest.raises(
            CameraError, match=r"scene of the view: found .*; expected a VesselTree, a Vessel, a Volume"
        ):
            Camera.anterior(thing)
        for take in (Window.whole, Window.from_data, as_volume):
            with pytest.raises(VolumeError, match=r"image: found .*; expected a lumencut\.Volume, SimpleITK"):
                take(thing)
        with pytest.raises(VolumeError, match=r"image: found"):
            lumencut.read_centerlines(tmp_path / "line.csv", volume=thing)
    with pytest.raises(VolumeError, match=r"4 dimensions"):
        Camera.anterior(nibabel.Nifti1Image(np.zeros((3, 3, 3, 2)), np.eye(4)))


def poly_data(radius="MaximumInscribedSphereRadius"):
    """Two vessels that share a point, in the form that vmtk uses."""
    points, lines, cells = vtk.vtkPoints(), [[0, 1, 2], [2, 3]], vtk.vtkCellArray()
    points.SetDataTypeToDouble()
    for place in ([0, 0, 0], [0, 0, 10.1], [0, 0, 1 / 3 + 20], [9, 0, 30]):
        points.InsertNextPoint(place)
    for ids in lines:
        cells.InsertNextCell(len(ids), ids)
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(cells)
    if radius:
        array = numpy_to_vtk(np.array([3.0, 2.9, 2.5, 1e-7]), deep=True)
        array.SetName(radius)
        data.GetPointData().AddArray(array)
    return data


@pytest.mark.parametrize("radius", ["MaximumInscribedSphereRadius", "Radius", None])
def test_poly_data_is_read_as_its_file_is(tmp_path, radius):
    data, writer = poly_data(radius), vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(str(tmp_path / "tree.vtp"))
    writer.Write()
    tree, expected = lumencut.read_centerlines(data), lumencut.read_centerlines(tmp_path / "tree.vtp")
    assert [v.points.tolist() for v in tree] == [v.points.tolist() for v in expected]
    for vessel, of_file in zip(tree, expected, strict=True):
        if radius is None:
            assert vessel.radius is None
        else:
            assert vessel.radius.tolist() == of_file.radius.tolist()
    assert len(tree) == 2
    assert inspect_centerlines(data).format == inspect_centerlines(tmp_path / "tree.vtp").format


def test_poly_data_in_ras_and_without_lines():
    tree = lumencut.read_centerlines(poly_data(), "ras")
    assert tree.points[:, 0].min() == -9
    sphere = vtk.vtkSphereSource()
    sphere.Update()
    for empty in (vtk.vtkPolyData(), sphere.GetOutput()):
        with pytest.raises(lumencut.FormatError, match=r"vtkPolyData"):
            lumencut.read_centerlines(empty)
    with pytest.raises(lumencut.FormatError, match=r"path: found \w*ImageData"):
        lumencut.read_centerlines(vtk.vtkImageData())
    written = lumencut.read_centerlines(poly_data())
    assert isinstance(lumencut.Renderer(None, written).cut_surface(), lumencut.Frame)


def test_a_dataset_alone_and_datasets_of_no_file():
    bare = []
    for data in STACK:
        copy = Dataset()
        copy.update({element.tag: element for element in data})
        bare.append(copy)
    assert not hasattr(bare[0], "file_meta")
    volume = as_volume(bare)
    np.testing.assert_array_equal(volume.array, VOLUME.array)
    np.testing.assert_array_equal(volume.world_from_index, VOLUME.world_from_index)
    single_slice = as_volume(STACK[0])
    assert single_slice.size == (*VOLUME.size[:2], 1)


def test_datasets_that_are_no_volume():
    with pytest.raises(VolumeError, match=r"DICOM datasets: found .*missing slice"):
        as_volume([*STACK[:4], *STACK[6:]])
    other = [single(image, 50 + number, series=7) for number, image in enumerate(images(axial()))]
    with pytest.raises(VolumeError, match=r"2 series.*give the datasets of one series"):
        as_volume([*STACK, *other])
    headless = pydicom.Dataset()
    headless.SOPClassUID = STACK[0].SOPClassUID
    with pytest.raises(VolumeError, match=r"dataset 0: found an image without rows and columns"):
        as_volume([headless])
    without_pixels = [single(image, number) for number, image in enumerate(images(axial()))]
    for data in without_pixels:
        del data.PixelData
    with pytest.raises(VolumeError, match=r"dataset .*: found no pixels"):
        as_volume(without_pixels)


def test_volumes_are_no_arrays_of_voxels():
    with pytest.raises(VolumeError, match=r"array of the volume: found a Volume"):
        Volume(VOLUME)
