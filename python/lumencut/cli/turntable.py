"""``lumencut turntable``: a view that turns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.labels import check_labels, label_options
from lumencut.cli.parameters import Named
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
from lumencut.cli.settings import paper_option, setting_options, settings_from
from lumencut.errors import CameraError, FormatError, SettingsError

if TYPE_CHECKING:
    from lumencut.animation import Writer
    from lumencut.camera import Camera
    from lumencut.frame import Frame

AXIS_NAMES = ("superior", "up", "right", "direction")


@click.command(short_help="Animate a turning view.")
@options.scene_arguments
@click.option(
    "-o",
    "--output",
    metavar="PATH",
    required=True,
    help=".webp (small, slightly lossy), .png or .apng (lossless), .mp4 (needs lumencut[video]), "
    "frame-%03d.png or a folder (one picture per frame).",
)
@click.option(
    "--axis",
    type=Named(AXIS_NAMES),
    default="superior",
    show_default=True,
    metavar="NAME|X,Y,Z",
    help="superior (of the patient); up, right or direction (of the first view); or a vector (LPS).",
)
@click.option(
    "--frames", type=click.IntRange(1, 10000), default=72, show_default=True, help="How many frames."
)
@click.option(
    "--degrees",
    type=float,
    default=360.0,
    show_default=True,
    help="How far the viewer moves in all (degrees).",
)
@click.option("--fps", type=click.FloatRange(0.1, 100), help="Frames per second; default 12.")
@click.option("--seconds", type=click.FloatRange(0.01, 3600), help="Duration in all (s), instead of --fps.")
@options.view_options
@label_options
@paper_option
@setting_options
@verbose_option
def turntable(
    output: str,
    frames: int,
    fps: float | None,
    seconds: float | None,
    **chosen: Any,
) -> None:
    """Render VOLUME along CENTERLINES as an animation of a turning view.

    The view options give the first frame; one pixel spacing fits all frames, so that the vessels keep their
    size. Without CENTERLINES the context alone is shown, all of the volume.

    \b
    lumencut turntable ct.nii.gz centerlines.vtp -o spin.webp
    lumencut turntable ct.nii.gz centerlines.vtp -o rock.mp4 --rotate -30 --degrees 60 --seconds 4
    """  # noqa: D301 - click needs the control character itself
    if fps is not None and seconds is not None:
        raise click.UsageError("--fps and --seconds exclude each other")
    is_timed = fps is not None or seconds is not None
    fps = fps or (frames / seconds if seconds else 12.0)
    degrees, axis = chosen["degrees"], chosen["axis"]
    settings, view = settings_from(chosen), options.view_from(chosen)
    files = scene_from(chosen)
    check_scene(files, chosen, settings)
    check_labels(chosen, [Path(output)], view.size)
    labels = {name: bool(chosen[name]) for name in ("annotate", "vessel_names")}
    labels["annotate"] |= labels["vessel_names"]
    write = _checked_writer(output, fps, labels, is_timed=is_timed)
    _check_turn(view, frames, degrees, axis)
    renderer, scene = read_scene(files, chosen)
    warn_of_window(settings, renderer)

    from lumencut import turntables as library

    camera = options.placed_like(library.fitted_turn(view, scene, degrees, axis), chosen)
    turn = library.turntable(renderer, camera, settings, frames, degrees, axis)
    empty: list[Camera] = []
    write(watched(turn, frames, empty), fps)
    detail(f"device: {renderer.device}")
    if empty:
        who = "no pixel of any frame" if len(empty) == frames else f"no pixel of {len(empty)} frames"
        warn_of_emptiness(who, empty[0], renderer)
    say(f"{output}: {frames} frames, {frames / fps:.3g} s, {shown(camera, settings, renderer)}")


def watched(turn: Iterable[Frame], count: int, empty: list[Camera]) -> Iterator[Frame]:
    """Pass frames on while a progress bar moves, and note which of them show nothing."""
    with bar("turntable", "frame") as told:
        for done, frame in enumerate(turn, 1):
            timings(f"frame {done}", frame.timings)
            if is_empty(frame):
                empty.append(frame.camera)
            yield frame
            told(done, count)


def _check_turn(view: Camera, frames: int, degrees: float, axis: Any) -> None:
    """Refuse a turn that cannot be made before any file is read."""
    from lumencut.turntables import frame_angles

    try:
        frame_angles(frames, degrees)
        view.rotated(0.0, (0, 0, 1) if axis == "superior" else axis)
    except CameraError as error:
        raise click.UsageError(str(error)) from error


def _checked_writer(output: str, fps: float, labels: dict[str, bool], *, is_timed: bool) -> Writer:
    """Refuse an output that cannot be written before any file is read."""
    from lumencut.animation import checked_fps, is_sequence, writer_for

    try:
        checked_fps(fps)
        write = writer_for(output, **labels)
        if is_timed and is_sequence(output):
            found = f"--fps and --seconds do nothing with one picture per frame ({output})"
            raise click.UsageError(f"{found}; leave them out, or name a moving file such as .webp")
    except (FormatError, SettingsError) as error:
        raise click.UsageError(str(error)) from error
    options.check_folder(Path(output))
    return write
