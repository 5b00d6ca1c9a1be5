"""The point in the volume that a click on a pixel picks."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import numbers
from lumencut.errors import CameraError
from lumencut.scene.camera import Camera
from lumencut.scene.images import as_volume
from lumencut.scene.volume import Volume


def brightest(
    volume: Volume | Any,
    camera: Camera,
    pixel: npt.ArrayLike,
    depths: npt.ArrayLike = (-np.inf, np.inf),
) -> npt.NDArray[np.float64]:
    """Return the brightest point on the ray of a pixel, which a click on a MIP picks, as in the viewer.

    The ray is sampled in steps of half the smallest side of a voxel, from the first voxel to the last. Of
    several equally bright points, the one nearest to the viewer is taken.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography.
    camera : Camera
        The view.
    pixel : array_like, shape (2,)
        Column and row, from (0, 0) in the middle of the pixel at the top left; parts of pixels are allowed.
    depths : array_like, shape (2,), default from minus to plus infinity
        Only places between these depths count (mm, from the plane of ``camera.center``, positive away from
        the viewer), as within a slab.

    Returns
    -------
    numpy.ndarray, shape (3,)
        The place (mm, LPS), such as a point for :func:`lumencut.trace`.

    Raises
    ------
    TracingError
        For a ray that meets no voxel between the depths.
    CameraError
        For another kind of camera, pixel or depths.
    VolumeError
        For anything that is not a volume.
    """
    if not isinstance(camera, Camera):
        raise CameraError("camera", type(camera).__name__, "a Camera")
    place = _lumencut.brightest(
        as_volume(volume),
        camera,
        tuple(numbers(CameraError, "pixel", pixel, (2,)).tolist()),
        tuple(numbers(CameraError, "depths", depths, (2,)).tolist()),
    )
    return np.array(place)
