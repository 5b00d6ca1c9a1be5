"""``lumencut trace``: centerlines of a mask."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from lumencut.cli.options import FILE, threads_option
from lumencut.cli.report import bar, say, verbose_option
from lumencut.cli.trace_mask import mask_options, traced_from_mask


@click.command(short_help="Trace the centerlines of a mask.")
@click.argument("volume", type=FILE, required=False)
@mask_options
@click.option(
    "-o",
    "--output",
    type=FILE,
    required=True,
    help="The centerlines: .vtp, .mrk.json, .vtk, .csv or .swc.",
)
@threads_option
@verbose_option
def trace(volume: Path | None, output: Path, **chosen: Any) -> None:
    """Trace the centerlines of a mask of the lumen, or of labels of a label map.

    VOLUME is the angiography, whose grid must be that of the mask.

    \b
    lumencut trace --mask lumen.nii.gz -o lines.vtp
    lumencut trace --mask total.nii.gz --label 52=aorta --label 65 -o lines.vtp
    """  # noqa: D301 - click needs the control character itself
    if chosen["mask"] is None:
        raise click.UsageError("Missing option '--mask'.")
    from lumencut.centerline_writers import write_centerlines
    from lumencut.volume_files import read_volume

    voxels = None
    if volume is not None:
        with bar(f"reading {volume.name}", "slice") as told:
            voxels = read_volume(volume, progress=told)
    write_centerlines(traced_from_mask(chosen, voxels), output)
    say(str(output))
