"""``lumencut render``: one picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import click

from lumencut.cli import options
from lumencut.cli.report import detail, say, timings, verbose_option
from lumencut.cli.scene import check_scene, is_empty, read_scene, shown, warn_of_emptiness
from lumencut.cli.settings import setting_options, settings_from


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
@setting_options
@verbose_option
def render(
    volume: Path,
    centerlines: Path | None,
    coordinates: Literal["lps", "ras"] | None,
    series: str | None,
    device: Literal["auto", "cpu", "gpu"],
    output: tuple[Path, ...],
    **chosen: Any,
) -> None:
    """Render VOLUME along CENTERLINES as one picture.

    VOLUME is a DICOM folder, NIfTI, NRRD or MetaImage file; CENTERLINES a .vtp, .vtk or .mrk.json file.
    Without CENTERLINES the context alone is shown, all of the volume. The view fits all vessels, or the
    volume, unless --center, --pixel-spacing or --zoom say otherwise.

    \b
    lumencut render ct.nii.gz centerlines.vtp -o anterior.png
    lumencut render dicom/ lines.mrk.json -o oblique.png --rotate 30 --tilt 15 --window 900/300
    lumencut render ct.nii.gz -o body.png --context dvr --context-transfer soft-tissue
    """  # noqa: D301 - click needs the control character itself
    settings, view = settings_from(chosen), options.view_from(chosen)
    check_scene(centerlines, coordinates, settings)
    for path in output:
        options.check_picture(path)
    renderer = read_scene(volume, centerlines, coordinates, series, device)
    frame = renderer.render(options.placed(view, renderer.scene, chosen), settings)
    timings("rendered", frame.timings)
    detail(f"device: {renderer.device}")
    if is_empty(frame):
        warn_of_emptiness("no pixel of the view", frame.camera, renderer)
    for path in output:
        frame.save(path)
        say(f"{path}: {shown(frame.camera, settings, renderer)}")
