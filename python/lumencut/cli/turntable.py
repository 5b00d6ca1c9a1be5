"""``lumencut turntable``: an animation of a turning view."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import check_objects, dicom_options, grey_option, is_object, study_of
from lumencut.cli.labels import check_labels, label_options
from lumencut.cli.measure import rim_profiles
from lumencut.cli.parameters import Named, PlaceOnVessel
from lumencut.cli.report import bar, detail, say, timings, verbose_option
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
from lumencut.errors import CameraError, FormatError, SettingsError

if TYPE_CHECKING:
    from lumencut.pictures.animation import Writer
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings

AXIS_NAMES = ("superior", "up", "right", "direction")


@click.command(short_help="Animate a turning view.")
@options.scene_arguments
@click.option(
    "-o",
    "--output",
    metavar="PATH",
    required=True,
    help=".webp (small, slightly lossy), .png or .apng (lossless), .mp4 (needs lumencut[video]), "
    ".dcm (DICOM), frame-%03d.png or a folder (one picture per frame).",
)
@click.option(
    "--axis",
    type=Named(AXIS_NAMES),
    metavar="NAME|X,Y,Z",
    help="superior (of the patient), the default; up, right or direction (of the first view); or a "
    "vector (LPS).",
)
@click.option(
    "--about",
    type=PlaceOnVessel(),
    metavar=PlaceOnVessel.name,
    help="Turn about this place on a vessel, such as LAD@41mm, which stays in the middle: the cut shows all "
    "its diameters, which are written on the frames.",
)
@click.option(
    "--fly-to",
    metavar="NAME|ID",
    help="Fly to the view that shows most of this vessel, instead of turning.",
)
@click.option(
    "--frames", type=click.IntRange(1, 10000), default=72, show_default=True, help="Number of frames."
)
@click.option(
    "--degrees",
    type=float,
    default=360.0,
    show_default=True,
    help="Total rotation of the viewer (degrees).",
)
@click.option("--fps", type=click.FloatRange(0.1, 100), help="Frames per second; default 12.")
@click.option("--seconds", type=click.FloatRange(0.01, 3600), help="Total duration (s), instead of --fps.")
@options.view_options
@label_options
@dicom_options
@grey_option
@paper_option
@setting_options
@rim_option
@verbose_option
def turntable(
    output: str,
    frames: int,
    fps: float | None,
    seconds: float | None,
    **chosen: Any,
) -> None:
    """Render VOLUME along CENTERLINES as an animation of a turning view.

    The view options set the first frame; one pixel spacing fits all frames, so that the vessels keep their
    size. Without CENTERLINES the frames show the context alone, all of the volume.

    \b
    lumencut turntable ct.nii.gz centerlines.vtp -o spin.webp
    lumencut turntable ct.nii.gz centerlines.vtp -o rock.mp4 --rotate -30 --degrees 60 --seconds 4
    lumencut turntable ct.nii.gz LAD.mrk.json -o stenosis.webp --about LAD@41mm --degrees 180
    lumencut turntable ct.nii.gz tree.vtp -o LAD.mp4 --fly-to LAD --focus-vessels LAD
    """  # noqa: D301 - click needs the control character itself
    if fps is not None and seconds is not None:
        raise click.UsageError("--fps and --seconds exclude each other")
    is_timed = fps is not None or seconds is not None
    fps = fps or (frames / seconds if seconds else 12.0)
    degrees, axis = chosen["degrees"], chosen["axis"] or "superior"
    _check_about(chosen)
    _check_flight(chosen, frames)
    settings, view = settings_from(chosen), options.view_from(chosen)
    files = scene_from(chosen)
    check_scene(files, chosen, settings)
    check_labels(chosen, [Path(output)], view.size)
    labels = {name: bool(chosen[name]) for name in ("annotate", "vessel_names")}
    labels["annotate"] |= labels["vessel_names"] or (is_object(Path(output)) and chosen["annotate"] is None)
    check_objects(chosen, [Path(output)])
    dicom = {**study_of(chosen), **{name: chosen[name] for name in ("grey", "compress")}}
    write = _checked_writer(output, fps, labels | {"dicom": dicom}, is_timed=is_timed)
    _check_turn(view, frames, degrees, axis)
    renderer, scene = read_scene(files, chosen, partial(rim_profiles, chosen, settings.rim))
    warn_of_window(settings, renderer)

    from lumencut.pictures import turntables as library

    if chosen["fly_to"] is not None:
        first = library.fitted_turn(view, scene, 0.0)
        camera, turn = _flight(renderer, options.placed_like(first, chosen), chosen, (settings, frames))
    elif chosen["about"] is None:
        camera = options.placed_like(library.fitted_turn(view, scene, degrees, axis), chosen)
        turn = library.turntable(renderer, camera, settings, frames, degrees, axis)
    else:
        camera, turn = _about(renderer, view, chosen, (settings, frames))
    empty: list[Camera] = []
    write(watched(turn, frames, empty), fps)
    detail(f"device: {renderer.device}")
    if empty:
        who = "no pixel of any frame" if len(empty) == frames else f"no pixel of {len(empty)} frames"
        warn_of_emptiness(who, empty[0], renderer)
    say(f"{output}: {frames} frames, {frames / fps:.3g} s, {shown(camera, settings, renderer)}")


def _check_about(chosen: dict[str, Any]) -> None:
    """Reject options that position the view if it turns about a place."""
    if chosen["about"] is None:
        return
    for name in ("axis", "center", "up", "tilt", "zoom_to"):
        if chosen[name] not in (None, 0, 0.0, ()):
            option = f"--{name.replace('_', '-')}"
            found = f"{option} does nothing with --about, which sets the middle and the up axis"
            raise click.UsageError(f"{found}; leave out {option}")


def _about(
    renderer: Renderer, view: Camera, chosen: dict[str, Any], how: tuple[Settings, int]
) -> tuple[Camera, Iterator[Frame]]:
    """Return the first view of a turn about a place, and the frames of the turn."""
    from lumencut.pictures.place_turns import radius_at, turn_about
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_names import id_or_name

    word, at = chosen["about"]
    tree = renderer.tree
    if tree is None:
        raise click.UsageError("--about needs CENTERLINES; give them, or leave out --about")
    vessel = tree[id_or_name(tree, word)]
    first = Camera.about(vessel, at, degrees=chosen["rotate"], size=view.size)
    camera = options.placed_like(first, chosen)
    settings, frames = how
    turn = turn_about(renderer, camera, radius_at(vessel, at), settings, frames, chosen["degrees"])
    return camera, turn


def _check_flight(chosen: dict[str, Any], frames: int) -> None:
    """Reject options that have no effect on a flight."""
    if chosen["fly_to"] is None:
        return
    for name, idle in (("about", None), ("axis", None), ("degrees", 360.0), ("turning_limit", None)):
        if chosen[name] != idle:
            option = f"--{name.replace('_', '-')}"
            found = f"{option} does nothing with --fly-to"
            raise click.UsageError(f"{found}, which sets the movement; leave out {option}")
    if frames < 2:
        raise click.UsageError("a flight needs at least 2 frames; give --frames 2 or more")


def _flight(
    renderer: Renderer, first: Camera, chosen: dict[str, Any], how: tuple[Settings, int]
) -> tuple[Camera, Iterator[Frame]]:
    """Return the first view of a flight to a vessel, and the frames of the flight."""
    from lumencut.pictures.flights import flight
    from lumencut.scene.camera import Camera
    from lumencut.scene.vessel_names import id_or_name

    word, tree = chosen["fly_to"], renderer.tree
    if tree is None:
        raise click.UsageError("--fly-to needs CENTERLINES; give them, or leave out --fly-to")
    vessel = tree[id_or_name(tree, word)]
    return first, flight(renderer, first, Camera.refocused(tree, vessel, first.size, start=first), *how)


def watched(turn: Iterable[Frame], count: int, empty: list[Camera]) -> Iterator[Frame]:
    """Yield frames while a progress bar moves, and count frames that show nothing."""
    with bar("turntable", "frame") as progress:
        for done, frame in enumerate(turn, 1):
            timings(f"frame {done}", frame.timings)
            if is_empty(frame):
                empty.append(frame.camera)
            yield frame
            progress(done, count)


def _check_turn(view: Camera, frames: int, degrees: float, axis: Any) -> None:
    """Reject an invalid turn before any file is read."""
    from lumencut.pictures.turntables import frame_angles

    try:
        frame_angles(frames, degrees)
        view.rotated(0.0, (0, 0, 1) if axis == "superior" else axis)
    except CameraError as error:
        raise click.UsageError(str(error)) from error


def _checked_writer(output: str, fps: float, how: dict[str, Any], *, is_timed: bool) -> Writer:
    """Reject an output that cannot be written before any file is read."""
    from lumencut.pictures.animation import checked_fps, is_sequence, writer_for

    try:
        checked_fps(fps)
        write = writer_for(output, **how)
        if is_timed and is_sequence(output):
            found = f"--fps and --seconds do nothing with one picture per frame ({output})"
            raise click.UsageError(f"{found}; leave out both, or use an animation format such as .webp")
    except (FormatError, SettingsError) as error:
        raise click.UsageError(str(error)) from error
    options.check_folder(Path(output))
    return write
