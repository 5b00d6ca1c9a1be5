"""``lumencut render``: pictures of one scene."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import check_objects, dicom_options, is_object, object_options
from lumencut.cli.found_vessels import WITH_FOUND, check_found, found_options
from lumencut.cli.labels import check_labels, label_options, labels_of
from lumencut.cli.like import (
    beside_session,
    camera_of,
    like_option,
    recipe_from,
    typed,
    views_of,
    warn_of_vessels,
)
from lumencut.cli.measure import rim_profiles
from lumencut.cli.outputs import name_of, pictures
from lumencut.cli.report import bar, busy, detail, say, timings, verbose_option
from lumencut.cli.scene import (
    check_scene,
    is_empty,
    read_scene,
    scene_from,
    shown,
    warn_of_emptiness,
    warn_of_window,
)
from lumencut.cli.settings import paper_option, rim_option, setting_options, settings_from

if TYPE_CHECKING:
    from lumencut.pictures.recipe import Recipe
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

#: The names of `lumencut.pictures.hanging.HANGINGS`; copied so that ``--help`` does not import numpy.
HANGINGS = ("evar", "carotid", "runoff", "coronary", "head")


@click.command(short_help="Render pictures.")
@options.scene_arguments
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    multiple=True,
    required=True,
    help="Picture (.png, .tif, .webp, …), .dcm (DICOM), or .npz for depth, vessels, values and positions; "
    "may be repeated. Each of several views is written to every output, with its name before the extension "
    "or in place of {view}.",
)
@options.several_views_options
@click.option(
    "--hanging",
    type=click.Choice(HANGINGS),
    help="A fixed set of views in a fixed order with one field of view, as one series of .dcm, instead of "
    "--view.",
)
@found_options
@click.option(
    "--all-parts",
    is_flag=True,
    help="Show all vessels that --find finds, not only those connected to the most important one.",
)
@click.option("--ras", is_flag=True, help="The seed is in RAS, not LPS.")
@like_option
@label_options
@dicom_options
@click.option(
    "--values",
    is_flag=True,
    help="For .dcm: the values at the cut surface as a derived CT or MR image, for any window, no labels.",
)
@paper_option
@setting_options
@rim_option
@verbose_option
def render(
    output: tuple[Path, ...],
    hanging: str | None,
    **chosen: Any,
) -> None:
    """Render VOLUME along CENTERLINES as one picture, or one for each --view.

    VOLUME is a DICOM folder or zip archive, NIfTI, NRRD or MetaImage file; CENTERLINES one or several .vtp,
    .vtk, .mrk.json, .fcsv, .pth, .swc, .tre, .csv, .txt or .npy files, whose vessels are shown together.
    --find finds the vessels of VOLUME and shows those connected to the most important one; --seed shows those
    connected to the vessel at this point. Without any of these the picture shows the context alone, all of
    the volume. The view fits all vessels, or the volume, unless --center, --pixel-spacing or --zoom change
    it.

    \b
    lumencut render ct.nii.gz centerlines.vtp -o anterior.png
    lumencut render dicom/ lines.mrk.json -o oblique.png --rotate 30 --tilt 15 --window 900/300
    lumencut render ct.nrrd LAD.mrk.json LCX.mrk.json --view left --view 0,1,1 --zoom-to LAD -o {view}.png
    lumencut render ct.nii.gz --find -o all.png
    lumencut render ct.nii.gz --seed 12,-30,85 -o tree.png
    lumencut render later.nii.gz lines.vtp -o later.png --like oblique.png
    lumencut render ct.nii.gz -o body.png --context dvr --context-transfer soft-tissue
    """  # noqa: D301 - click needs the control character itself
    chosen = beside_session(chosen)
    recipe = recipe_from(chosen["like"])
    given = chosen if recipe is None else typed(chosen)
    settings = settings_from(given, None if recipe is None else recipe.settings)
    views = views_of(chosen, recipe) if hanging is None else _hanging(hanging, chosen)
    planned = pictures([view for view, _ in views], output)
    files = scene_from(chosen)
    check_found(chosen, (*WITH_FOUND, "dark"))
    if chosen["ras"] and chosen["seed"] is None:
        raise click.UsageError("--ras without --seed does nothing; leave out --ras")
    check_scene(files, chosen, settings)
    check_labels(chosen, output, views[0][1].size)
    check_objects(chosen, output)
    if chosen["values"] and (chosen["annotate"] or chosen["compress"]):
        raise click.UsageError("--values has no labels and is not compressed; leave out these options")
    renderer, scene = read_scene(files, chosen, partial(rim_profiles, chosen, settings.rim))
    warn_of_window(settings, renderer)
    warn_of_vessels(chosen, recipe, renderer)
    cameras = _placed(views, scene, chosen, recipe, is_hanging=hanging is not None)
    for number, (picture, camera) in enumerate(zip(planned, cameras, strict=True), 1):
        name = "" if len(planned) == 1 else f" {name_of(picture.view)}"
        with bar(f"rendering{name}", "share") as progress:
            frame = renderer.render(camera, settings, progress=progress)
        timings(f"rendered{name}", frame.timings)
        if is_empty(frame):
            warn_of_emptiness(f"no pixel of the view{name}", frame.camera, renderer)
        for path in picture.paths:
            with busy(f"writing {path.name}"):
                labels = labels_of(path, chosen, recipe)
                if is_object(path):
                    how = {**object_options(path, chosen), "values": chosen["values"], "number": number}
                    labels["annotate"] &= not chosen["values"]
                    frame._save_object(path, labels, **how)
                else:
                    frame.save(path, **labels)
            say(f"{path}: {shown(frame.camera, settings, renderer)}")
    detail(f"device: {renderer.device}")


def _hanging(name: str, chosen: dict[str, Any]) -> list[tuple[Any, Camera]]:
    """Return the views of a hanging; it cannot be combined with options for the viewing direction."""
    for other in ("view", "like", "up", "rotate", "tilt", "center", "zoom_to"):
        if other in typed(chosen):
            found = f"--{other.replace('_', '-')} does nothing with --hanging"
            raise click.UsageError(f"{found}, which sets the views; leave out --{other.replace('_', '-')}")
    from lumencut.pictures.hanging import hanging_views

    return list(hanging_views(name, chosen["size"]))


def _placed(
    views: list[tuple[Any, Camera]],
    scene: VesselTree | Volume,
    chosen: dict[str, Any],
    recipe: Recipe | None,
    *,
    is_hanging: bool,
) -> list[Camera]:
    """Return the views with their cameras in position; all views of a hanging have one pixel spacing."""
    if not is_hanging:
        return [camera_of(view, scene, chosen, recipe) for _, view in views]
    from lumencut.pictures.hanging import fitted_alike

    alike = fitted_alike([view for _, view in views], scene)
    return [options.placed_like(camera, chosen) for camera in alike]
