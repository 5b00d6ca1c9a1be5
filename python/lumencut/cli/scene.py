"""Reading the volume and the centerlines of a picture."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from lumencut.cli.report import bar, detail, warn

if TYPE_CHECKING:
    from lumencut.camera import Camera
    from lumencut.frame import Frame
    from lumencut.renderer import Renderer


def read_scene(
    volume: Path, centerlines: Path, coordinates: Literal["lps", "ras"] | None, series: str | None
) -> Renderer:
    """Return a renderer of the two files."""
    from lumencut.centerlines import read_centerlines
    from lumencut.renderer import Renderer
    from lumencut.volume_files import read_volume

    start = time.perf_counter()
    # The small file first: what is wrong with it shows before gigabytes are read.
    tree = read_centerlines(centerlines, coordinates)
    detail(f"{centerlines}: {tree!r}")
    with bar(f"reading {volume.name}", "slice") as told:
        voxels = read_volume(volume, series=series, progress=told)
    detail(f"{volume}: {voxels!r}")
    # The renderer compares the tree with the volume and warns where the space looks wrong.
    renderer = Renderer(voxels, tree)
    detail(f"read in {time.perf_counter() - start:.2f} s")
    return renderer


def is_empty(frame: Frame) -> bool:
    """Tell whether a frame shows nothing of the volume."""
    import numpy as np

    return bool(np.isnan(frame.value).all())


def warn_of_emptiness(who: str, camera: Camera, renderer: Renderer) -> None:
    """Say in one line that nothing of the volume is to be seen, and where it would be."""
    if renderer.volume is None:
        return
    corners = renderer.volume.corners
    low, high = (",".join(f"{x:.1f}" for x in end) for end in (corners.min(axis=0), corners.max(axis=0)))
    center = ",".join(f"{x:.6g}" for x in camera.center)
    warn(f"{who} meets the volume: the center is {center}, the volume reaches from {low} to {high} (mm, LPS)")
