"""Arteries with walls and tissue as in scans, drawn from the distributions that measuring assumes.

A scene is a vessel of known lumen, with a wall, varying surroundings, point spread, voxels,
and noise that is correlated as by a reconstruction kernel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut import Vessel, VesselTree, Volume
from measure_scenes import means_of_parts

Floats = npt.NDArray[np.float64]

FAT, MUSCLE, AIR = -90.0, 55.0, -1000.0


@dataclass(frozen=True)
class Scene:
    """A vessel along z, or along a bend in the plane of x and z."""

    diameter: float
    wall: float = 45.0
    #: None: the usual thickness for arteries of this diameter.
    thickness: float | None = None
    lumen: float = 350.0
    #: Levels of the surroundings, evenly distributed over all directions.
    around: tuple[float, ...] = (FAT,)
    #: The standard deviation of patches of about 2 mm in the surroundings.
    patches: float = 0.0
    fwhm: float = 0.9
    spacing: tuple[float, float, float] = (0.5, 0.5, 0.5)
    noise: float = 20.0
    #: Standard deviation of the kernel that correlates the noise (voxels); below 0, a sharp kernel.
    kernel: float = 0.7
    stretch: float = 1.0
    bend: float = 0.0
    stenosis: float = 0.0
    stenosis_length: float = 12.0
    length: float = 24.0
    seed: int = 0

    @property
    def wall_thickness(self) -> float:
        """The thickness of the wall (mm)."""
        return 0.45 * self.diameter**0.5 if self.thickness is None else self.thickness

    def diameter_at(self, along: Floats) -> Floats:
        """The true diameter at arc lengths from the middle (mm)."""
        away = np.minimum(np.abs(along) / (self.stenosis_length / 2), 1)
        return self.diameter * (1 - self.stenosis / 100 * (0.5 + 0.5 * np.cos(np.pi * away)))

    def vessel(self) -> Vessel:
        """Its centerline."""
        t = np.linspace(-self.length / 2, self.length / 2, int(self.length / 0.5) + 1)
        if self.bend == 0.0:
            return Vessel(np.stack([0 * t, 0 * t, t], axis=1))
        angle = t / self.bend
        x, z = self.bend * (np.cos(angle) - 1), self.bend * np.sin(angle)
        return Vessel(np.stack([x, 0 * t, z], axis=1))

    def volume(self) -> Volume:
        """The scan."""
        spacing = np.array(self.spacing)
        reach = self.diameter / 2 * self.stretch + self.wall_thickness + 6.0
        sag = 0.0 if self.bend == 0.0 else self.bend * (1 - np.cos(self.length / 2 / self.bend))
        extent = np.array([2 * (reach + sag), 2 * reach, self.length + 2.0])
        size = np.ceil(extent / spacing).astype(int)
        parts = np.ceil(spacing / 0.2).astype(int)
        draw = np.random.default_rng(self.seed)
        shift = draw.uniform(-0.5, 0.5, 3) * spacing
        axes = [
            ((np.arange(n * p) + 0.5) / p - n / 2) * s + o
            for n, p, s, o in zip(size, parts, spacing, shift, strict=True)
        ]
        # What is the same along z is computed once.
        is_even = not (self.bend or self.stenosis or self.patches)
        along = axes[2][:1] if is_even else axes[2]
        z, y, x = np.meshgrid(along, axes[1], axes[0], indexing="ij", sparse=True)
        values = self._sharp(x, y, z, draw)
        values = np.array(np.broadcast_to(values, tuple(map(len, axes[::-1]))))
        # Air in a corner, as in every scan; so the values are recognised as CT.
        values[: 2 * parts[2], : parts[1], : parts[0]] = AIR
        sigma = self.fwhm / np.sqrt(8 * np.log(2)) / (spacing / parts)
        # Along z first: the means of voxels leave fewer values to blur along the other axes.
        means = means_of_parts(values, 0, sigma[2], parts[2])
        means = means_of_parts(means, 1, sigma[1], parts[1])
        means = means_of_parts(means, 2, sigma[0], parts[0])
        means += self.noise * correlated(draw, means.shape, self.kernel)
        affine = np.diag([*spacing, 1.0])
        affine[:3, 3] = -(size - 1) / 2 * spacing + shift
        return Volume(np.round(means).astype(np.int16), world_from_index=affine)

    def _sharp(self, x: Floats, y: Floats, z: Floats, draw: np.random.Generator) -> Floats:
        if self.bend == 0.0:
            along, across = z, x
        else:
            along = self.bend * np.arctan2(z, x + self.bend)
            across = np.hypot(x + self.bend, z) - self.bend
        radius = self.diameter_at(along) / 2
        root = np.sqrt(self.stretch)
        # The distance from the boundary of the ellipse, to first order.
        a, b = radius * root, radius / root
        norm = np.hypot(across / a, y / b)
        slope = np.hypot(across / a**2, y / b**2) / np.maximum(norm, 1e-9)
        away = (norm - 1) / np.maximum(slope, 1e-9)
        turn = np.arctan2(y, across) / (2 * np.pi) % 1.0
        first = draw.uniform()
        sector = ((turn + first) * len(self.around)).astype(int) % len(self.around)
        surroundings = np.asarray(self.around)[sector] + 0 * away
        if self.patches > 0.0:
            coarse = gaussian(draw.normal(size=away.shape), np.full(3, 5.0))
            surroundings = surroundings + self.patches * coarse / coarse.std()
        edge = 0.1
        inside = np.clip(0.5 - away / edge, 0, 1)
        enclosed = np.clip(0.5 - (away - self.wall_thickness) / edge, 0, 1)
        return self.lumen * inside + self.wall * (enclosed - inside) + surroundings * (1 - enclosed)


def gaussian(values: Floats, sigma: Floats) -> Floats:
    """Values blurred by a Gaussian of these standard deviations along each axis (samples)."""
    for axis, width in enumerate(sigma):
        margin = int(np.ceil(4 * width))
        bell = np.exp(-0.5 * (np.arange(-margin, margin + 1) / width) ** 2)
        padded = np.pad(
            values, [(margin, margin) if a == axis else (0, 0) for a in range(values.ndim)], "edge"
        )
        count = padded.shape[axis]
        spectrum = np.fft.rfft(padded, axis=axis)
        kernel = np.zeros(count)
        kernel[: 2 * margin + 1] = bell / bell.sum()
        shape = [-1 if a == axis else 1 for a in range(values.ndim)]
        smooth = np.fft.irfft(
            spectrum * np.fft.rfft(np.roll(kernel, -margin)).reshape(shape), count, axis=axis
        )
        values = np.take(smooth, np.arange(margin, count - margin), axis=axis)
    return values


def correlated(draw: np.random.Generator, shape: tuple[int, ...], kernel: float) -> Floats:
    """Noise of variance 1: white, smooth, or (below 0) with weak low frequencies."""
    white = draw.normal(size=shape)
    if kernel == 0.0:
        return white
    frequencies = np.meshgrid(*[np.fft.fftfreq(n) for n in shape], indexing="ij")
    square = sum(f**2 for f in frequencies)
    gain = np.exp(-2 * np.pi**2 * kernel**2 * square)
    if kernel < 0.0:
        in_plane = frequencies[1] ** 2 + frequencies[2] ** 2
        gain = gain * np.sqrt(np.sqrt(in_plane) + 0.02)
    noise = np.fft.ifftn(np.fft.fftn(white) * gain).real
    return noise / noise.std()


def tree_of(scenes: Sequence[Scene]) -> tuple[Volume, VesselTree]:
    """Straight vessels side by side in one scan, on the voxels of the first, and their tree."""
    spacing = np.array(scenes[0].spacing)
    scans = [scene.volume() for scene in scenes]
    deep, high = (max(scan.shape[axis] for scan in scans) for axis in (0, 1))
    values = np.full((deep, high, sum(scan.shape[2] for scan in scans)), FAT, np.int16)
    vessels, first = [], 0
    for scene, scan in zip(scenes, scans, strict=True):
        k, j, i = scan.shape
        values[:k, :j, first : first + i] = scan.array
        index = (scene.vessel().points - scan.world_from_index[:3, 3]) / spacing
        vessels.append(Vessel((index + np.array([first, 0, 0])) * spacing))
        first += i
    return Volume(values, world_from_index=np.diag([*spacing, 1.0])), VesselTree(vessels)
