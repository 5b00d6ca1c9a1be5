"""The commands that look at a vessel from inside, with their help texts and options."""

from __future__ import annotations

import click

from lumencut.cli.dicom import grey_option
from lumencut.cli.laid_out import reformation_options as shared
from lumencut.cli.laid_out.endoscopy import show_endoscopy, show_flight
from lumencut.cli.laid_out.reformation_options import command, option
from lumencut.cli.parameters import SIZE

_FROM_INSIDE = (
    *shared.VESSELS,
    option(
        "--lens",
        ("perspective", "fisheye"),
        "perspective: straight lines stay straight; fisheye: a round image of half of all directions.",
        "perspective",
    ),
    option(
        "--field-of-view",
        "DEGREES",
        "Angle across the smaller side of the picture; default: 100° in perspective, 180° with fisheye.",
    ),
    option("--size", SIZE, "Size of the picture (pixels).", "512x512", metavar=SIZE.name),
    option("--roll", "DEGREES", "Turn the picture clockwise.", 0.0),
)

ENDOSCOPY = command(
    "endoscopy",
    show_endoscopy,
    "Look at a vessel from inside.",
    """Show the wall of a vessel of CENTERLINES as an eye on its centerline sees it.

    The wall is the measured one. Calcium and metal are white; names mark the openings of branches. Of several
    vessels the longest is shown, unless --vessel or --path name one.

    \b
    lumencut endoscopy ct.nii.gz centerlines.vtp -o inside.png --vessel aorta --at 120
    lumencut endoscopy ct.nii.gz centerlines.vtp -o round.png --vessel aorta --at 120 --lens fisheye
    """,
    (
        shared.output("Picture (.png, .tif, .webp, …); .dcm (DICOM); .npz for the arrays."),
        option("--at", "MM", "Place of the eye along the vessel (mm).", 0.0),
        *_FROM_INSIDE,
        click.option("--backwards", is_flag=True, help="Look towards the start of the vessel."),
        shared.UP,
        shared.SMOOTHING,
    ),
)

FLY = command(
    "fly",
    show_flight,
    "Fly through a vessel (film).",
    """Write a film of a flight through a vessel of CENTERLINES, in the pictures of lumencut endoscopy.

    The flight slows down in bends. Of several vessels the longest is shown, unless --vessel or --path name
    one.

    \b
    lumencut fly ct.nii.gz centerlines.vtp -o fly.mp4 --vessel LAD
    lumencut fly ct.nii.gz centerlines.vtp -o back.webp --path 0,1,2 --from 200 --to 50 --speed 20
    """,
    (
        shared.output("Film (.webp, .apng, .mp4, .dcm, frame-%03d.png or a folder)."),
        click.option(
            "--from",
            "start",
            type=float,
            metavar="MM",
            default=0.0,
            show_default=True,
            help="Place along the vessel at which the flight starts (mm).",
        ),
        click.option(
            "--to",
            "end",
            type=float,
            metavar="MM",
            help="Place at which it ends (mm); default: the end of the vessel.",
        ),
        option("--speed", "MM/S", "Speed of the flight (mm per second).", 10.0),
        option("--fps", click.FloatRange(0.1, 100), "Frames per second.", 24),
        *_FROM_INSIDE,
        shared.UP,
        shared.SMOOTHING,
    ),
    (grey_option,),
)
