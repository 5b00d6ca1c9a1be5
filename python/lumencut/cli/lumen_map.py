"""``lumencut map``: the walls of vessels, cut open and unrolled."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options, reformations
from lumencut.cli.parameters import Parts

if TYPE_CHECKING:
    from lumencut.reformation import Reformation
    from lumencut.vessel import Vessel

#: The names of ``lumencut.unrolled_wall.MODES``; copied so that ``--help`` does not import numpy.
MODES = ("wall", "radius", "thickness", "shaded")


@click.command("map", short_help="Unroll the walls of vessels (lumen map).")
@reformations.file_options
@reformations.output_option
@click.option(
    "--mode",
    type=click.Choice(MODES),
    default="wall",
    show_default=True,
    help="wall: the volume at the wall, such as calcium and struts; radius: how far the wall is from the "
    "centerline, in colour; thickness: thickness of calcium or metal at the wall, in colour; shaded: the "
    "wall as a surface lit from within.",
)
@reformations.vessel_options
@click.option(
    "--angle",
    type=float,
    metavar="DEGREES",
    help="The direction around the vessel in the middle; 0 is to the right of the straightened CPR. "
    "Default: the side with most calcium, so that the cut does not run through it.",
)
@click.option(
    "--overlap",
    type=float,
    default=15.0,
    show_default=True,
    metavar="DEGREES",
    help="How much of the other side is repeated beyond each edge, dimmed.",
)
@click.option(
    "--band",
    type=Parts("FROM:TO", ":", float),
    default="-1:3",
    show_default=True,
    help="The band beyond the wall that is searched (mm).",
)
@click.option(
    "--show",
    type=click.Choice(("max", "mean", "min")),
    default="max",
    show_default=True,
    help="Which value of this band --mode wall shows.",
)
@click.option(
    "--calcium-level",
    type=float,
    metavar="LEVEL",
    help="Calcium or metal at the wall begins at this level; default: the lumen's level plus half "
    "of its contrast, at least 130.",
)
@reformations.up_option
@reformations.pixel_spacing_option
@reformations.smoothing_option
@reformations.picture_options
def lumen_map(**given: Any) -> None:
    """Cut the walls of the vessels of CENTERLINES open and unroll them: the lumen map.

    Rows are along the vessel, columns go once around it. Branches open as holes. All vessels are shown side
    by side, each below its id and name, unless --vessel, --exclude or --path choose among them.

    \b
    lumencut map ct.nii.gz centerlines.vtp -o stent.png --path 0,1,2
    lumencut map ct.nii.gz centerlines.vtp -o calcium.png --vessel LAD --mode thickness
    """  # noqa: D301 - click needs the control character itself
    options.check_picture(given["output"])
    chosen, settings = reformations.like(given, "map")
    renderer, tree, vessels = reformations.read_vessels(chosen, settings, "map")
    names = ("mode", "pixel_spacing", "band", "show", "calcium_level", "up", "smoothing")
    named = {name: chosen[name] for name in names}
    angle = None if chosen["angle"] is None else math.radians(chosen["angle"])

    def make(vessel: Vessel) -> Reformation:
        from lumencut.lumen_mapping import lumen_map_of

        overlap = math.radians(chosen["overlap"])
        return lumen_map_of(
            renderer, vessel, **named, angle=angle, overlap=overlap, tree=tree, settings=settings
        )

    reformations.write_each(chosen, vessels, make)
