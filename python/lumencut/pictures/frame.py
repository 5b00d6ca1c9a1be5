"""The images of a rendering, row 0 on top."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import flag
from lumencut.base.paths import WRITABLE, checked_path, replace_whole
from lumencut.base.pickles import by_name
from lumencut.base.values import KeepsReadOnly
from lumencut.errors import SettingsError, VolumeError
from lumencut.pictures.frame_source import FrameSource
from lumencut.pictures.picture_file import check_dicom_alone, check_values, picture_as_png, save_picture
from lumencut.scene.camera import Camera

if TYPE_CHECKING:
    from lumencut.dicom.writing.picture import Picture
    from lumencut.scene.study import Study

IMAGES = ("image", "depth", "vessel", "distance", "value", "context")

#: What was blended at each pixel of a cut surface, on request.
BLEND = ("cost", "level", "piece")

#: All images that a frame may have; positions are computed from the depth.
_IMAGES = ("image", "depth", "vessel", "distance", "position", "value", "context", "folded", *BLEND)


@by_name
@dataclass(frozen=True, eq=False, repr=False)
class Frame(KeepsReadOnly):
    """The images of one view, each (H, W) from the top row down.

    Requesting an image that the frame does not have raises a ``VolumeError`` with the reason: without a
    volume there is no picture, without centerlines no depth.

    Attributes
    ----------
    camera : Camera
        The view.
    timings : dict of str to float
        Wall time of each stage (ms), in the order in which they ran.
    """

    camera: Camera
    timings: dict[str, float]
    _image: npt.NDArray[np.uint8] | None = None
    _depth: npt.NDArray[np.float32] | None = None
    _vessel: npt.NDArray[np.int32] | None = None
    # The distance; until the first use, a function that computes it.
    _distance: npt.NDArray[np.float32] | Callable[[], npt.NDArray[np.float32]] | None = None
    _value: npt.NDArray[np.float32] | None = None
    _context: npt.NDArray[np.uint8] | None = None
    _folded: npt.NDArray[np.bool_] | None = None
    _cost: npt.NDArray[np.float32] | None = None
    _level: npt.NDArray[np.float32] | None = None
    _piece: npt.NDArray[np.int32] | None = None
    _asked: tuple[str, ...] | None = None
    _source: FrameSource | None = None

    @property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4)."""
        image: npt.NDArray[np.uint8] = self._present("image", self._image)
        return image

    @property
    def depth(self) -> npt.NDArray[np.float32]:
        """Depth of the cut surface (mm), growing away from the viewer, 0 at the camera's center.

        float32, shape (H, W); NaN where mpCPR shows nothing.
        """
        depth: npt.NDArray[np.float32] = self._present("depth", self._depth)
        return depth

    @property
    def vessel(self) -> npt.NDArray[np.int32]:
        """Id of the vessel whose influence zone the pixel is in, int32, shape (H, W).

        It is -1 where mpCPR shows nothing.
        """
        vessel: npt.NDArray[np.int32] = self._present("vessel", self._vessel)
        return vessel

    @property
    def distance(self) -> npt.NDArray[np.float32]:
        """Projected distance to the nearest centerline (mm), float32, shape (H, W).

        With ``level_choice="own"`` it is computed on first use, unless ``images`` named it; until then the
        frame keeps its renderer.
        """
        if not isinstance(self._distance, (np.ndarray, type(None))):
            object.__setattr__(self, "_distance", self._distance())
        distance: npt.NDArray[np.float32] = self._present("distance", self._distance)
        return distance

    @property
    def value(self) -> npt.NDArray[np.float32]:
        """The volume at the cut surface, float32, shape (H, W), NaN outside the volume."""
        value: npt.NDArray[np.float32] = self._present("value", self._value)
        return value

    @property
    def context(self) -> npt.NDArray[np.uint8]:
        """The picture of the context only, RGBA, uint8, shape (H, W, 4).

        Its colours are not multiplied by its opacity, and it is transparent where the cut surface hides it.
        """
        context: npt.NDArray[np.uint8] = self._present("context", self._context)
        return context

    @property
    def folded(self) -> npt.NDArray[np.bool_]:
        """Pixels in whose row one vessel has several points (the nearest is shown), bool, shape (H, W).

        Only frames of :func:`lumencut.mpcpr` have it.
        """
        folded: npt.NDArray[np.bool_] = self._present("folded", self._folded)
        return folded

    @property
    def cost(self) -> npt.NDArray[np.float32]:
        """The cost z + λ·max(0, d − r) in mm (paper, Eq. 2), float32, shape (H, W).

        It blends the levels of detail like the depth, before the depth filter. λ is ``cost_weight``, z the
        depth, d the projected distance from the centerline, and r the radius. Only frames of
        :meth:`Renderer.cut_surface` that name it in ``images`` have it.
        """
        cost: npt.NDArray[np.float32] = self._present("cost", self._cost)
        return cost

    @property
    def level(self) -> npt.NDArray[np.float32]:
        """The level of detail, 0 the finest, float32, shape (H, W).

        2.25 stands for three quarters of level 2 and a quarter of level 3. Requested as :attr:`cost`.
        """
        level: npt.NDArray[np.float32] = self._present("level", self._level)
        return level

    @property
    def piece(self) -> npt.NDArray[np.int32]:
        """The kind of piece of the level with the larger weight, int32, shape (H, W).

        0 is a stripe, 1 a wedge, 2 a half-plane, 3 a full plane. Requested as :attr:`cost`.
        """
        piece: npt.NDArray[np.int32] = self._present("piece", self._piece)
        return piece

    @property
    def position(self) -> npt.NDArray[np.float64]:
        """World point (mm, LPS) of the cut surface in each pixel, float64, shape (H, W, 3)."""
        depth = np.ascontiguousarray(self._present("position", self._depth), np.float32)
        return _lumencut.positions(self.camera, depth)

    def __getstate__(self) -> tuple[dict[str, Any], list[str]]:
        """Return the state for copies and pickles; images not yet computed are computed now."""
        if self.has("distance"):
            _ = self.distance
        return super().__getstate__()

    def __repr__(self) -> str:
        """Return the size and the names of the images."""
        width, height = self.camera.size
        return f"Frame({width} × {height} pixels: {', '.join(name for name in _IMAGES if self.has(name))})"

    def _repr_png_(self) -> bytes | None:
        """Return the picture for Jupyter; None if the frame has none."""
        return picture_as_png(self.image) if self.has("image") else None

    def has(self, name: str) -> bool:
        """Return whether the view has the image of this name, such as ``"depth"`` or ``"context"``."""
        if not isinstance(name, str) or name not in _IMAGES:
            return False
        return getattr(self, "_depth" if name == "position" else f"_{name}") is not None

    def _present(self, name: str, array: Any) -> Any:
        if array is not None:
            return array
        stored = "depth" if name == "position" else name
        if name == "folded":
            found, mend = "a frame of another method", "use mpcpr"
            raise VolumeError("folded of the frame", found, "a frame of mpCPR", mend)
        if name in BLEND:
            found, mend = "a frame that was not asked for it", f'use Renderer.cut_surface(images=["{name}"])'
            raise VolumeError(f"{name} of the frame", found, f"a cut surface with {name}", mend)
        if self._asked is not None and stored not in self._asked:
            found = f"a frame that was asked for {', '.join(self._asked) or 'no image'} alone"
            raise VolumeError(f"{name} of the frame", found, f"a frame with {stored}", "name it in images=")
        if self._image is None and self._asked is None:
            found, expected, mend = "a cut surface without a volume", "a rendered frame", "use render"
        elif name == "context":
            found, expected = "a frame rendered without a context", "a frame with one"
            mend = "give the settings a context such as 'mida'"
        else:
            found, expected = "the context alone", "a frame with a cut surface"
            mend = "give the renderer a vessel tree"
        raise VolumeError(f"{name} of the frame", found, expected, mend)

    def annotated(self, *, vessel_names: bool = False) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8, shape (H, W, 4); the frame does not change.

        The edges are labelled with the sides of the patient: R, L, A, P, S and I for right, left,
        anterior, posterior, superior and inferior. Oblique views have several letters, the main side first.
        The upper left corner shows the view and the window (W width, L level), the lower left one a scale bar
        of a round length in mm, the right edge the colours of a rim. If the source of the volume states no
        orientation (`Volume.states_orientation`) or no spacing (`Volume.states_spacing`), a text replaces
        letters and view, or the bar. Pictures with a side below 200 pixels get no labels.

        Parameters
        ----------
        vessel_names : bool, default False
            Write the names of the vessels at their ends, if there is room.

        Raises
        ------
        VolumeError
            For a frame without a picture.
        """
        from lumencut.pictures import annotation

        return annotation.annotated(self.image, self.camera, self._known_source(), vessel_names=vessel_names)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        annotate: bool = False,
        vessel_names: bool = False,
        study: Any = None,
        anonymous: bool = False,
        other_patient: bool = False,
        compress: bool = False,
        values: bool = False,
    ) -> None:
        """Write the picture, or with the extension ``.npz`` all arrays; a file appears only when complete.

        A ``.png`` states the size of its pixels, if the source of the volume states a spacing, and how it was
        rendered (view, settings and version), for ``lumencut render --like``. It names no file, and repeats
        nothing from the files about patient or scan. Pictures of mpCPR and CR, which that command cannot
        make, state only the size of their pixels.

        Parameters
        ----------
        path : path-like
            The extension selects the format: a picture format of Pillow (``.png``, ``.tif``, …), ``.npz``, or
            ``.dcm`` for a DICOM Secondary Capture in the study of the scan.
        annotate : bool, default False
            Write the picture with labels, see :meth:`annotated`. The arrays of ``.npz`` have none.
        vessel_names : bool, default False
            Write the names of the vessels too.
        study : Volume or path-like, optional
            For ``.dcm``: a volume that was read from DICOM, or a DICOM folder, file or zip archive, whose
            study the picture is put into; by default, the study of the scan that is shown.
        anonymous : bool, default False
            For ``.dcm``: leave out patient, study and the names of vessels. Each scan gets a new study
            instead. This is not the Basic Profile of PS3.15.
        other_patient : bool, default False
            For ``.dcm``: accept a `study` of another PatientID than that of the scan, which is an error
            otherwise. A `StudyWarning` names other differences, such as the study of a follow-up.
        compress : bool, default False
            For ``.dcm``: write the pixels as JPEG 2000, lossless.
        values : bool, default False
            For ``.dcm``: write the values at the cut surface, without labels and context, as a derived CT or
            MR image that a PACS shows in any window. It has its own frame of reference.

        Raises
        ------
        FormatError
            For an unknown extension; for ``.dcm`` without exactly one study, or that
            of another patient.
        FileError
            If the file cannot be written.
        SettingsError
            For names of vessels on a picture without labels, and for what only ``.dcm`` can hold.
        """
        path = checked_path(path, WRITABLE)
        for name, value in {"annotate": annotate, "vessel_names": vessel_names}.items():
            flag(SettingsError, name, value)
        if vessel_names and not annotate:
            raise SettingsError("vessel_names", "True without annotate", "annotate=True with it")
        if path.suffix.lower() == ".dcm":
            labels = {"annotate": annotate, "vessel_names": vessel_names}
            how = {"anonymous": anonymous, "other_patient": other_patient}
            self._save_object(path, labels, study, **how, compress=compress, values=values)
            return
        dicom = {"study": study, "anonymous": anonymous, "other_patient": other_patient}
        check_dicom_alone(path, **dicom, compress=compress, values=values)
        if path.suffix.lower() == ".npz":
            replace_whole(path, self._write_arrays)
            return
        image = self.annotated(vessel_names=vessel_names) if annotate else self.image
        save_picture(image, path, self._png_options(annotate=annotate, vessel_names=vessel_names))

    def _save_object(
        self,
        path: Path,
        labels: dict[str, bool],
        study: Any,
        *,
        anonymous: bool,
        other_patient: bool,
        compress: bool,
        values: bool,
        number: int = 1,
    ) -> None:
        """Write the picture or its values as DICOM, numbered within a series of several views."""
        from lumencut.dicom.writing.picture import write_picture
        from lumencut.dicom.writing.values import write_plane
        from lumencut.pictures.dicom_views import view_values

        found = self._study(study, anonymous=anonymous, other_patient=other_patient)
        if values:
            check_values(labels["annotate"], compress)
            plane, about = view_values(self.value, self.camera, self._known_source())
            write_plane(path, plane, about, found, number=number)
            return
        made = self._as_object(
            annotate=labels["annotate"], vessel_names=labels["vessel_names"] and not anonymous
        )
        write_picture(path, made, found, number=number, compress=compress)

    def _as_object(self, *, annotate: bool, vessel_names: bool) -> Picture:
        """Return the picture with the description for its DICOM object."""
        from lumencut.pictures.dicom_views import view_picture

        image = self.annotated(vessel_names=vessel_names) if annotate else self.image
        return view_picture(image, self.camera, self._known_source(), has_cut=self.has("depth"))

    def _study(self, study: Any, *, anonymous: bool, other_patient: bool = False) -> Study:
        """Return the study into which DICOM objects of the frame are put."""
        from lumencut.dicom.writing.chosen_study import chosen_study

        origin = self._known_source().origin
        assert origin is not None, "a rendered frame knows its scan"
        return chosen_study(origin, study, anonymous=anonymous, other_patient=other_patient)

    def _known_source(self) -> FrameSource:
        if self._source is None:
            raise VolumeError("source of the frame", "a frame made by hand", "a rendered frame", "use render")
        return self._source

    def _png_options(self, *, annotate: bool, vessel_names: bool) -> dict[str, Any]:
        """Return the metadata that Pillow writes into a PNG."""
        from lumencut.pictures.recipe import Recipe, pixel_size, png_options

        if self._source is None:
            return {}
        source = self._source
        labels = {"annotate": annotate, "vessel_names": vessel_names}
        if source.method != "csr":
            # No recipe: `--like` would render this picture by another method.
            return pixel_size(self.camera) if source.states_spacing else {}
        recipe = Recipe(self.camera, source.settings, **labels, vessels=source.vessels)
        return png_options(recipe, states_spacing=source.states_spacing)

    def _write_arrays(self, path: Path) -> None:
        arrays: dict[str, Any] = {name: getattr(self, name) for name in _IMAGES if self.has(name)}
        with path.open("wb") as file:
            np.savez_compressed(file, **arrays)


def depth_before(frame: Frame | None) -> tuple[Camera, npt.NDArray[np.float32]] | None:
    """Return camera and depth of the frame before in a turn."""
    if frame is None:
        return None
    if not isinstance(frame, Frame) or not frame.has("depth"):
        found = "a frame without depth" if isinstance(frame, Frame) else type(frame).__name__
        raise SettingsError("before", found, "a Frame of a cut surface, with its depth, or None")
    return frame.camera, frame.depth
