"""The part of a volume that a view can show."""

from __future__ import annotations

import itertools
import weakref
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.scene.checked_settings import checked
from lumencut.scene.volume_pyramid import VolumePyramid

if TYPE_CHECKING:
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.volume import Volume

#: Planes that meet at an angle below about this (radians) have no corner.
_PARALLEL = 1e-9
#: A corner may lie this far beyond a plane by rounding (mm).
_ROUNDING = 1e-6


class PartsInView:
    """What renders the views of a scene, and the volume that each of them reads.

    Parameters
    ----------
    core : _lumencut.Renderer
        Renders views of the whole volume.
    """

    def __init__(self, core: _lumencut.Renderer) -> None:
        self._core = core
        self._last: tuple[_lumencut.Renderer, weakref.ref[Volume]] | None = None

    def shown(
        self, volume: Volume, has_tree: bool, camera: Camera, settings: Settings
    ) -> tuple[_lumencut.Renderer, Volume]:
        """Return what renders a view, and the volume to read: of a pyramid, only what the view can show."""
        if not isinstance(volume, VolumePyramid):
            return self._core, volume
        part = _part_in_view(volume, self._core, camera, settings, has_tree=has_tree)
        if self._last is None or self._last[1]() is not part:
            # The pyramid alone keeps a part in memory.
            self._last = self._core.with_other_volume(), weakref.ref(part)
        return self._last[0], part


def _part_in_view(
    pyramid: VolumePyramid, core: _lumencut.Renderer, camera: Camera, settings: Settings, *, has_tree: bool
) -> Volume:
    """Return the part of a pyramid that a view shows, at the level that fits its pixels.

    A context shows all in front of and behind the pixels; without one, the cut surface is all that is read.
    """
    if settings.context is not None or not has_tree:
        return pyramid.part(corners_in_view(pyramid, camera), spacing=camera.pixel_spacing)
    depth = core.render(None, camera, checked(settings), ["depth"])["depth"]
    height, width = depth.shape
    across = (np.arange(width) + 0.5 - width / 2) * camera.pixel_spacing
    upwards = (height / 2 - np.arange(height) - 0.5) * camera.pixel_spacing
    places = np.asarray(camera.center) + (
        across[None, :, None] * camera.right_axis
        + upwards[:, None, None] * camera.up
        + depth[..., None].astype(np.float64) * camera.direction
    )
    # Further samples of a pixel lie next to its middle.
    reach = camera.pixel_spacing + (0.0 if settings.slab is None else settings.slab.thickness / 2)
    inside = places[pyramid.contains(places.reshape(-1, 3)).reshape(height, width)]
    return pyramid.part(inside, reach, camera.pixel_spacing)


def corners_in_view(volume: Volume, camera: Camera) -> npt.NDArray[np.float64]:
    """Return the corners of the part of a volume in front of or behind the pixels of a view, (n, 3) mm LPS.

    Both are convex, so the part lies between its corners; without one, the view shows no part of the volume.
    """
    normals, offsets = map(np.concatenate, zip(_of_box(volume), _of_view(camera), strict=True))
    corners = []
    for three in itertools.combinations(range(len(normals)), 3):
        planes = normals[list(three)]
        if abs(np.linalg.det(planes)) > _PARALLEL:
            corners.append(np.linalg.solve(planes, offsets[list(three)]))
    points = np.array(corners).reshape(-1, 3)
    inside = (points @ normals.T <= offsets + _ROUNDING).all(axis=1)
    return np.asarray(points[inside], np.float64)


def _of_box(volume: Volume) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return the planes around a volume: unit normals outwards, and their distances from the origin (mm)."""
    index_from_world = np.linalg.inv(volume.world_from_index)
    rows, shifts = index_from_world[:3, :3], index_from_world[:3, 3]
    lengths = np.linalg.norm(rows, axis=1)
    highest = np.asarray(volume.size) - 0.5
    normals = np.concatenate([rows, -rows]) / np.tile(lengths, 2)[:, None]
    return normals, np.concatenate([highest - shifts, 0.5 + shifts]) / np.tile(lengths, 2)


def _of_view(camera: Camera) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return the planes around the pixels of a view, as `_of_box` does."""
    axes = np.array([camera.right_axis, camera.up])
    half = np.asarray(camera.size) / 2 * camera.pixel_spacing
    middle = axes @ np.asarray(camera.center)
    return np.concatenate([axes, -axes]), np.concatenate([middle + half, half - middle])
