"""What another tree costs a renderer of a large volume: its levels of detail, and nothing of the volume.

``make bench`` runs it; ``python benches/another_tree.py`` alone needs the installed package.
"""

from __future__ import annotations

import statistics
import time

import numpy as np

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, Volume

SIDE = 512
"""Voxels along each side of the volume."""
TREES = 21
"""How many trees are exchanged."""


def tree(seed: int, vessels: int = 31, points: int = 160) -> VesselTree:
    """Smooth vessels that wander through the volume, 0.5 mm per segment."""
    random = np.random.default_rng(seed)
    made = []
    for _ in range(vessels):
        ahead = random.normal(size=3) + np.cumsum(0.3 * random.normal(size=(points, 3)), axis=0)
        steps = 0.5 * ahead / np.linalg.norm(ahead, axis=1)[:, None]
        made.append(Vessel(np.clip(random.uniform(-90, 90, 3) + np.cumsum(steps, axis=0), -127, 127), 2.0))
    return VesselTree(made)


def milliseconds(start: float) -> float:
    """The time since `start`."""
    return (time.perf_counter() - start) * 1e3


def main() -> None:
    """Exchange trees and print a Markdown table."""
    voxels = np.random.default_rng(1).integers(-1000, 1000, (SIDE, SIDE, SIDE), dtype=np.int16)
    volume = Volume(voxels, spacing=(0.5,) * 3, origin=(-SIDE / 4,) * 3)
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
    print(f"\nAnother tree of {segments} segments, volume of {SIDE}³ voxels (ms)\n")
    print("| what | median | worst |\n| --- | --- | --- |")
    print(f"| `with_tree` | {statistics.median(exchanged):.2f} | {max(exchanged):.2f} |")
    print(
        f"| its levels of detail, in its first view | {statistics.median(levels):.2f} | {max(levels):.2f} |"
    )
    both = [sum(pair) for pair in zip(exchanged, levels, strict=True)]
    print(f"| both | {statistics.median(both):.2f} | {max(both):.2f} |")
    print(f"| the first view of the volume, which reads it all | {first_view:.1f} | |")


if __name__ == "__main__":
    main()
