"""Converts vessels that the page measured to Python objects."""

from __future__ import annotations

from typing import Any

from lumencut import _lumencut
from lumencut.errors import MeasuringError, SettingsError, VesselTreeError
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
from lumencut.measuring.profile import Profile
from lumencut.scene.vessel import Vessel
from lumencut.viewer.pacs_zip.given import Given, refused


def measured_vessel(finding: Given, number: int, *, has_name: bool) -> MeasuredVessel:
    """Return a vessel of the page with what a reader marked on it; the core grades it again.

    Parameters
    ----------
    finding : Given
        Its name, its points (mm, LPS), the record of its profile, and its marks.
    number : int
        Its number among the findings, from 0.
    has_name : bool
        Whether it is called by its name.

    Raises
    ------
    FormatError
        For anything that is not such a vessel.
    """
    name = finding.text("name") if has_name else ""
    record, marked = finding.text("profile"), _marked(finding.object("marks"))
    try:
        vessel = Vessel(finding.points("points"), name=name or None)
        profile = Profile(_lumencut.profile_from_record(record), vessel)
        return MeasuredVessel.of(str(number), vessel, profile, marked)
    except VesselTreeError as error:
        raise refused(f"an invalid vessel ({error.found})", error.expected) from error
    except (MeasuringError, SettingsError) as error:
        raise refused(f"{error.found} as {error.subject}", error.expected) from error


def _marked(marks: Given) -> Marked:
    """The marks of a reader."""
    at, original, comparison = map(marks.number_or_none, ("at", "original", "comparison"))
    references, diameters = tuple(marks.numbers("references")), tuple(marks.numbers("diameters"))
    # The core checks both names.
    method: Any = marks.text("method")
    group: Any = marks.text_or_none("group")
    return Marked(at, references, method, original, comparison, group, diameters)
