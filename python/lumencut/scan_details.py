"""How a scan was made, as far as numbers measured in it depend on that."""

from __future__ import annotations

from dataclasses import dataclass

from lumencut._pickles import by_name


@by_name
@dataclass(frozen=True)
class ScanDetails:
    """What a file tells of how its scan was made; None of what it does not tell, or not alike for all slices.

    DICOM tells it, other formats do not, and of anonymised files a part may be missing. Nothing of it names a
    patient; the description of a series is what the scanner or somebody at it wrote.

    Attributes
    ----------
    series_number, series_description : str or None
        The series.
    phase : str or None
        The phase of the heart, of the contrast medium and of the series in words, as far as they are stated:
        such as ``"70 % of the cardiac cycle"``.
    slice_thickness : float or None
        How thick slices are (mm); they may lie nearer to each other.
    kernel : str or None
        The kernel of the reconstruction, such as ``"B30f"``.
    """

    series_number: str | None = None
    series_description: str | None = None
    phase: str | None = None
    slice_thickness: float | None = None
    kernel: str | None = None

    def __str__(self) -> str:
        """All of it in words, with what is not stated."""
        from lumencut import _lumencut

        return _lumencut.scan_words(self)
