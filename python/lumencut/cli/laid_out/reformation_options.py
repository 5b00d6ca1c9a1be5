"""Options that several commands of reformations have, and the function that declares an option."""

from __future__ import annotations

from typing import Any

import click

from lumencut._lumencut import PIXEL_SIDE
from lumencut.cli import options
from lumencut.cli.dicom import dicom_options
from lumencut.cli.parameters import VECTOR
from lumencut.cli.report import verbose_option
from lumencut.cli.settings import look_options
from lumencut.cli.vessels import path_option


def option(
    name: str, unit: Any, words: str, default: Any = None, *, is_shown: bool = True, **how: Any
) -> Any:
    """Return an option: a number with a unit, a value of a type, or one of some names."""
    if isinstance(unit, str):
        how = {"type": float, "metavar": unit, **how}
    else:
        how = {"type": click.Choice(unit) if isinstance(unit, tuple) else unit, **how}
    return click.option(
        name, help=words, default=default, show_default=is_shown and default is not None, **how
    )


def output(words: str) -> Any:
    """Return the option for the file to write."""
    return click.option("-o", "--output", type=options.FILE, required=True, help=words)


#: The scan and the centerlines.
SCENE = (
    click.argument("volume", type=options.FILE),
    click.argument("centerlines", type=options.FILE, nargs=-1, required=True),
)

PICTURES = output("Picture (.png, .tif, .webp, …); .dcm (DICOM); .npz for the arrays of one vessel.")
SMOOTHING = option(
    "--smoothing", "MM", "Smooth the centerlines by a Gaussian with this standard deviation (mm).", 0.0
)
UP = option("--up", VECTOR, "The direction that points up (LPS).", "0,0,1")
SIDE = option("--pixel-spacing", "MM", f"Side of a pixel (mm); default: {PIXEL_SIDE}.")

#: The options that select vessels, each shown separately.
VESSELS = (options.shown_vessel_options, path_option)

#: The options of every command, listed after its own.
LAST = (
    click.option(
        "--annotate/--no-annotate",
        default=True,
        show_default=True,
        help="Label the pictures with method, window, axes, names and scales.",
    ),
    option(
        "--like",
        options.FILE,
        "Take the options and settings of a .png that this command wrote. Other options change them further.",
        metavar="PICTURE.png",
    ),
    *(dicom_options, options.reading_options, look_options, verbose_option),
)


def command(
    name: str, run: Any, summary: str, words: str, own: tuple[Any, ...], more: tuple[Any, ...] = ()
) -> click.Command:
    """A command: its function, its short and long help texts, and its options in the order of the help."""
    parts = (*SCENE, *own, *LAST, *more)
    return click.command(name, short_help=summary, help=words)(options.added(parts, run))
