"""Short description of a DICOM series, for lists and for errors."""

from __future__ import annotations

from dataclasses import dataclass

from lumencut.base.pickles import by_name


@by_name
@dataclass(frozen=True)
class SeriesReport:
    """One DICOM series of a folder.

    Attributes
    ----------
    number, uid, description, modality : str
        As the series states them; empty where it does not.
    images : int
        How many images (frames) it has.
    size : tuple of 3 int, or None
        Number of voxels along i, j, k; None where its images form no stack.
    spacing : tuple of 3 float, or None
        Distance between neighbouring voxels along i, j, k (mm).
    can_be_volume : bool
        Whether it may be an angiography volume: a stack of grey CT, MR or 3D XA slices.
    trouble : str
        Why its images form no volume, or no such volume; empty otherwise.
    shown : str
        All of it on one line.
    """

    number: str
    uid: str
    description: str
    modality: str
    images: int
    size: tuple[int, int, int] | None
    spacing: tuple[float, float, float] | None
    can_be_volume: bool
    trouble: str
    shown: str

    def __str__(self) -> str:
        return self.shown
