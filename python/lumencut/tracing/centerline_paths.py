"""Paths through a vessel tree between two of its points."""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from lumencut.scene.vessel import Vessel

#: Points closer than this are merged (mm).
_SAME = 1e-3

#: Largest distance of neighbouring points after splitting segments (mm).
_STEP = 0.5

#: Distance between the samples of a line that decide to which connected piece the line belongs (mm).
_VOTES = 1.0

#: A path shorter than this share of the line may follow the wrong side of a cycle.
_AS_LONG = 0.8

_Points = npt.NDArray[np.float64]


class CenterlinePaths:
    """The points of vessels as a graph: neighbours along a vessel are joined, coincident points are merged.

    Parameters
    ----------
    vessels : sequence of Vessel
        At least one vessel (mm, LPS).
    """

    def __init__(self, vessels: Sequence[Vessel]) -> None:
        lines = [_parted(vessel.points, _STEP) for vessel in vessels]
        every = np.concatenate(lines)
        _, first, node = np.unique(
            np.round(every / _SAME).astype(np.int64), axis=0, return_index=True, return_inverse=True
        )
        self._points = every[first]
        self._neighbours: list[list[tuple[int, float]]] = [[] for _ in first]
        nodes = np.split(node.reshape(-1), np.cumsum([len(line) for line in lines])[:-1])
        for line in nodes:
            for a, b in zip(line[:-1].tolist(), line[1:].tolist(), strict=True):
                length = float(np.linalg.norm(self._points[a] - self._points[b]))
                self._neighbours[a].append((b, length))
                self._neighbours[b].append((a, length))
        self._piece = self._pieces()

    def along(self, line: _Points) -> _Points | None:
        """Return the shortest path from the point nearest to a line's start to the one nearest to its end.

        Both points belong to the connected piece that is nearest to most of the line. A path shorter than
        four fifths of the line may follow the wrong side of a cycle. Then a path through the points nearest
        to both thirds of the line replaces it if the length of that path fits better.

        Parameters
        ----------
        line : ndarray of shape (n, 3)
            Points of the line (mm, LPS).

        Returns
        -------
        ndarray of shape (m, 3) or None
            The points of the path; None if start and end are the same point.
        """
        votes = [self._piece[self._nearest(point, None)] for point in _parted(line, _VOTES)]
        piece = int(np.bincount(votes).argmax())
        parts = _parted(line, _VOTES)
        places = [line[0], parts[len(parts) // 3], parts[2 * len(parts) // 3], line[-1]]
        stops = [self._nearest(place, piece) for place in places]
        wanted = _length(line)
        way = self._points[self._through(stops[::3])]
        if _length(way) < _AS_LONG * wanted:
            longer = self._points[self._through(stops)]
            way = min(way, longer, key=lambda way: abs(_length(way) - wanted))
        return way if len(way) > 1 else None

    def _through(self, stops: Sequence[int]) -> list[int]:
        """Return the shortest path through these points in their order."""
        ways = (self._shortest(start, end)[1:] for start, end in itertools.pairwise(stops))
        return [stops[0], *itertools.chain.from_iterable(ways)]

    def _nearest(self, point: _Points, piece: int | None) -> int:
        distance = np.linalg.norm(self._points - point, axis=1)
        if piece is not None:
            distance[self._piece != piece] = np.inf
        return int(distance.argmin())

    def _pieces(self) -> npt.NDArray[np.int64]:
        """Number the connected parts of the graph, from 0."""
        piece = np.full(len(self._points), -1, dtype=np.int64)
        count = 0
        for start in range(len(piece)):
            if piece[start] >= 0:
                continue
            waiting = [start]
            piece[start] = count
            while waiting:
                for node, _ in self._neighbours[waiting.pop()]:
                    if piece[node] < 0:
                        piece[node] = count
                        waiting.append(node)
            count += 1
        return piece

    def _shortest(self, start: int, end: int) -> list[int]:
        """Dijkstra's search between two points of one piece."""
        before: dict[int, int] = {}
        best = {start: 0.0}
        waiting = [(0.0, start)]
        while waiting:
            way, node = heapq.heappop(waiting)
            if node == end:
                break
            if way > best[node]:
                continue
            for other, length in self._neighbours[node]:
                if way + length < best.get(other, np.inf):
                    best[other] = way + length
                    before[other] = node
                    heapq.heappush(waiting, (way + length, other))
        path = [end]
        while path[-1] != start:
            path.append(before[path[-1]])
        return path[::-1]


def _parted(points: _Points, step: float) -> _Points:
    """Return the points, with more points on segments longer than ``step``."""
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    counts = np.maximum(1, np.ceil(lengths / step)).astype(int)
    parts = [
        a + (b - a) * (np.arange(count)[:, None] / count)
        for a, b, count in zip(points[:-1], points[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, points[-1:]])


def _length(points: _Points) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
