"""Compares the arrays of two folders of frames: frames and pixels that differ, and by how much."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from frame_comparison import LIMITS as LIMITS_OF_TESTS
from image_comparison import compare

LIMITS = {**LIMITS_OF_TESTS, "position": LIMITS_OF_TESTS["depth"]}
"""For each array how far apart its pixels may be, and the share of a frame's pixels that may be farther."""


@dataclass
class Tally:
    """Counts of one kind of array over all frames."""

    frames: int = 0
    different_frames: int = 0
    pixels: int = 0
    different_pixels: int = 0
    largest: float = 0.0
    beyond: dict[float, int] = field(default_factory=dict)
    """How many pixels differ by more than each tolerance."""

    def add(self, name: str, one: npt.NDArray[Any], other: npt.NDArray[Any]) -> list[str]:
        """Count one pair of arrays, and describe what exceeds the limits."""
        pixels, result = one.shape[0] * one.shape[1], compare(other, one)
        self.frames += 1
        self.different_frames += one.tobytes() != other.tobytes()
        self.pixels += pixels
        self.different_pixels += result.count
        self.largest = max(self.largest, result.largest)
        worse = []
        for tolerance, share in LIMITS[name]:
            count = compare(other, one, tolerance).count
            self.beyond[tolerance] = self.beyond.get(tolerance, 0) + count
            if count > share * pixels:
                largest = f"up to {result.largest:.3g}"
                worse.append(f"{name}: {count} of {pixels} pixels by more than {tolerance:g}, {largest}")
        return worse

    def row(self, name: str) -> str:
        """One row of a table."""
        beyond = ", ".join(f"{count} > {tolerance:g}" for tolerance, count in self.beyond.items())
        frames = f"{self.different_frames} of {self.frames}"
        pixels = f"{self.different_pixels} of {self.pixels}"
        return f"| {name} | {frames} | {pixels} | {self.largest:.3g} | {beyond} |"


@dataclass
class Differences:
    """Counts over all frames."""

    frames: int = 0
    different_frames: int = 0
    tallies: dict[str, Tally] = field(default_factory=dict)
    worse: dict[str, list[str]] = field(default_factory=dict)
    """What is beyond the limits, by the names of the frames."""

    def add(self, frame: str, first: Path, second: Path) -> None:
        """Count one frame."""
        worse, different = [], False
        with np.load(first) as one, np.load(second) as other:
            for name in dict.fromkeys([*one, *other]):
                if name not in one or name not in other:
                    worse.append(f"{name}: only in the {'first' if name in one else 'second'} folder")
                    continue
                a, b = one[name], other[name]
                if (a.shape, a.dtype) != (b.shape, b.dtype):
                    worse.append(f"{name}: {a.shape} {a.dtype} and {b.shape} {b.dtype}")
                    continue
                worse += self.tallies.setdefault(name, Tally()).add(name, a, b)
                different |= a.tobytes() != b.tobytes()
        self.frames += 1
        self.different_frames += different or bool(worse)
        if worse:
            self.worse[frame] = worse

    def show(self) -> None:
        """Print the counts as a table, and each frame that exceeds the limits."""
        print(f"frames that differ: {self.different_frames} of {self.frames}\n")
        print("| array | frames that differ | pixels that differ | largest difference | pixels beyond |")
        print("| --- | --- | --- | --- | --- |")
        for name, tally in self.tallies.items():
            print(tally.row(name))
        print(f"\nframes beyond the limits of the tests: {len(self.worse)}")
        for name, words in self.worse.items():
            print(f"BEYOND: {name}: {'; '.join(words)}")


def difference(first: Path, second: Path) -> int:
    """Compare two folders of arrays; the exit status is 1 if frames exceed the limits or are in one only."""
    one, other = ({path.name: path for path in sorted(folder.glob("*.npz"))} for folder in (first, second))
    found = Differences()
    for name in dict.fromkeys([*one, *other]):
        if name in one and name in other:
            found.add(Path(name).stem, one[name], other[name])
        else:
            found.worse[Path(name).stem] = [f"only in the {'first' if name in one else 'second'} folder"]
    found.show()
    return 1 if found.worse or not found.frames else 0
