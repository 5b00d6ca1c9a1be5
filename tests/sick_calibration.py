"""Silent errors of diameters in sick vessels: `python tests/sick_calibration.py [SCENES [KIND ...]]`.

A silent error is a section that counts although its diameter is wrong by more than 10 %.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from calibration import MARKED
from calibration_scenes import Floats
from lumencut import Flag, measure
from voxelizer import SickScene

Draw = np.random.Generator

#: Sections with one of these flags do not count.
UNCOUNTED = MARKED | Flag.RECENTERED | Flag.RESTLESS_LINE | Flag.PLAQUE
#: An error is silent beyond this share of the diameter, and beyond this length (mm).
SILENT, SMALLEST = 0.1, 0.15
#: The width of the point spread (mm) and the edge enhancement of five kernels.
KERNELS = ((0.8, 0.0), (0.9, 0.0), (1.0, 0.0), (1.2, 0.0), (1.0, 0.4))


def _log(draw: Draw, low: float, high: float) -> float:
    return float(np.exp(draw.uniform(np.log(low), np.log(high))))


def _vessel(draw: Draw, low: float, high: float, **more: object) -> SickScene:
    fwhm, sharp = KERNELS[draw.integers(len(KERNELS))]
    diameter = _log(draw, low, high)
    usual: dict[str, object] = {
        "wall": 0.36 * diameter**0.5,
        "lumen": draw.uniform(280, 450),
        "noise": draw.uniform(12, 28),
        "around": draw.normal(-95, 10),
        "tilt": (draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)),
        "fwhm": (fwhm, fwhm, fwhm),
        "sharp": sharp,
        "seed": int(draw.integers(1 << 30)),
    }
    return SickScene(diameter, **(usual | more))  # type: ignore[arg-type]


def _stenosed(draw: Draw, low: float, high: float, narrowed: float, **more: object) -> SickScene:
    length, eccentric = draw.uniform(2, 5), draw.uniform(0.3, 1)
    return _vessel(draw, low, high, narrowed=narrowed, narrowed_length=length, eccentric=eccentric, **more)


def _healthy(draw: Draw) -> SickScene:
    return _vessel(draw, 1.8, 20, winding=0.3 * draw.integers(2), aspect=draw.uniform(1, 1.3))


def _soft(draw: Draw) -> SickScene:
    return _stenosed(draw, 3, 6.2, draw.uniform(0.65, 0.92), length=50.0)


def _plaque(draw: Draw) -> SickScene:
    return _stenosed(draw, 2.8, 4.5, draw.uniform(0.3, 0.6), wall_level=draw.uniform(60, 200))


def _slices(draw: Draw) -> SickScene:
    across = (0.0, draw.uniform(1.3, 1.57))
    return _vessel(draw, 3.5, 6, spacing=(0.6, 0.6, 3.0), fwhm=(1.0, 1.0, 3.0), sharp=0.0, tilt=across)


def _calcified(draw: Draw) -> SickScene:
    block = {"calcium": draw.uniform(0.5, 1.3), "calcium_level": draw.uniform(480, 1000)}
    return _stenosed(draw, 3, 6.5, draw.uniform(0.3, 0.7), **block)


def _beside(draw: Draw, neighbor: str, level: float) -> SickScene:
    more = {"neighbor": neighbor, "neighbor_level": level, "neighbor_diameter": draw.uniform(3, 8)}
    return _vessel(draw, 2.5, 6, gap=draw.uniform(0, 0.6), **more)


KINDS: dict[str, Callable[[Draw], SickScene]] = {
    "healthy": _healthy,
    "soft stenoses of 65 to 92 %": _soft,
    "lung": lambda draw: _vessel(draw, 1.5, 30, wall=_log(draw, 0.15, 2), around=draw.uniform(-900, -800)),
    "narrow in muscle": lambda draw: _vessel(draw, 1.2, 2.6, around=draw.normal(55, 8)),
    "next to bone": lambda draw: _beside(draw, "bone", draw.uniform(150, 400)),
    "next to a vein": lambda draw: _beside(draw, "vein", draw.uniform(180, 300)),
    "thin struts": lambda draw: _vessel(draw, 2.5, 4, strut=draw.uniform(0.1, 0.15)),
    "calcium": _calcified,
    "bright plaque": _plaque,
    "thick slices across": _slices,
    "flap": lambda draw: _vessel(draw, 20, 30, flap=draw.uniform(0.6, 1.4), spacing=(0.8, 0.8, 0.8)),
    "thrombus": lambda draw: _vessel(draw, 10, 20, thrombus=draw.uniform(12, 15), spacing=(0.8, 0.8, 0.8)),
}


@dataclass(frozen=True)
class Sections:
    """Errors (mm), stated standard deviations (mm) and true diameters (mm), and which sections count."""

    error: Floats
    stated: Floats
    true: Floats
    counts: Floats

    def row(self) -> list[str]:
        """Return the cells of the table: all but the first are of sections that count."""
        use = self.counts.astype(bool)
        error, stated, true = self.error[use], self.stated[use], self.true[use]
        if not use.any():
            return ["0 %", *["-"] * 4]
        wrong = np.abs(error) / true
        silent = (wrong > SILENT) & (np.abs(error) > SMALLEST)
        within = "/".join(f"{100 * np.mean(np.abs(error) <= n * stated):.0f}" for n in (1, 2, 3))
        return [
            f"{100 * use.mean():.0f} %",
            f"{100 * np.median(error / true):+.1f} %",
            within,
            f"{100 * np.quantile(wrong, 0.95):.0f} %",
            f"{100 * silent.mean():.1f} %",
        ]


def sections_of(name: str, count: int) -> Sections:
    """Measure this number of scenes of a kind, without a given FWHM; the same scenes each time."""
    found = []
    for number in range(count):
        scene = KINDS[name](np.random.default_rng([sum(name.encode()), number]))
        line, diameters = scene.line()
        profile = measure(scene.volume(), line)
        steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
        true = np.interp(profile.arc_length, np.concatenate([[0.0], np.cumsum(steps)]), diameters)
        error = profile.diameter_equivalent - true
        counts = ((profile.flags & int(UNCOUNTED)) == 0) & np.isfinite(error)
        found.append((error, profile.uncertainty, true, counts))
    return Sections(*(np.concatenate(column) for column in zip(*found, strict=True)))


def table(count: int, names: list[str]) -> None:
    """Print the table, with a row for all scenes."""
    print("| scenes | count | bias | within 1/2/3 stated | 95 % of errors below | silent |")
    print("|---|---|---|---|---|---|")
    every = []
    for name in names:
        every.append(sections_of(name, count))
        print(f"| {name} ({count}) | {' | '.join(every[-1].row())} |", flush=True)
    columns = ("error", "stated", "true", "counts")
    joined = Sections(*(np.concatenate([getattr(one, name) for one in every]) for name in columns))
    print(f"| all | {' | '.join(joined.row())} |")


if __name__ == "__main__":
    table(int(sys.argv[1]) if len(sys.argv) > 1 else 24, sys.argv[2:] or list(KINDS))
