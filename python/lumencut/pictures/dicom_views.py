"""The description of a view: how it was made, its pixel size, and the sides of the patient."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.dicom.writing.objects import CURVED_REFORMATION, RESEARCH
from lumencut.dicom.writing.picture import Picture
from lumencut.dicom.writing.values import About, Plane, scaling_of
from lumencut.errors import FormatError
from lumencut.pictures.frame_source import FrameSource
from lumencut.pictures.picture_text import plain_settings
from lumencut.pictures.reformation_recipe import ReformationRecipe, camera_parameters
from lumencut.scene.camera import Camera
from lumencut.scene.orientation import c_arm_angles, edges, view_name
from lumencut.scene.settings import Settings

_METHODS = {"csr": "CSR", "mpcpr": "mpCPR", "cr": "CR"}
_NAMES = {
    "CSR": "Curved surface reformation (CSR)",
    "mpCPR": "Multipath curved planar reformation (mpCPR)",
    "CR": "Centerline reformation (CR)",
}
#: Codes of the standard (DCM) for pictures without a cut surface.
_CONTEXT_CODES = {
    "mip": ("113078", "Maximum intensity projection"),
    "minip": ("113079", "Minimum intensity projection"),
}
_VOLUME_RENDERING = ("113074", "Volume rendering")


def view_picture(
    image: npt.NDArray[np.uint8], camera: Camera, source: FrameSource, *, has_cut: bool
) -> Picture:
    """Return the picture of a view with the description for its DICOM object.

    Parameters
    ----------
    image : numpy.ndarray, uint8, shape (H, W, 4)
        The picture, with or without labels.
    camera : Camera
        The view.
    source : FrameSource
        What the frame was made from.
    has_cut : bool
        Whether vessels are cut open; otherwise only the context is shown.
    """
    settings = source.settings
    method = _METHODS[source.method] if has_cut else (settings.context or "context")
    code = CURVED_REFORMATION if has_cut else _CONTEXT_CODES.get(method, _VOLUME_RENDERING)
    view = view_name(camera) if source.states_orientation else "orientation not stated"
    angles = c_arm_angles(camera) if source.states_orientation else view
    sides = edges(camera) if source.states_orientation else {}
    # mpCPR moves the rows of its pictures, so a ruler across them would measure wrongly.
    is_true = source.states_spacing and source.method != "mpcpr"
    words = (
        f"{_NAMES.get(method, method.upper() + ' of the volume')} {written_by()} View {view}; "
        f"camera {json.dumps(_rounded(camera_parameters(camera)))}; {changed(settings)}"
    )
    words += "" if source.legend is None else f". Colours: {source.legend}"
    return Picture(
        image,
        method.upper() if not has_cut else method,
        words,
        settings_text(settings),
        camera.pixel_spacing if is_true else None,
        (sides["right"], sides["bottom"]) if sides else None,
        f"View {view}" if angles in view else f"View {view}, C-arm {angles}",
        settings.context is not None,
        code,
    )


def view_values(values: npt.NDArray[np.float32], camera: Camera, source: FrameSource) -> tuple[Plane, About]:
    """Return the values of a view on a plane through the middle of the camera, and their description.

    Parameters
    ----------
    values : numpy.ndarray, float32, shape (H, W)
        The volume at the cut surface, NaN outside.
    camera : Camera
        The view.
    source : FrameSource
        What the frame was made from.

    Raises
    ------
    FormatError
        For mpCPR, in whose pictures distances are not true, and for a scan that states no spacing or no
        orientation.
    """
    if source.method == "mpcpr" or not (source.states_spacing and source.states_orientation):
        found = "a picture of mpCPR" if source.method == "mpcpr" else "a scan without spacing or orientation"
        expected = "a view whose distances and sides are true, for values"
        raise FormatError("values of the view", found, expected, "write the picture, without values")
    assert source.origin is not None, "a rendered frame knows its scan"
    picture = view_picture(np.empty((0, 0, 4), np.uint8), camera, source, has_cut=True)
    width, height = camera.size
    right, down = np.asarray(camera.right_axis), -np.asarray(camera.up)
    middle = (width - 1) / 2 * right + (height - 1) / 2 * down
    plane = Plane(values, right, down, camera.center - middle * camera.pixel_spacing, camera.pixel_spacing)
    scaling = scaling_of(values, is_whole=source.origin.is_whole)
    said = (picture.method, picture.words, picture.settings, picture.comments)
    return plane, About(*said, source.window, scaling)


def reformed_picture(
    image: npt.NDArray[np.uint8], recipe: ReformationRecipe, settings: Settings, edges: dict[str, str],
    spacing: float | None,
) -> Picture:  # fmt: skip
    """Return the picture of a reformation with the description for its DICOM object.

    Parameters
    ----------
    image : numpy.ndarray, uint8, shape (H, W, 4)
        The picture, with or without labels.
    recipe : ReformationRecipe
        Its description.
    settings : Settings
        How values are shown.
    edges : dict
        The sides of the patient at the edges, if they are true.
    spacing : float or None
        Side of a pixel (mm); None if a ruler across the picture would be wrong.
    """
    parameters = json.dumps(_rounded(recipe.parameters))
    words = f"{recipe.name} {written_by()} {recipe.axes} Parameters {parameters}; {changed(settings)}"
    sides = (edges["right"], edges["bottom"]) if {"right", "bottom"} <= edges.keys() else None
    text = parameters + settings_text(settings)
    short = "CFA" if recipe.command == "cfa" else "CPR"
    film = f"{short} uncurl film" if recipe.command == "uncurl" else None
    return Picture(image, f"{short} {recipe.name}", words, text, spacing, sides, recipe.axes, film=film)


def joined_picture(image: npt.NDArray[np.uint8], method: str, words: str, settings: Settings) -> Picture:
    """Return several pictures on one sheet without a scale, and their description."""
    text = f"{words} {written_by()} {changed(settings)}"
    return Picture(image, method, text, settings_text(settings) + words, None, None, words, True)


def written_by() -> str:
    """Return the sentence that says which program made a picture, and for what purpose."""
    return f"by Lumencut {_lumencut.__version__} {RESEARCH}."


def settings_text(settings: Settings) -> str:
    """Return settings as a text that differs for different settings."""
    return json.dumps(plain_settings(settings), sort_keys=True, default=vars)


def changed(settings: Settings) -> str:
    """Return the settings that differ from the defaults, as a text."""
    usual, used = plain_settings(Settings()), plain_settings(settings)
    other = {name: value for name, value in used.items() if value != usual[name]}
    return f"settings {json.dumps(_rounded(other), default=vars)}"


def _rounded(value: Any) -> Any:
    """Return a JSON value with numbers of six digits: short, and enough to reproduce the picture."""
    if isinstance(value, dict):
        return {name: _rounded(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(one) for one in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value
