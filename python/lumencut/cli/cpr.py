"""``lumencut cpr``: vessels laid out as images."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.parameters import SIZE, VECTOR
from lumencut.cli.report import busy, detail, say, timings, verbose_option, warn
from lumencut.cli.scene import read_files, scene_from, warn_of_window
from lumencut.cli.settings import look_options, settings_from
from lumencut.cli.tangential import MODE as TANGENTIAL
from lumencut.cli.tangential import check_view, tangential
from lumencut.cli.vessels import path_option, titled_vessels

if TYPE_CHECKING:
    from lumencut.reformation import Reformation
    from lumencut.renderer import Renderer
    from lumencut.vessel import Vessel
    from lumencut.volume import Volume

#: The modes of ``lumencut.cpr``, here so that ``--help`` need not import numpy.
MODES = ("projected", "stretched", "straightened", "tangential")

#: The coarsest pixels where the user names none (mm): most vessels then have room for labels.
_COARSEST = 0.25


@click.command(short_help="Lay vessels out as images (CPR).")
@click.argument("volume", type=options.FILE)
@click.argument("centerlines", type=options.FILE, nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    required=True,
    help="Picture (.png, .tif, .webp, …); .npz for the arrays of one vessel.",
)
@click.option(
    "--mode",
    type=click.Choice(MODES),
    default="straightened",
    show_default=True,
    help="projected: as the viewer sees the vessel; stretched: the surface through it unrolled; "
    "straightened: along its length; tangential: in the picture of a view, what lies beside it as deep. "
    "Distances are true where it is stretched or straightened.",
)
@click.option(
    "--view",
    type=options.VIEW,
    metavar="NAME|X,Y,Z",
    help=f"The view of --mode tangential, from anterior where not given: {', '.join(options.VIEW_NAMES)}, or "
    "the direction from the viewer into the scene (LPS).",
)
@click.option(
    "--size",
    type=SIZE,
    metavar=SIZE.name,
    help="Size of the picture of --mode tangential (pixels); default: 768x768.",
)
@options.shown_vessel_options
@path_option
@click.option(
    "--angle",
    type=float,
    default=0.0,
    metavar="DEGREES",
    help="Move the viewer to the right from the front: around the up axis, or around the vessel where it is "
    "straightened.",
)
@click.option(
    "--roll",
    type=click.Choice(("narrowest", "widest")),
    help="See each section of the straightened vessel from the angle at which its lumen is narrowest or "
    "widest, so that no eccentric stenosis hides; a strip beside the picture tells the angle.",
)
@click.option("--up", type=VECTOR, default="0,0,1", show_default=True, help="What points upwards (LPS).")
@click.option(
    "--width",
    type=float,
    metavar="MM",
    help="Width of the image (mm); default: 25 mm on each side of the vessel.",
)
@click.option(
    "--pixel-spacing",
    type=float,
    metavar="MM",
    help="Side of a pixel (mm); default: the smallest side of a voxel, but no more than 0.25 mm.",
)
@click.option(
    "--smoothing",
    type=float,
    default=0.0,
    show_default=True,
    metavar="MM",
    help="Smooth the centerlines by a Gaussian with this standard deviation (mm).",
)
@click.option(
    "--volume-out",
    type=options.FILE,
    help="Write the sections across one vessel as a volume too (.nrrd, .nii or .nii.gz).",
)
@click.option(
    "--annotate/--no-annotate",
    default=True,
    show_default=True,
    help="Mode, window, scale bar and sides of the patient on the pictures.",
)
@options.reading_options
@look_options
@verbose_option
def cpr(output: Path, volume_out: Path | None, annotate: bool, **chosen: Any) -> None:
    """Lay out the vessels of CENTERLINES with what surrounds them in VOLUME: Curved Planar Reformation.

    All vessels are shown side by side, each below its id and name, unless --vessel, --exclude or --path
    choose among them.

    \b
    lumencut cpr ct.nii.gz centerlines.vtp -o vessels.png
    lumencut cpr ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --angle 45 --slab 2mm:mean
    lumencut cpr ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --mode tangential --view left
    lumencut cpr ct.nii.gz lines.vtp -o leg.png --path 0,1,4 --mode stretched --volume-out leg.nrrd
    """  # noqa: D301 - click needs the control character itself
    settings = settings_from(chosen)
    check_view(chosen)
    _check_outputs(output, volume_out)
    files = scene_from(chosen)
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError("lumencut cpr needs VOLUME and CENTERLINES")
    vessels = titled_vessels(tree, chosen)
    _check_count(vessels, output, volume_out)

    from lumencut.renderer import Renderer

    renderer = Renderer(voxels, tree, files.device)
    warn_of_window(settings, renderer)
    made = [
        _reformation(renderer, vessel, title, {**chosen, "settings": settings}) for title, vessel in vessels
    ]
    with busy(f"writing {output.name}"):
        _write(output, made, [title for title, _ in vessels], annotate=annotate)
    say(f"{output}: {_described(made)}")
    if volume_out is not None:
        _write_volume(volume_out, voxels, vessels[0][1], chosen)
    detail(f"device: {renderer.device}")


def _check_outputs(output: Path, volume_out: Path | None) -> None:
    """Refuse files that could not be written before any is read."""
    options.check_picture(output)
    if volume_out is None:
        return
    if not volume_out.name.lower().endswith((".nrrd", ".nii", ".nii.gz")):
        found = f"{volume_out}: found the ending {volume_out.suffix!r}"
        raise click.UsageError(f"{found}; expected .nrrd, .nii or .nii.gz")
    options.check_folder(volume_out)


def _check_count(vessels: list[tuple[str, Vessel]], output: Path, volume_out: Path | None) -> None:
    """Refuse files of one vessel where there are several."""
    if len(vessels) == 1:
        return
    one = output if output.suffix.lower() == ".npz" else volume_out
    if one is not None:
        mend = "choose one by --vessel or --path"
        raise click.UsageError(f"{one} holds one vessel; found {len(vessels)}; {mend}")


def _reformation(renderer: Renderer, vessel: Vessel, title: str, chosen: dict[str, Any]) -> Reformation:
    """The image of one vessel, made, and a warning where it shows nothing."""
    import numpy as np

    is_tangential = chosen["mode"] == TANGENTIAL
    lay_out = partial(tangential, settings=chosen["settings"]) if is_tangential else _plane
    made = lay_out(renderer, vessel, chosen)
    _ = made.image
    timings(f"vessel {title}", made.timings)
    if np.isnan(made.value).all():
        warn(f"vessel {title}: no pixel lies in the volume")
    return made


def _plane(renderer: Renderer, vessel: Vessel, chosen: dict[str, Any]) -> Reformation:
    """The image of one vessel by the modes that have rows."""
    from lumencut.planar_reformation import cpr_of

    spacing = chosen["pixel_spacing"]
    if spacing is None and renderer.volume is not None:
        spacing = min(_COARSEST, float(renderer.volume.spacing.min()))
    named = {name: chosen[name] for name in ("width", "up", "smoothing", "roll", "settings")}
    return cpr_of(
        renderer, vessel, chosen["mode"], pixel_spacing=spacing, angle=math.radians(chosen["angle"]), **named
    )


def _write(output: Path, made: list[Reformation], titles: list[str], *, annotate: bool) -> None:
    """Write one vessel as it is, several as a contact sheet."""
    from lumencut.contact_sheet import contact_sheet
    from lumencut.frame import save_picture

    if len(made) == 1:
        made[0].save(output, annotate=annotate)
        return
    pictures = [one.annotated() if annotate else one.image for one in made]
    save_picture(contact_sheet(pictures, titles), output)


def _described(made: list[Reformation]) -> str:
    """What was made, in words."""
    from lumencut.window import Window

    first, window = made[0], made[0].settings.window
    count = "1 vessel" if len(made) == 1 else f"{len(made)} vessels"
    shown = f", window {window.width:.4g}/{window.level:.4g}" if isinstance(window, Window) else ""
    return f"{count} {first.recipe.parameters['mode']}, pixels of {first.pixel_spacing:.4g} mm{shown}"


def _write_volume(path: Path, voxels: Volume, vessel: Vessel, chosen: dict[str, Any]) -> None:
    """Write the sections across a vessel, with the voxels of the volume unless the user names pixels."""
    from lumencut.straightening import straightened_volume

    with busy(f"writing {path.name}"):
        made = straightened_volume(
            voxels,
            vessel,
            chosen["width"] or 50.0,
            chosen["pixel_spacing"],
            math.radians(chosen["angle"]),
            chosen["up"],
            chosen["smoothing"],
        )
        made.save(path)
    say(f"{path}: {made.volume!r}")
