"""``--like``: a picture rendered as another one was, but for the options beside it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from lumencut.cli.options import FILE, placed_like
from lumencut.errors import CameraError

if TYPE_CHECKING:
    from lumencut.camera import Camera
    from lumencut.recipe import Recipe

like_option = click.option(
    "--like",
    type=FILE,
    metavar="PICTURE.png",
    help="Render with the view, the settings and the labels of a .png that lumencut wrote. Options beside it "
    "come on top: --view and --up turn it, --rotate, --tilt and --zoom go on from it, --size keeps what is "
    "in view.",
)


def recipe_from(path: Path | None) -> Recipe | None:
    """Return how the picture of ``--like`` was rendered, None without one."""
    if path is None:
        return None
    from lumencut.recipe import read_recipe

    return read_recipe(path)


def typed(chosen: dict[str, Any]) -> dict[str, Any]:
    """Return the options that the user typed: no default may change the picture."""
    context = click.get_current_context()
    given = (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT)
    return {name: value for name, value in chosen.items() if context.get_parameter_source(name) in given}


def camera_like(camera: Camera, given: dict[str, Any]) -> Camera:
    """Return the camera of a picture, changed by the options that the user typed."""
    try:
        camera = _turned(_resized(camera, given), given)
        if not given.keys() & {"center", "pixel_spacing", "zoom"}:
            return camera
        return placed_like(camera, {"center": None, "pixel_spacing": None, "zoom": 1.0, **given})
    except CameraError as error:
        raise click.UsageError(str(error)) from error


def _resized(camera: Camera, given: dict[str, Any]) -> Camera:
    """With other pixels, all that was in view stays in view."""
    if "size" not in given:
        return camera
    larger = min(new / old for new, old in zip(given["size"], camera.size, strict=True))
    return replace(camera, size=given["size"], pixel_spacing=camera.pixel_spacing / larger)


def _turned(camera: Camera, given: dict[str, Any]) -> Camera:
    import numpy as np

    from lumencut.camera import VIEWS, upright

    if "view" in given or "up" in given:
        view = given.get("view", camera.direction)
        ahead, up = VIEWS[view] if isinstance(view, str) else (view, upright(view))
        camera = replace(camera, direction=np.array(ahead), up=np.array(given.get("up", up)))
    if "rotate" in given:
        camera = camera.rotated(math.radians(given["rotate"]), "up")
    # A right-handed turn about the right axis would lower the viewer.
    return camera.rotated(-math.radians(given["tilt"]), "right") if "tilt" in given else camera
