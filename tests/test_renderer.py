"""Renderers and frames: pictures of known scenes, and errors."""

from __future__ import annotations

import re

import nibabel
import numpy as np
import pytest
import SimpleITK
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import numpy_to_vtk

import reference
from conftest import needs_shared_data
from lumencut import (
    Camera,
    CameraError,
    Renderer,
    Settings,
    SettingsError,
    SpaceWarning,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
    VolumeError,
    Window,
    phantom,
    read_centerlines,
    read_volume,
    render,
)
from scenes import wandering

LUMEN, SOFT, CALCIFIED = 350, 40, 1000
AFFINE = np.array([[2.1, 0.3, -0.2, -30], [-0.4, 2.3, 0.1, -35], [0.2, 0.5, -2.6, 40], [0, 0, 0, 1.0]])


def indices():
    """Three volumes of 32 × 32 × 32 voxels on an oblique grid, whose values are the indices i, j and k."""
    k, j, i = np.mgrid[:32, :32, :32].astype(np.float32)
    return [Volume(index, world_from_index=AFFINE) for index in (i, j, k)]


def grey(value, window):
    """Return values from black to white as grey levels, not rounded."""
    return 255 * np.clip((np.asarray(value, float) - window.level) / window.width + 0.5, 0, 1)


def pixel(camera, point):
    """Row and column that a world point lies in."""
    x, y, _ = reference.view_from_world(np.asarray(point, float)[None], camera)[0] / camera.pixel_spacing
    width, height = camera.size
    return int(np.floor(height / 2 - y)), int(np.floor(x + width / 2))


@pytest.mark.parametrize("size", [(61, 37), (1, 1), (1, 9), (9, 1)])
def test_fields_of_a_frame(size):
    tree, width, height = wandering(1), *size
    renderer, camera = Renderer(indices()[0], tree), Camera.anterior(tree, size)
    frame, bare = renderer.render(camera), renderer.cut_surface(camera)
    expected = {
        "image": (np.uint8, (height, width, 4)),
        "depth": (np.float32, (height, width)),
        "vessel": (np.int32, (height, width)),
        "distance": (np.float32, (height, width)),
        "value": (np.float32, (height, width)),
        "context": (np.uint8, (height, width, 4)),
        "position": (np.float64, (height, width, 3)),
    }
    for name, (dtype, shape) in expected.items():
        array = getattr(frame, name)
        assert (array.dtype, array.shape) == (dtype, shape), name
        if name not in ("image", "value", "context"):
            np.testing.assert_array_equal(getattr(bare, name), array)
    assert frame.vessel.min() >= 0
    assert frame.vessel.max() < len(tree)
    assert np.isfinite(frame.depth).all()
    assert (frame.distance >= 0).all()
    assert frame.camera is camera
    assert list(bare.timings) == ["levels", "projection", "depth", "depth_filter"]
    stages = [
        "levels",
        "projection",
        "depth",
        "leap",
        "depth_filter",
        "focus",
        "far_rim",
        "surface",
        "silhouette",
    ]
    assert list(frame.timings)[:9] == stages
    assert list(frame.timings)[-2:] == ["context", "composite"]
    paper = renderer.render(camera, Settings.paper())
    stages = ["levels", "projection", "distance", "depth", "depth_filter", "surface", "silhouette"]
    assert list(paper.timings)[:7] == stages
    for name in ("image", "value", "context"):
        with pytest.raises(VolumeError, match=f"{name} of the frame: found a cut surface without a volume"):
            getattr(bare, name)


def test_silhouettes_stand_where_the_surface_leaps():
    made = phantom.crossing()
    flat, lined = (
        Renderer(made.volume, made.tree).render(None, Settings(silhouettes=s, silhouette_reach=None))
        for s in (False, True)
    )
    assert (flat.image[..., 0] == flat.image[..., 2]).all()
    yellow = lined.image[..., 0].astype(int) - lined.image[..., 2] > 100
    border = lined.vessel != np.roll(lined.vessel, 1, axis=0)
    rows, columns = np.nonzero(border[20:-20, 20:-20] & ~np.isnan(lined.value[20:-20, 20:-20]))
    assert len(rows) > 50
    # A line is on one side of a jump.
    either = yellow | np.roll(yellow, 1, axis=0)
    assert either[rows + 20, columns + 20].mean() > 0.9
    row, column = pixel(lined.camera, (0, -10, 0))
    assert not yellow[row, column]
    tube = phantom.straight_tube()
    image = render(tube.volume, tube.tree).image
    assert (image[..., 0] == image[..., 2]).all()


def test_an_aorta_shows_its_lumen():
    made = phantom.aorta(scale=0.3)
    frame = render(made.volume, made.tree)
    window = Renderer(made.volume, made.tree).window
    points = np.concatenate([vessel.points[vessel.radius > 2.5] for vessel in made.tree])
    shown = []
    for point in points:
        place = pixel(frame.camera, point)
        if abs(frame.depth[place] - (point - frame.camera.center) @ frame.camera.direction) < 1:
            shown.append((frame.value[place], frame.image[place][0]))
    assert len(shown) > len(points) / 2
    values, greys = np.array(shown).T
    assert np.median(values) == pytest.approx(LUMEN, abs=15)
    assert (abs(values - LUMEN) < 70).mean() > 0.9
    assert np.median(greys) == pytest.approx(grey(LUMEN, window), abs=8)
    assert grey(60, window) < 80 < grey(LUMEN, window) < 180 < grey(CALCIFIED, window)


@pytest.mark.parametrize("percent", [0, 30, 50, 70])
def test_a_stenosis_can_be_measured_in_the_picture(percent):
    made = phantom.stenosis(percent)
    renderer = Renderer(made.volume, made.tree)
    frame = renderer.render()
    bright = frame.image[..., 0] > grey((LUMEN + SOFT) / 2, renderer.window)
    for z, diameter in ((0, 8 * (1 - percent / 100)), (22, 8)):
        row, column = pixel(frame.camera, (0, 0, z))
        dark = np.flatnonzero(~bright[row])
        width = dark[dark > column].min() - dark[dark < column].max() - 1
        # Pixels of the picture are 0.13 mm wide, voxels 0.5 mm.
        assert width * frame.camera.pixel_spacing == pytest.approx(diameter, abs=0.3)


def test_a_calcification_is_bright_and_on_the_side_of_the_patients_left():
    made = phantom.calcified_wall()
    frame = render(made.volume, made.tree)
    (plaque,) = made.plaques
    row, column = pixel(frame.camera, plaque.position)
    middle = pixel(frame.camera, (0, 0, 0))[1]
    assert column > middle
    assert frame.value[row, column] > 900
    assert frame.image[row, column, 0] > 240
    expected = grey(LUMEN, Window.from_data(made.volume, made.tree))
    assert abs(int(frame.image[row, middle, 0]) - expected) <= 3
    assert frame.image[row, 2 * middle - column, 0] < 60


def test_images_of_other_packages():
    made = phantom.calcified_wall()
    array, affine = made.volume.array, made.volume.world_from_index
    spacing, origin = made.volume.spacing.tolist(), made.volume.origin.tolist()
    simple = SimpleITK.GetImageFromArray(array)
    simple.SetSpacing(spacing)
    simple.SetOrigin(origin)
    nifti = nibabel.Nifti1Image(array.T, np.diag([-1.0, -1.0, 1.0, 1.0]) @ affine)
    grid = vtk.vtkImageData()
    grid.SetDimensions(*array.shape[::-1])
    grid.SetSpacing(*spacing)
    grid.SetOrigin(*origin)
    grid.GetPointData().SetScalars(numpy_to_vtk(array.ravel(), deep=True))
    camera = Camera.anterior(made.tree, (90, 80))
    expected = render(made.volume, made.tree, camera)
    assert np.ptp(expected.image[..., 0]) > 200
    for image in (simple, nifti, grid):
        np.testing.assert_array_equal(render(image, made.tree, camera).image, expected.image)


def test_defaults_of_the_view_and_the_window():
    made = phantom.helix()
    frame = render(made.volume, made.tree)
    expected = Camera.anterior(made.tree)
    assert (frame.camera.size, frame.camera.pixel_spacing) == (expected.size, expected.pixel_spacing)
    np.testing.assert_array_equal(frame.camera.center, expected.center)
    window = Window.from_data(made.volume, made.tree)
    assert Renderer(made.volume, made.tree).window == window
    again = render(made.volume, made.tree, expected, Settings(window=window))
    np.testing.assert_array_equal(again.image, frame.image)


def test_without_a_volume_there_is_a_cut_surface_but_no_picture():
    renderer = Renderer(None, wandering(2))
    assert np.isfinite(renderer.cut_surface().depth).all()
    with pytest.raises(VolumeError, match=r"found None; expected a volume to show; use cut_surface"):
        renderer.render()
    with pytest.raises(VolumeError, match="found None"):
        _ = renderer.window


def test_a_tree_that_misses_the_volume_is_refused_with_counts():
    volume = Volume(np.zeros((20, 20, 20), np.int16), origin=(100, 100, 0))
    points = np.array([[105.0, 105.0, 1.0], [110.0, 110.0, 9.0], [115.0, 112.0, 12.0]])
    Renderer(volume, VesselTree([Vessel(points)]))
    far = VesselTree([Vessel(points + 500)])
    text = r"vessel tree: found none of its 3 points inside the volume .*; expected points within \[99.5, "
    with pytest.raises(VesselTreeError, match=text) as caught:
        Renderer(volume, far)
    assert caught.value.mend == ""
    flipped = VesselTree([Vessel(points * (-1, -1, 1))])
    with pytest.raises(VesselTreeError, match=r'; 3 points would be inside as RAS: .*coordinates="ras"'):
        render(volume, flipped)
    most = VesselTree([Vessel(np.concatenate([points[:1], points * (-1, -1, 1)]))])
    with pytest.warns(SpaceWarning, match=r"1 of 4 points lie inside the volume as read, but 3 with x and y"):
        Renderer(volume, most)


@needs_shared_data
def test_centerlines_in_ras_read_as_lps(shared_data):
    volume = read_volume(shared_data / "aorta-mra" / "aorta.mha")
    path = shared_data / "aorta-mra" / "aorta-centerline.vtp"
    text = re.escape("none of its 347 points inside the volume") + ".*347 points would be inside as RAS"
    with pytest.raises(VesselTreeError, match=text):
        render(volume, read_centerlines(path))
    frame = render(volume, read_centerlines(path, "ras"))
    lumen = frame.value[(frame.distance < 1) & ~np.isnan(frame.value)]
    assert np.median(lumen) > 1.5 * np.nanmedian(volume.array)


def test_arguments_of_another_kind_are_refused():
    made = phantom.straight_tube()
    renderer = Renderer(made.volume, made.tree)
    for draw in (renderer.render, renderer.cut_surface):
        with pytest.raises(CameraError, match="camera: found Settings; expected a Camera or None"):
            draw(Settings())
        with pytest.raises(SettingsError, match="settings: found dict; expected Settings or None"):
            draw(None, {})
    with pytest.raises(VesselTreeError, match="tree: found list; expected a VesselTree"):
        Renderer(made.volume, list(made.tree))
    with pytest.raises(VolumeError, match=r"found .*bare array"):
        Renderer(made.volume.array, made.tree)
    with pytest.raises(SettingsError, match="device: found 'tpu'"):
        Renderer(made.volume, made.tree, device="tpu")
