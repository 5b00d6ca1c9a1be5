"""Uneven distances between slices: named, or put on a regular grid where the caller asks for it.

The grid has the largest distance of which all distances are multiples, where that makes no more than four
times as many slices as there are: each slice then keeps its place. Otherwise it has the smallest distance, or
what makes four times as many slices.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut._wording import counted
from lumencut.errors import FormatError
from lumencut.volume_files.dicom.slices import Slice

_MILLIMETRE, _OF_STEP = 0.01, 0.01
_MOST_SLICES = 4
"""A grid has at most this many times as many slices as the series."""

_HOLE = 3.0
"""A distance more than this many times as long as those beside it is a hole."""

_RUN = 3
"""So many wide distances in a row are those of a part of the scan."""

_TOLD = 4
"""How many different distances are told one by one."""


def tolerance(step: float) -> float:
    """How far a slice may be off its place (mm)."""
    return max(_MILLIMETRE, _OF_STEP * step)


def has_run(steps: npt.NDArray[np.int64]) -> bool:
    """Tell whether wide steps of one length follow each other: a part scanned so, with nothing missing."""
    run = 1
    for before, after in itertools.pairwise(steps.tolist()):
        run = run + 1 if before == after > 1 else 1
        if run >= _RUN:
            return True
    return False


@dataclass(frozen=True)
class Uneven:
    """Slices at uneven distances, sorted along their normal."""

    subject: str
    ordered: Sequence[Slice]
    positions: npt.NDArray[np.float64]
    gaps: npt.NDArray[np.float64]

    def found(self) -> str:
        """What is odd, in words."""
        return f"uneven slices at mixed distances ({told(self.gaps)})"

    def refuse(self) -> FormatError:
        """The error for whoever did not ask for a grid."""
        self.require_line()
        holes = self._holes()
        mend = "resample_slices=True puts them on a regular grid"
        if holes:
            mend = f"add what is missing {holes}, or {mend} together with fill_gaps=True"
        return FormatError(self.subject, self.found(), "one distance between all slices", mend)

    def require_line(self) -> None:
        """Refuse slices that are shifted against each other: no distance along their normal mends that."""
        heights = self._heights()
        along = self.positions[0] + (heights / heights[-1])[:, None] * (
            self.positions[-1] - self.positions[0]
        )
        off = np.linalg.norm(self.positions - along, axis=1)
        allowed = tolerance(float(np.median(self.gaps)))
        if off.max() > allowed:
            odd = self.ordered[int(off.argmax())].name
            found = f"uneven slices: {odd} is {off.max():.3g} mm off the line of the others"
            raise FormatError(self.subject, found, f"slices on a straight line within {allowed:.3g} mm")

    def places(self, *, fill_gaps: bool) -> npt.NDArray[np.float64]:
        """The index of each slice on a regular grid, whole where it is measured there.

        Raises
        ------
        FormatError
            For slices beside a straight line, and for holes unless `fill_gaps` and the slices hold most of
            the stack.
        """
        self.require_line()
        if (holes := self._holes()) and not (
            fill_gaps and self.gaps[self._wide()].sum() < self.gaps.sum() / 2
        ):
            mend = "add the missing files" + ("" if fill_gaps else ", or have it filled with fill_gaps=True")
            found = f"{self.found()}, with a hole {holes}"
            raise FormatError(self.subject, found, "a series without holes", mend)
        return _common(self._heights(), self.gaps) if len(self.gaps) > 1 else np.arange(2.0)

    def note(self, places: npt.NDArray[np.float64]) -> str:
        """What became of the slices."""
        count, widest = int(places[-1]) + 1, int(self.gaps.argmax())
        kept = int((places % 1 == 0).sum())
        whole = f"all {kept}" if kept == len(places) else f"{kept} of {len(places)}"
        grid = f"{count} slices every {self.gaps.sum() / places[-1]:.4g} mm, linearly between neighbours"
        return (
            f"{self.found()}: resampled to {grid}; {whole} measured slices keep their values; "
            f"the largest gap is {self._gap(widest)}"
        )

    def _heights(self) -> npt.NDArray[np.float64]:
        return np.concatenate([[0.0], np.cumsum(self.gaps)])

    def _wide(self) -> list[int]:
        """The distances that are much longer than those beside them."""
        beside = np.concatenate([[0.0], self.gaps, [0.0]])
        return np.flatnonzero(self.gaps > _HOLE * np.maximum(beside[:-2], beside[2:])).tolist()

    def _holes(self) -> str:
        wide = self._wide() if len(self.gaps) > 1 else []
        more = f" and {counted(len(wide) - 1, 'more hole')}" if len(wide) > 1 else ""
        return f"of {self._gap(wide[0])}{more}" if wide else ""

    def _gap(self, n: int) -> str:
        return f"{self.gaps[n]:.4g} mm between {self.ordered[n].name} and {self.ordered[n + 1].name}"


def told(gaps: npt.NDArray[np.float64]) -> str:
    """Distances as words: each with its count where they are few, in the order in which they come."""
    allowed = tolerance(float(np.median(gaps)))
    groups: list[tuple[float, int]] = []
    for gap in gaps.tolist():
        n = next((n for n, (first, _) in enumerate(groups) if abs(gap - first) <= allowed), len(groups))
        groups[n : n + 1] = [(groups[n][0], groups[n][1] + 1) if n < len(groups) else (gap, 1)]
        if len(groups) > _TOLD:
            return f"{gaps.min():.4g} to {gaps.max():.4g} mm"
    return ", ".join(f"{count} of {gap:.4g} mm" for gap, count in groups)


def _common(heights: npt.NDArray[np.float64], gaps: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Indices on the grid that the module describes; the first and last slice are its ends."""
    total, most = float(heights[-1]), _MOST_SLICES * len(heights) - 1
    smallest = float(gaps.min())
    for parts in range(1, most + 1):
        steps = round(total * parts / smallest)
        if steps > most:
            break
        places = np.rint(heights / total * steps)
        off = np.abs(heights - places * total / steps)
        if off.max() <= tolerance(total / steps) and (np.diff(places) > 0).all():
            return places
    places = heights / total * min(most, int(np.ceil(total / smallest - 1e-6)))
    whole = np.rint(places)
    return np.where(np.abs(places - whole) < 1e-6, whole, places)
