"""Options shared by the commands that make pictures, and the camera and settings they stand for."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import click

from lumencut.errors import CameraError, FileError, SettingsError

if TYPE_CHECKING:
    from lumencut.camera import Camera
    from lumencut.settings import Settings
    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume
    from lumencut.window import Window

    _Type = click.ParamType[Any]
else:
    # Generic only in recent versions of click.
    _Type = click.ParamType

_Parameter: TypeAlias = "click.Parameter | None"
_Context: TypeAlias = "click.Context | None"
_Command = TypeVar("_Command", bound=Callable[..., Any])

#: The names of ``lumencut.VIEWS``, here so that ``--help`` need not import numpy.
VIEW_NAMES = ("anterior", "posterior", "left", "right", "superior", "inferior")


class Parts(_Type):
    """Numbers with a separator between them; ``form`` shows the user how to write them."""

    def __init__(self, form: str, separator: str, kind: type[float] | type[int]) -> None:
        self.name, self._separator, self._kind = form, separator, kind

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[float, ...]:
        """Return the numbers."""
        if not isinstance(value, str):
            return tuple(value)
        try:
            numbers = tuple(self._kind(part) for part in value.lower().split(self._separator))
        except ValueError:
            numbers = ()
        count = self.name.lower().count(self._separator) + 1
        if len(numbers) != count or not all(math.isfinite(number) for number in numbers):
            self.fail(f"{value!r} is not of the form {self.name}", param, ctx)
        return numbers


class Named(_Type):
    """One of some names, or a vector."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names, self.name = names, "|".join(names) + "|X,Y,Z"

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> Any:
        """Return the name or the vector."""
        if value in self.names:
            return value
        try:
            return VECTOR.convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{value!r} is neither one of {', '.join(self.names)} nor a vector X,Y,Z", param, ctx)


class Color(_Type):
    """A colour in hexadecimal, with or without opacity."""

    def __init__(self, form: str, lengths: tuple[int, ...]) -> None:
        self.name, self._lengths = form, lengths

    def convert(self, value: Any, param: _Parameter, ctx: _Context) -> tuple[int, ...]:
        """Return the channels, 0 to 255."""
        if not isinstance(value, str):
            return tuple(value)
        digits = value.removeprefix("#")
        try:
            channels = tuple(bytes.fromhex(digits))
        except ValueError:
            channels = ()
        if len(channels) not in self._lengths or len(digits) != 2 * len(channels):
            self.fail(f"{value!r} is not a colour of the form {self.name}", param, ctx)
        return channels


VECTOR = Parts("X,Y,Z", ",", float)
SIZE = Parts("WIDTHxHEIGHT", "x", int)
VIEW = Named(VIEW_NAMES)
FILE = click.Path(path_type=Path)


#: Which of several DICOM series to read.
series_option = click.option(
    "--series",
    metavar="NUMBER|UID",
    help="Which DICOM series to read where a folder holds several; lumencut info lists them.",
)


def scene_arguments(command: _Command) -> _Command:
    """Add the two files that every picture is made from."""
    parts = (
        click.argument("volume", type=FILE),
        click.argument("centerlines", type=FILE),
        click.option(
            "--coordinates",
            type=click.Choice(["lps", "ras"]),
            help="Space of the centerline file; default: the one it states, else lps.",
        ),
        series_option,
    )
    return _added(parts, command)


def view_options(command: _Command) -> _Command:
    """Add the options that make the camera."""
    parts = (
        click.option(
            "--view",
            type=VIEW,
            default="anterior",
            show_default=True,
            metavar="NAME|X,Y,Z",
            help=f"{', '.join(VIEW_NAMES)}, or the direction from the viewer into the scene (LPS).",
        ),
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
        click.option(
            "--size",
            type=SIZE,
            default="768x768",
            show_default=True,
            metavar=SIZE.name,
            help="Size of the picture (pixels).",
        ),
        click.option(
            "--center", type=VECTOR, help="Point in the middle (mm, LPS); default: fits all vessels."
        ),
        click.option(
            "--pixel-spacing",
            type=float,
            metavar="MM",
            help="Side of a pixel (mm); default: fits all vessels.",
        ),
        click.option("--zoom", type=float, default=1.0, metavar="FACTOR", help="Magnify about the middle."),
    )
    return _added(parts, command)


def setting_options(command: _Command) -> _Command:
    """Add one option for each field of `Settings`, under its name."""
    return _added(_SETTINGS, command)


# Defaults are Settings' own: an option that is not given is None. The help repeats them and a test compares.
_SETTINGS = (
    click.option(
        "--window",
        type=Parts("WIDTH/LEVEL", "/", float),
        help="Intensities from black to white, LEVEL ± WIDTH/2 (unit of the volume, HU for CT); "
        "default: from the data.",
    ),
    click.option(
        "--opacity",
        type=Parts("TRANSPARENT:OPAQUE", ":", float),
        help="Ramp of opacity over intensities (unit of the volume, HU for CT); default: all opaque.",
    ),
    click.option(
        "--background",
        type=Color("RRGGBB[AA]", (3, 4)),
        help="Colour behind it all (hexadecimal); default 000000ff.",
    ),
    click.option(
        "--cost-weight",
        type=float,
        metavar="NUMBER",
        help="λ of Eq. 2: what one mm beyond a vessel's wall costs (mm of depth per mm); default 10.",
    ),
    click.option(
        "--preserve-lumen/--no-preserve-lumen",
        default=None,
        help="Measure distance from the wall, or from the centerline (yes or no); default yes.",
    ),
    click.option(
        "--lumen-first/--no-lumen-first",
        default=None,
        help="Let every lumen beat every surrounding, whatever the depth (yes or no); default no.",
    ),
    click.option(
        "--lumen-margin",
        type=float,
        metavar="MM",
        help="How far beyond the wall lumen-first reaches (mm); default 0.",
    ),
    click.option(
        "--levels",
        type=int,
        metavar="N",
        help="Levels of detail beyond the finest (count, 0 to 15); default 6.",
    ),
    click.option(
        "--level-distance",
        type=float,
        metavar="MM",
        help="How far from the vessels one level of detail reaches (mm per level); default 8.",
    ),
    click.option(
        "--depth-filter/--no-depth-filter",
        default=None,
        help="Smooth the depth with a Gaussian of 7 × 7 pixels (yes or no); default yes.",
    ),
    click.option(
        "--silhouettes/--no-silhouettes",
        default=None,
        help="Draw lines where the cut surface leaps (yes or no); default yes.",
    ),
    click.option(
        "--silhouette-slope",
        type=float,
        metavar="SLOPE",
        help="Slope at which a silhouette has half its strength (mm of depth per mm); default 24.",
    ),
    click.option(
        "--silhouette-color",
        type=Color("RRGGBB", (3,)),
        help="Colour of the silhouettes (hexadecimal); default ffdc00.",
    ),
)


def settings_from(chosen: dict[str, Any]) -> Settings:
    """Return the settings that the options stand for; what was not given keeps its default."""
    from lumencut.settings import Settings
    from lumencut.window import Opacity, Window

    names = [field.name for field in fields(Settings)]
    given = {name: chosen[name] for name in names if chosen.get(name) is not None}
    try:
        if "window" in given:
            width, level = given["window"]
            given["window"] = Window(level=level, width=width)
        if "opacity" in given:
            given["opacity"] = Opacity(*given["opacity"])
        if len(given.get("background", ())) == 3:
            given["background"] = (*given["background"], 255)
        return Settings(**given)
    except SettingsError as error:
        raise click.UsageError(str(error)) from error


def view_from(chosen: dict[str, Any]) -> Camera:
    """Return a camera with the direction, up and size that the options stand for; its place is still open."""
    import numpy as np

    from lumencut.camera import VIEWS, Camera

    view = chosen["view"]
    direction, up = VIEWS[view] if isinstance(view, str) else (view, _upright(view))
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


def _upright(direction: tuple[float, float, float]) -> tuple[float, float, float]:
    """The head upwards, or the patient's front where the view runs along the body."""
    across = math.hypot(direction[0], direction[1])
    return (0.0, 0.0, 1.0) if across > 0.05 * abs(direction[2]) else (0.0, -1.0, 0.0)


def described(camera: Camera, window: Window) -> str:
    """Say what a picture shows, in words that --size, --pixel-spacing and --window take back."""
    width, height = camera.size
    spacing, intensities = f"{camera.pixel_spacing:.4g} mm", f"{window.width:.4g}/{window.level:.4g}"
    return f"{width} × {height} pixels of {spacing}, window {intensities}"


def check_picture(path: Path) -> None:
    """Refuse a picture that could not be written before any work is done for it."""
    from PIL import Image

    kind = Image.registered_extensions().get(path.suffix.lower())
    if path.suffix.lower() != ".npz" and kind not in Image.SAVE:
        known = "a picture format such as .png, .tif or .webp, or .npz"
        raise click.UsageError(f"{path}: found the ending {path.suffix!r}; expected {known}")
    check_folder(path)


def check_folder(path: Path) -> None:
    """Refuse a file in a folder that does not exist."""
    if not path.parent.is_dir():
        raise FileError(str(path), f"no folder {path.parent}", "a folder to write into", "make it first")


def _added(parts: tuple[Callable[[_Command], _Command], ...], command: _Command) -> _Command:
    for part in reversed(parts):
        command = part(command)
    return command
