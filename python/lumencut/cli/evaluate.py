"""``lumencut evaluate``: how well methods show the true lumen."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import click

from lumencut.cli import options
from lumencut.cli.mistakes import check_files, check_measured, check_options, check_reading
from lumencut.cli.parameters import SIZE
from lumencut.cli.report import bar, say, verbose_option
from lumencut.cli.scene import SceneFiles, read_files, scene_from
from lumencut.cli.settings import setting_options, settings_from
from lumencut.errors import FileError, SettingsError

if TYPE_CHECKING:
    from lumencut.evaluation import Evaluation
    from lumencut.scene.vessel_tree import VesselTree


@click.command(short_help="Measure how much of the true lumen each method shows.")
@click.argument("files", type=options.FILE, nargs=-1, required=True, metavar="[VOLUME] CENTERLINES...")
@options.reading_options
@click.option(
    "--methods",
    default="csr,csr-paper,cpr,mpcpr,cr",
    show_default=True,
    metavar="NAME,...",
    help="csr: with the settings given; csr-paper: with the paper's rules instead; cpr: the projected "
    "CPR of each single vessel; mpcpr: multipath CPR; cr: Centerline Reformation; untangled: the tree "
    "without overlap, evaluated for tissue and centerline.",
)
@click.option(
    "--views",
    type=click.IntRange(1, 10000),
    default=12,
    show_default=True,
    help="Number of views, spread evenly over the sphere.",
)
@click.option(
    "--size",
    type=SIZE,
    default="512x512",
    show_default=True,
    metavar=SIZE.name,
    help="Size of the views (pixels).",
)
@click.option(
    "--pixel-spacing", type=float, metavar="MM", help="Side of a pixel (mm); default: fits the vessels."
)
@click.option("--csv", type=options.FILE, help="Write the table as comma-separated values.")
@click.option("--markdown", type=options.FILE, help="Write the table as Markdown.")
@click.option(
    "--pictures",
    type=options.FILE,
    metavar="FOLDER",
    help="Write a picture of the worst view of each method; needs VOLUME.",
)
@setting_options
@verbose_option
def evaluate(
    files: tuple[Path, ...],
    csv: Path | None,
    markdown: Path | None,
    pictures: Path | None,
    **chosen: Any,
) -> None:
    """Measure how much of the true lumen of CENTERLINES each method shows, over views from all sides.

    The truth at each pixel is the depth of the nearest lumen along CENTERLINES as given. Without VOLUME the
    surroundings are not evaluated. Without an output file the table is printed as Markdown.

    \b
    lumencut evaluate centerlines.vtp
    lumencut evaluate ct.nii.gz centerlines.vtp --views 50 --csv numbers.csv --pictures worst
    """  # noqa: D301 - click needs the control character itself
    settings = settings_from(chosen)
    names = _checked_methods(chosen["methods"])
    scene = _scene(files, chosen)
    _check_outputs(scene, csv, markdown, pictures)
    if pictures is None:
        check_measured(chosen)
    check_options(chosen, settings, has_centerlines=True)
    volume, tree = read_files(scene, chosen)

    from lumencut.evaluation import evaluate as library

    with bar("evaluate", "frame") as progress:
        found = library(
            volume,
            cast("VesselTree", tree),
            names,
            chosen["views"],
            settings,
            chosen["size"],
            chosen["pixel_spacing"],
            device=scene.device,
            progress=progress,
        )
    _write(found, csv, markdown, pictures)


def _scene(files: tuple[Path, ...], chosen: dict[str, Any]) -> SceneFiles:
    """Return volume and centerlines: the first of several files is the volume, unless all are centerlines."""
    from lumencut.base.file_kinds import kind_of

    roles = [None if kind is None else kind.role for kind in map(kind_of, files)]
    has_volume = len(files) > 1 and (roles[0] != "centerlines" or "volume" in roles)
    volume, lines = (files[0], files[1:]) if has_volume else (None, files)
    scene = scene_from({**chosen, "volume": volume, "centerlines": lines})
    check_files(volume, scene.centerlines)
    check_reading(chosen, [] if volume is None else [volume], has_centerlines=True)
    return scene


def _checked_methods(names: str) -> tuple[str, ...]:
    from lumencut.evaluation.methods import checked_methods

    try:
        return checked_methods([name for name in names.split(",") if name])
    except SettingsError as error:
        raise click.UsageError(str(error)) from error


def _check_outputs(scene: SceneFiles, csv: Path | None, markdown: Path | None, pictures: Path | None) -> None:
    """Reject outputs that cannot be written before any file is read."""
    if pictures is not None and scene.volume is None:
        raise click.UsageError("--pictures without VOLUME; give the volume to show in them")
    for path in (csv, markdown, pictures):
        if path is not None:
            options.check_folder(path)
    if pictures is not None and pictures.exists() and not pictures.is_dir():
        raise FileError(str(pictures), "a file", "a folder, or the name of a new one")


def _write(found: Evaluation, csv: Path | None, markdown: Path | None, pictures: Path | None) -> None:
    """Write the requested outputs, or print the table."""
    from lumencut.base.paths import write_text

    summary = f"{', '.join(found.settings)} in {len(found.cameras)} views"
    if csv is not None:
        found.to_csv(csv)
        say(f"{csv}: {summary}")
    if markdown is not None:
        write_text(markdown, found.to_markdown())
        say(f"{markdown}: {summary}")
    if csv is None and markdown is None:
        say(found.to_markdown().rstrip("\n"))
    if pictures is not None:
        for path, name in zip(found.save_pictures(pictures), found.settings, strict=True):
            say(f"{path}: view {found.worst_view(name)}")
