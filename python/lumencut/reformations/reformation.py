"""Base of all reformations that lay vessels out as an image."""

from __future__ import annotations

import functools
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import flag, numbers
from lumencut.base.paths import WRITABLE, checked_path, replace_whole
from lumencut.errors import CameraError, SettingsError
from lumencut.pictures.picture_file import check_dicom_alone, picture_as_png, save_picture
from lumencut.pictures.renderer import Renderer
from lumencut.scene.checked_settings import checked
from lumencut.scene.settings import Settings
from lumencut.scene.volume import Volume
from lumencut.scene.volume_pyramid import VolumePyramid
from lumencut.scene.window import Window

if TYPE_CHECKING:
    from lumencut.dicom.writing.picture import Picture
    from lumencut.pictures.reformation_recipe import ReformationRecipe
    from lumencut.scene.study import Study

#: Narrower pictures (pixels) get no label with a sentence.
_WIDE = 400


class Reformation:
    """Vessels as an image (H, W) of their surroundings; each pixel shows its own point in the world.

    Each image is computed on first use from the volume, whose voxels must not be changed
    meanwhile. :func:`lumencut.cpr` and the other reformations return one, some with more attributes.

    Attributes
    ----------
    recipe : ReformationRecipe
        The name of the reformation, a description of its rows and columns, and its parameters.
    pixel_spacing : float
        Side of a pixel (mm).
    measurable : bool
        Whether distances along rows and columns are true in the image.
    settings : Settings
        The settings, with numbers for the window; one from the data is found on first use of settings or
        picture.
    timings : dict of str to float
        Wall time of each stage of the last computation (ms); ``"places"`` finds the places that pixels show.
        Empty at first.
    """

    #: Whether distances in the image are projected ones, so that a ruler may measure them.
    is_projection: bool = False
    _arrays: tuple[str, ...] = ("image", "value", "position", "arc_length", "folded")

    def __init__(
        self,
        renderer: Renderer,
        core: _lumencut.Layout,
        given: Settings,
        recipe: ReformationRecipe,
        *,
        measurable: bool,
    ) -> None:
        self._renderer, self._core, self._given = renderer, core, given
        self.recipe: ReformationRecipe = recipe
        self.measurable: bool = measurable
        self.pixel_spacing: float = core.pixel_spacing
        self.timings: dict[str, float] = {}

    def __repr__(self) -> str:
        """Return the name and the size."""
        width, height = self.size
        pixels = f"{width} × {height} pixels of {self.pixel_spacing:.4g} mm"
        return f"{type(self).__name__}({self.recipe.name}, {pixels})"

    def _repr_png_(self) -> bytes:
        """Return the picture as Jupyter shows it."""
        return picture_as_png(self.image)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height (pixels)."""
        width, height = self._core.size
        return width, height

    @functools.cached_property
    def settings(self) -> Settings:
        """The settings, with numbers for the window."""
        return self._renderer.windowed(self._given)

    @property
    def shown_window(self) -> Window | None:
        """The window in which the picture is shown; None if it shows no values of the volume."""
        window = self.settings.window
        return window if isinstance(window, Window) else None

    @functools.cached_property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4); transparent outside the volume."""
        made = self._look(self.settings, "image", "value")
        self.__dict__.setdefault("value", made["value"])
        image: npt.NDArray[np.uint8] = made["image"]
        return image

    @functools.cached_property
    def value(self) -> npt.NDArray[np.float32]:
        """The volume at the places of the pixels, float32, shape (H, W), NaN outside the volume."""
        value: npt.NDArray[np.float32] = self._look(self._given, "value")["value"]
        return value

    @functools.cached_property
    def _source(self) -> tuple[_lumencut.Renderer, Volume | None]:
        """What samples the pixels, and the volume to read: of a pyramid, only what the pixels show."""
        core, volume = self._renderer._core, self._renderer.volume
        if not isinstance(volume, VolumePyramid):
            return core, volume
        slab = self._given.slab
        places = self.position[np.isfinite(self.position).all(axis=-1)]
        reach = 0.0 if slab is None else slab.thickness / 2
        return core.with_other_volume(), volume.part(places, reach, self.pixel_spacing)

    def _look(self, settings: Settings, *images: str) -> dict[str, Any]:
        return self._shown(self._core, settings, *images)

    def _shown(self, layout: _lumencut.Layout, settings: Settings, *images: str) -> dict[str, Any]:
        core, volume = self._source
        made: dict[str, Any] = core.look(volume, layout, checked(settings), list(images))
        self.timings = made.pop("timings")
        return made

    @functools.cached_property
    def position(self) -> npt.NDArray[np.float64]:
        """World point (mm, LPS) of each pixel, float64, shape (H, W, 3)."""
        return self._core.position()

    @functools.cached_property
    def arc_length(self) -> npt.NDArray[np.float64]:
        """Length of the vessel from its first point (mm), float64.

        Shape (H,) where the rows run along one vessel; else (H, W), NaN where nothing is shown.
        """
        width, height = self.size
        along = self._core.arc_length()
        return along if len(along) == height else along.reshape(height, width)

    @functools.cached_property
    def folded(self) -> npt.NDArray[np.bool_]:
        """Unreliable pixels, bool, shape (H, W).

        The image runs backwards there, or repeats what it shows elsewhere.
        """
        return self._core.folded()

    def world_from_pixel(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return the world points that places in the image show.

        Parameters
        ----------
        points : array_like, shape (n, 2) or (2,)
            Column and row (pixels, with fractions); the centre of the first pixel is (0, 0).

        Returns
        -------
        numpy.ndarray, shape (n, 3)
            World points (mm, LPS), NaN where nothing is shown.

        Raises
        ------
        CameraError
            For points of another shape, or that are not finite.
        """
        return self._core.world_from_pixel(_points(points, 2))

    def pixel_from_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return where the image shows world points: the inverse of :meth:`world_from_pixel` off the folds.

        Parameters
        ----------
        points : array_like, shape (n, 3) or (3,)
            World points (mm, LPS).

        Returns
        -------
        numpy.ndarray, shape (n, 2)
            Column and row (pixels, with fractions); NaN for what the reformation does not show, except that a
            CPR gives every point a place (see :class:`PlanarReformation`).

        Raises
        ------
        CameraError
            For points of another shape, or that are not finite.
        """
        return self._core.pixel_from_world(_points(points, 3))

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8, shape (H, W, 4); a side below 200 pixels gets none.

        The labels are the name of the reformation, the window, the meaning of rows and columns (on pictures
        of at least 400 columns), a scale bar if distances can be measured, and the sides of the patient at
        the edges.

        Parameters
        ----------
        vessel_names : bool, default True
            Whether a reformation that labels vessels writes their names; otherwise it writes their ids.
        """
        from lumencut.pictures.annotation import window_words, with_labels

        volume, window = self._renderer.volume, self.shown_window
        words = [self._title()]
        words += [] if window is None else [window_words(window)]
        # On a narrow picture the sentence would cover the content; the file also contains it.
        words += [self.recipe.axes] if self.size[0] >= _WIDE else []
        letters = self._edges() if volume is not None and volume.states_orientation else {}
        has_scale = self.measurable and volume is not None and volume.states_spacing
        return with_labels(self.image, words, letters, self.pixel_spacing if has_scale else None)

    def _title(self) -> str:
        """Return the first label of the picture."""
        return self.recipe.name

    def _edges(self) -> dict[str, str]:
        """Return the sides of the patient at the edges."""
        return {}

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        annotate: bool = False,
        study: Any = None,
        anonymous: bool = False,
        other_patient: bool = False,
        compress: bool = False,
    ) -> None:
        """Write the picture, or with the extension ``.npz`` all arrays; a file appears only when complete.

        Parameters
        ----------
        path : path-like
            The extension selects the format: one of Pillow (``.png``, ``.tif``, …) or ``.npz``, which holds
            ``image``, ``value``, ``position``, ``arc_length`` and ``folded``. A ``.png`` also states the
            meaning of its rows and columns, and how it was made. ``.dcm`` is a DICOM Secondary Capture.
        annotate : bool, default False
            Write the picture with labels, see :meth:`annotated`.
        study, anonymous, other_patient, compress
            For ``.dcm``, as in :meth:`Frame.save`. The object states the size of a pixel only where the
            picture is a projection: a ruler across any other would be wrong.

        Raises
        ------
        FormatError
            For an unknown extension; for ``.dcm`` without exactly one study.
        FileError
            If the file cannot be written.
        SettingsError
            For options that only ``.dcm`` supports.
        """
        path = checked_path(path, WRITABLE)
        flag(SettingsError, "annotate", annotate)
        if path.suffix.lower() == ".dcm":
            from lumencut.dicom.writing.picture import write_picture

            made = self._as_object(annotate=annotate, vessel_names=not anonymous)
            found = self._study(study, anonymous=anonymous, other_patient=other_patient)
            write_picture(path, made, found, compress=compress)
            return
        dicom = {"study": study, "anonymous": anonymous, "other_patient": other_patient}
        check_dicom_alone(path, **dicom, compress=compress)
        if path.suffix.lower() == ".npz":
            replace_whole(path, self._write_arrays)
        else:
            from lumencut.pictures.reformation_recipe import png_options

            image = self.annotated() if annotate else self.image
            save_picture(image, path, png_options(self.recipe, self.settings))

    def _as_object(self, *, annotate: bool, vessel_names: bool) -> Picture:
        """Return the picture with the description for its DICOM object."""
        from lumencut.pictures.dicom_views import reformed_picture

        volume = self._renderer.volume
        edges = self._edges() if volume is not None and volume.states_orientation else {}
        is_true = self.is_projection and volume is not None and volume.states_spacing
        image = self.annotated(vessel_names=vessel_names) if annotate else self.image
        return reformed_picture(
            image, self.recipe, self.settings, edges, self.pixel_spacing if is_true else None
        )

    def _study(self, study: Any, *, anonymous: bool, other_patient: bool = False) -> Study:
        """Return the study into which DICOM objects of the reformation are put."""
        from lumencut.dicom.writing.chosen_study import chosen_study

        origin = self._known_volume()._origin
        return chosen_study(origin, study, anonymous=anonymous, other_patient=other_patient)

    def _known_volume(self) -> Volume:
        volume = self._renderer.volume
        assert volume is not None, "a reformation shows a volume"
        return volume

    def _write_arrays(self, path: Path) -> None:
        arrays: dict[str, Any] = {name: getattr(self, name) for name in self._arrays}
        with path.open("wb") as file:
            np.savez_compressed(file, **arrays)


def _points(points: npt.ArrayLike, count: int) -> npt.NDArray[np.float64]:
    """Return points as finite numbers of shape (n, count)."""
    try:
        shape = (count,) if np.ndim(points) == 1 else (-1, count)
    except ValueError:  # lists of several lengths
        shape = (-1, count)
    array = numbers(CameraError, "points of the reformation", points, shape).reshape(-1, count)
    if not np.isfinite(array).all():
        raise CameraError("points of the reformation", "numbers that are not finite", "finite numbers")
    return array
