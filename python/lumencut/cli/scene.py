"""Reading the volume and the centerlines of a picture, and reporting what it shows."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from lumencut.cli import vessels
from lumencut.cli.found_vessels import found_by, shown_vessels
from lumencut.cli.mistakes import check_files, check_options, check_radii, check_reading
from lumencut.cli.options import described, of_zarr
from lumencut.cli.report import bar, detail, warn

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.files.centerline_file import CenterlineFile
    from lumencut.files.several_centerlines import CenterlineFiles
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.camera import Camera
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume
    from lumencut.scene.window import Window


@dataclass(frozen=True)
class SceneFiles:
    """The files of a picture, and the options for reading them."""

    volume: Path | None
    centerlines: tuple[Path, ...]
    coordinates: Literal["lps", "ras"] | None
    unit: Literal["um", "mm", "cm", "dm", "m"] | None
    reorder: bool
    series: str | None
    phase: str | None
    fill_gaps: bool
    resample_slices: bool
    memory: float | None
    channel: str | None
    time_point: int | None
    device: Literal["auto", "cpu", "gpu"]


def scene_from(chosen: dict[str, Any]) -> SceneFiles:
    """Extract the files and their options from the command line."""
    return SceneFiles(**{field.name: chosen[field.name] for field in fields(SceneFiles)})


def check_scene(files: SceneFiles, chosen: dict[str, Any], settings: Settings) -> None:
    """Reject options that contradict each other before any file is read."""
    found = found_by(chosen)
    has_centerlines = bool(files.centerlines) or found is not None
    if files.centerlines and found is not None:
        words = f"found CENTERLINES and {found}; expected only one of them"
        raise click.UsageError(f"{words}, because {found} traces centerlines itself")
    check_files(files.volume, files.centerlines)
    volumes = [] if files.volume is None else [files.volume]
    check_reading(chosen, volumes, has_centerlines=has_centerlines)
    check_options(chosen, settings, has_centerlines=has_centerlines)
    if settings.context is None and not has_centerlines:
        found = "--context none without CENTERLINES shows nothing"
        raise click.UsageError(f"{found}; give CENTERLINES or another --context")


def read_scene(
    files: SceneFiles,
    chosen: dict[str, Any],
    profiles_of: Callable[[Volume | None, VesselTree], Iterable[Any]] = lambda _, __: (),
) -> tuple[Renderer, VesselTree | Volume]:
    """Return a renderer of the files and the vessels that views fit; reject options without effect.

    `profiles_of` returns the profiles that a rim needs.
    """
    from lumencut.pictures.renderer import Renderer

    voxels, tree = read_files(files, chosen)
    if tree is None:
        renderer = Renderer(voxels, tree, files.device)
        return renderer, renderer.scene
    shown, fitted = vessels.chosen_of(tree, chosen)
    # The renderer checks whether the tree fits the volume, and warns if the space looks wrong.
    profiles = profiles_of(voxels, tree)
    if shown is tree:
        return Renderer(voxels, tree, files.device, profiles=profiles), fitted
    # The window is always that of the whole tree, so the brightness does not depend on the shown vessels.
    whole = Renderer(voxels, tree, files.device)
    return whole.with_tree(shown, profiles=profiles), fitted


def read_files(files: SceneFiles, chosen: dict[str, Any]) -> tuple[Volume | None, VesselTree | None]:
    """Return the volume and the vessel tree; None for each that has no file."""
    start = time.perf_counter()
    # Small files are read first: their errors appear before gigabytes are read.
    lines = centerlines_of(files.centerlines)
    voxels = None if files.volume is None else _read_volume(files.volume, files)
    tree = None if lines is None else lines.tree(files.coordinates, files.unit, voxels, reorder=files.reorder)
    if voxels is not None and found_by(chosen) is not None:
        tree = shown_vessels(chosen, voxels)
    check_radii(chosen, tree)
    if tree is not None:
        detail(f"{', '.join(map(str, files.centerlines)) or 'found in the scan'}: {tree!r}")
    detail(f"read in {time.perf_counter() - start:.2f} s")
    return voxels, tree


def centerlines_of(paths: tuple[Path, ...]) -> CenterlineFile | CenterlineFiles | None:
    """Read files of centerlines. If there is only one, the renderer later compares it with the volume."""
    from lumencut.files.centerline_file import CenterlineFile

    if len(paths) < 2:
        return CenterlineFile(paths[0]) if paths else None
    from lumencut.files.several_centerlines import CenterlineFiles

    return CenterlineFiles(paths)


def _read_volume(path: Path, files: SceneFiles) -> Volume:
    return volume_of(path, {field.name: getattr(files, field.name) for field in fields(files)})


def volume_of(path: Path, chosen: dict[str, Any]) -> Volume:
    """Read a volume as the options define."""
    from lumencut.files.volumes import read_volume

    with bar(f"reading {path.name}", "slice") as progress:
        voxels = read_volume(
            path,
            series=chosen["series"],
            phase=chosen["phase"],
            fill_gaps=chosen["fill_gaps"],
            resample_slices=chosen["resample_slices"],
            progress=progress,
            **of_zarr(chosen),
        )
    detail(f"{path}: {voxels!r}")
    return voxels


def is_empty(frame: Frame) -> bool:
    """Return whether a frame shows nothing of the volume."""
    import numpy as np

    cut_surface = frame.has("value") and not np.isnan(frame.value).all()
    return not cut_surface and not (frame.has("context") and frame.context[..., 3].any())


def shown(camera: Camera, settings: Settings, renderer: Renderer) -> str:
    """Describe what a picture of a renderer shows."""
    name, used = _main_window(settings, renderer)
    return described(camera, name.replace("_", " "), used)


def _main_window(settings: Settings, renderer: Renderer) -> tuple[str, Window]:
    """Return the name and the window of the cut surface; without a cut surface, those of the context."""
    name = "context_window" if renderer.tree is None else "window"
    return name, getattr(renderer.windowed(settings), name) or renderer.window


def warn_of_window(settings: Settings, renderer: Renderer) -> None:
    """Warn if a requested window shows the whole volume in one grey, such as HU on a scan without HU."""
    name, window = _main_window(settings, renderer)
    if getattr(settings, name) is None or renderer.volume is None:
        return
    full = type(window).named("full", renderer.volume)
    low, high = full.level - full.width / 2, full.level + full.width / 2
    black, white = window.level - window.width / 2, window.level + window.width / 2
    if min(high, white) - max(low, black) < window.width / 50:
        warn(
            f"--{name.replace('_', '-')} {window.width:.4g}/{window.level:.4g} shows the volume in one grey: "
            f"its values reach from {low:.4g} to {high:.4g}; auto, mra and full are windows from the data"
        )


def _meets(camera: Camera, corners: npt.NDArray[np.float64]) -> bool:
    """Return whether the bounding box of the volume reaches into the picture."""
    import numpy as np

    place = (corners - camera.center) @ np.stack([camera.right_axis, camera.up], axis=1)
    half = np.array(camera.size) * camera.pixel_spacing / 2
    return bool(((place.min(axis=0) < half) & (place.max(axis=0) > -half)).all())


def warn_of_emptiness(who: str, camera: Camera, renderer: Renderer) -> None:
    """Report in one line that nothing of the volume is visible, and where the volume lies."""
    if renderer.volume is None:
        return
    corners = renderer.volume.corners
    if _meets(camera, corners):
        warn(
            f"{who} shows the volume: everything in view is transparent or outside the cut surface; "
            "see --context, --context-transfer, --context-window and --opacity"
        )
        return
    low, high = (",".join(f"{x:.1f}" for x in end) for end in (corners.min(axis=0), corners.max(axis=0)))
    center = ",".join(f"{x:.6g}" for x in camera.center)
    warn(f"{who} shows the volume: the center is {center}, the volume reaches from {low} to {high} (mm, LPS)")
