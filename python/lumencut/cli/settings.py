"""Options for the settings of a picture, and the settings they stand for."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli.options import Command, added
from lumencut.cli.parameters import RGB, WINDOW, Color, Parts, Thickness, Transfer
from lumencut.errors import SettingsError

if TYPE_CHECKING:
    from lumencut.settings import Settings

#: The names that the library knows, here so that ``--help`` need not import it; a test compares.
CONTEXT_NAMES = ("mida", "dvr", "mip", "minip", "average")
PRESET_NAMES = ("grey", "angio", "bone", "soft-tissue")
SLAB_NAMES = ("max", "mean", "min")

#: Stands for None.
NO_CONTEXT = "none"


def setting_options(command: Command) -> Command:
    """Add one option for each field of `Settings`, under its name."""
    return added(_SETTINGS, command)


# Defaults are Settings' own: an option that is not given is None. The help repeats them and a test compares.
_SETTINGS = (
    click.option(
        "--window",
        type=WINDOW,
        help="Intensities of the cut surface from black to white, LEVEL ± WIDTH/2 (unit of the volume, HU "
        "for CT); default: from the data.",
    ),
    click.option(
        "--opacity",
        type=Parts("TRANSPARENT:OPAQUE", ":", float),
        help="Ramp of opacity of the cut surface over intensities (unit of the volume, HU for CT); "
        "default: all opaque.",
    ),
    click.option(
        "--background",
        type=Color("RRGGBB[AA]", (3, 4)),
        help="Colour behind it all (hexadecimal); default 000000ff.",
    ),
    click.option(
        "--cost-weight",
        type=float,
        metavar="NUMBER",
        help="λ of Eq. 2: what one mm beyond a vessel's wall costs (mm of depth per mm); default 10.",
    ),
    click.option(
        "--preserve-lumen/--no-preserve-lumen",
        default=None,
        help="Measure distance from the wall, or from the centerline (yes or no); default yes.",
    ),
    click.option(
        "--lumen-first/--no-lumen-first",
        default=None,
        help="Let every lumen beat every surrounding, whatever the depth (yes or no); default no.",
    ),
    click.option(
        "--lumen-margin",
        type=float,
        metavar="MM",
        help="How far beyond the wall lumen-first reaches (mm); default 0.",
    ),
    click.option(
        "--levels",
        type=int,
        metavar="N",
        help="Levels of detail beyond the finest (count, 0 to 15); default 6.",
    ),
    click.option(
        "--level-distance",
        type=float,
        metavar="MM",
        help="How far from the vessels one level of detail reaches (mm per level); default 8.",
    ),
    click.option(
        "--depth-filter/--no-depth-filter",
        default=None,
        help="Smooth the depth with a Gaussian of 7 × 7 pixels (yes or no); default yes.",
    ),
    click.option(
        "--silhouettes/--no-silhouettes",
        default=None,
        help="Draw lines where the cut surface leaps (yes or no); default yes.",
    ),
    click.option(
        "--silhouette-slope",
        type=float,
        metavar="SLOPE",
        help="Slope at which a silhouette has half its strength (mm of depth per mm); default 24.",
    ),
    click.option(
        "--silhouette-color",
        type=RGB,
        help="Colour of the silhouettes (hexadecimal); default ffdc00.",
    ),
    click.option(
        "--slab",
        type=Thickness(SLAB_NAMES),
        help="Show the largest, mean or smallest value of a slab around the cut surface (mm, from its near "
        "to its far side), such as 4mm:mean; default: one point deep.",
    ),
    click.option(
        "--context",
        type=click.Choice([*CONTEXT_NAMES, NO_CONTEXT]),
        help="What is shown where the cut surface is outside the volume or transparent (name): maximum "
        "intensity difference accumulation, direct volume rendering, largest, smallest or mean value, "
        "or the background alone; default mida.",
    ),
    click.option(
        "--context-gamma",
        type=float,
        metavar="NUMBER",
        help="For mida: -1 is dvr, 0 mida, 1 mip, between them a blend (number, -1 to 1); default 0.",
    ),
    click.option(
        "--context-window",
        type=WINDOW,
        help="Intensities that the context takes as 0 to 1, LEVEL ± WIDTH/2 (unit of the volume, HU for CT); "
        "default: from the data.",
    ),
    click.option(
        "--context-transfer",
        type=Transfer(PRESET_NAMES),
        metavar=Transfer.name,
        help=f"Colours and opacities of mida, dvr and mip: {', '.join(PRESET_NAMES)}, or control points of "
        "intensity (unit of the volume, HU for CT), colour and opacity of one mm (0 to 1); "
        "default: grey for mip, else angio.",
    ),
    click.option(
        "--context-step",
        type=float,
        metavar="MM",
        help="Longest distance between samples along a ray (mm); default: the smallest side of a voxel, "
        "half of it for mida and dvr unless a preview.",
    ),
    click.option(
        "--context-shading/--no-context-shading",
        default=None,
        help="Shade mida and dvr by the gradient, with light from the viewer (yes or no); default no.",
    ),
    click.option(
        "--context-preview/--no-context-preview",
        default=None,
        help="Trace one ray for each square of four pixels: quicker and coarser (yes or no); default no.",
    ),
)


def settings_from(chosen: dict[str, Any]) -> Settings:
    """Return the settings that the options stand for; what was not given keeps its default."""
    from lumencut.settings import Settings

    names = [field.name for field in fields(Settings)]
    given = {name: chosen[name] for name in names if chosen.get(name) is not None}
    try:
        return Settings(**_as_fields(given))
    except SettingsError as error:
        raise click.UsageError(str(error)) from error


def _as_fields(given: dict[str, Any]) -> dict[str, Any]:
    """What the options hold as what the settings take."""
    from lumencut.settings import Slab
    from lumencut.transfer import TransferFunction
    from lumencut.window import Opacity, Window

    made = dict(given)
    for name in ("window", "context_window"):
        if name in made:
            width, level = made[name]
            made[name] = Window(level=level, width=width)
    for name, kind in (("opacity", Opacity), ("slab", Slab)):
        if name in made:
            made[name] = kind(*made[name])
    if isinstance(made.get("context_transfer"), tuple):
        made["context_transfer"] = TransferFunction(made["context_transfer"])
    if made.get("context") == NO_CONTEXT:
        made["context"] = None
    if len(made.get("background", ())) == 3:
        made["background"] = (*made["background"], 255)
    return made
