"""Recall and false vessels of `find_vessels` and `trace_from`, as a Markdown table.

``python benches/find_vessels.py [ROW ...]`` takes rows such as ``stent-cta`` or ``aorta@0.5+noise20``.
``--picture DIR`` draws the lines over four projections, coloured by confidence. Scans of patients must be in
``../shared/data``.
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
    "volume", "time", "level, contrast", "recall, first part", "by seed: min, median, max", "false, sure",
    "false, doubtful included", "sure", "doubtful", "parts",
)  # fmt: skip
SEEDS = 16
SEED_OFFSET_RADII = 0.6
FALSE_BEYOND_RADII = 1.5
MIN_RADIUS_VOXELS = 1.5
"""Only the truth with at least this radius counts for the recall."""

Floats = npt.NDArray[np.float64]


def samples(vessels: list[Vessel] | VesselTree, step: float = 0.5) -> tuple[Floats, Floats]:
    """Points and radii of vessels at equal steps (mm)."""
    parts = [resampled(vessel, step) for vessel in vessels]
    if not parts:
        return np.empty((0, 3)), np.empty(0)
    return np.concatenate([points for points, _ in parts]), np.concatenate([radius for _, radius in parts])


def nearest(points: Floats, others: Floats, units: Floats | float = 1.0) -> Floats:
    """Distance of each point to the nearest of `others`, divided by that one's unit."""
    found = np.full(len(points), np.inf)
    for first in range(0, len(points) if len(others) else 0, 200):
        apart = np.linalg.norm(points[first : first + 200, None] - others[None], axis=2) / units
        found[first : first + 200] = apart.min(axis=1)
    return found


def recall(vessels: list[Vessel], truth: tuple[Floats, Floats], voxel: float) -> float:
    """The share of the truth with a found point within its radius or one voxel, whichever is larger."""
    points, radius = truth
    return float((nearest(points, samples(vessels)[0]) <= np.maximum(radius, voxel)).mean())


def false_share(vessels: list[Vessel], known: tuple[Floats, Floats], voxel: float) -> tuple[float, float]:
    """Length of found vessels beyond 1.5 radii of all known ones, and their total length (mm)."""
    points, _ = samples(vessels)
    length = sum(vessel.length for vessel in vessels)
    if not len(points):
        return 0.0, 0.0
    units = np.maximum(known[1], voxel / FALSE_BEYOND_RADII)
    return float((nearest(points, known[0], units) > FALSE_BEYOND_RADII).mean() * length), length


def seeds(truth: tuple[Floats, Floats]) -> Floats:
    """Points evenly spaced along the truth, shifted off its middle in random directions."""
    points, radius = truth
    chosen = np.linspace(0, len(points) - 1, SEEDS + 2).astype(int)[1:-1]
    random = np.random.default_rng(3)
    ahead = points[np.minimum(chosen + 1, len(points) - 1)] - points[np.maximum(chosen - 1, 0)]
    across = np.cross(ahead, random.normal(size=ahead.shape))
    across /= np.linalg.norm(across, axis=1)[:, None] + 1e-12
    return np.asarray(points[chosen] + across * (SEED_OFFSET_RADII * radius[chosen])[:, None])


def chosen_by(seed: Floats, made: Scene) -> list[Vessel]:
    """The sure vessels of the part around a seed; empty if there is none."""
    try:
        return list(trace_from(made.volume, seed))
    except TracingError:
        return []


def percent(share: float) -> str:
    """A share as text."""
    return f"{100 * share:.1f} %"


def compared_with_truth(made: Scene, tree: VesselTree) -> list[str]:
    """The columns from recall to false length."""
    assert made.truth is not None
    voxel = voxel_of(made.volume)
    points, radius = samples(made.truth)
    wide = radius >= MIN_RADIUS_VOXELS * voxel
    truth = (points[wide], radius[wide])
    first = recall([tree[n] for n in tree.parts[0]], truth, voxel)
    each = sorted(recall(chosen_by(seed, made), truth, voxel) for seed in seeds(truth))
    words = [percent(first), ", ".join(percent(each[n]) for n in (0, len(each) // 2, -1))]
    if not made.is_complete:
        return [*words, "–", "–"]
    known = samples([*made.truth, *made.besides])
    sure = false_share(list(tree), known, voxel)
    doubtful = false_share(list(tree.doubtful), known, voxel)
    both = [sure[n] + doubtful[n] for n in (0, 1)]
    return [*words, *(f"{percent(a / max(b, 1e-9))}, {a:.0f} mm" for a, b in (sure, both))]


def row(name: str, folder: Path | None) -> str:
    """The row of one scene."""
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
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rows", nargs="*", help="names of rows; default: all")
    parser.add_argument("--picture", type=Path, help="folder for pictures of the found vessels")
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
