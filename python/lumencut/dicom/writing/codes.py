"""Codes of measures, methods and vessels, all from the dictionary of the standard (PS3.16)."""

from __future__ import annotations

from lumencut import _lumencut

Coded = tuple[str, str, str]

DIAMETER = ("397413000", "SCT", "Vessel lumen diameter")
AREA = ("397415007", "SCT", "Vessel lumen cross-sectional area")
DIAMETER_STENOSIS = ("408715008", "SCT", "Lumen Diameter Stenosis")
AREA_STENOSIS = ("408714007", "SCT", "Lumen Area Stenosis")
SEGMENT_LENGTH = ("414599003", "SCT", "Length of Segment")
MEAN = ("373098007", "SCT", "Mean")
SHORTEST = ("255605001", "SCT", "Minimum")
LONGEST = ("56851009", "SCT", "Maximum")
LUMEN_MINIMUM = ("122382", "DCM", "Site of Lumen Minimum")
PROXIMAL_REFERENCE = ("122380", "DCM", "Proximal Reference")
DISTAL_REFERENCE = ("122381", "DCM", "Distal Reference")
CENTERLINE = ("130490", "DCM", "Centerline")
STENOSIS = ("415582006", "SCT", "stenosis")
BY_AREA = ("122650", "DCM", "Area Based Method")
REPORT = ("126000", "DCM", "Imaging Measurement Report")
COMMENT = ("121106", "DCM", "Comment")
METHODS = {
    "nascet": ("122655", "DCM", "NASCET"),
    "ecst": ("122656", "DCM", "ECST"),
    "area": BY_AREA,
}
PROCEDURES = {
    "CT": ("77477000", "SCT", "Computed tomography"),
    "MR": ("241663008", "SCT", "Magnetic resonance angiography"),
}
OTHER_PROCEDURE = ("363679005", "SCT", "Imaging procedure")


def site_of(name: str | None) -> tuple[Coded | None, Coded | None]:
    """Return the codes of a named vessel and of its side; None if the name does not contain them.

    Only complete names match, such as ``"left renal artery"``, ``"ICA R"`` or ``"LAD"``, not parts of other
    names.
    """
    found = _lumencut.vessel_code(name or "")
    if found is None:
        return None, None
    return _snomed(found[0]), None if found[1] is None else _snomed(found[1])


def _snomed(code: tuple[str, str]) -> Coded:
    return code[0], "SCT", code[1]
