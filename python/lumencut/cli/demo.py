"""``lumencut demo``: pictures of a real angiography, to show the method."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from lumencut.cli.first_words import program
from lumencut.cli.options import device_option
from lumencut.cli.report import bar, detail, say, timings, verbose_option, warn

if TYPE_CHECKING:
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

_SIZE, _TURN_SIZE, _TURN_FRAMES = (768, 768), (384, 384), 24


@click.command(short_help="Render a CT of an aorta with a stent graft.")
@click.argument("directory", type=click.Path(path_type=Path, file_okay=False), default="demo")
@click.option(
    "--cache",
    type=click.Path(path_type=Path, file_okay=False),
    help="The folder for the CT; default: lumencut in the user's cache folder.",
)
@click.option("--no-annotate", is_flag=True, help="Omit the labels of the pictures.")
@device_option
@verbose_option
def demo(
    directory: Path, cache: Path | None, no_annotate: bool, device: Literal["auto", "cpu", "gpu"]
) -> None:
    """Render a CT angiography of an aorta with a stent graft into DIRECTORY (default: demo).

    Writes four pictures, one with a transparent cut surface, one of vessels traced from two points each, and
    a turntable. The CT (3 MB, from the Python package index) is downloaded once, checked and kept; if it
    cannot be downloaded, a phantom is shown instead.
    """
    start = time.perf_counter()
    renderer, points = _scene(cache, device)
    directory.mkdir(parents=True, exist_ok=True)
    for name, camera, settings in _views(renderer):
        frame = renderer.render(camera, settings)
        timings(name, frame.timings)
        frame.save(directory / f"{name}.png", annotate=not no_annotate)
        say(str(directory / f"{name}.png"))
    _trace(renderer, points, directory / "traced.png", annotate=not no_annotate)
    _spin(renderer, directory / "turntable.webp")
    detail(f"device: {renderer.device}")
    say(f"made in {time.perf_counter() - start:.1f} s")
    say(f"turn it in your browser: {program()} view --demo")


def _scene(cache: Path | None, device: Literal["auto", "cpu", "gpu"]) -> tuple[Renderer, Any]:
    """The scene, and points from which its vessels can be traced."""
    from lumencut.demo import STENT_POINTS
    from lumencut.pictures.renderer import Renderer

    volume, tree, is_stent = demo_scene(cache)
    points: Any = STENT_POINTS
    if not is_stent:
        points = [max(tree, key=lambda vessel: vessel.length).points[[2, -3]]]
    return Renderer(volume, tree, device), points


def demo_scene(cache: Path | None = None) -> tuple[Volume, VesselTree, bool]:
    """Return the volume and the vessels of the demo, and whether they come from the CT; warn of a phantom."""
    from lumencut import demo

    volume, tree, error = demo.demo_scene(cache)
    if error is not None:
        warn(f"the CT of the demo cannot be downloaded, a phantom is shown instead ({error})")
    return volume, tree, error is None


def _views(renderer: Renderer) -> Iterator[tuple[str, Camera, Settings]]:
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.window import Opacity

    scene, window = renderer.scene, renderer.window
    anterior = Camera.anterior(scene, _SIZE)
    oblique = anterior.rotated(math.radians(40)).rotated(math.radians(-20), "right")
    oblique = Camera.fitted(scene, oblique.direction, oblique.up, _SIZE)
    yield "anterior", anterior, Settings()
    yield "left", Camera.left(scene, _SIZE), Settings()
    yield "oblique", oblique, Settings()
    yield "inferior", Camera.inferior(scene, _SIZE), Settings()
    # A window from the data shows tissue at a fifth of its width: tissue becomes nearly transparent.
    tissue = Opacity(window.level - window.width / 3, window.level - window.width / 6)
    yield "context", oblique, Settings(opacity=tissue)
    yield "focus", Camera.left(scene, _SIZE), Settings.focused()


def _trace(renderer: Renderer, points: Any, path: Path, *, annotate: bool) -> None:
    """Trace vessels from points only, and write their picture from the front."""
    from lumencut.scene.camera import Camera
    from lumencut.tracing.tracer import trace

    assert renderer.volume is not None
    with bar("tracing", "share") as progress:
        tree = trace(renderer.volume, points, progress=progress)
    camera = Camera.anterior(tree, _SIZE)
    renderer.with_tree(tree).render(camera).save(path, annotate=annotate)
    say(f"{path} (traced from two points for each vessel)")


def _spin(renderer: Renderer, path: Path) -> None:
    from lumencut.pictures.turntables import fitted_turn, save_animation, turntable
    from lumencut.scene.camera import Camera

    camera = fitted_turn(Camera.anterior(renderer.scene, _TURN_SIZE), renderer.scene)
    with bar("turntable", "frame") as progress:
        turn = turntable(renderer, camera, frames=_TURN_FRAMES)
        save_animation((progress(done, _TURN_FRAMES) or frame for done, frame in enumerate(turn, 1)), path)
    say(str(path))
