"""Time of uncurl, tangential CPR and CFA: ``python benches/uncurl.py [RUNS]``.

The stent CTA from the front, 512 × 1024 pixels. Each run uncurls by another amount, so nothing is reused. CPU
time is that of all threads.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

from lumencut import Camera, Renderer, VesselTree, cfa, demo, set_threads
from lumencut.reformations.tangential import tangential_of
from lumencut.reformations.uncurling import fitted_uncurling, uncurl_of

SIZE = (512, 1024)
THREADS = 2


def main(runs: int) -> None:
    """Print the medians (ms)."""
    set_threads(THREADS)
    volume, tree = demo.stent_scene()
    vessel = tree.path([0, 1, 2])
    renderer = Renderer(volume, VesselTree([vessel]), "cpu")
    camera = fitted_uncurling(Camera.anterior(vessel, size=SIZE), vessel)
    uncurled = uncurl_of(renderer, vessel, camera)
    print("| picture | size | time (ms) | CPU time (ms) |\n|---|---|---|---|")
    row("tangential CPR", runs, lambda _: tangential_of(renderer, vessel, camera))
    row("uncurl", runs, lambda run: uncurled.changed((run + 0.5) / (runs + 1)))
    start, used = time.perf_counter(), time.process_time()
    made = cfa(volume, vessel, 10.0, "max", 0.25, device="cpu")
    taken = f"{1e3 * (time.perf_counter() - start):.0f} | {1e3 * (time.process_time() - used):.0f}"
    print(f"| CFA, {made.angles} directions | {made.size} | {taken} |")


def row(name: str, runs: int, make: Callable[[int], Any]) -> None:
    """Print the medians of all runs but the first, each with positions, values and colours."""
    times, processor, made = [], [], make(0)
    _ = made.image
    for run in range(1, runs + 1):
        start, used = time.perf_counter(), time.process_time()
        made = make(run)
        _ = made.image
        times.append(1e3 * (time.perf_counter() - start))
        processor.append(1e3 * (time.process_time() - used))
    print(f"| {name} | {made.size} | {statistics.median(times):.1f} | {statistics.median(processor):.1f} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
