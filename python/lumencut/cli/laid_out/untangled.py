"""``lumencut untangled`` and ``network``: their pictures, and the words about them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import check_objects, object_options
from lumencut.cli.laid_out import each
from lumencut.cli.measure import rim_profiles
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import busy, detail, say, timings, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window
from lumencut.cli.vessels import shown_ids

if TYPE_CHECKING:
    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.untangled_tree import UntangledTree
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

#: View options without effect on a layout.
_UNUSED = {"size": (64, 64), "zoom": 1.0}


def show_untangled(**given: Any) -> None:
    """Write the picture of a tree."""
    options.check_picture(given["output"])
    chosen, settings = each.like(given, "untangled")
    view = options.view_from({**chosen, **_UNUSED, "pixel_spacing": None})
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


def show_network(**given: Any) -> None:
    """Write the map of a tree."""
    options.check_picture(given["output"])
    chosen, _ = each.like(given, "network")
    view = options.view_from({**chosen, **_UNUSED, "pixel_spacing": None})
    output, value = chosen["output"], chosen["value"]
    voxels, tree = _read(chosen, "network")
    profiles = rim_profiles(chosen, value, voxels, tree)

    from lumencut.reformations.network_map import network

    shown = tree.select(*shown_ids(tree, chosen))
    with busy("laying out the tree"):
        made = network(voxels, shown, profiles, value, view, chosen["hull_margin"], chosen["pixel_spacing"])
    with busy(f"writing {output.name}"):
        made.save(output, annotate=chosen["annotate"], **object_options(output, chosen))
    say(f"{output}: {made.recipe.name}, {made.legend}")
    detail(made.recipe.axes)
    _warn_of_overlaps(made)


def _read(chosen: dict[str, Any], command: str) -> tuple[Volume, VesselTree]:
    """Read the files of a command; reject options without effect."""
    files = scene_from(chosen)
    check_objects(chosen, [chosen["output"]])
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError(f"lumencut {command} needs VOLUME and CENTERLINES")
    return voxels, tree


def _renderer(chosen: dict[str, Any], settings: Settings) -> Renderer:
    """Return a renderer of the chosen vessels, with the window of all vessels."""
    voxels, tree = _read(chosen, "untangled")
    wanted = shown_ids(tree, chosen)

    from lumencut.pictures.renderer import Renderer

    renderer = Renderer(voxels, tree, chosen["device"])
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
    _warn_of_overlaps(made)
    if np.isnan(made.value).all():
        warn("no pixel lies in the volume")


def _warn_of_overlaps(made: UntangledTree) -> None:
    """Warn of vessels that could not be separated."""
    if made.overlaps:
        ids = ", ".join(map(str, made.overlaps))
        warn(
            f"vessels that could not be separated: {ids}; show fewer vessels, or use a smaller --hull-margin"
        )
