"""``lumencut cpr``: vessels straightened or unrolled into images."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut._lumencut import DEFAULTS
from lumencut.cli import options, reformations
from lumencut.cli.dicom import study_of
from lumencut.cli.parameters import SIZE
from lumencut.cli.report import busy, detail, say, warn
from lumencut.cli.tangential import MODE as TANGENTIAL
from lumencut.cli.tangential import check_view, tangential

if TYPE_CHECKING:
    from lumencut.planar_reformation import PlanarReformation
    from lumencut.renderer import Renderer
    from lumencut.settings import Settings
    from lumencut.vessel import Vessel
    from lumencut.volume import Volume

#: The modes of ``lumencut.cpr``; copied so that ``--help`` does not import numpy.
MODES = ("projected", "stretched", "straightened", "tangential")


@click.command(short_help="Lay vessels out as images (CPR).")
@reformations.file_options
@reformations.output_option
@click.option(
    "--mode",
    type=click.Choice(MODES),
    default="straightened",
    show_default=True,
    help="projected: as the viewer sees the vessel; stretched: the surface through it unrolled; "
    "straightened: along its length; tangential: in the picture of a view, with the tissue at the same "
    "depth. Distances are true in stretched and straightened images.",
)
@click.option(
    "--view",
    type=options.VIEW,
    metavar="NAME|X,Y,Z",
    help=f"The view of --mode tangential, default anterior: {', '.join(options.VIEW_NAMES)}, or "
    "the direction from the viewer into the scene (LPS).",
)
@click.option(
    "--size",
    type=SIZE,
    metavar=SIZE.name,
    help="Size of the picture of --mode tangential (pixels); default: 768x768.",
)
@reformations.vessel_options
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
    "widest, so that an eccentric stenosis stays visible; a strip next to the picture shows the angle.",
)
@reformations.up_option
@click.option(
    "--width",
    type=float,
    metavar="MM",
    help="Width of the image (mm); default: 25 mm on each side of the vessel.",
)
@reformations.pixel_spacing_option
@reformations.smoothing_option
@click.option(
    "--volume-out",
    type=options.FILE,
    help="Write the sections across one vessel as a volume too (.nrrd, .nii or .nii.gz, or a name without an "
    "ending: a new folder for a DICOM series).",
)
@reformations.picture_options
def cpr(volume_out: Path | None, **given: Any) -> None:
    """Lay out the vessels of CENTERLINES with their surroundings in VOLUME: Curved Planar Reformation.

    All vessels are shown side by side, each below its id and name, unless --vessel, --exclude or --path
    choose among them.

    \b
    lumencut cpr ct.nii.gz centerlines.vtp -o vessels.png
    lumencut cpr ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --angle 45 --slab 2mm:mean
    lumencut cpr ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --mode tangential --view left
    lumencut cpr ct.nii.gz lines.vtp -o leg.png --path 0,1,4 --mode stretched --volume-out leg.nrrd
    """  # noqa: D301 - click needs the control character itself
    check_view(given)
    _check_outputs(given["output"], volume_out)
    chosen, settings = reformations.like({**given, "camera": None}, "cpr")
    has_series = volume_out is not None and not volume_out.suffix
    renderer, _, vessels = reformations.read_vessels(chosen, settings, "cpr", has_series=has_series)
    if volume_out is not None:
        reformations.check_single(vessels, volume_out)
    lay_out = tangential if chosen["mode"] == TANGENTIAL else _plane
    reformations.write_each(chosen, vessels, lambda vessel: lay_out(renderer, vessel, chosen, settings))
    if volume_out is not None and renderer.volume is not None:
        _write_volume(volume_out, renderer.volume, vessels[0][1], chosen)
    detail(f"device: {renderer.device}")


def _check_outputs(output: Path, volume_out: Path | None) -> None:
    """Reject outputs that cannot be written before any file is read."""
    options.check_picture(output)
    if volume_out is None:
        return
    if volume_out.suffix and not volume_out.name.lower().endswith((".nrrd", ".nii", ".nii.gz")):
        found = f"{volume_out}: found the extension {volume_out.suffix!r}"
        raise click.UsageError(f"{found}; expected .nrrd, .nii or .nii.gz, or none for a DICOM series")
    options.check_folder(volume_out)


def _plane(
    renderer: Renderer, vessel: Vessel, chosen: dict[str, Any], settings: Settings
) -> PlanarReformation:
    """Return the image of one vessel, for all modes except the tangential one."""
    from lumencut.planar_reformation import cpr_of

    named = {name: chosen[name] for name in ("width", "pixel_spacing", "up", "smoothing", "roll")}
    angle = math.radians(chosen["angle"])
    return cpr_of(renderer, vessel, chosen["mode"], angle=angle, settings=settings, **named)


def _write_volume(path: Path, voxels: Volume, vessel: Vessel, chosen: dict[str, Any]) -> None:
    """Write the sections across a vessel as a volume, by default with the voxel size of the scan."""
    from lumencut.straightening import straightened_volume

    with busy(f"writing {path.name}"):
        made = straightened_volume(
            voxels,
            vessel,
            chosen["width"] or DEFAULTS["cpr.width"],
            chosen["pixel_spacing"],
            math.radians(chosen["angle"]),
            chosen["up"],
            chosen["smoothing"],
        )
        made.save(path, **({} if path.suffix else study_of(chosen)))
    say(f"{path}: {made.volume!r}")
    for note in made.notes:
        warn(note)
