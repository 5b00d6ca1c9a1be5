"""Codes of measures, methods and vessels, all from the dictionary of the standard (PS3.16)."""

from __future__ import annotations

import re

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
SIDES = {"left": ("7771000", "SCT", "Left"), "right": ("24028007", "SCT", "Right")}

#: Patterns of vessel names; a longer name comes before a shorter one that it contains.
_VESSELS: tuple[tuple[str, Coded], ...] = (
    (r"ascending aorta", ("54247002", "SCT", "Ascending aorta")),
    (r"aortic arch", ("57034009", "SCT", "Aortic arch")),
    (r"descending aorta", ("281130003", "SCT", "Descending aorta")),
    (r"thoracic aorta", ("113262008", "SCT", "Thoracic aorta")),
    (r"abdominal aorta", ("7832008", "SCT", "Abdominal aorta")),
    (r"aorta", ("15825003", "SCT", "Aorta")),
    (r"renal( artery)?|ra", ("2841007", "SCT", "Renal artery")),
    (r"common iliac( artery)?|cia", ("73634005", "SCT", "Common iliac artery")),
    (r"external iliac( artery)?|eia", ("113269004", "SCT", "External iliac artery")),
    (r"internal iliac( artery)?|iia", ("90024005", "SCT", "Internal iliac artery")),
    (r"common carotid( artery)?|cca", ("32062004", "SCT", "Common carotid artery")),
    (r"internal carotid( artery)?|ica", ("86117002", "SCT", "Internal carotid artery")),
    (r"external carotid( artery)?|eca", ("22286001", "SCT", "External carotid artery")),
    (r"vertebral( artery)?|va", ("85234005", "SCT", "Vertebral artery")),
    (r"subclavian( artery)?", ("36765005", "SCT", "Subclavian artery")),
    (r"popliteal( artery)?", ("43899006", "SCT", "Popliteal artery")),
    (r"femoral( artery)?|sfa|cfa", ("7657000", "SCT", "Femoral artery")),
    (r"co?eliac( artery| trunk| axis)?", ("57850000", "SCT", "Celiac Axis")),
    (r"superior mesenteric( artery)?|sma", ("42258001", "SCT", "Superior mesenteric artery")),
    (r"inferior mesenteric( artery)?|ima", ("33795007", "SCT", "Inferior mesenteric artery")),
    (r"left main( coronary artery)?|lm", ("3227004", "SCT", "Left Main Coronary Artery")),
    (
        r"left anterior descending( artery)?|lad",
        ("59438005", "SCT", "Left Anterior Descending Coronary Artery"),
    ),
    (r"(left )?circumflex( artery)?|lcx", ("57396003", "SCT", "Circumflex Coronary Artery")),
    (r"right coronary( artery)?|rca", ("13647002", "SCT", "Right Coronary Artery")),
)
_OF_ONE_SIDE = ("3227004", "59438005", "57396003", "13647002")


def site_of(name: str | None) -> tuple[Coded | None, Coded | None]:
    """Return the codes of a named vessel and of its side; None if the name is unknown.

    Only complete names match, such as ``"left renal artery"``, ``"ICA R"`` or ``"LAD"``, not parts of other
    names.
    """
    words = re.sub(r"[\s_\-.,()]+", " ", (name or "").lower()).strip()
    # A number at the end distinguishes pieces of one vessel; it is removed.
    words = re.sub(r" \d+$", "", words)
    for pattern, code in _VESSELS:
        if re.fullmatch(pattern, words):
            return code, None
    letters = {"l": "left", "r": "right", "left": "left", "right": "right"}
    first, _, rest = words.partition(" ")
    before, _, last = words.rpartition(" ")
    for side, other in ((first, rest), (last, before)):
        found = next((code for pattern, code in _VESSELS if re.fullmatch(pattern, other)), None)
        if side in letters and found is not None and found[0] not in _OF_ONE_SIDE:
            return found, SIDES[letters[side]]
    return None, None
