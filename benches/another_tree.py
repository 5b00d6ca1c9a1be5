"""Time for `Renderer.with_tree` on a large volume: ``python benches/another_tree.py``."""

from __future__ import annotations

import statistics
import time

import numpy as np

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, Volume

VOXELS_PER_SIDE = 512
TREES = 21


def tree(seed: int, vessels: int = 31, points: int = 160) -> VesselTree:
    """Smooth random vessels with segments of 0.5 mm."""
    random = np.random.default_rng(seed)
    made = []
    for _ in range(vessels):
        ahead = random.normal(size=3) + np.cumsum(0.3 * random.normal(size=(points, 3)), axis=0)
        steps = 0.5 * ahead / np.linalg.norm(ahead, axis=1)[:, None]
        made.append(Vessel(np.clip(random.uniform(-90, 90, 3) + np.cumsum(steps, axis=0), -127, 127), 2.0))
    return VesselTree(made)


def milliseconds(start: float) -> float:
    """Milliseconds since `start`."""
    return (time.perf_counter() - start) * 1e3


def main() -> None:
    """Print the table."""
    voxels = np.random.default_rng(1).integers(
        -1000, 1000, (VOXELS_PER_SIDE, VOXELS_PER_SIDE, VOXELS_PER_SIDE), dtype=np.int16
    )
    volume = Volume(voxels, spacing=(0.5,) * 3, origin=(-VOXELS_PER_SIDE / 4,) * 3)
    renderer = Renderer(volume, tree(0), "cpu")
    camera, settings = Camera.anterior(tree(0), (64, 64)), Settings(window=renderer.window)
    start = time.perf_counter()
    renderer.render(camera, settings)
    first_view = milliseconds(start)
    exchanged, levels = [], []
    for seed in range(1, TREES + 1):
        other = tree(seed)
        start = time.perf_counter()
        renderer = renderer.with_tree(other)
        exchanged.append(milliseconds(start))
        levels.append(renderer.render(camera, settings).timings["levels"])
    segments = sum(len(vessel) - 1 for vessel in other)
    print(f"\nNew tree of {segments} segments, volume of {VOXELS_PER_SIDE}³ voxels (ms)\n")
    print("| step | median | worst |\n| --- | --- | --- |")
    print(f"| `with_tree` | {statistics.median(exchanged):.2f} | {max(exchanged):.2f} |")
    print(f"| levels of detail | {statistics.median(levels):.2f} | {max(levels):.2f} |")
    both = [sum(pair) for pair in zip(exchanged, levels, strict=True)]
    print(f"| both | {statistics.median(both):.2f} | {max(both):.2f} |")
    print(f"| first view of the volume | {first_view:.1f} | |")


if __name__ == "__main__":
    main()
