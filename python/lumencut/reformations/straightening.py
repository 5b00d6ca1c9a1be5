"""The straightened volume: sections across a vessel, and the conversion between its voxels and the world."""

from __future__ import annotations

import functools
import os
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import number, numbers
from lumencut.base.mends import advised
from lumencut.base.paths import WRITABLE, checked_path
from lumencut.errors import CameraError
from lumencut.files.volume_writers import write_volume
from lumencut.pictures.picture_file import check_dicom_alone
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.checks import check_vessel
from lumencut.reformations.planar_reformation import CprRequest, PlanarReformation, one_angle
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

#: Largest number of voxels of a straightened volume: two gigabytes of floats.
_MOST_VOXELS = 1 << 29

#: Number of voxels that are sampled in one call.
_TOGETHER = 1 << 20

#: A comment that viewers show with each image of the series, after the letters of its sides.
_PLACE = "Position and sides are those of a patient whose vessel is straight"


class StraightenedVolume:
    """A vessel and its surroundings, straightened; made by :func:`lumencut.straightened_volume`.

    Attributes
    ----------
    volume : Volume
        float32 voxels [k, j, i], NaN outside the volume they come from. Slice k is the section across the
        vessel at arc length k times the spacing. i runs to the right in a straightened CPR from the same
        side, j away from its viewer, k along the vessel. Its own coordinates (mm) are those of a patient
        whose vessel is straight and begins at the origin: i, j and k state the signed axes of the patient
        that are nearest to the true ones at the middle of the vessel, with the same handedness.
    sides : str
        The letters of the sides that i, j and k state, such as ``"RPS"`` for a vessel that runs to the head.
    notes : tuple of str
        Notes on these sides, a sentence each: that the vessel runs across the body at its
        middle, that along it a true axis is more than 45° off its side, or that the scan states no
        orientation.
    """

    def __init__(self, volume: Volume, surface: PlanarReformation, mark: str) -> None:
        self.volume: Volume = volume
        found = _lumencut.straightened_mark(mark)
        assert found is not None, "the core reads its own output"
        self.sides: str = found[0]
        self.notes: tuple[str, ...] = tuple(found[1])
        self._core, self._surface, self._mark = surface._core, surface, mark

    @property
    def arc_length(self) -> npt.NDArray[np.float64]:
        """Length of the vessel from its first point to each section (mm), shape (n,)."""
        return self._core.arc_length()

    def world_from_index(self, indices: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return the world points (n, 3) (mm, LPS) of voxels (n, 3): i, j and k, with fractions."""
        places = numbers(CameraError, "indices of the straightened volume", indices, (-1, 3))
        scale, origin = self._grid
        return self._core.world_from_straightened(places * scale + origin)

    def index_from_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return the voxels (n, 3), i, j and k with fractions, of world points (n, 3) (mm, LPS).

        The inverse of :meth:`world_from_index` wherever sections do not meet. A point in several sections
        lies in that whose centre is nearest.
        """
        checked = numbers(CameraError, "points of the straightened volume", points, (-1, 3))
        scale, origin = self._grid
        return (self._core.straightened_from_world(checked) - origin) / scale

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        study: Any = None,
        anonymous: bool = False,
        other_patient: bool = False,
    ) -> None:
        """Write the volume as ``.nrrd``, ``.nii`` or ``.nii.gz``; the file appears only when complete.

        A name without an extension is a folder, which must not exist yet: a series of derived CT or MR images
        is written into it, one for each section, with its own frame of reference. The letters of sides that
        viewers show on them are those of the straightened patient. Each file also says its :attr:`notes`,
        which ``lumencut info`` repeats.

        Parameters
        ----------
        path : path-like
            The file or folder.
        study, anonymous, other_patient
            For a folder, as in :meth:`Frame.save`.

        Raises
        ------
        FormatError
            For another extension; for a folder without exactly one study of CT or MR.
        SettingsError
            For what only a folder can hold.
        FileError
            If the file cannot be written.
        """
        place = checked_path(path, WRITABLE)
        if place.suffix:
            check_dicom_alone(place, study=study, anonymous=anonymous, other_patient=other_patient)
            write_volume(self.volume, place, self._mark)
            return
        from lumencut.reformations.straightened_series import write_straightened

        surface = self._surface
        found = surface._study(study, anonymous=anonymous, other_patient=other_patient)
        is_whole = surface._known_volume().dtype.kind in "iu"
        about = (surface.recipe, surface.settings, surface.shown_window)
        said = ". ".join([self._mark, _PLACE, *self.notes])
        write_straightened(place, self.volume, about, found, said, is_whole=is_whole)

    def __repr__(self) -> str:
        """Return the size."""
        return f"StraightenedVolume({self.volume!r})"

    @functools.cached_property
    def _grid(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Return scale and origin that convert i, j and k to distances across, ahead and along (mm)."""
        affine, step = self.volume.world_from_index, self.volume.spacing
        return step, (affine[:3, :3] / step).T @ affine[:3, 3]


def straightened_volume(
    volume: Any,
    vessel: Vessel,
    width: float = 50.0,
    pixel_spacing: float | None = None,
    angle: float = 0.0,
    up: npt.ArrayLike = (0.0, 0.0, 1.0),
    smoothing: float = 0.0,
    *,
    degrees: float | None = None,
    normal: npt.ArrayLike | None = None,
) -> StraightenedVolume:
    """Return the sections across a vessel as a volume.

    The middle slice along j is the straightened CPR with the same parameters.

    Parameters
    ----------
    volume, vessel, pixel_spacing, angle, up, smoothing, degrees, normal
        As for :func:`lumencut.cpr`; ``pixel_spacing`` is that along all axes.
    width : float, default 50
        Distance of the outermost voxels of a section (mm), at most, along both of its axes.

    Raises
    ------
    LumencutError
        As :func:`lumencut.cpr`, and a ``CameraError`` for more than 2^29 voxels.
    """
    check_vessel(vessel)
    from lumencut.scene.images import as_volume

    source = as_volume(volume)
    renderer = Renderer(source, VesselTree([vessel]), "cpu")
    wide, turned = number(CameraError, "width of the CPR", width), one_angle(angle, degrees)
    asked = CprRequest("straightened", wide, pixel_spacing, turned, up, smoothing=smoothing, normal=normal)
    surface = asked.of(renderer, vessel)
    columns, sections = surface.size
    if columns * columns * sections > _MOST_VOXELS:
        found = f"{columns} × {columns} × {sections} voxels"
        mend = advised("", [("fewer_pixels", ())])
        raise CameraError("size of the straightened volume", found, f"at most {_MOST_VOXELS}", mend)
    step = surface.pixel_spacing
    side = (np.arange(columns) - columns // 2) * step
    array = np.empty((sections, columns, columns), np.float32)
    axes, mark = surface._core.straightened_sides(step, source.states_orientation)
    straight = Volume(
        array,
        world_from_index=_affine(np.array(axes), step, side[0]),
        states_spacing=source.states_spacing,
        states_orientation=source.states_orientation,
    )
    made = StraightenedVolume(straight, surface, mark)
    together = max(1, _TOGETHER // columns**2)
    for first in range(0, sections, together):
        k = np.arange(first, min(first + together, sections))
        along, ahead, across = np.meshgrid(k * step, side, side, indexing="ij")
        places = np.stack([across, ahead, along], axis=-1).reshape(-1, 3)
        array[k] = source.sample(surface._core.world_from_straightened(places)).reshape(-1, columns, columns)
    return made


def _affine(axes: npt.NDArray[np.float64], step: float, first: float) -> npt.NDArray[np.float64]:
    """Return world from index of a straightened volume, whose vessel begins at the origin.

    Rows of `axes` are the directions (LPS) of i, j and k; `first` is the place of the first i and j (mm).
    """
    affine = np.eye(4)
    affine[:3, :3] = axes.T * step
    affine[:3, 3] = (axes[0] + axes[1]) * first
    return affine
