"""How much of a tree is found without a seed and from many seeds, and how much of what is found is false.

``python benches/find_vessels.py`` prints a Markdown table; names of rows, such as ``stent-cta`` or
``aorta@0.5+noise20``, print these alone. ``--picture DIR`` draws the lines of each row over projections from
four sides, coloured by confidence. Patients need the folder ``../shared/data`` beside the repository.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
import numpy.typing as npt
from vessel_pictures import save_pictures
from vessel_scenes import NEGATIVE, PATIENTS, PHANTOMS, SHARED, Scene, resampled, scene, voxel_of

from lumencut import TracingError, Vessel, VesselTree, find_vessels, trace_from

ROWS = (
    *PHANTOMS,
    *(f"aorta+{change}" for change in ("noise10", "noise20", "noise40", "fading", "stent", "bone", "veins")),
    *PATIENTS,
    *NEGATIVE,
)
COLUMNS = (
    "volume", "time", "level, contrast", "recall, first part", "from seeds: min, median, max", "false, sure",
    "false, with doubtful", "sure", "doubtful", "parts",
)  # fmt: skip
SEEDS = 16
"""How many seeds are put along the truth, each this share of the radius from the middle."""
OFF_MIDDLE = 0.6
REACH = 1.5
"""A line farther than so many radii from all of the truth is false."""
WIDE = 1.5
"""Vessels of this radius are to be found (voxels)."""

Floats = npt.NDArray[np.float64]


def places(vessels: list[Vessel] | VesselTree, step: float = 0.5) -> tuple[Floats, Floats]:
    """The points and radii of vessels in even steps (mm)."""
    parts = [resampled(vessel, step) for vessel in vessels]
    if not parts:
        return np.empty((0, 3)), np.empty(0)
    return np.concatenate([points for points, _ in parts]), np.concatenate([radius for _, radius in parts])


def nearest(points: Floats, others: Floats, units: Floats | float = 1.0) -> Floats:
    """How far each point is from the nearest of others, in units of each of these."""
    found = np.full(len(points), np.inf)
    for first in range(0, len(points) if len(others) else 0, 200):
        apart = np.linalg.norm(points[first : first + 200, None] - others[None], axis=2) / units
        found[first : first + 200] = apart.min(axis=1)
    return found


def recall(vessels: list[Vessel], truth: tuple[Floats, Floats], voxel: float) -> float:
    """The share of the truth with a found point within its radius, or a voxel where that is more."""
    points, radius = truth
    return float((nearest(points, places(vessels)[0]) <= np.maximum(radius, voxel)).mean())


def false_share(vessels: list[Vessel], known: tuple[Floats, Floats], voxel: float) -> tuple[float, float]:
    """The length of found vessels that lies beyond 1.5 radii of all known ones (mm), and that of all."""
    points, _ = places(vessels)
    length = sum(vessel.length for vessel in vessels)
    if not len(points):
        return 0.0, 0.0
    units = np.maximum(known[1], voxel / REACH)
    return float((nearest(points, known[0], units) > REACH).mean() * length), length


def seeds(truth: tuple[Floats, Floats]) -> Floats:
    """Points along the truth in even numbers of its points, off its middle, in directions by chance."""
    points, radius = truth
    chosen = np.linspace(0, len(points) - 1, SEEDS + 2).astype(int)[1:-1]
    random = np.random.default_rng(3)
    ahead = points[np.minimum(chosen + 1, len(points) - 1)] - points[np.maximum(chosen - 1, 0)]
    across = np.cross(ahead, random.normal(size=ahead.shape))
    across /= np.linalg.norm(across, axis=1)[:, None] + 1e-12
    return np.asarray(points[chosen] + across * (OFF_MIDDLE * radius[chosen])[:, None])


def chosen_by(seed: Floats, made: Scene) -> list[Vessel]:
    """The sure vessels of the part that a seed lies in; none where it lies in none."""
    try:
        return list(trace_from(made.volume, seed))
    except TracingError:
        return []


def percent(share: float) -> str:
    """A share in words."""
    return f"{100 * share:.1f} %"


def compared_with_truth(made: Scene, tree: VesselTree) -> list[str]:
    """The columns from recall to false length."""
    assert made.truth is not None
    voxel = voxel_of(made.volume)
    points, radius = places(made.truth)
    wide = radius >= WIDE * voxel
    truth = (points[wide], radius[wide])
    first = recall([tree[n] for n in tree.parts[0]], truth, voxel)
    each = sorted(recall(chosen_by(seed, made), truth, voxel) for seed in seeds(truth))
    words = [percent(first), ", ".join(percent(each[n]) for n in (0, len(each) // 2, -1))]
    if not made.is_complete:
        return [*words, "–", "–"]
    known = places([*made.truth, *made.besides])
    sure = false_share(list(tree), known, voxel)
    doubtful = false_share(list(tree.doubtful), known, voxel)
    both = [sure[n] + doubtful[n] for n in (0, 1)]
    return [*words, *(f"{percent(a / max(b, 1e-9))}, {a:.0f} mm" for a, b in (sure, both))]


def row(name: str, folder: Path | None) -> str:
    """Find the vessels of a scene, and compare them with its truth."""
    made = scene(name)
    start = time.perf_counter()
    try:
        tree = find_vessels(made.volume)
    except TracingError as error:
        took = time.perf_counter() - start
        return f"| {name} | {took:.1f} s | {error.subject}: {error.found} |" + " – |" * (len(COLUMNS) - 3)
    took = time.perf_counter() - start
    if folder is not None:
        save_pictures(folder / f"{name}.png", made.volume, tree)
    compared = ["–"] * 4 if made.truth is None else compared_with_truth(made, tree)
    lengths = [
        f"{len(part)}, {sum(vessel.length for vessel in part):.0f} mm" for part in (tree, tree.doubtful)
    ]
    words = [f"{took:.1f} s", tree.notes[0].partition("about ")[2], *compared, *lengths, str(len(tree.parts))]
    return f"| {name} | " + " | ".join(words) + " |"


def main() -> None:
    """Print a Markdown table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rows", nargs="*", help="names of rows; all where none is given")
    parser.add_argument("--picture", type=Path, help="a folder for pictures of what is found")
    given = parser.parse_args()
    rows = given.rows or [name for name in ROWS if SHARED.is_dir() or name not in PATIENTS]
    if given.picture is not None:
        given.picture.mkdir(parents=True, exist_ok=True)
    print("| " + " | ".join(COLUMNS) + " |")
    print("|" + "---|" * len(COLUMNS))
    for name in rows:
        print(row(name, given.picture), flush=True)


if __name__ == "__main__":
    main()
