"""``lumencut render``: one picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import click

from lumencut.cli import options
from lumencut.cli.report import say, timings, verbose_option
from lumencut.cli.scene import is_empty, read_scene, warn_of_emptiness


@click.command(short_help="Render one picture.")
@options.scene_arguments
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    multiple=True,
    required=True,
    help="Picture (.png, .tif, .webp, …), or .npz for depth, vessels, values and positions too; "
    "may be repeated.",
)
@options.view_options
@options.setting_options
@verbose_option
def render(
    volume: Path,
    centerlines: Path,
    coordinates: Literal["lps", "ras"] | None,
    series: str | None,
    output: tuple[Path, ...],
    **chosen: Any,
) -> None:
    """Render VOLUME along CENTERLINES as one picture.

    VOLUME is a DICOM folder, NIfTI, NRRD or MetaImage file; CENTERLINES a .vtp, .vtk or .mrk.json file.
    The view fits all vessels unless --center, --pixel-spacing or --zoom say otherwise.

    \b
    lumencut render ct.nii.gz centerlines.vtp -o anterior.png
    lumencut render dicom/ lines.mrk.json -o oblique.png --rotate 30 --tilt 15 --window 900/300
    """  # noqa: D301 - click needs the control character itself
    settings, view = options.settings_from(chosen), options.view_from(chosen)
    for path in output:
        options.check_picture(path)
    renderer = read_scene(volume, centerlines, coordinates, series)
    frame = renderer.render(options.placed(view, renderer.scene, chosen), settings)
    timings("rendered", frame.timings)
    if is_empty(frame):
        warn_of_emptiness("no pixel of the view", frame.camera, renderer)
    for path in output:
        frame.save(path)
        say(f"{path}: {options.described(frame.camera, settings.window or renderer.window)}")
