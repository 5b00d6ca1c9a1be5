"""Measured vessels as a structured report (TID 1500), for databases and other programs."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.dicom.writing import codes
from lumencut.dicom.writing.codes import Coded
from lumencut.dicom.writing.objects import LO, RESEARCH, ST, Kind, Target, cut, new_object, sealed, write
from lumencut.dicom.writing.uids import uid_of
from lumencut.errors import FormatError, MissingPackageError
from lumencut.measuring.dicom_profile import Measured, Place
from lumencut.measuring.flags import Flag
from lumencut.measuring.stenosis import Stenosis
from lumencut.scene.study import Study

#: Attributes of highdicom's document that are not copied: it names the scanner's maker as the report's maker.
_OF_HIGHDICOM = ("ContributingEquipmentSequence", "InstanceCreationDate", "InstanceCreationTime")
_BY_HAND = (
    (Flag.BY_HAND, "Contour by hand: the reader drew it"),
    (Flag.LINE_BY_HAND, "Centerline by hand: the reader moved it"),
)
_REPORT = "1.2.840.10008.5.1.4.1.1.88.34"


def check_highdicom() -> None:
    """Raise an error if highdicom is missing.

    Raises
    ------
    MissingPackageError
    """
    try:
        import highdicom  # noqa: F401 - whether it is there
    except ImportError as error:
        mend = 'pip install "lumencut[dicom]"'
        raise MissingPackageError(
            "structured report", "no package highdicom", "the extra [dicom]", mend
        ) from error


def write_report(target: Target, vessels: Sequence[Measured], study: Study, *, names: bool = True) -> None:
    """Write vessels with the marks of a reader, flagged as PRELIMINARY and UNVERIFIED.

    Parameters
    ----------
    target : Path or binary file
        The file or binary stream to write to.
    vessels : sequence of Measured
        The content.
    study : Study
        The study of the report; all coordinates are in the frame of reference of this study.
    names : bool, default True
        Whether vessels are called by their names.

    Raises
    ------
    FormatError
        For a study whose images state no frame of reference.
    MissingPackageError
        Without highdicom.
    """
    check_highdicom()
    frame = study.text("FrameOfReferenceUID")
    if not frame:
        found, mend = "images without a FrameOfReferenceUID", "give anonymous=True (--anonymous)"
        raise FormatError("study of the scan", found, "one that coordinates are in", mend)
    groups = [
        group
        for number, one in enumerate(vessels, 1)
        for group in _Vessel(one, one.name if names else None, number, frame).groups()
    ]
    content = _content(groups, study)
    kind = Kind(_REPORT, "measurements", 9007, "SR")
    data = new_object(study, kind, "")
    data.SeriesDescription = f"Lumencut measurements {RESEARCH}"
    _take(data, _document(content, data, study))
    texts = [text for group in groups for text in _texts(group)]
    sealed(data, *texts)
    write(data, target)


class _Vessel:
    """Makes the groups of measurements of one vessel."""

    def __init__(self, one: Measured, name: str | None, number: int, frame: str) -> None:
        self._one, self._frame = one, frame
        self._title = cut(name or f"vessel {number}", LO)
        self._key = repr((number, one.length, one.points[0].tolist()))
        code, side = codes.site_of(name)
        self._sites = [_site(code, side)] if code is not None else None

    def groups(self) -> list[Any]:
        """Return the marked places, the stenoses, and the centerline with its length."""
        places = [self._place(place) for place in self._one.places]
        return [*places, *(self._stenosis(one) for one in self._one.stenoses), self._line()]

    def _tracked(self, words: str) -> Any:
        from highdicom.sr import TrackingIdentifier

        return TrackingIdentifier(uid_of("tracking", self._key, words), f"{self._title}, {words}")

    def _place(self, place: Place) -> Any:
        """Return a section with its contour (TID 1410)."""
        from highdicom.sr import ImageRegion3D, PlanarROIMeasurementsAndQualitativeEvaluations

        group = PlanarROIMeasurementsAndQualitativeEvaluations(
            self._tracked(f"{place.kind[2]} at {place.arc_length:.1f} mm"),
            referenced_region=ImageRegion3D("POLYGON", _outline(place), self._frame),
            finding_type=_code(place.kind),
            finding_sites=self._sites,
            measurements=_measurements(place),
        )
        _say_by_hand(group, place.flags)
        return group

    def _stenosis(self, one: Stenosis) -> Any:
        """Return a percentage with its method (TID 1501) and the doubts about it."""
        from highdicom.sr import MeasurementsAndQualitativeEvaluations

        name = codes.AREA_STENOSIS if one.method == "area" else codes.DIAMETER_STENOSIS
        method = codes.METHODS[one.method]
        group = MeasurementsAndQualitativeEvaluations(
            self._tracked(f"stenosis at {one.at:.1f} mm"),
            finding_type=_code(codes.STENOSIS),
            finding_sites=self._sites,
            measurements=[
                _number(name, one.percent, "%", method, one.percent_uncertainty, regions=self._walls(one))
            ],
        )
        for words in (str(one), *one.doubts):
            _comment(group, words)
        return group

    def _walls(self, one: Stenosis) -> list[Any]:
        """Return the walls that a percentage was computed from: at the narrow place, then at the references.

        They give the group a position: OHIF cannot open a report with a group without one.
        """
        from highdicom.sr import CoordinatesForMeasurement3D

        used = [place for place in self._one.places if place.marked in (one.at, *dict(one.references))]
        used.sort(key=lambda place: place.marked != one.at)
        return [CoordinatesForMeasurement3D("POLYGON", _outline(place), self._frame) for place in used]

    def _line(self) -> Any:
        """Return the centerline with its length (TID 1501)."""
        from highdicom.sr import (
            CoordinatesForMeasurement3D,
            Measurement,
            MeasurementsAndQualitativeEvaluations,
        )

        line = CoordinatesForMeasurement3D("POLYLINE", self._one.points, self._frame)
        length = Measurement(
            _code(codes.SEGMENT_LENGTH),
            _rounded(self._one.length),
            _unit("mm"),
            referenced_coordinates=[line],
        )
        group = MeasurementsAndQualitativeEvaluations(
            self._tracked("centerline"),
            finding_type=_code(codes.CENTERLINE),
            finding_sites=self._sites,
            measurements=[length],
        )
        _say_by_hand(group, self._one.flags & Flag.LINE_BY_HAND)
        return group


def _say_by_hand(group: Any, flags: Flag) -> None:
    """Add a sentence for a contour and for a centerline that the reader made by hand."""
    for flag, words in _BY_HAND:
        if flags & flag:
            _comment(group, words)


def _outline(place: Place) -> npt.NDArray[np.float64]:
    """Return the wall of a section as a closed polygon whose first point is repeated at the end (mm, LPS)."""
    return np.vstack([place.contour, place.contour[:1]])


def _measurements(place: Place) -> list[Any]:
    """Return the diameters and the area of a section."""
    found = [_number(codes.DIAMETER, place.equivalent, "mm", codes.BY_AREA, place.uncertainty)]
    derived = ((codes.MEAN, place.mean), (codes.SHORTEST, place.shortest), (codes.LONGEST, place.longest))
    for derivation, value in derived:
        found.append(_number(codes.DIAMETER, value, "mm", derivation=derivation))
    return [*found, _number(codes.AREA, place.area, "mm2")]


def _number(
    name: Coded,
    value: float,
    unit: str,
    method: Coded | None = None,
    uncertainty: float = np.nan,
    derivation: Coded | None = None,
    regions: Sequence[Any] | None = None,
) -> Any:
    """Return a number; its uncertainty, if known, is one standard deviation in both directions.

    `regions` are the sources of the number, unless its group states them for all numbers.
    """
    from highdicom.sr import Measurement, MeasurementProperties

    properties = None
    if np.isfinite(uncertainty):
        spread = _rounded(uncertainty)
        properties = MeasurementProperties(
            upper_measurement_uncertainty=spread, lower_measurement_uncertainty=spread
        )
        # The uncertainty has the unit of the number; highdicom has no argument for it.
        for item in properties:
            item.MeasuredValueSequence[0].MeasurementUnitsCodeSequence[0] = _unit(unit)
    return Measurement(
        _code(name),
        _rounded(value),
        _unit(unit),
        method=None if method is None else _code(method),
        derivation=None if derivation is None else _code(derivation),
        properties=properties,
        referenced_coordinates=regions,
    )


def _comment(group: Any, words: str) -> None:
    """Add a sentence to a group of measurements."""
    from highdicom.sr import TextContentItem

    item = TextContentItem(_code(codes.COMMENT), cut(words, ST), relationship_type="CONTAINS")
    group[0].ContentSequence.append(item)


def _content(groups: list[Any], study: Study) -> Any:
    """Return the content tree of the report."""
    from highdicom import sr

    device = sr.DeviceObserverIdentifyingAttributes(
        uid_of("device", _lumencut.__version__),
        manufacturer_name="Lumencut",
        model_name=f"Lumencut {_lumencut.__version__} {RESEARCH}",
    )
    observer = sr.ObserverContext(_code(("121007", "DCM", "Device")), device)
    procedure = codes.PROCEDURES.get(study.text("Modality"), codes.OTHER_PROCEDURE)
    return sr.MeasurementReport(
        sr.ObservationContext(observer_device_context=observer),
        _code(procedure),
        groups,
        title=_code(codes.REPORT),
    )


def _document(content: Any, data: Any, study: Study) -> Any:
    """Return the content tree in a document of highdicom, with one image of the scan as evidence."""
    from highdicom.sr import Comprehensive3DSR

    image = copy.deepcopy(data)
    image.SeriesInstanceUID = study.text("SeriesInstanceUID") or data.SeriesInstanceUID
    # One image is enough: all images of a long scan would make the report two hundred times as large.
    kinds = study.instances or ((data.SOPClassUID, uid_of("nothing")),)
    image.SOPClassUID, image.SOPInstanceUID = kinds[len(kinds) // 2]
    return Comprehensive3DSR(
        [image],
        content[0],
        data.SeriesInstanceUID,
        data.SeriesNumber,
        uid_of("replaced"),
        data.InstanceNumber,
        manufacturer="Lumencut",
        is_complete=True,
        is_final=False,
        is_verified=False,
        record_evidence=bool(study.instances),
    )


def _take(data: Any, document: Any) -> None:
    """Copy the attributes of a report document, except patient and author, which are set already."""
    for element in document:
        if element.tag not in data and element.keyword not in _OF_HIGHDICOM:
            data[element.tag] = element


def _texts(group: Any) -> list[bytes]:
    """Yield all texts of a group; the UID of the report depends on them."""
    return [str(item).encode() for item in group]


def _code(code: Coded) -> Any:
    from highdicom.sr import CodedConcept

    return CodedConcept(*code)


def _unit(unit: str) -> Any:
    meanings = {"mm": "mm", "mm2": "square millimeter", "%": "percent"}
    return _code((unit, "UCUM", meanings[unit]))


def _site(code: Coded, side: Coded | None) -> Any:
    from highdicom.sr import FindingSite

    return FindingSite(_code(code), laterality=None if side is None else _code(side))


def _rounded(value: float) -> float:
    """Return a number with seven digits, as in all tables."""
    return float(f"{value:.7g}")
