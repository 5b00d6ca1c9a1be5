"""Accuracy of `trace` between two clicks by the Rotterdam measures: ``python benches/trace_pairs.py``.

Clicks are drawn on reference lines, at least 25 mm apart. Scans of patients are read from ``../shared/data``,
if present; their references are VMTK's lines, not an expert's. Phantoms have exact lines.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut import (
    TracingError,
    Vessel,
    VesselTree,
    Volume,
    compare_centerlines,
    phantom,
    read_centerlines,
    read_volume,
    trace,
)

SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"
SCANS = {
    "stent graft": ("stent-cta/stent_cta.nii.gz", "stent-cta/centerlines.vtp"),
    "MRA": ("aorta-mra/aorta.mha", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
    "true lumen": ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/true_lumen_centerline_LPS.vtp"),
    "false lumen": ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/false_lumen_centerline_LPS.vtp"),
    "aortic arch": ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/aorta_arch_centerlines_LPS.vtp"),
}
PHANTOMS = ("aorta", "cervical")
#: Least distance between two clicks along the line, and distance of the points of a reference (mm).
LEAST, STEP = 25.0, 0.5


def scenes() -> Iterator[tuple[str, Volume, VesselTree]]:
    """Return the scans with their references."""
    for name, (scan, lines) in SCANS.items() if SHARED.is_dir() else ():
        volume = read_volume(SHARED / scan)
        yield name, volume, read_centerlines(SHARED / lines, volume=volume)
    for name in PHANTOMS:
        made = getattr(phantom, name)()
        yield f"`{name}`", made.volume, made.tree


def even(vessel: Vessel) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return points and radii every `STEP` along a vessel."""
    steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.arange(0.0, along[-1], STEP)
    points = np.stack([np.interp(at, along, vessel.points[:, axis]) for axis in range(3)], axis=1)
    return points, np.interp(at, along, np.broadcast_to(vessel.radius, len(along)))


def pairs(tree: VesselTree, count: int) -> Iterator[Vessel]:
    """Return parts of the reference between two clicks, always the same ones."""
    draw = np.random.default_rng(7)
    long = [vessel for vessel in tree if vessel.length >= 1.2 * LEAST and vessel.radius is not None]
    while count > 0:
        points, radius = even(long[draw.integers(len(long))])
        first, last = np.sort(draw.integers(0, len(points), 2))
        if (last - first) * STEP >= LEAST:
            count -= 1
            yield Vessel(points[first : last + 1], radius[first : last + 1])


def row(name: str, volume: Volume, tree: VesselTree, count: int) -> str:
    """Return the row of a scan: means over pairs, and the least overlap."""
    found, refused = [], 0
    for reference in pairs(tree, count):
        try:
            (traced,) = trace(volume, reference.points[[0, -1]])
        except TracingError:
            refused += 1
            continue
        found.append(compare_centerlines(traced, reference, sampling=0.1))
    if not found:
        return f"| {name} | {count} | {refused} | | | | | |"
    numbers = np.array([[one.ov, one.of, one.ot, one.ai] for one in found])
    ov, of, ot, ai = numbers.mean(axis=0)
    shares = " | ".join(f"{100 * share:.1f}" for share in (ov, numbers[:, 0].min(), of, ot))
    return f"| {name} | {count} | {refused} | {shares} | {ai:.2f} of {volume.spacing.min():.2f} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=20, help="pairs of clicks for each scan")
    count = parser.parse_args().pairs
    print("| scan | pairs | refused | OV (%) | least OV (%) | OF (%) | OT (%) | AI of voxel (mm) |")
    print("|---|---|---|---|---|---|---|---|")
    for name, volume, tree in scenes():
        print(row(name, volume, tree, count), flush=True)


if __name__ == "__main__":
    main()
