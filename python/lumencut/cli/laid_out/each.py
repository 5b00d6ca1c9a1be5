"""Shared by the commands of reformations: chosen vessels, outputs, and ``--like``."""

from __future__ import annotations

import math
from dataclasses import fields
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import check_objects, object_options, save_sheet
from lumencut.cli.like import typed
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import busy, detail, say, timings, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window
from lumencut.cli.settings import settings_from
from lumencut.cli.vessels import titled_vessels

if TYPE_CHECKING:
    from collections.abc import Callable

    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.reformation import Reformation
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.vessel_tree import VesselTree

#: Parameters that a recipe holds in radians and the command line in degrees.
_ANGLES = ("angle", "field_of_view", "overlap", "roll")


def like(chosen: dict[str, Any], command: str) -> tuple[dict[str, Any], Settings]:
    """Return the options, with missing ones taken from ``--like``, and the settings."""
    path = chosen.pop("like")
    if path is None:
        return chosen, settings_from(chosen)
    from lumencut.base.checks import number
    from lumencut.errors import FormatError
    from lumencut.pictures.reformation_recipe import read_reformation_recipe

    recipe, settings = read_reformation_recipe(path)
    if recipe.command != command:
        found = f"a picture of lumencut {recipe.command or 'no command'}"
        raise FormatError(str(path), found, f"one of lumencut {command}", "use the command that made it")
    own = {name: value for name, value in recipe.parameters.items() if name in chosen and value is not None}
    angles = {name: number(FormatError, f"{name} in {path}", own[name]) for name in _angles_of(own)}
    degrees = {name: math.degrees(angle) for name, angle in angles.items()}
    return {**chosen, **own, **degrees, **typed(chosen)}, settings_from(chosen, settings)


def read_vessels(
    chosen: dict[str, Any], settings: Settings, command: str, *, has_series: bool = False
) -> tuple[Renderer, VesselTree, list[tuple[str, Vessel]]]:
    """Return a renderer of the files, the tree, and the chosen vessels with their titles.

    If `has_series`, the command also writes a DICOM series.
    """
    files = scene_from(chosen)
    check_objects(chosen, [chosen["output"]], has_series=has_series)
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError(f"lumencut {command} needs VOLUME and CENTERLINES")
    vessels = titled_vessels(tree, chosen)
    if chosen["output"].suffix.lower() == ".npz":
        check_single(vessels, chosen["output"])

    from lumencut.pictures.renderer import Renderer

    renderer = Renderer(voxels, tree, files.device)
    warn_of_window(settings, renderer)
    return renderer, tree, vessels


def asked(command: str, chosen: dict[str, Any], settings: Settings, tree: VesselTree) -> Any:
    """Return the request for the reformation of a command, from its options."""
    requests = _requests()
    given = {**chosen, "settings": settings, "slab": None, "tree": tree}
    own = {field.name: given[field.name] for field in fields(requests[command]) if field.name in given}
    own |= {name: math.radians(own[name]) for name in _angles_of(own) if own[name] is not None}
    return requests[command](**own)


def _angles_of(own: dict[str, Any]) -> list[str]:
    """Return the parameters that are angles; the roll of a CPR may be a word."""
    return [name for name in _ANGLES if name in own and not (name == "roll" and isinstance(own[name], str))]


def _requests() -> dict[str, Any]:
    """Return the requests that show vessels one by one, by the names of their commands."""
    from lumencut.reformations.endoscoping import EndoscopyRequest
    from lumencut.reformations.feature_aggregation import CfaRequest
    from lumencut.reformations.lumen_mapping import LumenMapRequest
    from lumencut.reformations.planar_reformation import CprRequest
    from lumencut.reformations.spiral_reformation import SpiralRequest

    all_requests = (CprRequest, CfaRequest, SpiralRequest, LumenMapRequest, EndoscopyRequest)
    return {request.kind: request for request in all_requests}


def show_each(command: str, **given: Any) -> None:
    """Write the pictures of vessels that a command makes, each by itself."""
    options.check_picture(given["output"])
    chosen, settings = like(given, command)
    renderer, tree, vessels = read_vessels(chosen, settings, command)
    write_each(chosen, vessels, partial(asked(command, chosen, settings, tree).of, renderer))


def check_single(vessels: list[tuple[str, Vessel]], path: Path) -> None:
    """Reject an output that can hold only one vessel if several are chosen."""
    if len(vessels) > 1:
        mend = "choose one by --vessel or --path"
        raise click.UsageError(f"{path} holds one vessel; found {len(vessels)}; {mend}")


def write_each(
    chosen: dict[str, Any], vessels: list[tuple[str, Vessel]], make: Callable[[Vessel], Reformation]
) -> None:
    """Make the image of each vessel and write it, several as a contact sheet; report the files."""
    made = [made_of(title, vessel, make) for title, vessel in vessels]
    output, annotate = chosen["output"], chosen["annotate"]
    with busy(f"writing {output.name}"):
        _write(chosen, made, [title for title, _ in vessels], annotate=annotate)
    count = "1 vessel" if len(made) == 1 else f"{len(made)} vessels"
    window = made[0].shown_window
    shown = "" if window is None else f", window {window.width:.4g}/{window.level:.4g}"
    say(f"{output}: {made[0].recipe.name} of {count}, pixels of {made[0].pixel_spacing:.4g} mm{shown}")
    detail(made[0].recipe.axes)


def made_of(title: str, vessel: Vessel, make: Callable[[Vessel], Reformation]) -> Reformation:
    """Return the image of one vessel, and warn if it shows nothing."""
    import numpy as np

    with busy(f"vessel {title}"):
        made = make(vessel)
        _ = made.image
    timings(f"vessel {title}", made.timings)
    if np.isnan(made.value).all():
        warn(f"vessel {title}: no pixel lies in the volume")
    return made


def _write(chosen: dict[str, Any], made: list[Reformation], titles: list[str], *, annotate: bool) -> None:
    from lumencut.pictures.contact_sheet import contact_sheet

    output = chosen["output"]
    if len(made) == 1:
        made[0].save(output, annotate=annotate, **object_options(output, chosen))
        return
    pictures = [one.annotated() if annotate else one.image for one in made]
    write_sheet(contact_sheet(pictures, titles), chosen, made)


def write_sheet(sheet: Any, chosen: dict[str, Any], made: list[Reformation]) -> None:
    """Write the pictures of several vessels, or several pictures of one vessel, on one sheet."""
    recipes = {one.recipe.name: one.recipe.axes for one in made}
    words = " ".join(f"{name}: {axes}" for name, axes in recipes.items())
    about = (f"CPR {', '.join(recipes)}", words, made[0].settings)
    save_sheet(sheet, chosen["output"], chosen, about, made[0]._known_volume())
