"""``lumencut flatten``: its picture, and the words about it."""

from __future__ import annotations

from typing import Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import check_objects, object_options
from lumencut.cli.laid_out import each
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import busy, detail, say, timings, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window


def show_flattened(**given: Any) -> None:
    """Write the picture of the surface through the vessels of a file."""
    options.check_picture(given["output"])
    chosen, settings = each.like(given, "flatten")
    files = scene_from(chosen)
    check_objects(chosen, [chosen["output"]])
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError("lumencut flatten needs VOLUME and CENTERLINES")
    import numpy as np

    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.flattening import FlattenRequest

    renderer = Renderer(voxels, None, files.device)
    warn_of_window(settings, renderer)
    request = FlattenRequest(chosen["keep"], chosen["pixel_spacing"], settings=settings)
    with busy("laying out the surface"):
        made = request.of(renderer, [vessel.points for vessel in tree])
        _ = made.image
    timings("surface", made.timings)
    output = chosen["output"]
    with busy(f"writing {output.name}"):
        made.save(output, annotate=chosen["annotate"], **object_options(output, chosen))
    distortion, shear = (np.nanpercentile(np.abs(one), 95) for one in (made.distortion, made.shear))
    say(
        f"{output}: {made.recipe.name} of {len(tree)} curves, pixels of {made.pixel_spacing:.4g} mm, "
        f"areas within {100 * distortion:.1f} % and shear within {shear:.2f} (95 % of the pixels)"
    )
    detail(made.recipe.axes)
    if np.isnan(made.value).all():
        warn("no pixel lies in the volume")
