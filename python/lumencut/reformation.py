"""A vessel laid out as an image: what Curved Planar Reformation leaves behind."""

from __future__ import annotations

import functools
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut._checked_settings import checked
from lumencut._checks import number, numbers
from lumencut._files import WRITABLE, checked_path, replace_whole
from lumencut.errors import CameraError
from lumencut.frame import picture_as_png, save_picture
from lumencut.renderer import Renderer
from lumencut.settings import Settings
from lumencut.window import Window

#: What a file of arrays holds.
_ARRAYS = ("image", "value", "position", "arc_length", "folded")


class Reformation:
    """One vessel as an image (H, W) of its surroundings, made by :func:`lumencut.cpr`.

    Rows run from the vessel's first point at the top to its last one (projected: from the highest point to
    the lowest). The vessel lies in or about the middle column. No picture is mirrored. Each image is made
    when it is first asked for, from the volume, whose voxels must not be changed meanwhile.

    Attributes
    ----------
    mode : {"projected", "stretched", "straightened"}
        How the vessel is laid out.
    angle : float
        By how much the viewer has moved to the right (radians).
    pixel_spacing : float
        Side of a pixel (mm).
    settings : Settings
        The settings, with numbers for the window; one from the data is found when they, or the picture, are
        first asked for.
    timings : dict of str to float
        Wall time of each stage of what was last made (ms): ``"places"`` found where the pixels look. Empty
        before anything was made.
    """

    def __init__(
        self,
        renderer: Renderer,
        core: _lumencut.Cpr,
        given: Settings,
        mode: str,
        angle: float,
        spacing: float,
    ) -> None:
        self._renderer, self._core, self._given = renderer, core, given
        self.mode, self.angle, self.pixel_spacing = mode, angle, spacing
        self.timings: dict[str, float] = {}

    def __repr__(self) -> str:
        """Return the mode and the size."""
        width, height = self.size
        return f"Reformation({self.mode}, {width} × {height} pixels of {self.pixel_spacing:.4g} mm)"

    def _repr_png_(self) -> bytes:
        """Return the picture as Jupyter shows it."""
        return picture_as_png(self.image)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height (pixels)."""
        width, height = self._core.size
        return width, height

    @property
    def measurable(self) -> bool:
        """Whether distances along the vessel and across it are true in the image: not so where projected."""
        return self.mode != "projected"

    @functools.cached_property
    def settings(self) -> Settings:
        """The settings, with numbers for the window."""
        return self._renderer.windowed(self._given)

    @functools.cached_property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4); what lies outside the volume is transparent."""
        made = self._look(self.settings, "image", "value")
        # One look gives both.
        self.__dict__.setdefault("value", made["value"])
        image: npt.NDArray[np.uint8] = made["image"]
        return image

    @functools.cached_property
    def value(self) -> npt.NDArray[np.float32]:
        """The volume where the pixels look, float32, shape (H, W), NaN outside the volume."""
        value: npt.NDArray[np.float32] = self._look(self._given, "value")["value"]
        return value

    def _look(self, settings: Settings, *images: str) -> dict[str, Any]:
        volume = self._renderer.volume
        made: dict[str, Any] = self._renderer._core.look(volume, self._core, checked(settings), list(images))
        self.timings = made.pop("timings")
        return made

    @functools.cached_property
    def position(self) -> npt.NDArray[np.float64]:
        """World point (mm, LPS) of each pixel, float64, shape (H, W, 3)."""
        return self._core.position()

    @functools.cached_property
    def arc_length(self) -> npt.NDArray[np.float64]:
        """Length of the vessel from its first point to each row (mm), float64, shape (H,).

        Where several points of the vessel share a row (projected), that of the first of them.
        """
        return self._core.arc_length()

    @functools.cached_property
    def folded(self) -> npt.NDArray[np.bool_]:
        """Which pixels are not to be trusted, bool, shape (H, W).

        Straightened and stretched: lines across the vessel have met before they reach the pixel, so that the
        image runs backwards there, or shows what it shows nearer to the vessel in another row. Projected:
        several points of the vessel share the row.
        """
        return self._core.folded()

    def world_from_pixel(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return the world points that places in the image show.

        Parameters
        ----------
        points : array_like, shape (n, 2) or (2,)
            Column and row (pixels, with fractions); the centre of the first pixel is (0, 0). Beyond the image
            the vessel goes on straight.

        Returns
        -------
        numpy.ndarray, shape (n, 3)
            World points (mm, LPS).

        Raises
        ------
        CameraError
            For points of another shape, or that are not finite.
        """
        return self._core.world_from_pixel(_points(points, 2))

    def pixel_from_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return where the image shows world points: the inverse of :meth:`world_from_pixel` off the folds.

        A point that the image shows several times lies where it is nearest to the vessel. One that it does
        not show lies, projected, where the viewer sees it; stretched, where the surface of the image is
        nearest; straightened, in that of the sections through the point whose centre is nearest.

        Parameters
        ----------
        points : array_like, shape (n, 3) or (3,)
            World points (mm, LPS).

        Returns
        -------
        numpy.ndarray, shape (n, 2)
            Column and row (pixels, with fractions), also beyond the image.

        Raises
        ------
        CameraError
            For points of another shape, or that are not finite.
        """
        return self._core.pixel_from_world(_points(points, 3))

    def rotated(self, angle: float | None = None, *, degrees: float | None = None) -> Reformation:
        """Return the same vessel seen from another side; renderer, volume and frames are used again.

        Without a width of its own a projected or stretched image is as wide as the vessel from that side.

        Parameters
        ----------
        angle : float
            By how much more the viewer moves to the right (radians): around up as with
            :meth:`Camera.rotated`, and around the vessel where it is straightened.
        degrees : float
            The angle in degrees, in the place of ``angle``.

        Raises
        ------
        CameraError
            For both angles or neither, or one that is no finite number.
        """
        if (angle is None) == (degrees is None):
            found = "neither" if angle is None else "an angle in radians and one in degrees"
            raise CameraError("angle of the rotation", found, "one of angle= (radians) and degrees=")
        turned = self.angle + radians("angle of the rotation", angle, degrees)
        core = self._core.rotated(turned)
        return Reformation(self._renderer, core, self._given, self.mode, turned, self.pixel_spacing)

    def annotated(self) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8, shape (H, W, 4); a side below 200 pixels gets none.

        The labels are the mode with the angle, the window, a scale bar where distances can be measured, and,
        unless straightened, the sides of the patient.
        """
        from lumencut.annotation import window_words, with_labels

        volume, window = self._renderer.volume, self.settings.window
        words = [f"{self.mode} {round(math.degrees(self.angle)) % 360}°"]
        words += [window_words(window)] if isinstance(window, Window) else []
        letters = self._edges() if volume is not None and volume.states_orientation else {}
        has_scale = self.measurable and volume is not None and volume.states_spacing
        return with_labels(self.image, words, letters, self.pixel_spacing if has_scale else None)

    def _edges(self) -> dict[str, str]:
        """The sides of the patient that edges look to, as far as they do so in all rows."""
        if self.mode == "straightened":
            return {}
        # Above the image it goes on straight, and no two points of the vessel share a row.
        origin, *ends = self.world_from_pixel([[0, -2], [1, -2], [0, -1]])
        right, down = np.array(ends) - origin
        named = ("left", "right", "top", "bottom") if self.mode == "projected" else ("left", "right")
        return {edge: letters for edge, letters in _lumencut.edge_letters(right, down) if edge in named}

    def save(self, path: str | os.PathLike[str], *, annotate: bool = False) -> None:
        """Write the picture, or with the ending ``.npz`` all arrays; a file appears only once it is whole.

        Parameters
        ----------
        path : path-like
            The ending names the format: a picture format of Pillow (``.png``, ``.tif``, …) or ``.npz``, which
            holds ``image``, ``value``, ``position``, ``arc_length`` and ``folded``.
        annotate : bool, default False
            Write the picture with labels, see :meth:`annotated`.

        Raises
        ------
        FormatError
            For an ending that names no format.
        FileError
            Where the file cannot be written.
        """
        path = checked_path(path, WRITABLE)
        if path.suffix.lower() == ".npz":
            replace_whole(path, self._write_arrays)
        else:
            save_picture(self.annotated() if annotate else self.image, path)

    def _write_arrays(self, path: Path) -> None:
        arrays: dict[str, Any] = {name: getattr(self, name) for name in _ARRAYS}
        with path.open("wb") as file:
            np.savez_compressed(file, **arrays)


def radians(subject: str, angle: float | None, degrees: float | None) -> float:
    """Return the one of two angles that is given, in radians."""
    if degrees is not None:
        return math.radians(number(CameraError, subject.replace("angle", "degrees"), degrees))
    return number(CameraError, subject, angle)


def _points(points: npt.ArrayLike, count: int) -> npt.NDArray[np.float64]:
    """Points as finite numbers of shape (n, count)."""
    try:
        shape = (count,) if np.ndim(points) == 1 else (-1, count)
    except ValueError:  # lists of several lengths
        shape = (-1, count)
    array = numbers(CameraError, "points of the CPR", points, shape).reshape(-1, count)
    if not np.isfinite(array).all():
        raise CameraError("points of the CPR", "numbers that are not finite", "finite numbers")
    return array
