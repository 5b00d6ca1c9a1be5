"""Checks in random scenes whether the uncertainty that measuring states is right."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from calibration_scenes import FAT, MUSCLE, Scene, tree_of
from lumencut import Flag, measure

Floats = npt.NDArray[np.float64]
Draw = np.random.Generator

#: Sections with one of these flags are not compared.
MARKED = Flag.AT_LIMIT | Flag.BRANCH | Flag.CALCIUM | Flag.METAL | Flag.NEIGHBOR | Flag.OUTSIDE | Flag.NO_EDGE


def _artery(draw: Draw, narrowest: float = 1.8, widest: float = 8.0) -> dict[str, float]:
    """A lumen and a wall with the properties of arteries."""
    diameter = float(np.exp(draw.uniform(np.log(narrowest), np.log(widest))))
    return {
        "diameter": diameter,
        "wall": float(draw.normal(45, 25)),
        "thickness": float(0.45 * diameter**0.5 * np.exp(draw.normal(0, 0.3))),
        "lumen": float(draw.uniform(280, 450)),
        "noise": float(draw.uniform(12, 28)),
        "seed": int(draw.integers(1 << 30)),
    }


def _tissue(draw: Draw) -> Scene:
    artery = _artery(draw)
    artery["wall"] = float(draw.normal(45, 10))
    return Scene(**artery, around=(artery["wall"],), kernel=0.0)


def _fat(draw: Draw) -> Scene:
    return Scene(**_artery(draw), around=(draw.normal(FAT, 12),))


def _muscle(draw: Draw) -> Scene:
    return Scene(**_artery(draw), around=(draw.normal(MUSCLE, 10),))


def _both(draw: Draw) -> Scene:
    return Scene(**_artery(draw), around=(draw.normal(FAT, 12), draw.normal(MUSCLE, 10)), patches=15)


def _smooth(draw: Draw) -> Scene:
    return Scene(**_artery(draw, 2.4), around=(draw.normal(FAT, 12),), fwhm=1.2, kernel=1.1)


def _sharp(draw: Draw) -> Scene:
    return Scene(**_artery(draw, 1.4), around=(draw.normal(FAT, 12),), fwhm=0.65, kernel=-0.5)


def _ellipse(draw: Draw) -> Scene:
    return Scene(**_artery(draw, 3.0), around=(draw.normal(FAT, 12),), stretch=draw.uniform(1.2, 1.8))


def _bend(draw: Draw) -> Scene:
    artery = _artery(draw, 2.0, 6.0)
    return Scene(**artery, around=(draw.normal(FAT, 12),), bend=draw.uniform(12, 30))


def _voxels(draw: Draw) -> Scene:
    side = float(np.exp(draw.uniform(np.log(0.3), np.log(1.5))))
    fwhm = side * draw.uniform(1.2, 1.8)
    artery = _artery(draw, 2.0 * fwhm, max(8.0, 3.0 * fwhm))
    return Scene(**artery, around=(draw.normal(FAT, 12),), spacing=(side, side, side), fwhm=fwhm)


def _stenosis(draw: Draw) -> Scene:
    artery = _artery(draw, 4.0, 6.0)
    percent = draw.uniform(20, 60)
    return Scene(**artery, around=(draw.normal(FAT, 12),), stenosis=percent, stenosis_length=14)


def _estimated(draw: Draw) -> Scene:
    return Scene(**_artery(draw, 5.0, 9.0), around=(draw.normal(FAT, 12),), fwhm=draw.uniform(0.7, 1.2))


def _assumed(draw: Draw) -> Scene:
    fwhm = max(draw.normal(0.85, 0.2), 0.45)
    return Scene(**_artery(draw, 1.4, 2.4), around=(draw.normal(FAT, 12),), fwhm=fwhm)


@dataclass(frozen=True)
class Kind:
    """A kind of scene."""

    name: str
    scene: Callable[[Draw], Scene]
    is_fwhm_given: bool = True
    #: The stated FWHM is the true one times this factor.
    fwhm_factor: float = 1.0


KINDS = (
    Kind("even tissue, white noise", _tissue),
    Kind("fat", _fat),
    Kind("muscle", _muscle),
    Kind("fat and muscle, patches", _both),
    Kind("smooth kernel", _smooth),
    Kind("sharp kernel", _sharp),
    Kind("ellipses", _ellipse),
    Kind("bends", _bend),
    Kind("voxels of 0.3 to 1.5 mm", _voxels),
    Kind("stenoses", _stenosis),
    Kind("FWHM estimated", _estimated, is_fwhm_given=False),
    Kind("FWHM assumed", _assumed, is_fwhm_given=False),
)


def _wall_off(sign: int) -> Callable[[Draw], Scene]:
    """Arteries whose wall is two standard deviations away from the level that measuring expects."""

    def scene(draw: Draw) -> Scene:
        artery = _artery(draw) | {"wall": 45.0 + sign * 2 * 25.0}
        return Scene(**artery, around=(draw.normal(FAT, 12),))

    return scene


#: Not covered by the stated uncertainty: wrong user input, and walls far from the expected level.
NOT_COVERED = (
    Kind("FWHM given 30 % too small", _fat, fwhm_factor=0.7),
    Kind("FWHM given 30 % too large", _fat, fwhm_factor=1.3),
    Kind("wall of 95 HU", _wall_off(1)),
    Kind("wall of -5 HU", _wall_off(-1)),
)


#: Standard deviations (HU) by which the walls of one tree differ.
TREES = (7.0, 15.0)


@dataclass
class Told:
    """Errors of diameters and their stated standard deviations in the scenes of one kind (mm)."""

    name: str
    errors: list[Floats]
    told: list[Floats]
    true: list[Floats]

    def within(self, deviations: float) -> tuple[float, float, float]:
        """Return the share of sections within this number of stated standard deviations (percent).

        With the share come the ends of its 95 % interval, by drawing scenes again (bootstrap).
        """
        hits = np.array(
            [
                [np.sum(np.abs(e) <= deviations * s), len(e)]
                for e, s in zip(self.errors, self.told, strict=True)
            ]
        )
        draw = np.random.default_rng(1)
        picks = draw.integers(len(hits), size=(2000, len(hits)))
        shares = 100 * hits[picks, 0].sum(axis=1) / hits[picks, 1].sum(axis=1)
        low, high = np.quantile(shares, [0.025, 0.975])
        return float(100 * hits[:, 0].sum() / hits[:, 1].sum()), float(low), float(high)


def calibrated(kind: Kind, count: int) -> Told:
    """Measure this number of scenes of a kind; the same scenes each time."""
    draw = np.random.default_rng(sum(kind.name.encode()))
    told = Told(kind.name, [], [], [])
    for _ in range(count):
        scene = kind.scene(draw)
        fwhm = scene.fwhm * kind.fwhm_factor if kind.is_fwhm_given else None
        profile = measure(scene.volume(), scene.vessel(), fwhm=fwhm)
        judged = (profile.flags & (MARKED if kind.name != "FWHM assumed" else MARKED & ~Flag.AT_LIMIT)) == 0
        true = scene.diameter_at(profile.arc_length - profile.arc_length[-1] / 2)
        if judged.any():
            told.errors.append((profile.diameter_equivalent - true)[judged])
            told.told.append(profile.uncertainty[judged])
            told.true.append(true[judged])
    return told


def calibrated_trees(apart: float, count: int) -> tuple[Told, Told]:
    """Measure the three arteries in fat of each of these trees: each one alone, and together.

    The walls of a tree differ by a standard deviation ``apart`` (HU); the walls of all trees vary as before.
    """
    draw = np.random.default_rng(1)
    name = f"trees, walls {apart:g} HU apart"
    alone, together = Told(f"{name}, each alone", [], [], []), Told(f"{name}, together", [], [], [])
    for _ in range(count):
        wall = draw.normal(45, (25**2 - apart**2) ** 0.5)
        walls = [{"wall": float(wall + draw.normal(0, apart))} for _ in range(3)]
        scenes = [Scene(**(_artery(draw) | one), around=(draw.normal(FAT, 12),)) for one in walls]
        volume, tree = tree_of(scenes)
        for told, known in ((alone, None), (together, tree)):
            for scene, vessel in zip(scenes, tree, strict=True):
                profile = measure(volume, vessel, fwhm=scene.fwhm, tree=known)
                judged = (profile.flags & MARKED) == 0
                true = np.full(judged.sum(), scene.diameter)
                told.errors.append(profile.diameter_equivalent[judged] - true)
                told.told.append(profile.uncertainty[judged])
                told.true.append(true)
    return alone, together


def table(count: int, kinds: Sequence[Kind] = (*KINDS, *NOT_COVERED)) -> str:
    """Return the table of kinds, with the table of trees below."""
    lines = [
        "| scenes | sections | bias (mm) | worst scene (mm) | told (mm) | within 1 told | within 2 told |",
        "|---|---|---|---|---|---|---|",
    ]
    all_told = (calibrated(kind, count) for kind in kinds)
    trees = (told for apart in TREES for told in calibrated_trees(apart, count))
    for told in itertools.chain(all_told, trees):
        one, two = told.within(1), told.within(2)
        errors = np.concatenate(told.errors)
        worst = max(told.errors, key=lambda e: abs(e.mean())).mean()
        shares = [f"{share:.0f} % ({low:.0f} to {high:.0f})" for share, low, high in (one, two)]
        lines.append(
            f"| {told.name} ({len(told.errors)}) | {len(errors)} | {errors.mean():+.3f} | {worst:+.2f} "
            f"| {np.median(np.concatenate(told.told)):.3f} | {shares[0]} | {shares[1]} |"
        )
        print(lines[-1], flush=True)
    return "\n".join(lines)


def figure(place: str) -> None:
    """Draw the errors of measured diameters of arteries in fat, with and without a wall level."""
    import matplotlib.pyplot as plt

    true = np.array([1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 12.0])
    _, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
    for wall, color, word in (
        ("off", "#b35900", "lumen and surroundings"),
        (None, "#006680", "with the wall"),
    ):
        profiles = [
            measure(scene.volume(), scene.vessel(), fwhm=scene.fwhm, wall=wall)  # type: ignore[arg-type]
            for scene in (Scene(float(diameter), seed=3) for diameter in true)
        ]
        away = [np.median(one.diameter_equivalent) - d for one, d in zip(profiles, true, strict=True)]
        told = [2 * np.median(one.uncertainty) for one in profiles]
        axes.errorbar(true, away, yerr=told, fmt="o", color=color, capsize=3, label=word)
    axes.axhline(0, color="#606060", linewidth=0.8)
    axes.set(xlabel="true diameter (mm)", ylabel="told less true (mm)", xscale="log")
    axes.set_xticks(true, [f"{d:g}" for d in true])
    axes.minorticks_off()
    axes.legend(frameon=False)
    plt.savefig(place, dpi=110)


if __name__ == "__main__":
    import sys

    if len(sys.argv) > 2:
        figure(sys.argv[2])
    table(int(sys.argv[1]) if len(sys.argv) > 1 else 24)
