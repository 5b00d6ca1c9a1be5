"""``lumencut network``: its picture, and the words about it."""

from __future__ import annotations

from typing import Any

import click

from lumencut.cli import options, reformations
from lumencut.cli.dicom import check_objects, object_options
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import busy, detail, say
from lumencut.cli.rim import rim_profiles
from lumencut.cli.scene import read_files, scene_from
from lumencut.cli.untangled import UNUSED, warn_of_overlaps
from lumencut.cli.vessels import shown_ids


def show_network(**given: Any) -> None:
    """Write the map of a tree."""
    options.check_picture(given["output"])
    chosen, _ = reformations.like(given, "network")
    view = options.view_from({**chosen, **UNUSED, "pixel_spacing": None})
    files = scene_from(chosen)
    output, value = chosen["output"], chosen["value"]
    check_objects(chosen, [output])
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError("lumencut network needs VOLUME and CENTERLINES")
    profiles = rim_profiles((voxels, tree), chosen, value)

    from lumencut.reformations.network_map import network

    shown = tree.select(*shown_ids(tree, chosen))
    with busy("laying out the tree"):
        made = network(voxels, shown, profiles, value, view, chosen["hull_margin"], chosen["pixel_spacing"])
    with busy(f"writing {output.name}"):
        made.save(output, annotate=chosen["annotate"], **object_options(output, chosen))
    say(f"{output}: {made.recipe.name}, {made.legend}")
    detail(made.recipe.axes)
    warn_of_overlaps(made)
