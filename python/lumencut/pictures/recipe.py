"""The text in a PNG that describes how the picture was rendered, and its parser.

It holds the camera, the settings with the windows that were used, what is labelled, the number of vessels,
and the version. It names no file and no vessel, and repeats nothing from the files about patient or
scan.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from lumencut import _lumencut
from lumencut.base.paths import checked_path
from lumencut.errors import CameraError, FormatError, SettingsError
from lumencut.pictures.picture_text import KEYWORD, plain_settings, settings_of, text_of
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings

_FORMAT = 1

_EXPECTED = "a PNG picture that Lumencut wrote"
_PLACE = ("center", "direction", "right_axis", "up", "pixel_spacing")


@dataclass(frozen=True)
class Recipe:
    """How a picture was made, except volume and vessel tree; it holds the number of vessels."""

    camera: Camera
    settings: Settings
    annotate: bool
    vessel_names: bool
    vessels: int


def png_options(recipe: Recipe, *, states_spacing: bool) -> dict[str, Any]:
    """Return the PNG metadata with the recipe, and with the pixel size if the source states one."""
    from PIL.PngImagePlugin import PngInfo

    info = PngInfo()
    info.add_text("Software", f"Lumencut {_lumencut.__version__}")
    info.add_text(KEYWORD, json.dumps(_as_json(recipe), allow_nan=False))
    return {"pnginfo": info, **(pixel_size(recipe.camera) if states_spacing else {})}


def pixel_size(camera: Camera) -> dict[str, Any]:
    """Return the PNG metadata with the pixel size; empty if PNG cannot hold it."""
    per_metre = round(1000 / camera.pixel_spacing)
    # PNG stores integer pixels per metre; the size of pixels above 1 m is only in the recipe.
    return {"dpi": (per_metre * 0.0254,) * 2} if per_metre else {}


def _as_json(recipe: Recipe) -> dict[str, Any]:
    camera, settings = recipe.camera, recipe.settings
    place = {name: np.asarray(getattr(camera, name)).tolist() for name in _PLACE}
    return {
        "format": _FORMAT,
        "version": _lumencut.__version__,
        "camera": {"size": list(camera.size), **place},
        "settings": plain_settings(settings),
        "annotate": recipe.annotate,
        "vessel_names": recipe.vessel_names,
        "vessels": recipe.vessels,
    }


def read_recipe(path: str | Path) -> Recipe:
    """Return how a picture was rendered.

    Raises
    ------
    FormatError
        For an incomplete PNG, one not written by Lumencut, or one that cannot be rendered.
    FileError
        For a file that cannot be read.
    """
    place = checked_path(path, _EXPECTED)
    text = text_of(place, _EXPECTED)
    try:
        content = json.loads(text, parse_constant=_refuse_constant)
        if "reformation" in content:
            found = f"a picture of a reformation ({str(content['reformation'])[:40]})"
            raise FormatError(
                str(place), found, _EXPECTED + " by render or turntable", "use the --like of its own command"
            )
        version = content["format"]
        if version != _FORMAT or isinstance(version, bool):
            found = "a text of another version of Lumencut"
            raise FormatError(str(place), found, f"a text of format {_FORMAT}", "give the options themselves")
        return _recipe(content)
    except (CameraError, SettingsError) as error:
        # The error does not quote the text, because anybody may have written it.
        found = f"a text whose {error.subject.partition(' of ')[0]} cannot be used"
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        if isinstance(error, FormatError):
            raise
        found = "a text that does not say how to render it"
    raise FormatError(str(place), found, _EXPECTED, "give the options themselves")


def _refuse_constant(_: str) -> NoReturn:
    raise ValueError("a number that is not finite")


def _recipe(content: dict[str, Any]) -> Recipe:
    flags = {name: content[name] for name in ("annotate", "vessel_names")}
    if not all(isinstance(flag, bool) for flag in flags.values()):
        raise TypeError("a flag that is neither true nor false")
    vessels = content["vessels"]
    if not isinstance(vessels, int) or isinstance(vessels, bool) or vessels < 0:
        raise TypeError("an invalid number of vessels")
    return Recipe(_camera(content["camera"]), settings_of(content["settings"]), **flags, vessels=vessels)


def _camera(content: dict[str, Any]) -> Camera:
    """Create the camera with exactly these axes; normalising them again would round them."""
    made = Camera(**{name: content[name] for name in ("center", "direction", "up", "size", "pixel_spacing")})
    stated = {name: np.asarray(content[name], dtype=np.float64) for name in _PLACE[:-1]}
    for name in ("direction", "right_axis", "up"):
        if not np.allclose(stated[name], getattr(made, name), rtol=0, atol=1e-9):
            raise CameraError(name, "a vector that does not fit", "a unit vector perpendicular to the others")
    return made._moved({**stated, "pixel_spacing": made.pixel_spacing})
