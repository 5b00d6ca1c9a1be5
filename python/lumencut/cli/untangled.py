"""``lumencut untangled``: its picture, and the words about it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options, reformations
from lumencut.cli.dicom import check_objects, object_options
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import busy, detail, say, timings, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window
from lumencut.cli.vessels import shown_ids

if TYPE_CHECKING:
    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.untangled_tree import UntangledTree
    from lumencut.scene.settings import Settings

#: View options without effect on a layout.
UNUSED = {"size": (64, 64), "zoom": 1.0}


def show_untangled(**given: Any) -> None:
    """Write the picture of a tree."""
    options.check_picture(given["output"])
    chosen, settings = reformations.like(given, "untangled")
    view = options.view_from({**chosen, **UNUSED, "pixel_spacing": None})
    renderer = _renderer(chosen, settings)

    from lumencut.reformations.untangling import UntangledRequest

    own = {name: chosen[name] for name in UntangledRequest.stored}
    with busy("laying out the tree"):
        made = UntangledRequest(view, settings=settings, **own).of(renderer)
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

    from lumencut.pictures.renderer import Renderer

    renderer = Renderer(voxels, tree, files.device)
    warn_of_window(settings, renderer)
    return renderer if len(wanted) == len(tree) else renderer.with_tree(tree.select(*wanted))


def _print(output: str, made: UntangledTree) -> None:
    """Print the file, and warn of what it does not show."""
    import numpy as np

    turns = [abs(part.turn) for part in made.parts if part.turn]
    turned = f", {len(turns)} turned by up to {math.degrees(max(turns)):.0f}°" if turns else ", none turned"
    count = len(made.rotations)
    vessels = "1 vessel" if count == 1 else f"{count} vessels"
    say(f"{output}: {made.recipe.name} of {vessels}{turned}, pixels of {made.pixel_spacing:.4g} mm")
    detail(made.recipe.axes)
    warn_of_overlaps(made)
    if np.isnan(made.value).all():
        warn("no pixel lies in the volume")


def warn_of_overlaps(made: UntangledTree) -> None:
    """Warn of vessels that could not be separated."""
    if made.overlaps:
        ids = ", ".join(map(str, made.overlaps))
        warn(
            f"vessels that could not be separated: {ids}; show fewer vessels, or use a smaller --hull-margin"
        )
