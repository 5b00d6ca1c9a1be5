"""Acquisition details of a scan that affect measured numbers."""

from __future__ import annotations

from dataclasses import dataclass

from lumencut.base.pickles import by_name


@by_name
@dataclass(frozen=True)
class ScanDetails:
    """Acquisition details from a file; None for those that are missing or differ between slices.

    Only DICOM has them, and anonymised files may lack some. They do not name a patient; the description of a
    series was written at the scanner.

    Attributes
    ----------
    series_number, series_description : str or None
        The series.
    phase : str or None
        The phase of the heart, of the contrast medium and of the series in words, as far as they are stated:
        such as ``"70 % of the cardiac cycle"``.
    slice_thickness : float or None
        Thickness of slices (mm); the distance between slices may be smaller.
    kernel : str or None
        The kernel of the reconstruction, such as ``"B30f"``.
    """

    series_number: str | None = None
    series_description: str | None = None
    phase: str | None = None
    slice_thickness: float | None = None
    kernel: str | None = None

    def __str__(self) -> str:
        """Return all details in words, also which ones the file does not state."""
        from lumencut import _lumencut

        return _lumencut.scan_words(self)
