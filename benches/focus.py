"""Times of the stages with and without a focus: ``python benches/focus.py [RUNS]``.

The stent CTA from the front, 1024 × 1024 pixels; all looks alternate on one thread, so wall time is CPU time.
"""

from __future__ import annotations

import statistics
import sys
from collections import defaultdict

from lumencut import Camera, Renderer, Settings, demo, set_threads

STAGES = ("depth", "leap", "depth_filter", "focus", "surface", "silhouette", "context", "body", "composite")
LOOKS = {
    "default": Settings(),
    "without context": Settings(context=None),
    "quiet surroundings": Settings(silhouette_reach=10),
    "focus": Settings.focused(),
    "focus, while moving": Settings.focused(context_preview=True),
}


def main(runs: int) -> None:
    """Print the medians (ms)."""
    set_threads(1)
    volume, tree = demo.stent_scene()
    renderer = Renderer(volume, tree, device="cpu")
    camera = Camera.anterior(tree, size=(1024, 1024))
    times: dict[str, dict[str, list[float]]] = {look: defaultdict(list) for look in LOOKS}
    for run in range(runs + 1):
        for look, settings in LOOKS.items():
            timings = renderer.render(camera, settings).timings
            for stage, milliseconds in timings.items() if run else ():
                times[look][stage].append(milliseconds)
    print("| look |", " | ".join(STAGES), "| all |")
    print("| --- |" + " --- |" * (len(STAGES) + 1))
    for look, found in times.items():
        medians = {stage: statistics.median(found[stage]) for stage in found}
        row = [f"{medians[stage]:.1f}" if stage in medians else "" for stage in STAGES]
        print(f"| {look} |", " | ".join(row), f"| {sum(medians.values()):.1f} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
