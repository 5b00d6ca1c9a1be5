"""Accuracy and speed of `trace` on phantoms with known truth: ``python benches/trace.py [--scenes 200]``."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut import Tracer, TracingError, VesselTree, Volume, phantom, trace

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from trace_scenes import LUMEN, Scene, arc, away, leaks, narrowed, random_case, room

Row = tuple[str, str]


def tube() -> Iterator[Row]:
    """A tube of 151 mm with a stenosis of 45 %."""
    line = arc(151)
    scene = Scene(room(line, 0.5), (0.5,) * 3)
    scene.paint(line, narrowed(line, 3.0, 45), LUMEN)
    volume = scene.volume(1)
    seconds, tree = timed(volume, line[[5, -6]])
    off = away(tree[0].points, line)
    measured = f"mean {off.mean():.3f} mm, max {off.max():.3f} mm, {seconds:.2f} s"
    yield "tube of 151 mm, stenosis of 45 %", measured


def timed(volume: Volume, clicks: npt.ArrayLike) -> tuple[float, VesselTree]:
    """The shortest of three times, and the tree."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        tree = trace(volume, clicks)
        times.append(time.perf_counter() - start)
    return min(times), tree


def scenes(count: int) -> Iterator[Row]:
    """Random scenes: how many leak, and how many are rejected for lack of points."""
    for clicks in (2, 3):
        correct = leaking = 0
        for seed in range(count):
            case = random_case(seed)
            try:
                (vessel,) = trace(case.volume, case.clicks[[0, -1]] if clicks == 2 else case.clicks)
            except TracingError:
                continue
            correct += not leaks(vessel.points, case)
            leaking += leaks(vessel.points, case)
        rejected = count - correct - leaking
        yield (
            f"{count} scenes, {clicks} clicks",
            f"{correct} without leak, {leaking} with one, {rejected} rejected",
        )


def changes() -> Iterator[Row]:
    """Time of changes of points in a large volume."""
    made = phantom.cervical()
    carotid = made.tree["right internal carotid artery"].points
    tracer = Tracer(made.volume)
    tracer.add(carotid[2])
    tracer.add(carotid[-3])
    yield f"first of {made.volume.size}", f"{routed(tracer):.0f} ms"
    tracer.add(carotid[len(carotid) // 2], index=1)
    yield "a point added", f"{routed(tracer):.0f} ms"
    times = []
    for step in range(1, 9):
        tracer.move(1, carotid[len(carotid) // 2 + step] + [0.4, 0.0, 0.0])
        times.append(routed(tracer))
    yield "a point moved (median of 8, and the longest)", f"{np.median(times):.0f} ms, {max(times):.0f} ms"
    tracer.remove(1)
    yield "a point removed", f"{routed(tracer):.0f} ms"


def routed(tracer: Tracer) -> float:
    """Milliseconds of `Tracer.route`."""
    start = time.perf_counter()
    tracer.route()
    return (time.perf_counter() - start) * 1e3


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=200)
    count = parser.parse_args().scenes
    print("| task | measured |\n|---|---|")
    for rows in (tube(), changes(), scenes(count)):
        for what, measured in rows:
            print(f"| {what} | {measured} |", flush=True)


if __name__ == "__main__":
    main()
