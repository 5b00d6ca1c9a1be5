"""Accuracy and speed of `measure` on vessels of known width and blur: ``python benches/measure.py``.

Rows of round vessels also give the result of the half-maximum rule.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut import Flag, Vessel, Volume, cross_section, measure
from lumencut.measuring.profile import Profile

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from measure_scenes import FWHM, LUMEN, Grid, Tube, narrowed, round_tube

Row = tuple[str, str, str]
Floats = npt.NDArray[np.float64]

CUBIC_VOXELS = (0.4, 0.4, 0.4)


def signed(values: Floats, true: float) -> str:
    """Bias and spread (%) as text."""
    values = values[np.isfinite(values)]
    return f"{100 * (values.mean() / true - 1):+.1f} % ± {100 * values.std() / true:.1f} %"


def half_maximum(volume: Volume, vessel: Vessel, profile: Profile) -> Floats:
    """Diameters where 64 rays cross midway between the background and the peak of each section."""
    found = []
    for at in profile.arc_length:
        section = cross_section(volume, vessel, at, size=12.0, pixel_spacing=0.1)
        rows, columns = np.indices(section.value.shape)
        distance = np.hypot(rows - 59.5, columns - 59.5) * 0.1
        peak = section.value[distance < 0.3].mean()
        half = (peak + profile.levels[0, 1]) / 2
        angles = np.arange(64) * 2 * np.pi / 64
        steps = np.arange(0, 58) * 0.1
        i = np.round(59.5 + np.outer(np.cos(angles), steps) / 0.1).astype(int)
        j = np.round(59.5 + np.outer(np.sin(angles), steps) / 0.1).astype(int)
        below = section.value[j, i] < half
        found.append(2 * steps[below.argmax(axis=1)].mean())
    return np.array(found)


def widths() -> Iterator[Row]:
    """Round vessels of 6 to 0.9 mm."""
    for diameter in (6.0, 4.0, 2.4, 1.6, 1.2, 0.9):
        tube = round_tube(diameter)
        volume = tube.volume(Grid.even(CUBIC_VOXELS, (diameter + 9, diameter + 9, 64)))
        vessel = tube.vessel(60)
        profile = measure(volume, vessel, fwhm=FWHM)
        aim = "bias 2 %, spread 3 %" if diameter >= 2 * FWHM else "bias 5 %"
        half = signed(half_maximum(volume, vessel, profile), diameter)
        measured = signed(profile.diameter_equivalent, diameter)
        yield f"{diameter} mm, {diameter / FWHM:.1f} FWHM", aim, f"{measured} (half maximum {half})"


def shapes() -> Iterator[Row]:
    """Ellipses of 6 × 3 mm."""
    cases = (
        ("cubic voxels", CUBIC_VOXELS, (0.0, 0.0, 1.0), 0.0),
        ("oblique", CUBIC_VOXELS, (1.0, -0.7, 0.9), 0.0),
        ("sheared", (0.4, 0.4, 0.8), (0.2, 0.1, 1.0), 0.35),
        ("0.4 × 0.4 × 1 mm along k", (0.4, 0.4, 1.0), (0.0, 0.0, 1.0), 0.0),
        ("0.4 × 0.4 × 1 mm across k", (0.4, 0.4, 1.0), (1.0, 0.1, 0.3), 0.0),
    )
    for name, spacing, direction, shear in cases:
        tube = Tube((6.0, 3.0), direction)
        grid = Grid.even(spacing, tuple(13 + 26 * np.abs(tube.axes()[2])))
        grid.sides[1, 2] = shear * spacing[2]
        profile = measure(tube.volume(grid), tube.vessel(26), fwhm=FWHM)
        axes = f"{signed(profile.diameter_max, 6.0)}; {signed(profile.diameter_min, 3.0)}"
        yield f"ellipse 6 × 3 mm, {name}", "axes 3 %", axes


def stenoses() -> Iterator[Row]:
    """Stenoses of 12 mm in 5 mm vessels."""
    for percent in (20, 40, 50, 60, 70, 80):
        profile = measure(*narrowed(percent), fwhm=FWHM)
        nascet, area = profile.stenosis(30, 45), profile.stenosis(30, (15, 45), "area")
        true = 100 * (1 - (1 - percent / 100) ** 2)
        measured = f"NASCET {nascet.percent:.1f} %, area {area.percent:.1f} % (true {true:.0f} %)"
        yield f"stenosis of {percent} %", "3 points", f"{measured}, {nascet.diameter:.2f} mm"


def neighbors() -> Iterator[Row]:
    """A vessel of 4 mm next to calcium, a stent or another vessel."""

    def calcium(values: Floats, x: Floats, y: Floats) -> Floats:
        return np.where((np.hypot(x - 2.7, y) < 0.8) & (np.hypot(x, y) > 2.0), 1100.0, values)

    def stent(values: Floats, x: Floats, y: Floats) -> Floats:
        return np.where(np.abs(np.hypot(x, y) - 2.2) < 0.15, 3000.0, values)

    def neighbor(values: Floats, x: Floats, y: Floats) -> Floats:
        return np.where(np.hypot(x - 5.0, y) < 2.0, LUMEN, values)

    cases: tuple[tuple[str, Callable[[Floats, Floats, Floats], Floats], Flag], ...] = (
        ("calcium in the wall", calcium, Flag.CALCIUM),
        ("a stent", stent, Flag.METAL),
        ("a neighbour at 1 mm", neighbor, Flag.NEIGHBOR),
    )
    for name, paint, flag in cases:
        tube = round_tube(4.0, paint=paint)
        profile = measure(tube.volume(Grid.even(CUBIC_VOXELS, (14, 14, 34))), tube.vessel(30), fwhm=FWHM)
        marked = 100 * np.mean(profile.flags & flag > 0)
        yield name, "flagged", f"flagged in {marked:.0f} %; {signed(profile.diameter_equivalent, 4.0)}"


def point_spreads() -> Iterator[Row]:
    """The blur, estimated on a vessel of 6 mm."""
    for fwhm in (0.6, 0.8, 1.1):
        tube = round_tube(6.0, fwhm=fwhm)
        profile = measure(tube.volume(Grid.even(CUBIC_VOXELS, (15, 15, 34))), tube.vessel(30))
        yield f"FWHM of {fwhm} mm, estimated", "", f"{profile.fwhm:.2f} mm"


def speed() -> Iterator[Row]:
    """Time of 500 sections."""
    for diameter in (2.4, 6.0):
        tube = round_tube(diameter)
        volume = tube.volume(Grid.even(CUBIC_VOXELS, (diameter + 9, diameter + 9, 64)))
        vessel = tube.vessel(60)
        times = []
        for _ in range(5):
            start = time.perf_counter()
            profile = measure(volume, vessel, 60 / 499, FWHM)
            times.append(time.perf_counter() - start)
        yield f"{len(profile)} sections of {diameter} mm", "0.5 s", f"{min(times):.2f} s"


def main() -> None:
    """Print the table."""
    print("| vessel | goal | measured |\n|---|---|---|")
    for rows in (widths, shapes, stenoses, neighbors, point_spreads, speed):
        for row in rows():
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
