"""``lumencut untangled``: every vessel of a tree cut open in one picture without overlap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options, reformations
from lumencut.cli.dicom import check_objects, object_options
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.parameters import VECTOR
from lumencut.cli.report import busy, detail, say, timings, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window
from lumencut.cli.vessels import shown_ids

if TYPE_CHECKING:
    from lumencut.renderer import Renderer
    from lumencut.settings import Settings
    from lumencut.untangled_tree import UntangledTree

_UNUSED = {"size": (64, 64), "zoom": 1.0}


@click.command("untangled", short_help="Show a vessel tree without overlap (untangled CPR).")
@reformations.file_options
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    required=True,
    help="Picture (.png, .tif, .webp, …), or .npz for the arrays.",
)
@options.shown_vessel_options
@options.direction_options
@click.option(
    "--width",
    type=float,
    default=25.0,
    show_default=True,
    metavar="MM",
    help="How far from each vessel its surroundings are shown (mm), on each side.",
)
@click.option(
    "--hull-margin",
    type=float,
    default=2.0,
    show_default=True,
    metavar="MM",
    help="Margin around the lumen that no other vessel may enter (mm).",
)
@click.option(
    "--smoothing",
    type=float,
    default=4.0,
    show_default=True,
    metavar="MM",
    help="Smooth the directions of vessels in the view by a Gaussian with this standard deviation (mm).",
)
@reformations.pixel_spacing_option
@click.option(
    "--root",
    type=VECTOR,
    help="Point (mm, LPS) near the end of the vessel from which the tree grows; default: the free end with "
    "the largest radius.",
)
@click.option(
    "--unknown-radius",
    type=float,
    metavar="MM",
    help="Radius of vessels that have none (mm); default: 1.",
)
@reformations.picture_options
def untangled(**given: Any) -> None:
    """Cut every vessel of CENTERLINES open in one picture without overlap: untangled CPR.

    Each vessel keeps its direction in the view and its true length. Branches that would overlap are turned at
    their origin by the smallest angle that separates them; arcs show turns of more than 5°. With more than
    about 15 vessels, choose among them by --vessel or --exclude.

    \b
    lumencut untangled ct.nii.gz centerlines.vtp -o tree.png
    lumencut untangled ct.nii.gz centerlines.vtp -o legs.png --view left --exclude SMA --slab 4mm:mean
    """  # noqa: D301 - click needs the control character itself
    options.check_picture(given["output"])
    chosen, settings = reformations.like(given, "untangled")
    view = options.view_from({**chosen, **_UNUSED, "pixel_spacing": None})
    renderer = _renderer(chosen, settings)

    from lumencut.untangling import untangled_of

    names = ("width", "hull_margin", "smoothing", "pixel_spacing", "root")
    with busy("laying out the tree"):
        made = untangled_of(renderer, view, **{name: chosen[name] for name in names}, settings=settings)
        _ = made.image
    timings("tree", made.timings)
    output = chosen["output"]
    with busy(f"writing {output.name}"):
        made.save(output, annotate=chosen["annotate"], **object_options(output, chosen))
    _print(str(output), made)


def _renderer(chosen: dict[str, Any], settings: Settings) -> Renderer:
    """Return a renderer of the chosen vessels, with the window of all vessels."""
    files = scene_from(chosen)
    check_objects(chosen, [chosen["output"]])
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError("lumencut untangled needs VOLUME and CENTERLINES")
    wanted = shown_ids(tree, chosen)

    from lumencut.renderer import Renderer

    renderer = Renderer(voxels, tree, files.device)
    warn_of_window(settings, renderer)
    return renderer if len(wanted) == len(tree) else renderer.with_tree(tree.select(*wanted))


def _print(output: str, made: UntangledTree) -> None:
    """Print the files, and warn of vessels that could not be separated."""
    import numpy as np

    turns = [abs(part.turn) for part in made.parts if part.turn]
    turned = f", {len(turns)} turned by up to {math.degrees(max(turns)):.0f}°" if turns else ", none turned"
    count = len(made.rotations)
    vessels = "1 vessel" if count == 1 else f"{count} vessels"
    say(f"{output}: {made.recipe.name} of {vessels}{turned}, pixels of {made.pixel_spacing:.4g} mm")
    detail(made.recipe.axes)
    if made.overlaps:
        ids = ", ".join(map(str, made.overlaps))
        warn(
            f"vessels that could not be separated: {ids}; show fewer vessels, or use a smaller --hull-margin"
        )
    if np.isnan(made.value).all():
        warn("no pixel lies in the volume")
