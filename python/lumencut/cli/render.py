"""``lumencut render``: one picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from lumencut.cli import options
from lumencut.cli.labels import check_labels, label_options, labels_of
from lumencut.cli.like import camera_like, like_option, recipe_from, typed
from lumencut.cli.report import detail, say, timings, verbose_option
from lumencut.cli.scene import check_scene, is_empty, read_scene, scene_from, shown, warn_of_emptiness
from lumencut.cli.settings import paper_option, setting_options, settings_from


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
@like_option
@label_options
@paper_option
@setting_options
@verbose_option
def render(
    output: tuple[Path, ...],
    **chosen: Any,
) -> None:
    """Render VOLUME along CENTERLINES as one picture.

    VOLUME is a DICOM folder or zip archive, NIfTI, NRRD or MetaImage file; CENTERLINES a .vtp, .vtk,
    .mrk.json, .fcsv, .pth, .swc, .tre, .csv, .txt or .npy file.
    Without CENTERLINES the context alone is shown, all of the volume. The view fits all vessels, or the
    volume, unless --center, --pixel-spacing or --zoom say otherwise.

    \b
    lumencut render ct.nii.gz centerlines.vtp -o anterior.png
    lumencut render dicom/ lines.mrk.json -o oblique.png --rotate 30 --tilt 15 --window 900/300
    lumencut render later.nii.gz lines.vtp -o later.png --like oblique.png
    lumencut render ct.nii.gz -o body.png --context dvr --context-transfer soft-tissue
    """  # noqa: D301 - click needs the control character itself
    recipe = recipe_from(chosen["like"])
    given = chosen if recipe is None else typed(chosen)
    settings = settings_from(given, None if recipe is None else recipe.settings)
    view = options.view_from(chosen) if recipe is None else camera_like(recipe.camera, given)
    files = scene_from(chosen)
    check_scene(files, chosen, settings)
    for path in output:
        options.check_picture(path)
    check_labels(chosen, output, view.size)
    renderer = read_scene(files, chosen)
    camera = options.placed(view, renderer.scene, chosen) if recipe is None else view
    frame = renderer.render(camera, settings)
    timings("rendered", frame.timings)
    detail(f"device: {renderer.device}")
    if is_empty(frame):
        warn_of_emptiness("no pixel of the view", frame.camera, renderer)
    for path in output:
        frame.save(path, **labels_of(path, chosen, recipe))
        say(f"{path}: {shown(frame.camera, settings, renderer)}")
