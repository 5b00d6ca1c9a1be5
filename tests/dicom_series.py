"""DICOM series of known truth, and what a reader must make of each."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from pydicom.dataset import Dataset

from dicom_codecs import Encoder
from dicom_phantom import PLAIN, SIZE, Affine, Array, Image, Stored, axial, corner, images, save, single

Change = Callable[[int, Dataset], None]
COUNT = SIZE[2]
PLAIN_STACK = images(axial())
LATE_STACK = images(axial(), contrast=120.0)


@dataclass(frozen=True)
class Made:
    """The files of a case, and the truth about them.

    Attributes
    ----------
    path : Path
        The folder or file to read.
    images : list of Image
        All images that state a position, of every stack.
    wanted : str, optional
        The stack that forms the volume; None if no volume can be formed.
    distance : float, optional
        The slice distance (mm) of the regular grid on which uneven slices are resampled.
    """

    path: Path
    images: list[Image]
    wanted: str | None = "only"
    distance: float | None = None

    @property
    def truth(self) -> tuple[Affine, Array]:
        """The affine (LPS) and the voxels [k, j, i] of the volume, slices along their normal."""
        stack = [one for one in self.images if one.part == self.wanted]
        normal = np.cross(stack[0].plane[:3, 0], stack[0].plane[:3, 1])
        stack.sort(key=lambda one: float(one.plane[:3, 3] @ normal))
        affine, voxels = stack[0].plane.copy(), np.stack([one.values for one in stack])
        heights = np.array([np.linalg.norm(one.plane[:3, 3] - affine[:3, 3]) for one in stack])
        last = len(stack) - 1 if self.distance is None else round(heights[-1] / self.distance)
        affine[:3, 2] = (stack[-1].plane[:3, 3] - affine[:3, 3]) / last
        return affine, voxels if self.distance is None else on_grid(voxels, heights, last)


def on_grid(voxels: Array, heights: Array, last: int) -> Array:
    """Slices at these heights (mm) on a regular grid, linearly between neighbours."""
    wanted = np.linspace(heights[0], heights[-1], last + 1)
    above = np.searchsorted(heights, wanted).clip(1, len(heights) - 1)
    share = (wanted - heights[above - 1]) / (heights[above] - heights[above - 1])
    share = share[:, None, None]
    return np.rint((1 - share) * voxels[above - 1] + share * voxels[above]).astype(np.int32)


@dataclass(frozen=True)
class Case:
    """A situation that readers of DICOM meet.

    Attributes
    ----------
    name : str
        Its description.
    group : str
        The row of the table in which it is counted.
    write : callable
        Writes the files into an empty folder.
    words : tuple of str
        Words that the error must contain; empty if the volume must be read.
    notes : tuple of str
        Words that a note must contain.
    loss : float
        Largest allowed error of a value, if the compression is lossy.
    series : str, optional
        The requested series.
    phase : str, optional
        The requested phase.
    resample_slices : bool
        Whether slices of uneven distances shall be resampled to a regular grid.
    needs : str
        A package that only this case needs.
    """

    name: str
    group: str
    write: Callable[[Path], Made]
    words: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    loss: float = 0.0
    series: str | None = None
    phase: str | None = None
    resample_slices: bool = False
    needs: str = ""


@dataclass(frozen=True)
class Stack:
    """One series of single-frame files; calling it writes them."""

    images: Sequence[Image]
    stored: Stored | Callable[[int], Stored] = PLAIN
    change: Change = field(default=lambda k, data: None)
    name: Callable[[int], str] = field(default=lambda k: f"IM{k + 1:04}.dcm")
    number: Callable[[int], int] = field(default=lambda k: k + 1)
    encoder: Encoder | None = None
    series: int = 3
    description: str = "made for a test"
    thickness: float = 2.0
    wanted: str | None = "only"

    def __call__(self, folder: Path) -> Made:
        for k, image in enumerate(self.images):
            stored = self.stored(k) if callable(self.stored) else self.stored
            data = single(image, self.number(k), self.series, stored, self.thickness)
            data.SeriesDescription = self.description
            self.change(k, data)
            path = save(data, folder / self.name(k))
            if self.encoder:
                self.encoder(path)
        return Made(folder, list(self.images), self.wanted)


def quantised(stack: Sequence[Image], scale: Callable[[int], Stored]) -> list[Image]:
    """Return the images with their values as they are after being stored."""
    scales = [scale(k) for k in range(len(stack))]
    return [
        replace(one, values=s.numbers(one.values) * s.slope + s.intercept)
        for one, s in zip(stack, scales, strict=True)
    ]


def sets(**values: object) -> Change:
    """Return a change that gives every image the same attributes; None removes an attribute."""

    def change(k: int, data: Dataset) -> None:
        for keyword, value in values.items():
            if value is None:
                delattr(data, keyword)
            else:
                setattr(data, keyword, value)

    return change


def shuffled(count: int) -> list[int]:
    """Return an order that neither rises nor falls."""
    return [int(k) for k in np.random.default_rng(3).permutation(count)]


def two_phases(
    stack: Sequence[Image], late: Sequence[Image], change: Callable[[int, Dataset], None]
) -> Stack:
    """Put two phases into one series, one after the other; `change` gets the number of the phase (1 or 2)."""
    both = [replace(one, part="early") for one in stack] + [replace(one, part="late") for one in late]
    return Stack(both, change=lambda k, data: change(1 + (k >= len(stack)), data), wanted=None)


def trigger(phase: int, data: Dataset) -> None:
    """Phases of the heart."""
    data.TriggerTime, data.TemporalPositionIdentifier = str(400 * (phase - 1)), phase
    data.NumberOfTemporalPositions = 2


def acquisition(phase: int, data: Dataset) -> None:
    """Write phases of contrast that only the acquisition number distinguishes."""
    data.AcquisitionNumber = phase
    data.AcquisitionTime = data.ContentTime = f"1200{30 * (phase - 1):02}"


def kernel(phase: int, data: Dataset) -> None:
    """Two reconstructions of one scan."""
    data.ConvolutionKernel = ("Br36", "Bv49")[phase - 1]


def doubled(stack: Sequence[Image]) -> Callable[[Path], Made]:
    """A stack with exact copies of three of its files."""

    def write(folder: Path) -> Made:
        made = Stack(stack)(folder)
        for k in (5, 6, 17):
            shutil.copy(folder / f"IM{k:04}.dcm", folder / f"COPY{k:04}.dcm")
        return made

    return write


def truncated(stack: Sequence[Image]) -> Callable[[Path], Made]:
    """Write a stack whose last file is cut off."""

    def write(folder: Path) -> Made:
        made = Stack(stack)(folder)
        last = folder / f"IM{len(stack):04}.dcm"
        last.write_bytes(last.read_bytes()[:-2000])
        return replace(made, wanted=None)

    return write


def resampled(stack: Sequence[Image], distance: float) -> Callable[[Path], Made]:
    """Write a stack of uneven distances that must be resampled to this slice distance (mm)."""
    return lambda folder: replace(Stack(stack)(folder), distance=distance)


def zipped(stack: Sequence[Image]) -> Callable[[Path], Made]:
    """A stack in a folder in a ZIP file."""

    def write(folder: Path) -> Made:
        inside = folder / "unpacked" / "CT" / "SE3"
        inside.mkdir(parents=True)
        made = Stack(stack)(inside)
        archive = shutil.make_archive(str(folder / "series"), "zip", folder / "unpacked")
        shutil.rmtree(folder / "unpacked")
        return replace(made, path=Path(archive))

    return write


def localiser(series: int, first: int = 1, same_series: bool = False) -> Callable[[Path], list[Image]]:
    """Write two projections, lateral and frontal, each with its own size and spacing."""

    def write(folder: Path) -> list[Image]:
        scouts = []
        for number, axis in enumerate((1, 0), start=first):
            plane = np.eye(4)
            plane[:3, 0], plane[:3, 1] = np.roll([1.5, 0, 0], 1 - axis), (0, 0, -1.5)
            plane[:3, 3] = (-20, -60, 200)
            image = images(plane, (50, 70, 1), part="localiser")[0]
            data = single(image, number, series, thickness=60)
            data.ImageType = ["ORIGINAL", "PRIMARY", "LOCALIZER"]
            data.SeriesDescription = "made for a test" if same_series else "Topogram"
            data.ImagePositionPatient = corner(plane)
            save(data, folder / f"SC{number:04}.dcm")
            scouts.append(image)
        return scouts

    return write


def together(*writers: Callable[[Path], Made | list[Image]], wanted: str | None) -> Callable[[Path], Made]:
    """Let several functions write into one folder."""

    def write(folder: Path) -> Made:
        found: list[Image] = []
        for writer in writers:
            made = writer(folder)
            found += made.images if isinstance(made, Made) else made
        return Made(folder, found, wanted)

    return write
