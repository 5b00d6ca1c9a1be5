"""Options shared by the commands that make pictures, and the cameras made from them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from lumencut.base.memory import PYRAMID_MEMORY, in_words
from lumencut.cli.parameters import BYTES, SIZE, VECTOR, Named, Quantity
from lumencut.errors import CameraError, FileError

if TYPE_CHECKING:
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume
    from lumencut.scene.window import Window


Command = TypeVar("Command", bound=Callable[..., Any])

#: The names of ``lumencut.VIEWS``; copied so that ``--help`` does not import numpy.
VIEW_NAMES = ("anterior", "posterior", "left", "right", "superior", "inferior")


VIEW = Named(VIEW_NAMES)
FILE = click.Path(path_type=Path)


series_option = click.option(
    "--series",
    metavar="NUMBER|UID",
    help="The DICOM series to read from a folder of several; lumencut info lists them.",
)


phase_option = click.option(
    "--phase",
    metavar="VALUE",
    help="The phase of a DICOM series that mixes several: the value that distinguishes it, "
    "as listed by the error without this option.",
)


fill_gaps_option = click.option(
    "--fill-gaps",
    is_flag=True,
    help="Interpolate missing DICOM slices between their neighbours instead of rejecting the series.",
)


resample_slices_option = click.option(
    "--resample-slices",
    is_flag=True,
    help="Resample DICOM slices of uneven spacing to a regular grid, linearly between neighbours, instead of "
    "rejecting the series.",
)


coordinates_option = click.option(
    "--coordinates",
    type=click.Choice(["lps", "ras"]),
    help="Space of the centerline file; default: as stated in the file, otherwise the one that fits the "
    "volume.",
)
unit_option = click.option(
    "--unit",
    type=click.Choice(["um", "mm", "cm", "dm", "m"]),
    help="Unit of the centerline file; default: as stated in the file, otherwise the one that fits the "
    "volume, trying that of its format first (.pth cm, others mm).",
)
reorder_option = click.option(
    "--reorder",
    is_flag=True,
    help="Sort the points of each centerline along the vessel; an error if the order is in doubt.",
)


device_option = click.option(
    "--device",
    type=click.Choice(["auto", "cpu", "gpu"]),
    default="auto",
    show_default=True,
    help="The device that computes: auto uses a hardware GPU if there is one, otherwise the CPU; "
    "lumencut info --devices lists the GPUs.",
)


def _remember_threads(ctx: click.Context, _: click.Parameter, count: int | None) -> None:
    if count is not None and not ctx.resilient_parsing:
        from lumencut.base.threads import set_threads

        set_threads(count)


threads_option = click.option(
    "--threads",
    type=click.IntRange(1, 1024),
    metavar="N",
    expose_value=False,
    callback=_remember_threads,
    help="Number of CPU threads; default: as many as the CPU runs at once. Results do not depend on it.",
)


_DIRECTION = (
    click.option("--up", type=VECTOR, help="The direction that points up (LPS); default: towards the head."),
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
    """Add the input files of a picture."""
    parts = (
        click.argument("volume", type=FILE),
        click.argument("centerlines", type=FILE, nargs=-1),
        reading_options,
        vessel_options,
    )
    return added(parts, command)


def zarr_options(command: Command) -> Command:
    """Add the options for OME-Zarr images."""
    memory = click.option(
        "--memory",
        type=Quantity("SIZE", BYTES, "4GB"),
        help=f"Most memory for the voxels of an OME-Zarr image; default: {in_words(PYRAMID_MEMORY)}.",
    )
    channel = click.option("--channel", metavar="NAME|N", help="The channel to read from an OME-Zarr image.")
    time_point = click.option(
        "--time-point",
        type=click.IntRange(0),
        metavar="N",
        help="The time point to read from an OME-Zarr image.",
    )
    return added((memory, channel, time_point), command)


def reading_options(command: Command) -> Command:
    """Add the options for reading the files, and for the device."""
    return added((file_options, device_option, threads_option), command)


def file_options(command: Command) -> Command:
    """Add the options for reading the files."""
    parts = (
        coordinates_option,
        unit_option,
        reorder_option,
        series_option,
        phase_option,
        fill_gaps_option,
        resample_slices_option,
        zarr_options,
    )
    return added(parts, command)


def of_zarr(chosen: dict[str, Any]) -> dict[str, Any]:
    """Return the options for OME-Zarr images as arguments of `lumencut.read_volume`."""
    memory = chosen.get("memory")
    used = {name: chosen.get(name) for name in ("channel", "time_point")}
    return {"memory": None if memory is None else int(memory), **used}


_NAMED: dict[str, Any] = {"metavar": "NAME|ID", "multiple": True}


def vessel_options(command: Command) -> Command:
    """Add the options that choose vessels."""
    zoom = click.option(
        "--zoom-to", help="Fit the view to this vessel, with any others shown; may be repeated.", **_NAMED
    )
    return added((shown_vessel_options, zoom), command)


def shown_vessel_options(command: Command) -> Command:
    """Add the options that choose the vessels to show."""
    parts = (
        click.option("--vessel", help="Show only this vessel; may be repeated.", **_NAMED),
        click.option("--exclude", help="Leave this vessel out; may be repeated.", **_NAMED),
    )
    return added(parts, command)


def view_options(command: Command) -> Command:
    """Add the options that define the camera."""
    return added((_view_option(default="anterior"), _camera_options), command)


def direction_options(command: Command) -> Command:
    """Add the options for the viewing direction, without position and number of pixels."""
    return added((_view_option(default="anterior"), *_DIRECTION), command)


def several_views_options(command: Command) -> Command:
    """Add the options that define the cameras of several views."""
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
    """Add the options that define the camera of a view."""
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
    """Return a camera with the direction, up vector and size of the options; its position is not set yet."""
    import numpy as np

    from lumencut.scene.camera import VIEWS, Camera, upright

    view = chosen["view"]
    direction, up = VIEWS[view] if isinstance(view, str) else (view, upright(view))
    try:
        camera = Camera(np.zeros(3), np.array(direction), np.array(chosen["up"] or up), chosen["size"])
        camera = camera.rotated(math.radians(chosen["rotate"]), "up")
        # The sign is negative because a right-handed turn about the right axis would lower the viewer.
        return _magnified(camera.rotated(-math.radians(chosen["tilt"]), "right"), chosen)
    except CameraError as error:
        raise click.UsageError(str(error)) from error


def placed(view: Camera, scene: VesselTree | Volume, chosen: dict[str, Any]) -> Camera:
    """Return the camera of this view; what the options do not fix is fitted to the scene."""
    from lumencut.scene.camera import Camera

    return placed_like(Camera.fitted(scene, view.direction, view.up, view.size), chosen)


def placed_like(fitted: Camera, chosen: dict[str, Any]) -> Camera:
    """Return a fitted camera with the position and magnification of the options."""
    if chosen["center"] is not None:
        fitted = replace(fitted, center=chosen["center"])
    return _magnified(fitted, chosen)


def _magnified(camera: Camera, chosen: dict[str, Any]) -> Camera:
    if chosen["pixel_spacing"] is not None:
        camera = replace(camera, pixel_spacing=chosen["pixel_spacing"])
    return camera.zoomed(chosen["zoom"])


def described(camera: Camera, name: str, window: Window) -> str:
    """Describe a picture in the same notation as --size, --pixel-spacing and --NAME."""
    width, height = camera.size
    spacing, intensities = f"{camera.pixel_spacing:.4g} mm", f"{window.width:.4g}/{window.level:.4g}"
    return f"{width} × {height} pixels of {spacing}, {name} {intensities}"


def check_picture(path: Path) -> None:
    """Reject a picture that cannot be written before any time is spent on it."""
    from PIL import Image

    kind = Image.registered_extensions().get(path.suffix.lower())
    if path.suffix.lower() not in (".npz", ".dcm") and kind not in Image.SAVE:
        known = "a picture format such as .png, .tif or .webp, .dcm (DICOM), or .npz"
        raise click.UsageError(f"{path}: found the extension {path.suffix!r}; expected {known}")
    check_folder(path)


def check_folder(path: Path) -> None:
    """Reject a file in a folder that does not exist."""
    if not path.parent.is_dir():
        raise FileError(str(path), f"no folder {path.parent}", "a folder to write into", "create it first")


def added(parts: tuple[Callable[[Command], Command], ...], command: Command) -> Command:
    """Add options and arguments to a command, in this order."""
    for part in reversed(parts):
        command = part(command)
    return command
