"""Options shared by the commands that make pictures, and the camera they stand for."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from lumencut.cli.parameters import SIZE, VECTOR, Named
from lumencut.errors import CameraError, FileError

if TYPE_CHECKING:
    from lumencut.camera import Camera
    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume
    from lumencut.window import Window


Command = TypeVar("Command", bound=Callable[..., Any])

#: The names of ``lumencut.VIEWS``, here so that ``--help`` need not import numpy.
VIEW_NAMES = ("anterior", "posterior", "left", "right", "superior", "inferior")


VIEW = Named(VIEW_NAMES)
FILE = click.Path(path_type=Path)


#: Which of several DICOM series to read.
series_option = click.option(
    "--series",
    metavar="NUMBER|UID",
    help="Which DICOM series to read where a folder holds several; lumencut info lists them.",
)


#: Which of several phases of one DICOM series to read.
phase_option = click.option(
    "--phase",
    metavar="VALUE",
    help="Which phase of a DICOM series that mixes several: the value that tells it apart, "
    "as the error without it lists them.",
)


#: What becomes of a DICOM series from which slices are missing.
fill_gaps_option = click.option(
    "--fill-gaps",
    is_flag=True,
    help="Interpolate missing DICOM slices between their neighbours instead of refusing the series.",
)


#: What becomes of a DICOM series whose slices lie at uneven distances.
resample_slices_option = click.option(
    "--resample-slices",
    is_flag=True,
    help="Put DICOM slices of uneven distances on a regular grid, linearly between neighbours, instead of "
    "refusing the series.",
)


#: How the coordinates of centerline files are to be understood.
coordinates_option = click.option(
    "--coordinates",
    type=click.Choice(["lps", "ras"]),
    help="Space of the centerline file; default: the one it states, else the one that fits the volume.",
)
unit_option = click.option(
    "--unit",
    type=click.Choice(["um", "mm", "cm", "dm", "m"]),
    help="Unit of the centerline file; default: the one it states, else the one that fits the volume, "
    "first of all that of its format (.pth cm, others mm).",
)
reorder_option = click.option(
    "--reorder",
    is_flag=True,
    help="Put the points of each centerline into their order along the vessel; refused where it is in doubt.",
)


#: What computes.
device_option = click.option(
    "--device",
    type=click.Choice(["auto", "cpu", "gpu"]),
    default="auto",
    show_default=True,
    help="What computes: auto takes a GPU where there is a hardware one, else the CPU; "
    "lumencut info --devices lists the GPUs.",
)


def _remember_threads(ctx: click.Context, _: click.Parameter, count: int | None) -> None:
    if count is not None and not ctx.resilient_parsing:
        from lumencut.threads import set_threads

        set_threads(count)


#: How many threads compute.
threads_option = click.option(
    "--threads",
    type=click.IntRange(1, 1024),
    metavar="N",
    expose_value=False,
    callback=_remember_threads,
    help="How many threads compute on the CPU; default: as many as it runs at once. "
    "Results do not depend on it.",
)


#: From which direction one looks.
_DIRECTION = (
    click.option("--up", type=VECTOR, help="What points upwards (LPS); default: the patient's head."),
    click.option(
        "--rotate",
        type=float,
        default=0.0,
        metavar="DEGREES",
        help="Move the viewer to the right around the up axis (from anterior: to the patient's left).",
    ),
    click.option(
        "--tilt",
        type=float,
        default=0.0,
        metavar="DEGREES",
        help="Then move the viewer upwards around the right axis.",
    ),
)


def scene_arguments(command: Command) -> Command:
    """Add the files that every picture is made from."""
    parts = (
        click.argument("volume", type=FILE),
        click.argument("centerlines", type=FILE, nargs=-1),
        reading_options,
        vessel_options,
    )
    return added(parts, command)


def reading_options(command: Command) -> Command:
    """Add the options that say how the files are read, and what computes."""
    return added((file_options, device_option, threads_option), command)


def file_options(command: Command) -> Command:
    """Add the options that say how the files are read."""
    parts = (
        coordinates_option,
        unit_option,
        reorder_option,
        series_option,
        phase_option,
        fill_gaps_option,
        resample_slices_option,
    )
    return added(parts, command)


#: How vessels are named.
_NAMED: dict[str, Any] = {"metavar": "NAME|ID", "multiple": True}


def vessel_options(command: Command) -> Command:
    """Add the options that choose among the vessels."""
    zoom = click.option(
        "--zoom-to", help="Fit the view to this vessel, whatever else is shown; may be repeated.", **_NAMED
    )
    return added((shown_vessel_options, zoom), command)


def shown_vessel_options(command: Command) -> Command:
    """Add the options that say which vessels are shown."""
    parts = (
        click.option("--vessel", help="Show this vessel and no other; may be repeated.", **_NAMED),
        click.option("--exclude", help="Leave this vessel out; may be repeated.", **_NAMED),
    )
    return added(parts, command)


def view_options(command: Command) -> Command:
    """Add the options that make the camera."""
    return added((_view_option(default="anterior"), _camera_options), command)


def direction_options(command: Command) -> Command:
    """Add the options that say from where one looks, without a place or pixels."""
    return added((_view_option(default="anterior"), *_DIRECTION), command)


def several_views_options(command: Command) -> Command:
    """Add the options that make the cameras of several views."""
    return added(
        (_view_option("; may be repeated", default=("anterior",), multiple=True), _camera_options), command
    )


def _view_option(more: str = "", **how: Any) -> Callable[[Command], Command]:
    return click.option(
        "--view",
        type=VIEW,
        show_default=True,
        metavar="NAME|X,Y,Z",
        help=f"{', '.join(VIEW_NAMES)}, or the direction from the viewer into the scene (LPS){more}.",
        **how,
    )


def _camera_options(command: Command) -> Command:
    """Add the options that make a camera of a view."""
    parts = (
        *_DIRECTION,
        click.option(
            "--size",
            type=SIZE,
            default="768x768",
            show_default=True,
            metavar=SIZE.name,
            help="Size of the picture (pixels).",
        ),
        click.option(
            "--center",
            type=VECTOR,
            help="Point in the middle (mm, LPS); default: fits the vessels, or the volume.",
        ),
        click.option(
            "--pixel-spacing",
            type=float,
            metavar="MM",
            help="Side of a pixel (mm); default: fits the vessels, or the volume.",
        ),
        click.option("--zoom", type=float, default=1.0, metavar="FACTOR", help="Magnify about the middle."),
    )
    return added(parts, command)


def view_from(chosen: dict[str, Any]) -> Camera:
    """Return a camera with the direction, up and size that the options stand for; its place is still open."""
    import numpy as np

    from lumencut.camera import VIEWS, Camera, upright

    view = chosen["view"]
    direction, up = VIEWS[view] if isinstance(view, str) else (view, upright(view))
    try:
        camera = Camera(np.zeros(3), np.array(direction), np.array(chosen["up"] or up), chosen["size"])
        camera = camera.rotated(math.radians(chosen["rotate"]), "up")
        # A right-handed turn about the right axis would lower the viewer.
        return _magnified(camera.rotated(-math.radians(chosen["tilt"]), "right"), chosen)
    except CameraError as error:
        raise click.UsageError(str(error)) from error


def placed(view: Camera, scene: VesselTree | Volume, chosen: dict[str, Any]) -> Camera:
    """Return the camera of this view where all of the scene fits, as far as the options leave that open."""
    from lumencut.camera import Camera

    return placed_like(Camera.fitted(scene, view.direction, view.up, view.size), chosen)


def placed_like(fitted: Camera, chosen: dict[str, Any]) -> Camera:
    """Return a fitted camera with the place and magnification that the options name."""
    if chosen["center"] is not None:
        fitted = replace(fitted, center=chosen["center"])
    return _magnified(fitted, chosen)


def _magnified(camera: Camera, chosen: dict[str, Any]) -> Camera:
    if chosen["pixel_spacing"] is not None:
        camera = replace(camera, pixel_spacing=chosen["pixel_spacing"])
    return camera.zoomed(chosen["zoom"])


def described(camera: Camera, name: str, window: Window) -> str:
    """Say what a picture shows, in words that --size, --pixel-spacing and --NAME take back."""
    width, height = camera.size
    spacing, intensities = f"{camera.pixel_spacing:.4g} mm", f"{window.width:.4g}/{window.level:.4g}"
    return f"{width} × {height} pixels of {spacing}, {name} {intensities}"


def check_picture(path: Path) -> None:
    """Refuse a picture that could not be written before any work is done for it."""
    from PIL import Image

    kind = Image.registered_extensions().get(path.suffix.lower())
    if path.suffix.lower() not in (".npz", ".dcm") and kind not in Image.SAVE:
        known = "a picture format such as .png, .tif or .webp, .dcm (DICOM), or .npz"
        raise click.UsageError(f"{path}: found the ending {path.suffix!r}; expected {known}")
    check_folder(path)


def check_folder(path: Path) -> None:
    """Refuse a file in a folder that does not exist."""
    if not path.parent.is_dir():
        raise FileError(str(path), f"no folder {path.parent}", "a folder to write into", "make it first")


def added(parts: tuple[Callable[[Command], Command], ...], command: Command) -> Command:
    """Add options and arguments to a command, in this order."""
    for part in reversed(parts):
        command = part(command)
    return command
