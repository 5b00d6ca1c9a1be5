"""What Python traces in phantoms that the page opens too: the truth for the tests of its tracing.

    python traced.py FOLDER

writes a mask of each phantom to the folder, and what came of all to ``truth.json``.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import nibabel
import numpy as np

from lumencut import (
    Vessel,
    VesselTree,
    Volume,
    find_vessels,
    phantom,
    trace,
    trace_from,
    trace_mask,
    write_centerlines,
)

ENDINGS = ("vtp", "mrk.json")


def numbers(vessel: Vessel) -> dict[str, Any]:
    """All numbers of a vessel as the page has them."""
    parts = (vessel.radius, vessel.confidence, vessel.bridged)
    radius, confidence, bridged = (None if part is None else part.tolist() for part in parts)
    return {
        "points": vessel.points.tolist(),
        "radius": radius,
        "confidence": confidence,
        "bridged": bridged,
    }


def files(vessels: Iterable[Vessel]) -> dict[str, str]:
    """The centerline files of some vessels."""
    tree = VesselTree(vessels)
    written = {}
    with tempfile.TemporaryDirectory() as folder:
        for ending in ENDINGS:
            path = Path(folder) / f"lines.{ending}"
            write_centerlines(tree, path)
            written[ending] = path.read_text()
    return written


def truth(folder: Path, scene: Any, clicks: list[list[Any]]) -> dict[str, Any]:
    """What comes of clicks, of a seed in the first of them, without any, and of a mask."""
    volume = scene.volume
    clicked = [[np.asarray(point, float).tolist() for point in points] for points in clicks]
    names = [f"vessel {n}" for n in range(len(clicked))]
    traced = trace(volume, clicked, names=names)
    branches = trace_from(volume, clicked[0][0])
    found = find_vessels(volume)
    lumen = (volume.array > 205).astype(np.uint8)
    # A hole that produces a note.
    inside = np.linalg.inv(volume.world_from_index) @ [*clicked[0][0], 1.0]
    lumen[tuple(np.round(inside[2::-1]).astype(int))] = 0
    mask = Volume(lumen, world_from_index=volume.world_from_index)
    masked = trace_mask(mask, volume)
    path = folder / f"{scene.name}.nii.gz"
    ras = np.diag([-1, -1, 1, 1]) @ mask.world_from_index
    image = nibabel.Nifti1Image(mask.array.T, ras)
    image.header.set_xyzt_units("mm")
    nibabel.save(image, path)
    return {
        "phantom": scene.name,
        "mask": str(path),
        "clicks": clicked,
        "lines": [numbers(vessel) for vessel in traced],
        "files": files(traced),
        "branches": [numbers(vessel) for vessel in (*branches, *branches.doubtful)],
        "found": [numbers(vessel) for vessel in (*found, *found.doubtful)],
        "told": list(found.notes[:1]),
        "masked": [numbers(vessel) for vessel in masked],
        "notes": list(masked.notes),
    }


def main() -> None:
    """Write everything."""
    folder = Path(sys.argv[1])
    y_junction, stenosis = phantom.y_junction(), phantom.stenosis(50.0)
    trunk, right, left = (vessel.points for vessel in y_junction.tree)
    (tube,) = (vessel.points for vessel in stenosis.tree)
    off = np.array([0.7, -0.4, 0.3])
    every = [
        truth(folder, y_junction, [[trunk[3] + off, right[-4]], [trunk[20], left[-5] - off]]),
        truth(folder, stenosis, [[tube[5] + off, tube[40], tube[-6]]]),
    ]
    (folder / "truth.json").write_text(json.dumps(every))


if __name__ == "__main__":
    main()
