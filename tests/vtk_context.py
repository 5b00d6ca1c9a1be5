"""The same view drawn by VTK's CPU ray caster, as far as VTK supports it."""

from __future__ import annotations

import ctypes
import re

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkVolumeProperty,
)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper

# These imports register the windows, also off-screen ones, and the display of the ray caster's image.
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401  isort: skip


def image_data(volume):
    """The voxels with spacing and origin; its axes must be those of the world."""
    if not np.array_equal(volume.direction, np.eye(3)):
        raise ValueError("VTK's ray caster knows no direction")
    data = vtkImageData()
    data.SetDimensions(*volume.size)
    data.SetSpacing(*volume.spacing)
    data.SetOrigin(*volume.origin)
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(volume.array).reshape(-1), deep=True))
    return data


def volume_property(points, mode, shading):
    """Return the transfer function: linear between its points, opacity per mm; opaque for maxima."""
    colour, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
    for intensity, rgb, per_mm in points:
        colour.AddRGBPoint(intensity, *(c / 255 for c in rgb))
        opacity.AddPoint(intensity, 1.0 if mode == "mip" else per_mm)
    made = vtkVolumeProperty()
    made.SetColor(colour)
    made.SetScalarOpacity(opacity)
    made.SetScalarOpacityUnitDistance(1.0)
    made.SetInterpolationTypeToLinear()
    made.SetShade(shading)
    made.SetAmbient(0.4)
    made.SetDiffuse(0.6)
    made.SetSpecular(0.2)
    made.SetSpecularPower(16)
    return made


class Drawing:
    """An off-screen window that shows one volume through one camera."""

    def __init__(self, volume, camera, mode, points, step, *, shading=False, threads=None):
        self.mapper = vtkFixedPointVolumeRayCastMapper()
        self.mapper.SetInputData(image_data(volume))
        self.mapper.AutoAdjustSampleDistancesOff()
        self.mapper.SetImageSampleDistance(1.0)
        self.mapper.SetSampleDistance(step)
        self.mapper.SetInteractiveSampleDistance(step)
        if threads:
            self.mapper.SetNumberOfThreads(threads)
        if mode == "mip":
            self.mapper.SetBlendModeToMaximumIntensity()
        else:
            self.mapper.SetBlendModeToComposite()
        shown = vtkVolume()
        shown.SetMapper(self.mapper)
        shown.SetProperty(volume_property(points, mode, shading))
        renderer = vtkRenderer()
        renderer.AddVolume(shown)
        self.camera = renderer.GetActiveCamera()
        self.camera.ParallelProjectionOn()
        self.camera.SetParallelScale(camera.size[1] * camera.pixel_spacing / 2)
        reach = np.linalg.norm(volume.corners - camera.center, axis=1).max()
        self.camera.SetFocalPoint(*camera.center)
        self.camera.SetPosition(*(camera.center - 2 * reach * camera.direction))
        self.camera.SetViewUp(*camera.up)
        renderer.ResetCameraClippingRange()
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*camera.size)
        self.window.AddRenderer(renderer)

    def render(self):
        """Draw the view again."""
        self.camera.Modified()
        self.window.Render()

    def image(self):
        """Return the ray caster's own image: premultiplied colours and opacity, 0 to 1, (H, W, 4).

        The window shows it stretched by a pixel, so it is read from memory, with 15 bits per channel.
        """
        self.render()
        rays = self.mapper.GetRayCastImage()
        (columns, rows), (width, height) = rays.GetImageMemorySize(), rays.GetImageInUseSize()
        address = int(re.match(r"_([0-9a-f]+)_p_void$", rays.GetImage())[1], 16)
        memory = (ctypes.c_uint16 * (rows * columns * 4)).from_address(address)
        used = np.frombuffer(memory, np.uint16).reshape(rows, columns, 4)[:height, :width] / 32767
        across, high = rays.GetImageViewportSize()
        image = np.zeros((high, across, 4))
        left, bottom = rays.GetImageOrigin()
        image[bottom : bottom + height, left : left + width] = used
        return image[::-1]
