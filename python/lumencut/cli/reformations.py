"""Shared by the commands of reformations: chosen vessels, outputs, and ``--like``."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut._lumencut import PIXEL_SIDE
from lumencut.cli import options
from lumencut.cli.dicom import check_objects, dicom_options, object_options, save_sheet
from lumencut.cli.like import typed
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.parameters import VECTOR
from lumencut.cli.report import busy, detail, say, timings, verbose_option, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window
from lumencut.cli.settings import look_options, settings_from
from lumencut.cli.vessels import path_option, titled_vessels

if TYPE_CHECKING:
    from collections.abc import Callable

    from lumencut.reformation import Reformation
    from lumencut.renderer import Renderer
    from lumencut.settings import Settings
    from lumencut.vessel import Vessel
    from lumencut.vessel_tree import VesselTree

#: Parameters that a recipe holds in radians and the command line in degrees.
_ANGLES = ("angle", "overlap")

output_option = click.option(
    "-o",
    "--output",
    type=options.FILE,
    required=True,
    help="Picture (.png, .tif, .webp, …); .dcm (DICOM); .npz for the arrays of one vessel.",
)

smoothing_option = click.option(
    "--smoothing",
    type=float,
    default=0.0,
    show_default=True,
    metavar="MM",
    help="Smooth the centerlines by a Gaussian with this standard deviation (mm).",
)

pixel_spacing_option = click.option(
    "--pixel-spacing", type=float, metavar="MM", help=f"Side of a pixel (mm); default: {PIXEL_SIDE}."
)

up_option = click.option(
    "--up", type=VECTOR, default="0,0,1", show_default=True, help="The direction that points up (LPS)."
)

annotate_option = click.option(
    "--annotate/--no-annotate",
    default=True,
    show_default=True,
    help="Label the pictures with method, window, axes, names and scales.",
)

like_option = click.option(
    "--like",
    type=options.FILE,
    metavar="PICTURE.png",
    help="Take the options and settings of a .png that this command wrote. Other options change them "
    "further.",
)


def file_options(command: options.Command) -> options.Command:
    """Add the scan and the centerlines."""
    volume = click.argument("volume", type=options.FILE)
    centerlines = click.argument("centerlines", type=options.FILE, nargs=-1, required=True)
    return options.added((volume, centerlines), command)


def vessel_options(command: options.Command) -> options.Command:
    """Add the options that choose vessels, each shown in its own image."""
    return options.added((options.shown_vessel_options, path_option), command)


def picture_options(command: options.Command) -> options.Command:
    """Add the options for labels, for reading files, and for how values are shown."""
    parts = (
        *(annotate_option, like_option, dicom_options),
        *(options.reading_options, look_options, verbose_option),
    )
    return options.added(parts, command)


def like(chosen: dict[str, Any], command: str) -> tuple[dict[str, Any], Settings]:
    """Return the options, with missing ones taken from ``--like``, and the settings."""
    path = chosen.pop("like")
    if path is None:
        return chosen, settings_from(chosen)
    from lumencut._checks import number
    from lumencut.errors import FormatError
    from lumencut.reformation_recipe import read_reformation_recipe

    recipe, settings = read_reformation_recipe(path)
    if recipe.command != command:
        found = f"a picture of lumencut {recipe.command or 'no command'}"
        raise FormatError(str(path), found, f"one of lumencut {command}", "use the command that made it")
    own = {name: value for name, value in recipe.parameters.items() if name in chosen and value is not None}
    angles = {name: number(FormatError, f"{name} in {path}", own[name]) for name in _ANGLES if name in own}
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

    from lumencut.renderer import Renderer

    renderer = Renderer(voxels, tree, files.device)
    warn_of_window(settings, renderer)
    return renderer, tree, vessels


def check_single(vessels: list[tuple[str, Vessel]], path: Path) -> None:
    """Reject an output that can hold only one vessel if several are chosen."""
    if len(vessels) > 1:
        mend = "choose one by --vessel or --path"
        raise click.UsageError(f"{path} holds one vessel; found {len(vessels)}; {mend}")


def write_each(
    chosen: dict[str, Any], vessels: list[tuple[str, Vessel]], make: Callable[[Vessel], Reformation]
) -> None:
    """Make the image of each vessel and write it, several as a contact sheet; report the files."""
    made = [_made(title, vessel, make) for title, vessel in vessels]
    output, annotate = chosen["output"], chosen["annotate"]
    with busy(f"writing {output.name}"):
        _write(chosen, made, [title for title, _ in vessels], annotate=annotate)
    count = "1 vessel" if len(made) == 1 else f"{len(made)} vessels"
    window = made[0].shown_window
    shown = "" if window is None else f", window {window.width:.4g}/{window.level:.4g}"
    say(f"{output}: {made[0].recipe.name} of {count}, pixels of {made[0].pixel_spacing:.4g} mm{shown}")
    detail(made[0].recipe.axes)


def write_beside(
    chosen: dict[str, Any],
    vessels: list[tuple[str, Vessel]],
    make: Callable[..., Reformation],
    shown: tuple[str, ...],
) -> None:
    """Make the images `shown` of each vessel by calling `make`, and write a sheet with one row per vessel."""
    from lumencut.contact_sheet import contact_sheet

    pictures, titles, all_made = [], [], []
    for title, vessel in vessels:
        for name in shown:
            made = _made(f"{title} ({name})", vessel, partial(make, shown=name))
            pictures.append(made.annotated() if chosen["annotate"] else made.image)
            titles.append(f"{title}, {made.recipe.name}")
            all_made.append(made)
    with busy(f"writing {chosen['output'].name}"):
        starts = range(0, len(pictures), len(shown))
        _save_sheet(contact_sheet(pictures, titles, starts), chosen, all_made)
    count = "1 vessel" if len(vessels) == 1 else f"{len(vessels)} vessels"
    say(f"{chosen['output']}: {', '.join(shown)} of {count}")


def _made(title: str, vessel: Vessel, make: Callable[[Vessel], Reformation]) -> Reformation:
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
    from lumencut.contact_sheet import contact_sheet

    output = chosen["output"]
    if len(made) == 1:
        made[0].save(output, annotate=annotate, **object_options(output, chosen))
        return
    pictures = [one.annotated() if annotate else one.image for one in made]
    _save_sheet(contact_sheet(pictures, titles), chosen, made)


def _save_sheet(sheet: Any, chosen: dict[str, Any], made: list[Reformation]) -> None:
    """Write the pictures of several vessels, or several pictures of one vessel, on one sheet."""
    recipes = {one.recipe.name: one.recipe.axes for one in made}
    words = " ".join(f"{name}: {axes}" for name, axes in recipes.items())
    about = (f"CPR {', '.join(recipes)}", words, made[0].settings)
    save_sheet(sheet, chosen["output"], chosen, about, made[0]._known_volume())
