"""How much of a tree one seed finds, and how much of what it finds is false, on phantoms with known trees.

``make bench`` runs it; ``python benches/trace_from.py`` alone needs the installed package. With the folder
``../shared/data`` beside the repository two CT angiographies are traced too, and compared with lines of VMTK.
"""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from lumencut import (
    VesselTree,
    Volume,
    compare_centerlines,
    phantom,
    read_centerlines,
    read_volume,
    trace_from,
)

SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"
VOLUMES = (
    ("stent-cta/stent_cta.nii.gz", "stent-cta/centerlines.vtp", 0.7),
    ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/aorta_arch_centerlines_LPS.vtp", 0.5),
)
"""Volumes of patients, lines that VMTK made of them, and where along the first of these the seed lies."""
WIDE = 1.5
"""Branches of this radius are to be found (mm)."""
COLUMNS = ("volume", "time", "found, r ≥ 1.5 mm", "OV", "AI (mm)", "false length", "branches", "doubtful")


def found_share(tree: VesselTree, truth: VesselTree) -> float:
    """The share of the length of wide branches that has a traced point within its radius."""
    traced = tree.points
    found = whole = 0.0
    for vessel in truth:
        radius = np.zeros(len(vessel)) if vessel.radius is None else vessel.radius
        steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
        middles = (vessel.points[1:] + vessel.points[:-1]) / 2
        for step, middle, wide in zip(steps, middles, np.minimum(radius[1:], radius[:-1]), strict=True):
            if wide >= WIDE:
                whole += step
                found += step * bool(np.linalg.norm(traced - middle, axis=1).min() <= wide)
    return found / whole


def row(name: str, volume: Volume, truth: VesselTree, share: float) -> str:
    """Trace from a point of the first vessel, and compare with the truth."""
    seed = truth[0].points[int(share * len(truth[0]))]
    start = time.perf_counter()
    tree = trace_from(volume, seed)
    took = time.perf_counter() - start
    found = compare_centerlines(tree, truth, sampling=0.1)
    length = sum(vessel.length for vessel in tree)
    doubtful = sum(vessel.length for vessel in tree.doubtful)
    numbers = (
        f"{took:.1f} s",
        f"{100 * found_share(tree, truth):.1f} %",
        f"{found.ov:.3f}",
        f"{found.ai:.2f}",
        f"{100 * found.false_length / length:.1f} %",
        f"{len(tree)}, {length:.0f} mm",
        f"{len(tree.doubtful)}, {doubtful:.0f} mm",
    )
    return f"| {name} | " + " | ".join(numbers) + " |"


def main() -> None:
    """Print a Markdown table."""
    print("| " + " | ".join(COLUMNS) + " |")
    print("|" + "---|" * len(COLUMNS))
    for name in ("aorta", "cervical", "runoff"):
        made = getattr(phantom, name)()
        print(row(f"`{name}`", made.volume, made.tree, 0.5), flush=True)
    for volume, lines, share in VOLUMES if SHARED.is_dir() else ():
        truth = read_centerlines(SHARED / lines, coordinates="lps")
        print(row(volume.partition("/")[0], read_volume(SHARED / volume), truth, share), flush=True)


if __name__ == "__main__":
    main()
