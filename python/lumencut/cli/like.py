"""``--like``: render a picture like another one, except for the options given."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from lumencut.base.wording import counted
from lumencut.cli import options
from lumencut.cli.found_vessels import found_by
from lumencut.cli.report import warn
from lumencut.errors import CameraError, FormatError

if TYPE_CHECKING:
    from lumencut.pictures.recipe import Recipe
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

like_option = click.option(
    "--like",
    type=options.FILE,
    metavar="PICTURE.png|SESSION.mrk.json",
    help="Render with the view, settings and labels of a .png that lumencut wrote, or of a session that the "
    "viewer saved. Without CENTERLINES the vessels of the session are shown. Other options change it "
    "further: --view and --up turn it, --rotate, --tilt and --zoom start from it, --size keeps what is in "
    "view, --zoom-to fits it again. The picture does not store the choice of vessels: give --vessel and "
    "--exclude again.",
)


def recipe_from(path: Path | None) -> Recipe | None:
    """Return how the picture of ``--like`` was rendered; None if there is no ``--like``."""
    if path is None:
        return None
    from lumencut.pictures.recipe import read_recipe
    from lumencut.viewer.session_file import is_session_file, read_session

    if not is_session_file(path):
        return read_recipe(path)
    recipe = read_session(path).recipe
    if recipe is None:
        found = "a session without a view"
        raise FormatError(str(path), found, "one that stores a view", "give --view")
    return recipe


def beside_session(chosen: dict[str, Any]) -> dict[str, Any]:
    """Return the options; missing ones are taken from a session file given to ``--like``."""
    from lumencut.viewer.session_file import is_session_file, read_session

    like = chosen["like"]
    if like is None or not is_session_file(like):
        return chosen
    session, found = read_session(like), dict(chosen)
    if not found["centerlines"] and found_by(found) is None and session.marks:
        found["centerlines"] = (like,)
    is_own = len(found["centerlines"]) == 1 and found["centerlines"][0].resolve() == like.resolve()
    if is_own and session.hidden and not found["vessel"] and not found["exclude"]:
        found["exclude"] = tuple(map(str, session.hidden))
    return found


def typed(chosen: dict[str, Any]) -> dict[str, Any]:
    """Return only the options that the user typed, because defaults must not change the picture."""
    context = click.get_current_context()
    given = (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT)
    return {name: value for name, value in chosen.items() if context.get_parameter_source(name) in given}


def views_of(chosen: dict[str, Any], recipe: Recipe | None) -> list[tuple[Any, Camera]]:
    """Return each requested view with its camera; without a recipe the camera has no position yet.

    Without ``--view`` the view of a recipe is None.
    """
    if recipe is None:
        return [(view, options.view_from({**chosen, "view": view})) for view in chosen["view"]]
    given = typed(chosen)
    views = given.pop("view", (None,))
    if len(views) > 1:
        found = f"--view is given {len(views)} times with --like, which renders the view of one picture"
        raise click.UsageError(f"{found}; give --view at most once, or leave out --like")
    if views[0] is not None:
        given["view"] = views[0]
    return [(views[0], camera_like(recipe.camera, given))]


def camera_of(
    view: Camera, scene: VesselTree | Volume, chosen: dict[str, Any], recipe: Recipe | None
) -> Camera:
    """Return the camera of a view; a recipe fixes its position too, unless it must fit other vessels."""
    return options.placed(view, scene, chosen) if recipe is None or chosen["zoom_to"] else view


def warn_of_vessels(chosen: dict[str, Any], recipe: Recipe | None, renderer: Renderer) -> None:
    """Warn if the picture showed another number of vessels, since it does not store which vessels they were.

    There is no warning if the user chooses vessels.
    """
    if recipe is None or chosen["vessel"] or chosen["exclude"]:
        return
    count = 0 if renderer.tree is None else len(renderer.tree)
    if recipe.vessels != count:
        shown = f"{chosen['like']} shows {counted(recipe.vessels, 'vessel')}, the new picture {count}"
        warn(f"{shown}; --vessel and --exclude choose vessels, also with --like")


def camera_like(camera: Camera, given: dict[str, Any]) -> Camera:
    """Return the camera of a picture, changed by the options that the user typed."""
    try:
        camera = _turned(_resized(camera, given), given)
        if not given.keys() & {"center", "pixel_spacing", "zoom"}:
            return camera
        return options.placed_like(camera, {"center": None, "pixel_spacing": None, "zoom": 1.0, **given})
    except CameraError as error:
        raise click.UsageError(str(error)) from error


def _resized(camera: Camera, given: dict[str, Any]) -> Camera:
    """Return the camera with another size in pixels; everything that was visible stays visible."""
    if "size" not in given:
        return camera
    larger = min(new / old for new, old in zip(given["size"], camera.size, strict=True))
    return replace(camera, size=given["size"], pixel_spacing=camera.pixel_spacing / larger)


def _turned(camera: Camera, given: dict[str, Any]) -> Camera:
    import numpy as np

    from lumencut.scene.camera import VIEWS, upright

    if "view" in given or "up" in given:
        view = given.get("view", camera.direction)
        ahead, up = VIEWS[view] if isinstance(view, str) else (view, upright(view))
        camera = replace(camera, direction=np.array(ahead), up=np.array(given.get("up", up)))
    if "rotate" in given:
        camera = camera.rotated(math.radians(given["rotate"]), "up")
    # The sign is negative because a right-handed turn about the right axis would lower the viewer.
    return camera.rotated(-math.radians(given["tilt"]), "right") if "tilt" in given else camera
