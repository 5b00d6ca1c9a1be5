"""Time, memory and accuracy of `trace_mask`: ``python benches/trace_mask.py``.

Masks of patients in ``../shared/data``, if present, are compared with VMTK's centerlines there.
"""

from __future__ import annotations

import statistics
import sys
import time
from pathlib import Path

import numpy as np

from lumencut import (
    Vessel,
    VesselTree,
    Volume,
    compare_centerlines,
    phantom,
    read_centerlines,
    read_volume,
    trace_mask,
)

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from mask_scenes import betti, betti_of, lumen_mask

SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"
MASKS = (
    ("stent-cta/stent_lumen_mask.nii.gz", "stent-cta/centerlines.vtp"),
    ("aorta-mra/aorta_lumen_mask.nii.gz", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
    ("dissection-cta/aorta.nii.gz", "dissection-cta/aorta_centerline_LPS.vtp"),
    ("dissection-cta/aorta_true_lumen.nii.gz", "dissection-cta/true_lumen_centerline_LPS.vtp"),
    ("dissection-cta/aorta_false_lumen.nii.gz", "dissection-cta/false_lumen_centerline_LPS.vtp"),
)
"""Masks of patients and the centerlines that VMTK computed from them."""
COLUMNS = (
    *("mask", "voxels", "grid", "time", "memory", "b₀, b₁ of mask, of tree"),
    *("OV", "OF", "OT", "AI of voxel (mm)", "false length"),
)
RUNS = 3


def memory(name: str) -> float:
    """Memory of the process (MB) on Linux: `VmRSS` now, `VmHWM` at its peak."""
    status = Path("/proc/self/status").read_text("ascii")
    return int(status.partition(f"{name}:")[2].split()[0]) / 1024


def reset_peak() -> None:
    """Reset `VmHWM`."""
    Path("/proc/self/clear_refs").write_text("5", "ascii")


def row(name: str, mask: Volume, truth: VesselTree) -> str:
    """The row of one mask."""
    reset_peak()
    before, times = memory("VmRSS"), []
    for _ in range(RUNS):
        start = time.perf_counter()
        tree = trace_mask(mask)
        times.append(time.perf_counter() - start)
    grown = memory("VmHWM") - before
    found = compare_centerlines(tree, truth, sampling=0.05)
    traced = sum(vessel.length for vessel in tree)
    numbers = [
        f"{np.count_nonzero(mask.array):,}",
        " × ".join(map(str, mask.size)),
        f"{statistics.median(times):.2f} s",
        f"{grown:.0f} MB",
        f"{betti(mask)} {betti_of(tree)}",
        f"{found.ov:.4f}",
        f"{found.of:.4f}",
        f"{found.ot:.4f}",
        f"{found.ai:.3f} of {mask.spacing.min():.2f}",
        f"{100 * found.false_length / traced:.1f} %",
    ]
    return f"| {name} | " + " | ".join(numbers) + " |"


def large() -> tuple[Volume, VesselTree]:
    """The phantom `cervical` in 512 × 512 × 600 voxels, widened to about 10⁶ voxels of lumen."""
    made = phantom.cervical()
    tree = VesselTree(
        [Vessel(vessel.points, 1.25 * vessel.radius + 0.6, vessel.name) for vessel in made.tree]
    )
    low, high = made.volume.corners.min(axis=0), made.volume.corners.max(axis=0)
    spacing = (high - low) / (512, 512, 600)
    grid = Volume(np.zeros((600, 512, 512), np.uint8), spacing=spacing, origin=low + spacing / 2)
    return lumen_mask(tree, grid), tree


def main() -> None:
    """Print the table."""
    print("| " + " | ".join(COLUMNS) + " |")
    print("|" + "---|" * len(COLUMNS))
    print(row("10⁶ voxels", *large()), flush=True)
    for name in ("helix", "y_junction", "trefoil", "aorta", "runoff", "cervical"):
        made = getattr(phantom, name)()
        print(row(f"`{name}`", lumen_mask(made.tree, made.volume), made.tree), flush=True)
    for mask, lines in MASKS if SHARED.is_dir() else ():
        truth = read_centerlines(SHARED / lines, coordinates="lps")
        print(row(mask.partition(".")[0], read_volume(SHARED / mask), truth), flush=True)


if __name__ == "__main__":
    main()
