"""Vessels from formulas among bone, veins and stents, with seeded noise, for tests of tracing."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from lumencut import Volume

Floats = npt.NDArray[np.float64]

FAT, TISSUE, LUMEN, BONE, STENT = -100.0, 50.0, 350.0, 1150.0, 1600.0


@dataclass
class Scene:
    """A volume that is painted step by step, and the true centerline of its vessel."""

    size: tuple[int, int, int]
    spacing: tuple[float, float, float]
    values: Floats = field(init=False)
    shear: float = 0.0

    def __post_init__(self) -> None:
        self.values = np.full(self.size[::-1], TISSUE)
        self.affine = np.eye(4)
        self.affine[:3, :3] = np.diag(self.spacing)
        self.affine[1, 2] = self.shear * self.spacing[2]
        self.affine[:3, 3] = -self.affine[:3, :3] @ (np.asarray(self.size) - 1) / 2

    def distance(self, line: Floats, radius: Floats) -> tuple[Floats, Floats]:
        """Return the signed distance of voxels from a tube's surface (mm), and the nearest line point."""
        inverse = np.linalg.inv(self.affine)
        found = np.full(self.size[::-1], 1e3)
        nearest = np.zeros(self.size[::-1])
        margin = 3 * max(self.spacing)
        for n, (point, r) in enumerate(zip(line, radius, strict=True)):
            index = inverse[:3, :3] @ point + inverse[:3, 3]
            reach = np.linalg.norm(inverse[:3, :3], axis=1) * (r + margin)
            low = np.maximum(np.floor(index - reach), 0).astype(int)
            high = np.minimum(np.ceil(index + reach) + 1, self.size).astype(int)
            if (high <= low).any():
                continue
            box = tuple(slice(low[a], high[a]) for a in (2, 1, 0))
            axes = [np.arange(low[a], high[a]) - index[a] for a in range(3)]
            k, j, i = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij", sparse=True)
            m = self.affine[:3, :3]
            square = sum((m[a, 0] * i + m[a, 1] * j + m[a, 2] * k) ** 2 for a in range(3))
            here = np.sqrt(square) - r
            closer = here < found[box]
            found[box] = np.where(closer, here, found[box])
            nearest[box] = np.where(closer, n, nearest[box])
        return found, nearest

    def paint(self, line: Floats, radius: Floats | float, value: Floats | float) -> None:
        """Paint a tube whose edge is a ramp one voxel wide, centred on the surface."""
        radius = np.broadcast_to(np.asarray(radius, dtype=float), len(line))
        distance, nearest = self.distance(line, radius)
        if np.ndim(value):
            value = np.asarray(value)[nearest.astype(int)]
        share = np.clip(0.5 - distance / max(self.spacing), 0, 1)
        # A lumen thinner than a voxel fills only a part of it.
        thin = np.minimum(1, radius / (0.5 * max(self.spacing))) ** 2
        share = share * thin[nearest.astype(int)]
        self.values += share * (value - self.values)

    def shell(self, line: Floats, radius: float, thickness: float, value: float, every: float) -> None:
        """Paint the rings of a stent around a line, at equal distances (mm)."""
        distance, nearest = self.distance(line, np.full(len(line), radius))
        along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))][nearest.astype(int)]
        ring = (np.abs(distance) < thickness / 2) & (nearest > 0) & (nearest < len(line) - 1)
        self.values[ring & (along % every < every / 2)] = value

    def volume(self, seed: int, noise: float = 20.0) -> Volume:
        """Return the volume with noise, slightly blurred as by a scanner."""
        values = self.values
        for axis in range(3):
            ends = np.pad(values, [(1, 1) if a == axis else (0, 0) for a in range(3)], mode="edge")
            parts = [np.take(ends, np.arange(n, n + values.shape[axis]), axis) for n in range(3)]
            values = 0.2 * parts[0] + 0.6 * parts[1] + 0.2 * parts[2]
        values = values + np.random.default_rng(seed).normal(0, noise, values.shape)
        return Volume(np.round(values).astype(np.int16), world_from_index=self.affine)


def lengths(line: Floats) -> Floats:
    """The length from the first point to each (mm)."""
    return np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]


def arc(length: float, step: float = 0.2, bend: float = 60.0) -> Floats:
    """A line in all three directions, `length` mm long."""
    s = np.arange(0, 4 * length, step / 4)
    ahead = np.stack([0.6 * np.cos(s / bend), 0.5 * np.sin(s / (0.7 * bend)), np.full_like(s, 0.8)], axis=1)
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    line = np.cumsum(ahead * step / 4, axis=0)
    line = line[lengths(line) <= length][::4]
    return line - (line.min(axis=0) + line.max(axis=0)) / 2


def narrowed(line: Floats, radius: float, percent: float, at: float = 0.5, length: float = 12.0) -> Floats:
    """Radii of a vessel with a stenosis whose diameter is reduced by a percentage."""
    along = lengths(line)
    away = np.abs(along - at * along[-1]) / (length / 2)
    shape = np.where(away < 1, 0.5 + 0.5 * np.cos(np.pi * np.minimum(away, 1)), 0)
    return radius * (1 - percent / 100 * shape)


def away(points: Floats, line: Floats) -> Floats:
    """Return the distance of each point from a line (mm)."""
    found = np.full(len(points), np.inf)
    for a, b in itertools.pairwise(line):
        ab = b - a
        t = np.clip((points - a) @ ab / max(ab @ ab, 1e-12), 0, 1)
        found = np.minimum(found, np.linalg.norm(points - a - t[:, None] * ab, axis=1))
    return found


def room(line: Floats, spacing: float, margin: float = 12.0) -> tuple[int, int, int]:
    """The size of a volume of isotropic voxels around a line that is centred at the origin."""
    reach = np.abs(line).max(axis=0) + margin
    ni, nj, nk = (int(n) for n in np.ceil(2 * reach / spacing))
    return ni, nj, nk


def beside(line: Floats, distance: float, angle: float, first: float, last: float) -> Floats:
    """Return the part of a line from `first` to `last` (mm), moved sideways by a length (mm) at an angle."""
    ahead = np.gradient(line, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    u = np.cross(ahead, [0.3, 0.9, 0.1])
    u /= np.linalg.norm(u, axis=1)[:, None]
    moved = line + distance * (np.cos(angle) * u + np.sin(angle) * np.cross(ahead, u))
    along = lengths(line)
    return moved[(along >= first) & (along <= last)]


@dataclass(frozen=True)
class Case:
    """A scene with its true centerline, and clicks: the ends of the vessel and a point between them."""

    volume: Volume
    line: Floats
    radius: Floats
    clicks: Floats
    what: str


def random_case(seed: int) -> Case:
    """Return a vessel with random neighbouring structures; the seed decides all."""
    random = np.random.default_rng(seed)
    spacing = random.uniform(0.5, 0.8)
    line = _turned(arc(random.uniform(70, 110), bend=random.uniform(20, 80)), random)
    healthy = random.uniform(1.6, 4.0)
    percent = random.choice([0, 50, 70, 80])
    radius = narrowed(line, healthy, float(percent), random.uniform(0.3, 0.7), random.uniform(8, 16))
    scene = Scene(room(line, spacing, healthy + 9), (spacing,) * 3)
    scene.values[:] = random.choice([FAT, TISSUE])
    what = [f"{percent} % stenosis of {2 * healthy:.1f} mm"]
    end = lengths(line)[-1]
    angle, first = random.uniform(0, 2 * np.pi), random.uniform(10, end - 50)
    if random.random() < 0.4:
        scene.paint(beside(line, healthy + 6, angle, first, first + 30), 6.0, LUMEN + 800)
        what.append("bone")
    if random.random() < 0.4:
        other = angle + np.pi * random.uniform(0.7, 1.3)
        scene.paint(beside(line, healthy + 1 + 3.5, other, 5, end - 5), 3.5, LUMEN - random.uniform(0, 80))
        what.append("vein")
    scene.paint(line, radius, np.linspace(LUMEN, random.uniform(220, LUMEN), len(line)))
    if random.random() < 0.3:
        stented = (lengths(line) > first) & (lengths(line) < first + 25)
        scene.shell(line[stented], healthy, spacing, STENT, 3.0)
        what.append("stent")
    volume = scene.volume(seed, random.uniform(10, 30))
    middle = int(random.uniform(0.4, 0.6) * len(line))
    clicks = np.array([_off_middle(line, radius, n, random) for n in (8, middle, len(line) - 9)])
    return Case(volume, line, radius, clicks, ", ".join(what))


def _turned(line: Floats, random: np.random.Generator) -> Floats:
    """A line turned at random, in the middle of its box."""
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    turned: Floats = line @ axes
    return turned - (turned.min(axis=0) + turned.max(axis=0)) / 2


def _off_middle(line: Floats, radius: Floats, n: int, random: np.random.Generator) -> Floats:
    """A point of the lumen up to half a radius from its middle."""
    ahead = line[n + 1] - line[n - 1]
    across = np.cross(ahead, random.normal(size=3))
    moved: Floats = line[n] + across / np.linalg.norm(across) * random.uniform(0, 0.5) * radius[n]
    return moved


def leaks(points: Floats, case: Case) -> bool:
    """Return whether a traced line leaves the vessel, or does not follow it from end to end."""
    healthy = float(case.radius.max())
    inner = case.line[10:-10]
    return bool((away(points, case.line) > healthy).any() or (away(inner, points) > healthy).any())
