"""A stenosis, graded by standard methods."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from lumencut import _lumencut
from lumencut.base.checks import choice
from lumencut.base.pickles import by_name
from lumencut.errors import SettingsError

Method: TypeAlias = Literal["nascet", "ecst", "area"]

METHODS: tuple[Method, ...] = ("nascet", "ecst", "area")


@by_name
class Stenosis:
    """A stenosis at a place that the caller named; :meth:`Profile.stenosis` makes it.

    Lumencut is not a medical device: a percentage is a number, not a diagnosis.
    """

    def __init__(self, graded: _lumencut.Stenosis) -> None:
        self._graded = graded
        self._numbers = graded.numbers()

    def __getstate__(self) -> Any:
        """Return the state to copy or pickle: plain values."""
        return _lumencut.stored_stenosis(self._graded)

    def __setstate__(self, state: Any) -> None:
        Stenosis.__init__(self, _lumencut.restored_stenosis(state))

    @property
    def percent(self) -> float:
        """By how much the vessel is narrower, 0 to 100: in diameter, or in area with ``"area"``."""
        return self._numbers[0]

    @property
    def percent_uncertainty(self) -> float:
        """The standard deviation of the percentage, in percent; NaN if unknown.

        Errors of point spread and wall affect the place and its reference together.
        """
        return self._numbers[5]

    @property
    def at(self) -> float:
        """The place of the stenosis: an arc length on the vessel (mm)."""
        return self._numbers[1]

    @property
    def diameter(self) -> float:
        """The diameter there, of a circle of the same area (mm)."""
        return self._numbers[2]

    @property
    def uncertainty(self) -> float:
        """The standard deviation of the diameter (mm)."""
        return self._numbers[3]

    @property
    def reference(self) -> float:
        """The diameter that it is compared with (mm); with ``"ecst"`` the assumed original one.

        Of two references it lies between both, by their distances from the stenosis.
        """
        return self._numbers[4]

    @property
    def references(self) -> tuple[tuple[float, float], ...]:
        """The places of the references: arc length and diameter of each (mm)."""
        return tuple(self._graded.references)

    @property
    def method(self) -> Method:
        """The method of grading: ``"nascet"``, ``"ecst"`` or ``"area"``."""
        return self._graded.method

    @property
    def doubts(self) -> tuple[str, ...]:
        """Doubts about the percentage, a sentence each; empty if none.

        They come from the flags of the sections used (:class:`lumencut.Flag`), and from a branch between the
        place and a reference. With ``"ecst"`` only the place is used.
        """
        return tuple(self._graded.doubts)

    def group(self, vessel: Literal["carotid", "coronary"]) -> str:
        """Return the severity group of the percentage, with its source.

        Parameters
        ----------
        vessel : {"carotid", "coronary"}
            Which vessel it is: ``"carotid"`` for the groups of NASCET (50 and 70 %), ``"coronary"`` for
            those of CAD-RADS 2.0. Lumencut does not know which vessel it is.

        Raises
        ------
        SettingsError
            For another vessel.
        MeasuringError
            For a stenosis that was not graded by ``"nascet"``.
        """
        choice(SettingsError, "vessel of the group", vessel, _lumencut.STENOSIS_TERRITORIES)
        return self._graded.group(vessel)

    def __str__(self) -> str:
        """Return one line with the method, both diameters in mm, and the doubts."""
        return self._graded.doubtful_words()

    def __repr__(self) -> str:
        return f"Stenosis({self})"
