"""The text in a picture of a reformation: its axes, and how it was made.

It names no file and no vessel, and repeats nothing from the files about patient or scan.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lumencut import _lumencut
from lumencut.base.paths import checked_path
from lumencut.errors import CameraError, FormatError, SettingsError
from lumencut.pictures.picture_text import KEYWORD, plain_settings, settings_of, text_of
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings

_FORMAT = 1


@dataclass(frozen=True)
class ReformationRecipe:
    """How the image of a reformation was made.

    Attributes
    ----------
    name : str
        The name of the reformation, such as ``"straightened CPR"``.
    axes : str
        The meaning of rows and columns, in words.
    parameters : dict
        The parameters of the function that made it, by their names, as JSON holds them.
    command : str
        The subcommand that makes it, such as ``"cpr"``.
    """

    name: str
    axes: str
    parameters: dict[str, Any]
    command: str


def camera_parameters(camera: Camera) -> dict[str, Any]:
    """Return a camera as parameters of a recipe: the arguments of its constructor."""
    vectors = {name: np.asarray(getattr(camera, name)).tolist() for name in ("center", "direction", "up")}
    return {**vectors, "size": list(camera.size), "pixel_spacing": camera.pixel_spacing}


def recipe_camera(parameters: dict[str, Any]) -> Camera:
    """Return the camera that `camera_parameters` describes.

    Raises
    ------
    CameraError
        For invalid parameters.
    """
    from lumencut.scene.camera import Camera

    try:
        return Camera(**{**parameters, "size": tuple(parameters["size"])})
    except (KeyError, TypeError):
        expected = "the parameters of a camera"
        raise CameraError(
            "camera of the picture", "others", expected, "give the options themselves"
        ) from None


def png_options(recipe: ReformationRecipe, settings: Settings) -> dict[str, Any]:
    """Return the PNG metadata with the recipe."""
    from PIL.PngImagePlugin import PngInfo

    content = {
        "format": _FORMAT,
        "version": _lumencut.__version__,
        "reformation": recipe.name,
        "axes": recipe.axes,
        "parameters": recipe.parameters,
        "command": recipe.command,
        "settings": plain_settings(settings),
    }
    info = PngInfo()
    info.add_text("Software", f"Lumencut {_lumencut.__version__}")
    info.add_text("Description", f"{recipe.name}. {recipe.axes}")
    info.add_text(KEYWORD, json.dumps(content, allow_nan=False))
    return {"pnginfo": info}


def read_reformation_recipe(path: str | Path) -> tuple[ReformationRecipe, Settings]:
    """Return how a picture of a reformation was made, and its settings.

    Raises
    ------
    FormatError
        For an incomplete PNG, one not written by Lumencut, or one without a reformation.
    FileError
        For a file that cannot be read.
    """
    expected = "a PNG picture of a reformation that Lumencut wrote"
    place = checked_path(path, expected)
    found = "a text that does not say how to make it"
    try:
        content = json.loads(text_of(place, expected))
        if content.get("format") != _FORMAT:
            found = "a text of another version of Lumencut"
        elif "reformation" not in content:
            found = "a picture of a view, which lumencut render --like takes"
        else:
            names = ("reformation", "axes", "parameters", "command")
            recipe = ReformationRecipe(*(content[name] for name in names))
            texts = (recipe.name, recipe.axes, recipe.command)
            if isinstance(recipe.parameters, dict) and all(isinstance(text, str) for text in texts):
                return recipe, settings_of(content["settings"])
    except (SettingsError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        if isinstance(error, FormatError):
            raise
    raise FormatError(str(place), found, expected, "give the options themselves")
