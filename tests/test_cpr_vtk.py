"""CPR of real vessels: values as vtkProbeFilter computes them at the positions of the pixels."""

from __future__ import annotations

import numpy as np
import pytest
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter

from conftest import needs_shared_data
from cpr_scenes import trilinear
from device_scenes import scene
from lumencut import Volume, cpr, straightened_volume
from test_cpr import each_mode
from vtk_context import image_data


def probed(volume, points):
    """Return the values at world points (…, 3), NaN if VTK finds none; the grid must be axis-aligned."""
    data, places = vtkPolyData(), vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points.reshape(-1, 3)), deep=True))
    data.SetPoints(places)
    probe = vtkProbeFilter()
    probe.SetInputData(data)
    probe.SetSourceData(image_data(volume))
    probe.Update()
    found = probe.GetOutput().GetPointData()
    values = vtk_to_numpy(found.GetScalars()).astype(float)
    is_valid = vtk_to_numpy(found.GetArray("vtkValidPointMask")).astype(bool)
    return np.where(is_valid, values, np.nan).reshape(points.shape[:-1])


@needs_shared_data
@each_mode
def test_the_stent_as_vtk_sees_it(mode):
    volume, tree = scene("stent")
    as_float = Volume(volume.array.astype(np.float64), world_from_index=volume.world_from_index)
    for vessel in (tree.path([0, 1, 4]), tree[6]):
        made = cpr(volume, vessel, mode, pixel_spacing=0.5, smoothing=1.0, slab=None)
        expected = probed(as_float, made.position)
        sure = ~np.isnan(expected) & ~np.isnan(made.value)
        assert sure.mean() > 0.7
        # For values up to 2000, this is the rounding of 32-bit floats.
        assert np.abs(made.value - expected)[sure].max() < 0.01


@needs_shared_data
@each_mode
def test_the_dissection_as_numpy_sees_it(mode):
    volume, tree = scene("dissection")
    for vessel in tree:
        made = cpr(volume, vessel, mode, smoothing=1.0)
        expected = trilinear(volume, made.position)
        sure = ~np.isnan(expected)
        assert sure.mean() > 0.5
        assert np.abs(made.value - expected)[sure].max() < 0.05


@needs_shared_data
@pytest.mark.parametrize("data", ["stent", "dissection"])
def test_the_lumen_lies_in_the_middle_of_sections(data):
    volume, tree = scene(data)
    for vessel in tree:
        made = straightened_volume(volume, vessel, 4, smoothing=1.0)
        middle = made.volume.array[:, 2:-2, 2:-2] if made.volume.size[0] > 4 else made.volume.array
        assert np.nanmedian(middle) == pytest.approx(np.nanmedian(volume.sample(vessel.points)), rel=0.2)
