"""Time of the pictures of one vessel at about 512 × 1024 pixels: ``python benches/reformations.py``.

The vessel is a helix of 128 mm, lumen 300, tissue 0; its measured profile is given. The table shows the first
picture, which includes finding the wall, and the fastest of nine more.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from lumencut import Vessel, Volume, cpr, lumen_map, measure, spiral

SPACING_MM = 0.125


def scene() -> tuple[Volume, Vessel]:
    """A helix with a lumen of 10.2 mm radius, 10 mm around its axis, in voxels of 0.5 mm."""
    turn = np.linspace(0, 2.2 * np.pi, 400)
    points = np.stack([10 * np.cos(turn), 10 * np.sin(turn), 54 - 108 * turn / turn[-1]], axis=1)
    z, y, x = np.meshgrid(*(np.arange(-r, r + 0.1, 0.5) for r in (60, 32, 32)), indexing="ij")
    along = np.clip((54 - z) / 108, 0, 1) * turn[-1]
    away = np.hypot(x - 10 * np.cos(along), y - 10 * np.sin(along))
    values = 300 / (1 + np.exp((away - 10.2) / 0.3))
    return Volume(values.astype(np.float32), (0.5,) * 3, (-32, -32, -60)), Vessel(points, radius=10.2)


def times(first: Callable[[], Any], again: Callable[[Any], Any]) -> tuple[float, float, Any]:
    """Milliseconds of the first picture and of the fastest later one."""
    start = time.perf_counter()
    made = first()
    _ = made.image
    initial = time.perf_counter() - start
    later = []
    for _ in range(9):
        start = time.perf_counter()
        made = again(made)
        _ = made.image
        later.append(time.perf_counter() - start)
    return 1e3 * initial, 1e3 * min(later), made


def main() -> None:
    """Print the table."""
    volume, vessel = scene()
    profile = measure(volume, vessel)

    def straight(_: Any = None) -> Any:
        return cpr(volume, vessel, "straightened", 64.0, SPACING_MM)

    def rolled(_: Any = None) -> Any:
        return cpr(volume, vessel, "straightened", 64.0, SPACING_MM, roll="narrowest", profile=profile)

    def mapped(mode: Any) -> tuple[Callable[[], Any], Callable[[Any], Any]]:
        return (
            lambda: lumen_map(volume, vessel, mode, SPACING_MM, angle=0.0, profile=profile),
            lambda made: made.changed(mode),
        )

    def wound(_: Any = None) -> Any:
        return spiral(volume, vessel, 8.0, 12.8, pixel_spacing=SPACING_MM)

    rows = {"straightened CPR": (straight, straight), "narrowest roll": (rolled, rolled)}
    rows |= {f"lumen map, {mode}": mapped(mode) for mode in ("wall", "radius", "thickness", "shaded")}
    rows |= {"spiral CPR": (wound, wound)}
    print("| picture | pixels | first (ms) | following (ms) |\n|---|---|---|---|")
    for name, (first, again) in rows.items():
        initial, later, made = times(first, again)
        width, height = made.size
        print(f"| {name} | {width} × {height} | {initial:.0f} | {later:.0f} |")


if __name__ == "__main__":
    main()
