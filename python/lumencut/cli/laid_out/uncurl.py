"""``lumencut uncurl``: its view, its film and its picture."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import study_of
from lumencut.cli.laid_out import each
from lumencut.cli.laid_out.films import film, film_writer
from lumencut.cli.like import typed
from lumencut.cli.report import say

if TYPE_CHECKING:
    from lumencut.pictures.animation import Writer
    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.uncurling import Uncurled
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel import Vessel


def show_uncurled(**given: Any) -> None:
    """Write the film of the longest vessel, or one picture of it."""
    output, fps = given["output"], given["fps"]
    chosen, settings = each.like({**given, "camera": None}, "uncurl")
    dicom = {**study_of(chosen), "compress": chosen["compress"], "grey": chosen["grey"]}
    write = _writer(output, chosen["amount"], fps, dicom)
    renderer, _, vessels = each.read_vessels(chosen, settings, "uncurl")
    title, vessel = max(vessels, key=lambda named: named[1].length)
    camera = _camera(chosen, vessel)
    first = _made(renderer, vessel, camera, chosen, settings)
    if write is None:
        each.write_each(chosen, [(title, vessel)], lambda _: first)
        return
    frames = chosen["frames"]
    write(_film(first, frames, annotate=chosen["annotate"]), fps)
    say(f"{output}: vessel {title} uncurled, {frames} frames, {frames / fps:.3g} s")


def _writer(output: Path, amount: float | None, fps: float, dicom: dict[str, Any]) -> Writer | None:
    """Return the writer of a film, or None for one picture; reject files that cannot be written."""
    if amount is None:
        return film_writer(output, fps, dicom, "; one picture needs --amount")
    if dicom["grey"]:
        raise click.UsageError("--grey does nothing with --amount; leave out one of them")
    options.check_picture(output)
    return None


def _camera(chosen: dict[str, Any], vessel: Vessel) -> Camera:
    """Return the view of --like unless options define another one, fitted to the film."""
    from lumencut.pictures.reformation_recipe import recipe_camera
    from lumencut.reformations.uncurling import fitted_uncurling

    own = {"view", "up", "rotate", "tilt", "size", "center", "pixel_spacing", "zoom"}
    if chosen["camera"] is not None and not own & typed(chosen).keys():
        return recipe_camera(chosen["camera"])
    fitted = fitted_uncurling(options.view_from(chosen), vessel, chosen["smoothing"])
    return options.placed_like(fitted, chosen)


def _made(
    renderer: Renderer, vessel: Vessel, camera: Camera, chosen: dict[str, Any], settings: Settings
) -> Uncurled:
    """Return the vessel, straightened by the requested amount, in the window of all frames."""
    from lumencut.reformations.uncurling import UncurlRequest

    amount, shown = chosen["amount"] or 0.0, renderer.windowed(settings)
    asked = UncurlRequest(camera, amount, chosen["width"], smoothing=chosen["smoothing"], settings=shown)
    return asked.of(renderer, vessel)


def _film(first: Uncurled, frames: int, *, annotate: bool) -> Iterator[Any]:
    """Return the frames."""
    from lumencut.reformations.uncurling import uncurling

    return film("uncurl", uncurling(first, frames), frames, annotate=annotate)
