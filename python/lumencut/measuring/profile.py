"""The lumen of a vessel by its arc length."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice, number, numbers
from lumencut.base.pickles import by_name
from lumencut.errors import MeasuringError, SettingsError
from lumencut.measuring.profile_outputs import ProfileOutputs
from lumencut.measuring.stenosis import METHODS, Method, Stenosis
from lumencut.scene.scan_details import ScanDetails

_Floats = npt.NDArray[np.float64]


@by_name
class Spot(NamedTuple):
    """A place on a vessel: its arc length and the diameter there, both in mm."""

    arc_length: float
    diameter: float


@by_name
class Throat(NamedTuple):
    """A place without a clear wall: its arc length, and the largest diameter it can have, both in mm."""

    arc_length: float
    at_most: float


@by_name
class Stretch(NamedTuple):
    """The length of a part of a vessel (mm): along the vessel, and straight from end to end."""

    length: float
    straight: float

    @property
    def tortuosity(self) -> float:
        """The length along the vessel divided by the straight distance: 1 for a straight part."""
        return self.length / self.straight if self.straight > 0 else math.inf


@by_name
class Angle(float):
    """An angle in radians, with its degrees."""

    @property
    def degrees(self) -> float:
        """The angle in degrees."""
        return math.degrees(self)


@by_name
class CArm(NamedTuple):
    """The angles of a C-arm (radians): LAO and cranial above 0, RAO and caudal below."""

    lao: Angle
    cranial: Angle

    def __str__(self) -> str:
        """The angles as displayed on a C-arm."""
        return _lumencut.c_arm_words(self.lao, self.cranial)


@by_name
class Profile(ProfileOutputs):
    """The lumen of one vessel by its arc length; :func:`lumencut.measure` makes it.

    Arrays have one row for each section, n in all, and cannot be written to. What could not be measured is
    NaN. A diameter is that of the lumen: thrombus and plaque are not lumen.
    """

    def __repr__(self) -> str:
        length = self.arc_length[-1]
        return f"Profile({len(self)} sections, {length:.1f} mm, FWHM {self.fwhm:.2f} mm {self.fwhm_source})"

    @property
    def noise(self) -> float:
        """The standard deviation of a voxel around the fit, in the unit of the volume."""
        return self._core.noise

    @property
    def fwhm_source(self) -> str:
        """How :attr:`fwhm` was found: ``"given"``, ``"estimated on …"`` or ``"assumed: …"``."""
        return self._core.fwhm[1]

    @property
    def scan(self) -> ScanDetails:
        """Acquisition details of the measured scan, from its file; :attr:`fwhm_source` describes the blur."""
        return ScanDetails(*_lumencut.scan_of(self._core))

    @property
    def wall_source(self) -> str:
        """The assumed level of walls, or why walls were not distinguished."""
        return self._core.wall_source

    def stenosis(
        self,
        at: float,
        reference: float | Iterable[float] | None = None,
        method: Method = "nascet",
        original: float | None = None,
        *,
        comparison: float | None = None,
    ) -> Stenosis:
        """Grade the stenosis at a place.

        Diameters are those of circles of the same area. A reference is the median of the sections within
        1.5 mm of its place that count; :class:`lumencut.Flag` says which do.

        Parameters
        ----------
        at : float
            The place of the stenosis: an arc length on the vessel (mm).
        reference : float or pair of float
            The place of the normal vessel (mm), for NASCET beyond the stenosis where the walls are
            parallel; or one place on each side: then the reference lies between both, by their distances.
            ECST needs none.
        method : {"nascet", "ecst", "area"}, default "nascet"
            ``"nascet"``: 1 - diameter / reference. ``"ecst"``: 1 - diameter / original. ``"area"``: 1 -
            area / area of the reference.
        original : float, optional
            The assumed original diameter at the stenosis (mm); needed for ECST and for nothing else.
        comparison : float, optional
            The diameter of a vessel like the normal one (mm), such as that of the other side of the body.

        Raises
        ------
        MeasuringError
            For places beyond the vessel or where nothing was measured, a reference that is narrower than
            the stenosis or lies within its own diameter of it, two references on one side of it, a missing
            or needless original diameter; and for NASCET at a near-occlusion, where the reference is below
            half of the vessel on the other side of the stenosis, or at most 0.87 of ``comparison``.
        SettingsError
            For another method.
        """
        choice(SettingsError, "method of the stenosis", method, METHODS)
        if method != "ecst" and original is not None:
            raise MeasuringError(
                "original diameter of the stenosis", f"{original!r} with the method {method!r}", "'ecst'"
            )
        places = [] if reference is None else np.atleast_1d(np.asarray(reference, dtype=object)).tolist()
        graded = self._core.stenosis(
            number(MeasuringError, "place of the stenosis", at),
            method,
            [number(MeasuringError, "reference of the stenosis", place) for place in places],
            None if original is None else number(MeasuringError, "original diameter", original),
            None if comparison is None else number(MeasuringError, "comparison", comparison),
        )
        return Stenosis(graded)

    def narrowest(self) -> Spot | None:
        """Return the narrowest place among safe sections: a suggestion, not a finding.

        A safe section counts, has no flag `METAL` or `CALCIUM`, has an uncertainty of at most a third of its
        diameter, and lies more than one diameter from a change of lumen and from a flap. None if no section
        is safe, if the vessel only tapers towards an end, or if a place that could not be measured must be
        narrower (:meth:`throat`); :meth:`not_suggested` says why.
        """
        found = self._core.narrowest()
        return None if found is None else Spot(*found)

    def throat(self) -> Throat | None:
        """Return a place without a clear wall that must be narrower than all measured ones, or None.

        A lumen narrower than the blur is dim, so its peak limits its diameter, which is not measured. Then
        :meth:`narrowest` returns None.
        """
        found = self._core.throat()
        return None if found is None else Throat(*found)

    def not_suggested(self, at: float | None = None) -> tuple[str, ...]:
        """Return why no place is suggested, a sentence each; empty where places are suggested.

        The first sentence tells a :meth:`throat`, if there is one.

        Parameters
        ----------
        at : float, optional
            The place for which references are suggested (mm of arc length); without it the narrowest one.
        """
        place = None if at is None else number(MeasuringError, "place on the vessel", at)
        return tuple(_lumencut.not_suggested_places(self._core, place, []))

    def outer_volume(self, start: float, end: float) -> tuple[float, float]:
        """Return the volume within the outer wall around thrombus or plaque, and its standard deviation.

        Parameters
        ----------
        start, end : float
            The ends of the stretch (mm of arc length).

        Returns
        -------
        tuple of float
            The volume and its standard deviation (mm³).

        Raises
        ------
        MeasuringError
            If :attr:`outer_wall` is not seen over more than 5 mm, or for places beyond the vessel.
        """
        ends = [number(MeasuringError, "end of the stretch", end) for end in (start, end)]
        return self._core.outer_volume((ends[0], ends[1]))

    def not_measured(self) -> tuple[str, ...]:
        """Return which stretches were not measured and why, a sentence each; mostly empty.

        A line that continues where lumen and tissue cannot be distinguished is measured only over its longest
        stretch of 10 mm pieces that each have a wall. Sections elsewhere are NaN. Ends of 10 mm and more
        without a wall are reported as well.
        """
        return tuple(_lumencut.not_measured_stretches(self._core))

    def widest(self) -> Spot | None:
        """Return the place of the longest diameter of all sections that count, and that diameter.

        It ignores flags: an odd outline, a nearby branch, or an outlier of the fit may cause it. Files,
        reports and the viewer omit it if a section within 1 mm is not round or lies in a branch. They accept
        a section more than 1.3 times as long as wide only if its neighbours agree; otherwise they take the
        section with the largest area.
        """
        found = self._core.widest()
        return None if found is None else Spot(*found)

    def suggested_references(self, at: float) -> tuple[Spot | None, Spot | None]:
        """Return suggested references before and after an arc length (mm).

        Each is the nearest place, 3 to 50 mm and at least its own diameter away, with parallel walls over 5
        mm and about as wide as most of the vessel on its side; None if there is none. No branch lies between,
        unless both sides would then have no reference. A reader must check these suggestions.

        Raises
        ------
        MeasuringError
            For a place beyond the vessel.
        """
        before, after = self._core.suggested_references(number(MeasuringError, "place on the vessel", at))
        return (
            None if before is None else Spot(*before),
            None if after is None else Spot(*after),
        )

    def diameter_at(self, at: float) -> tuple[float, float]:
        """Return the diameter at an arc length, between sections, and its standard deviation (mm).

        Raises
        ------
        MeasuringError
            For a place beyond the vessel, or where nothing was measured.
        """
        return self._core.diameter_at(number(MeasuringError, "place on the vessel", at))

    def stretch(self, start: float, end: float) -> Stretch:
        """Return the length from one arc length to another (mm): along the vessel, and straight.

        Raises
        ------
        MeasuringError
            For places beyond the vessel, or one place twice.
        """
        return Stretch(*self._core.stretch(_ends((start, end))))

    def direction(self, start: float, end: float) -> _Floats:
        """Return the unit vector of the line that fits the middles of a stretch best, shape (3,), LPS.

        Raises
        ------
        MeasuringError
            As for :meth:`stretch`.
        """
        return np.array(self._core.direction(_ends((start, end))))

    def angle_between(self, first: tuple[float, float], second: tuple[float, float]) -> Angle:
        """Return the angle between two stretches, 0 where the second continues as the first does.

        Parameters
        ----------
        first, second : pair of float
            Start and end of each, arc lengths (mm); such as neck and sac of an aneurysm.

        Returns
        -------
        Angle
            In radians; its property ``degrees`` gives degrees.

        Raises
        ------
        MeasuringError
            As for :meth:`stretch`.
        """
        return Angle(self._core.angle_between(_ends(first), _ends(second)))

    def c_arm(self, start: float, end: float, lao: float | None = None) -> CArm:
        """Return the angles of a C-arm that shows a stretch without foreshortening.

        Parameters
        ----------
        start, end : float
            Start and end of the stretch, arc lengths (mm).
        lao : float, optional
            The rotation (radians), to the patient's left above 0; the angulation follows from it. By default
            the view nearest to the front is returned.

        Raises
        ------
        MeasuringError
            As for :meth:`stretch`, and for a rotation at which no angulation shows the stretch.
        """
        turned = None if lao is None else number(MeasuringError, "rotation of the C-arm", lao)
        found = self._core.c_arm(_ends((start, end)), turned)
        return CArm(Angle(found[0]), Angle(found[1]))


def _ends(ends: tuple[float, float]) -> tuple[float, float]:
    start, end = numbers(MeasuringError, "ends of the stretch", ends, (2,)).tolist()
    return start, end
