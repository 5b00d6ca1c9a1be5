"""``lumencut spiral``: vessels whose sections are wound into spirals."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options, reformations

if TYPE_CHECKING:
    from lumencut.reformation import Reformation
    from lumencut.vessel import Vessel


@click.command("spiral", short_help="Show vessels as spirals of their sections (spiral CPR).")
@reformations.file_options
@reformations.output_option
@reformations.vessel_options
@click.option(
    "--pitch",
    type=float,
    metavar="MM",
    help="Distance between neighbouring windings (mm); default: a quarter of the median radius, at least "
    "the smallest side of a voxel.",
)
@click.option(
    "--radius",
    type=float,
    metavar="MM",
    help="How far the spiral reaches from the vessel (mm); default: 1.25 times its largest radius plus 2 mm.",
)
@click.option(
    "--sampling",
    type=click.Choice(("arc", "angle")),
    default="arc",
    show_default=True,
    help="arc: samples a pixel apart, so that widths are areas; angle: every winding has the same width.",
)
@click.option(
    "--angle", type=float, default=0.0, show_default=True, metavar="DEGREES", help="Turn the sections."
)
@reformations.up_option
@reformations.pixel_spacing_option
@reformations.smoothing_option
@reformations.picture_options
def spiral(**given: Any) -> None:
    """Show the vessels of CENTERLINES as spirals of their sections: all around a vessel in one still picture.

    The width of anything in a row is its area in the section, divided by the pitch.

    \b
    lumencut spiral ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD
    lumencut spiral ct.nii.gz centerlines.vtp -o graft.png --path 0,1,2 --pitch 2
    """  # noqa: D301 - click needs the control character itself
    options.check_picture(given["output"])
    chosen, settings = reformations.like(given, "spiral")
    renderer, _, vessels = reformations.read_vessels(chosen, settings, "spiral")
    names = ("pitch", "radius", "sampling", "pixel_spacing", "up", "smoothing")
    named = {name: chosen[name] for name in names}

    def make(vessel: Vessel) -> Reformation:
        from lumencut.spiral_reformation import spiral_of

        return spiral_of(renderer, vessel, **named, angle=math.radians(chosen["angle"]), settings=settings)

    reformations.write_each(chosen, vessels, make)
