"""The pictures that the page shows, with the descriptions for their DICOM objects."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lumencut.dicom.writing.picture import Picture
from lumencut.errors import CameraError, SettingsError
from lumencut.pictures.dicom_views import changed, settings_text, view_picture, written_by
from lumencut.pictures.frame_source import FrameSource
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.study import Origin
from lumencut.viewer.pacs_zip.given import Given, checked, points_of, refused
from lumencut.viewer.session_file import view_settings

_METHODS = {"csr": "csr", "csr-paper": "csr", "cr": "cr", "mpcpr": "mpcpr"}


def settings_in(view: Given) -> Settings:
    """Return the settings of the view that the page shows.

    Raises
    ------
    FormatError
        For invalid settings.
    """
    method = checked(view.text("method"), "a method", " or ".join(_METHODS), _METHODS.__contains__)
    try:
        return view_settings(method, view.plain("settings"))
    except (SettingsError, TypeError, ValueError) as error:
        raise refused(f"invalid settings ({error})", "the settings of a view") from error


def big_view(view: Given, stated: Given, origin: Origin) -> Picture:
    """Return the turning view as it is shown, with the labels that are in it.

    Parameters
    ----------
    view : Given
        The picture, the camera with its pixels, method and settings, and whether vessels are cut.
    stated : Given
        Whether spacing and orientation of the scan are known.
    origin : Origin
        The scan.

    Raises
    ------
    FormatError
        For anything that is not a view.
    """
    image = view.picture("picture")
    height, width = image.shape[:2]
    given = view.object("camera")
    try:
        camera = Camera(
            center=_vector(given, "center"), direction=_vector(given, "direction"), up=_vector(given, "up"),
            size=(width, height), pixel_spacing=given.number("pixel_spacing"),
        )  # fmt: skip
    except CameraError as error:
        raise refused(f"an invalid camera ({error.found})", error.expected) from error
    how = (settings_in(view), None, stated.flag("spacing"), stated.flag("orientation"))
    source = FrameSource(*how, 0, (), _METHODS[view.text("method")], origin)
    return view_picture(image, camera, source, has_cut=view.flag("has_cut"))


def pane_picture(pane: Given, settings: Settings) -> Picture:
    """Return the reformation next to the turning view, without a pixel spacing: rulers would be wrong."""
    axes = pane.text("axes")
    words = f"A reformation of the viewer, {written_by()} {axes} {changed(settings)}"
    return Picture(pane.picture("picture"), "CPR", words, settings_text(settings) + axes, None, None, axes)


def key_image(finding: Given, number: int, settings: Settings) -> Picture:
    """Return the key image of a finding: the straightened vessel, and the sections at its places."""
    caption = f"Key image of finding {number}: the straightened vessel from left to right, sections below it."
    words = f"{caption[:-1]}, {written_by()} {changed(settings)}"
    text = f"{settings_text(settings)} findings"
    return Picture(finding.picture("picture"), "CPR key image", words, text, None, None, caption)


def _vector(given: Given, name: str) -> npt.NDArray[np.float64]:
    """Return a vector of a camera, shape (3,)."""
    return points_of([given.items(name)], f"{name} of a camera").reshape(3)
