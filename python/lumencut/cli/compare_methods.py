"""``lumencut compare``: mpCPR, CR and CSR of one view side by side."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import check_objects, dicom_options, is_object, save_sheet
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
from lumencut.cli.outputs import name_of, pictures
from lumencut.cli.report import busy, detail, say, verbose_option
from lumencut.cli.scene import (
    check_scene,
    is_empty,
    read_scene,
    scene_from,
    shown,
    warn_of_emptiness,
    warn_of_window,
)
from lumencut.cli.settings import setting_options, settings_from

if TYPE_CHECKING:
    from lumencut.evaluation.methods_side_by_side import Panel
    from lumencut.reformations.untangled_tree import UntangledTree
    from lumencut.scene.camera import Camera


@click.command("compare", short_help="Show mpCPR, CR and CSR side by side.")
@options.scene_arguments
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    multiple=True,
    required=True,
    help="Picture (.png, .tif, .webp, …) or .dcm (DICOM); may be repeated. Each of several views is written "
    "to every output, with its name before the extension or in the place of {view}.",
)
@click.option(
    "--radius-offset",
    type=float,
    default=50.0,
    show_default=True,
    metavar="PIXELS",
    help="CR: how far beyond its radius a vessel hides what lies behind it.",
)
@click.option(
    "--arc-threshold",
    type=float,
    default=150.0,
    show_default=True,
    metavar="PIXELS",
    help="CR: the largest distance along the tree at which two places belong to one stretch.",
)
@click.option(
    "--untangled",
    is_flag=True,
    help="Also show the untangled CPR of the view, on the right: every vessel, without overlap.",
)
@options.several_views_options
@like_option
@label_options
@dicom_options
@setting_options
@verbose_option
def compare_methods(
    output: tuple[Path, ...], radius_offset: float, arc_threshold: float, untangled: bool, **chosen: Any
) -> None:
    """Show VOLUME along CENTERLINES by four methods, side by side in one picture, or one for each --view.

    From the left: multipath CPR (mpCPR), Centerline Reformation (CR), CSR by the paper's rules, and CSR by
    the settings given. Below each of the first three, colours show how far its depth differs from that of the
    last, in mm. --size is that of one of the four pictures.

    \b
    lumencut compare ct.nii.gz centerlines.vtp -o compare.png
    lumencut compare ct.nii.gz centerlines.vtp -o compare.png --view left --size 512x512 --radius-offset 20
    """  # noqa: D301 - click needs the control character itself
    chosen = beside_session(chosen)
    recipe = recipe_from(chosen["like"])
    given = chosen if recipe is None else typed(chosen)
    settings = settings_from(given, None if recipe is None else recipe.settings)
    views = views_of(chosen, recipe)
    planned = pictures([view for view, _ in views], output)
    files = scene_from(chosen)
    _check(output, views[0][1].size, chosen, (radius_offset, arc_threshold))
    check_scene(files, chosen, settings)
    check_labels(chosen, output, views[0][1].size)
    check_objects(chosen, output)
    renderer, scene = read_scene(files, chosen)
    warn_of_window(settings, renderer)
    warn_of_vessels(chosen, recipe, renderer)

    from lumencut.evaluation.methods_side_by_side import panels, side_by_side
    from lumencut.reformations.untangling import UntangledRequest

    for picture, (_, view) in zip(planned, views, strict=True):
        camera = camera_of(view, scene, chosen, recipe)
        name = "" if len(planned) == 1 else f" {name_of(picture.view)}"
        with busy(f"rendering{name}"):
            found = panels(renderer, camera, settings, radius_offset, arc_threshold)
            tree = UntangledRequest(camera, settings=settings).of(renderer) if untangled else None
        if is_empty(found[-1].frame):
            warn_of_emptiness(f"no pixel of the view{name}", camera, renderer)
        for path in picture.paths:
            with busy(f"writing {path.name}"):
                labels = labels_of(path, chosen, recipe)
                further = [] if tree is None else [("Untangled CPR", _picture(tree, labels))]
                labels["vessel_names"] &= not (is_object(path) and chosen["anonymous"])
                sheet = side_by_side(found, _labelled(found, labels), further)
                about = ("CSR and other methods", _words(camera), settings)
                save_sheet(sheet, path, chosen, about, renderer.volume)
            say(f"{path}: {shown(camera, settings, renderer)}")
    detail(f"device: {renderer.device}")


def _words(camera: Camera) -> str:
    """Return the description of the sheet for its DICOM object."""
    from lumencut.scene.orientation import view_name

    return f"mpCPR, CR and CSR side by side, and how far their depths differ. View {view_name(camera)}."


def _picture(tree: UntangledTree, labels: dict[str, bool]) -> Any:
    """Return the picture of the untangled tree, with labels if requested."""
    return tree.annotated() if labels["annotate"] else tree.image


def _labelled(found: list[Panel], labels: dict[str, bool]) -> list[Any]:
    """Return the pictures of the panels with the requested labels."""
    if not labels["annotate"]:
        return [panel.frame.image for panel in found]
    return [panel.frame.annotated(vessel_names=labels["vessel_names"]) for panel in found]


def _check(
    output: tuple[Path, ...], size: tuple[int, int], chosen: dict[str, Any], thresholds: tuple[float, float]
) -> None:
    """Reject what cannot be compared before any file is read."""
    from lumencut.errors import SettingsError
    from lumencut.evaluation.methods_side_by_side import SMALLEST_SIDE
    from lumencut.reformations.tree_reformations import cr_method

    if not chosen["centerlines"]:
        raise click.UsageError("found no CENTERLINES; expected VOLUME, then CENTERLINES to compare along")
    arrays = next((path for path in output if path.suffix.lower() == ".npz"), None)
    if arrays is not None:
        raise click.UsageError(
            f"{arrays}: found the extension '.npz'; expected a picture format such as .png"
        )
    if min(size) < SMALLEST_SIDE:
        width, height = size
        raise click.UsageError(
            f"--size {width}x{height} leaves no room for words; expected {SMALLEST_SIDE} pixels or more each"
        )
    try:
        cr_method(*thresholds)
    except SettingsError as error:
        raise click.UsageError(f"--{str(error).replace('_', '-')}") from error
