"""Errors and warnings. Every error names its subject, what was found, what was expected and the remedy."""

from __future__ import annotations

from lumencut.base.mends import Mend, Told, Write, as_argument, written
from lumencut.base.series_report import SeriesReport


class LumencutError(Exception):
    """Base of all errors of this package.

    Parameters
    ----------
    subject : str
        The file, argument or item that is wrong.
    found : str
        What was found.
    expected : str
        What was expected instead.
    mend : str, optional
        The remedy, such as the argument to pass.

    Attributes
    ----------
    mends : tuple of Mend
        The remedies that programs can act on, by stable names, such as ``Mend("fill_gaps")``; may be empty.
    advice : str
        The remedy as text only, as far as it is not in `mends`.
    """

    def __init__(self, subject: str, found: str, expected: str, mend: str = "") -> None:
        self.subject: str = subject
        self.found: str = found
        self.expected: str = expected
        self.mend: str = mend
        super().__init__(subject, found, expected, mend)

    def __str__(self) -> str:
        return self.written(as_argument)

    @property
    def mends(self) -> tuple[Mend, ...]:
        """The remedies that programs can act on."""
        return self.mend.mends if isinstance(self.mend, Told) else ()

    @property
    def advice(self) -> str:
        """The remedy as text."""
        return self.mend.advice if isinstance(self.mend, Told) else self.mend

    def written(self, write: Write) -> str:
        """Return the message; the host writes the options in it."""
        tail = f"; {written(self.mend, write)}" if self.mend else ""
        return f"{self.subject}: found {self.found}; expected {self.expected}{tail}"


class VolumeError(LumencutError, ValueError):
    """A volume whose voxels or geometry cannot be used."""


class VesselTreeError(LumencutError, ValueError):
    """A vessel or vessel tree whose points or radii cannot be used."""


class CameraError(LumencutError, ValueError):
    """A camera that defines no view."""


class SettingsError(LumencutError, ValueError):
    """A setting outside its range."""


class DeviceError(LumencutError, RuntimeError):
    """A GPU that is missing, too small for the work, or failed."""


class TracingError(LumencutError, ValueError):
    """Points between which no centerline can be traced: outside the lumen, or not connected by lumen."""


class MeasuringError(LumencutError, ValueError):
    """A vessel whose lumen cannot be measured, or a place on it where a number would make no sense."""


class FormatError(LumencutError, ValueError):
    """A file whose content does not match its format, or an unsupported format."""


class SeriesError(FormatError):
    """A folder of several DICOM series without a choice; `series` describes them."""

    series: tuple[SeriesReport, ...] = ()


class FileError(LumencutError, OSError):
    """A file that cannot be opened, read or written."""


class PacsError(LumencutError, OSError):
    """A PACS that cannot be reached, rejects a request, or handles only a part of it."""


class MissingPackageError(LumencutError, RuntimeError):
    """An optional package that the call needs is not installed."""


class DeviceWarning(UserWarning):
    """A GPU that failed or lacks memory; the CPU continues."""


class StudyWarning(UserWarning):
    """A chosen study or mask that may not belong to the scan: another patient, day, body part or place."""


class LineWarning(UserWarning):
    """A centerline that is doubtful by itself: its points are in another order, far away, or missing."""

    def written(self, write: Write) -> str:
        """Return the warning; the host writes the options in it."""
        return written(self.args[0], write)


class SpaceWarning(UserWarning):
    """Coordinates that fit the volume better in another space than the one stated."""

    def written(self, write: Write) -> str:
        """Return the warning; the host writes the options in it."""
        return written(self.args[0], write)
