"""Closed-form scenes of sick vessels as a CT would show them, independent of `lumencut.phantom`.

A tube along a sine curve, with a wall, and if wanted a round or eccentric stenosis, calcium, a stent,
thrombus, a flap, and a neighbour. Its fine samples are blurred and averaged over voxels; noise as of a ramp
filter is added.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from calibration_scenes import AIR, Floats, gaussian
from lumencut import Vessel, Volume

SIGMA_PER_FWHM = 1 / np.sqrt(8 * np.log(2))
STRUT, CORTEX, OLD_THROMBUS, RIM = 3000.0, 1100.0, 35.0, 50.0
#: Rows of fine samples that are painted at once.
ROWS = 24


@dataclass(frozen=True)
class SickScene:
    """A vessel with a disease; lengths in mm, levels in HU. The vessel runs along z before it is tilted."""

    diameter: float
    length: float = 40.0
    spacing: tuple[float, float, float] = (0.6, 0.6, 0.6)
    #: Amplitude of the winding, relative to 1.2 diameters.
    winding: float = 0.0
    #: Ratio of the axes of the lumen.
    aspect: float = 1.0
    #: Share of the diameter that the stenosis takes, half its length, and 0 (round) to 1 (eccentric).
    narrowed: float = 0.0
    narrowed_length: float = 3.0
    eccentric: float = 0.0
    wall: float = 0.5
    wall_level: float = 50.0
    lumen: float = 350.0
    around: float = -95.0
    #: Half the angle of the calcium opposite the lumen (rad).
    calcium: float = 0.0
    calcium_level: float = 800.0
    #: Radius of the struts.
    strut: float = 0.0
    #: Outer radius of the thrombus.
    thrombus: float = 0.0
    flap: float = 0.0
    #: "vein" or "bone" at this distance from the wall, and the level of the vein or of the marrow.
    neighbor: str = ""
    gap: float = 0.0
    neighbor_level: float = 220.0
    neighbor_diameter: float = 6.0
    fwhm: tuple[float, float, float] = (1.0, 1.0, 1.0)
    #: Strength of the edge enhancement of the kernel.
    sharp: float = 0.0
    noise: float = 20.0
    tilt: tuple[float, float] = (0.0, 0.0)
    seed: int = 0

    @property
    def middle(self) -> float:
        """The parameter of the curve where the disease is."""
        return self.length / 2

    def radius_at(self, t: Floats) -> Floats:
        """Return the radius of a disc with the area of the lumen."""
        away = ((t - self.middle) / self.narrowed_length) ** 4
        return self.diameter / 2 * (1 - self.narrowed * np.exp(-away))

    def curve(self, t: Floats) -> tuple[Floats, Floats]:
        """Return points of the middle of the vessel and derivatives, shape (..., 3)."""
        size = self.winding * np.clip(1.2 * self.diameter, 2.0, 5.0)
        p, q = 2 * np.pi / max(20.0, 5 * self.diameter), 2 * np.pi / max(26.0, 6 * self.diameter)
        point = np.stack([size * np.sin(p * t), 0.8 * size * np.sin(q * t), t], axis=-1)
        slope = np.stack([size * p * np.cos(p * t), 0.8 * size * q * np.cos(q * t), 1 + 0 * t], axis=-1)
        return point, slope

    def rotation(self) -> Floats:
        """Return the rotation from world space to the space of the curve."""
        (a, b), one, zero = self.tilt, 1.0, 0.0
        about_x = np.array([[one, zero, zero], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
        about_y = np.array([[np.cos(b), 0, np.sin(b)], [zero, one, zero], [-np.sin(b), 0, np.cos(b)]])
        return (about_x @ about_y).T

    def line(self) -> tuple[Vessel, Floats]:
        """Return the line through the middle of the lumen, and the true diameter at each of its points."""
        t = np.arange(3.0, self.length - 3.0, 0.1)
        point, slope = self.curve(t)
        radius = self.radius_at(t)
        point = point + _across(slope)[0] * (self.eccentric * (self.diameter / 2 - radius))[:, None]
        centered = point - self.curve(np.array(self.middle))[0]
        return Vessel(centered @ self.rotation()), 2 * radius

    def volume(self) -> Volume:
        """Return the scan."""
        draw = np.random.default_rng(self.seed)
        spacing = np.array(self.spacing)
        finest = 0.17 if self.diameter < 4 else 0.25 if self.diameter < 12 else 0.4
        parts = np.maximum(2, np.round(spacing / finest)).astype(int)
        corners = self.line()[0].points
        margin = 6.0 + max(self.diameter / 2, self.thrombus) + self.wall
        margin += self.gap + self.neighbor_diameter if self.neighbor == "vein" else 0.0
        low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin
        # At the ends of the line the vessel leaves the scan, as long as it runs along z.
        low[2], high[2] = low[2] + margin - 2, high[2] - margin + 2
        size = np.ceil((high - low) / spacing).astype(int)
        origin = low + draw.uniform(0, 1, 3) * spacing
        values = self._painted(origin, spacing / parts, size * parts)
        values = self._blurred(values, spacing / parts)
        k, j, i = size[::-1]
        means = values.reshape(k, parts[2], j, parts[1], i, parts[0]).mean(axis=(1, 3, 5))
        means += self.noise * _ramp_noise(means.shape, self.spacing, draw)
        affine = np.diag([*spacing, 1.0])
        affine[:3, 3] = origin + spacing / 2
        means = np.clip(np.round(means), -1024, 3071).astype(np.int16)
        # Air in a corner, as in every scan.
        means[:2, :2, :2] = AIR
        return Volume(means, world_from_index=affine)

    def _painted(self, origin: Floats, step: Floats, count: npt.NDArray[np.int64]) -> npt.NDArray[np.float32]:
        x, y, z = (origin[n] + (np.arange(count[n]) + 0.5) * step[n] for n in range(3))
        values = np.empty((len(z), len(y), len(x)), np.float32)
        middle = self.curve(np.array(self.middle))[0]
        for first in range(0, len(z), ROWS):
            deep, high, wide = np.meshgrid(z[first : first + ROWS], y, x, indexing="ij")
            world = np.stack([wide, high, deep], axis=-1)
            values[first : first + ROWS] = self._level(world @ self.rotation().T + middle)
        return values

    def _level(self, point: Floats) -> Floats:
        """Return the level at points in the space of the curve."""
        t = _nearest(self, point)
        middle, slope = self.curve(t)
        first, second = _across(slope)
        away = point - middle
        u, v = (away * first).sum(axis=-1), (away * second).sum(axis=-1)
        whole, radius = self.diameter / 2, self.radius_at(t)
        shift = self.eccentric * (whole - radius)
        long, short = self.aspect**0.5, self.aspect**-0.5
        out = np.hypot(u, v)
        in_lumen = np.hypot((u - shift) / (radius * long), v / (radius * short)) < 1
        in_wall = np.hypot(u / (whole * long + self.wall), v / (whole * short + self.wall)) < 1
        level = np.full(t.shape, self.around)
        if self.thrombus > 0:
            level[out < self.thrombus + 1.2] = RIM
            level[out < self.thrombus] = OLD_THROMBUS
        self._paint_neighbor(level, u, v)
        level[in_wall] = self.wall_level
        is_near = np.abs(t - self.middle) < 1.6 * self.narrowed_length
        if self.calcium > 0:
            is_block = np.abs(np.arctan2(v, -(u - shift))) < self.calcium
            level[in_wall & ~in_lumen & is_near & is_block] = self.calcium_level
        level[in_lumen] = self.lumen
        if self.flap > 0:
            level[in_lumen & (np.abs(u - 0.15 * whole) < self.flap / 2)] = self.wall_level
        if self.strut > 0:
            turn = (t - self.middle) / 2.4 - 0.25 * np.sin(6 * np.arctan2(v, u))
            along = 2.4 * np.abs(turn - np.round(turn))
            is_strut = np.hypot(out - whole - 0.05, along) < self.strut
            level[is_strut & (np.abs(t - self.middle) < 10)] = STRUT
        return level

    def _paint_neighbor(self, level: Floats, u: Floats, v: Floats) -> None:
        edge = -(self.diameter / 2 + self.wall + self.gap)
        if self.neighbor == "vein":
            half = self.neighbor_diameter / 2
            level[np.hypot(u - edge + half, v) < half] = self.neighbor_level
        elif self.neighbor == "bone":
            level[u < edge] = CORTEX
            level[u < edge - 1.2] = self.neighbor_level

    def _blurred(self, values: npt.NDArray[np.float32], step: Floats) -> Floats:
        sigma = (np.array(self.fwhm) * SIGMA_PER_FWHM / step)[::-1]
        blurred = gaussian(values, sigma)
        if self.sharp > 0:
            blurred = (1 + self.sharp) * blurred - self.sharp * gaussian(values, 1.8 * sigma)
        return blurred


def _nearest(scene: SickScene, point: Floats) -> Floats:
    """Return the parameter of the nearest point of the curve, by Newton's method from the same height."""
    t = point[..., 2].copy()
    if scene.winding == 0.0:
        return t
    for _ in range(4):
        middle, slope = scene.curve(t)
        t += ((point - middle) * slope).sum(axis=-1) / (slope**2).sum(axis=-1)
    return t


def _across(slope: Floats) -> tuple[Floats, Floats]:
    """Return two unit vectors across the curve; the first one is close to x."""
    along = slope / np.linalg.norm(slope, axis=-1, keepdims=True)
    first = np.array([1.0, 0.0, 0.0]) - along * along[..., :1]
    first = first / np.linalg.norm(first, axis=-1, keepdims=True)
    return first, np.cross(along, first)


def _ramp_noise(
    shape: tuple[int, ...], spacing: tuple[float, float, float], draw: np.random.Generator
) -> Floats:
    """Return noise of variance 1 with the spectrum of filtered back projection: a ramp in the slice."""
    deep = np.fft.fftfreq(shape[0], spacing[2])[:, None, None]
    high = np.fft.fftfreq(shape[1], spacing[1])[None, :, None]
    wide = np.fft.rfftfreq(shape[2], spacing[0])[None, None]
    square = high**2 + wide**2
    gain = np.sqrt(np.sqrt(square) * np.exp(-square / 0.55**2) + 0.02) * np.exp(-((0.6 * deep) ** 2))
    noise = np.fft.irfftn(np.fft.rfftn(draw.normal(size=shape)) * gain, s=shape, axes=(0, 1, 2))
    return noise / noise.std()
