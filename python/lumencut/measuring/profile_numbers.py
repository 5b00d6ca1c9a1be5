"""The numbers of a profile, as arrays with a row for each section."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.errors import MeasuringError
from lumencut.scene.study import Origin
from lumencut.scene.vessel import Vessel

#: The present version of pickled profiles, and the older version with columns instead of a record.
_VERSION, _OF_COLUMNS = 2, 1
#: The fields of a scan in that pickle, in their order.
_SCAN = ("series_number", "series_description", "phase", "slice_thickness_mm", "kernel")

_Floats = npt.NDArray[np.float64]


class ProfileNumbers:
    """The numbers of a profile, a base of :class:`lumencut.Profile`."""

    def __init__(
        self, core: _lumencut.Profile, vessel: Vessel | None = None, origin: Origin | None = None
    ) -> None:
        self._core, self._vessel, self._origin = core, vessel, origin
        self._numbers = {name: _locked(values) for name, values in core.numbers()}
        self._parts = {name: _locked(values) for name, values in core.uncertainty_parts()}
        self._flags = core.flags
        self._flags.flags.writeable = False
        self._center, self._normal = _locked(core.center), _locked(core.normal)
        self._axes = _locked(core.axes)
        self._contour, self._levels = _locked(core.contour), _locked(core.levels)
        self._outer_contour = _locked(core.outer_contour)
        self._own_lumen, self._other_lumen = _locked(core.own_lumen), _locked(core.other_lumen)

    def __getstate__(self) -> dict[str, Any]:
        """Return the state to copy or pickle: plain values by stable names."""
        return {
            "version": _VERSION,
            "record": _lumencut.profile_record(self._core),
            "vessel": self._vessel,
            "origin": self._origin,
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        version = state["version"]
        if version not in (_VERSION, _OF_COLUMNS):
            found, expected = f"version {version}", f"version {_OF_COLUMNS} or {_VERSION}"
            raise MeasuringError("stored profile", found, expected, "measure the vessel again")
        record = state["record"] if version == _VERSION else _record_of_columns(state)
        core = _lumencut.profile_from_record(record)
        ProfileNumbers.__init__(self, core, state["vessel"], state["origin"])

    def __len__(self) -> int:
        return len(self.arc_length)

    @property
    def fwhm(self) -> float:
        """The full width at half maximum of the point spread that was used (mm)."""
        return self._core.fwhm[0]

    @property
    def arc_length(self) -> _Floats:
        """Arc length on the vessel from its first point, shape (n,), mm."""
        return self._numbers["arc_length"]

    @property
    def diameter_min(self) -> _Floats:
        """The shortest diameter: the shorter axis of the ellipse, shape (n,), mm."""
        return self._numbers["diameter_min"]

    @property
    def diameter_max(self) -> _Floats:
        """The longest diameter: the longer axis of the ellipse, shape (n,), mm."""
        return self._numbers["diameter_max"]

    @property
    def diameter_mean(self) -> _Floats:
        """The mean of the shortest and the longest diameter, shape (n,), mm."""
        return self._numbers["diameter_mean"]

    @property
    def diameter_equivalent(self) -> _Floats:
        """The diameter of a circle of the same area, shape (n,), mm."""
        return self._numbers["diameter_equivalent"]

    @property
    def area(self) -> _Floats:
        """The area of the lumen, shape (n,), mm²."""
        return self._numbers["area"]

    @property
    def uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`diameter_equivalent`, shape (n,), mm.

        :attr:`uncertainty_parts` lists its components.
        """
        return self._numbers["uncertainty"]

    @property
    def uncertainty_parts(self) -> dict[str, _Floats]:
        """Components of :attr:`uncertainty`, each of shape (n,), mm; their squares add up to its square.

        ``noise``: the correlated noise of the voxels; ``point_spread``: the uncertainty of the FWHM (0 if it
        was given); ``wall``: that of the level and thickness of the wall; ``lumen_level``: that of the level
        of a narrow lumen; ``surroundings``: deviations from the model, such as patches of another tissue.
        """
        return self._parts

    @property
    def wall(self) -> _Floats:
        """The thickness of the wall, shape (n,), mm; NaN if it is not distinct from its surroundings."""
        return self._numbers["wall"]

    @property
    def wall_uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`wall`, shape (n,), mm."""
        return self._numbers["wall_uncertainty"]

    @property
    def diameter_calcium_excluded(self) -> _Floats:
        """The diameter of a circle of the same area if nothing brighter than lumen at its wall is lumen.

        Calcium and metal look larger than they are and hide where the lumen ends; this is the smallest
        possible diameter, and :attr:`diameter_calcium_included` the largest one. Shape (n,), mm; NaN where no
        flag `CALCIUM` or `METAL` is set. :attr:`diameter_equivalent` lies between them.
        """
        return self._numbers["diameter_calcium_excluded"]

    @property
    def diameter_calcium_included(self) -> _Floats:
        """The diameter of a circle of the same area if all that is brighter than lumen at its wall is lumen.

        Shape (n,), mm; NaN where no flag `CALCIUM` or `METAL` is set.
        """
        return self._numbers["diameter_calcium_included"]

    @property
    def diameter_at_most(self) -> _Floats:
        """The largest diameter that the values allow in a dim throat without a clear wall.

        Shape (n,), mm; NaN elsewhere. It is a limit, not a measured diameter.
        """
        return self._numbers["diameter_at_most"]

    @property
    def diameter_outer(self) -> _Floats:
        """The diameter of a circle of the area that the wall encloses, shape (n,), mm, or NaN."""
        return self._numbers["diameter_outer"]

    @property
    def diameter_outer_uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`diameter_outer`, shape (n,), mm."""
        return self._numbers["diameter_outer_uncertainty"]

    @property
    def inscribed_radius(self) -> _Floats:
        """The radius of the largest ball around the middle that lies within the lumen, shape (n,), mm."""
        return self._numbers["inscribed_radius"]

    @property
    def flags(self) -> npt.NDArray[np.uint32]:
        """The flags of each section, bits of :class:`lumencut.Flag`, shape (n,)."""
        return self._flags

    @property
    def center(self) -> _Floats:
        """The middle of the lumen, shape (n, 3), mm, LPS; the vessel's point where no lumen was found."""
        return self._center

    @property
    def normal(self) -> _Floats:
        """Unit vectors along the vessel, across which the sections lie, shape (n, 3), LPS."""
        return self._normal

    @property
    def axes(self) -> _Floats:
        """Unit vectors to the right and downwards in the plane of each section, shape (n, 2, 3), LPS.

        The contour lies in the plane of these through :attr:`center`.
        """
        return self._axes

    @property
    def contour(self) -> _Floats:
        """The wall along 64 rays of each section, shape (n, 64, 3), mm, LPS."""
        return self._contour

    @property
    def outer_contour(self) -> _Floats:
        """The outer wall around thrombus or plaque, shape (n, 64, 3), mm, LPS; NaN where it is not seen."""
        return self._outer_contour

    @property
    def outer_wall(self) -> list[str]:
        """For each section ``"seen"`` if :attr:`outer_contour` is, otherwise the reason why it is not."""
        return self._core.outer_wall

    @property
    def own_lumen(self) -> _Floats:
        """The lumen of the line where a flap is seen, shape (n, 64, 3), mm, LPS; otherwise NaN."""
        return self._own_lumen

    @property
    def other_lumen(self) -> _Floats:
        """The lumen behind the flap, shape (n, 64, 3), mm, LPS; NaN where it is not seen."""
        return self._other_lumen

    @property
    def flap(self) -> list[str]:
        """For each section ``"seen"`` if both lumens are, otherwise the reason why they are not."""
        return self._core.flap

    @property
    def area_own_lumen(self) -> _Floats:
        """The area within :attr:`own_lumen`, shape (n,), mm²; otherwise NaN."""
        return self._numbers["area_own_lumen"]

    @property
    def area_own_lumen_uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`area_own_lumen`, shape (n,), mm²."""
        return self._numbers["area_own_lumen_uncertainty"]

    @property
    def area_other_lumen(self) -> _Floats:
        """The area within :attr:`other_lumen`, shape (n,), mm²; otherwise NaN."""
        return self._numbers["area_other_lumen"]

    @property
    def area_other_lumen_uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`area_other_lumen`, shape (n,), mm²."""
        return self._numbers["area_other_lumen_uncertainty"]

    @property
    def area_both_lumens(self) -> _Floats:
        """The areas of both lumens together, without the flap, shape (n,), mm²; otherwise NaN."""
        return self._numbers["area_both_lumens"]

    @property
    def area_both_lumens_uncertainty(self) -> _Floats:
        """The standard deviation of :attr:`area_both_lumens`, shape (n,), mm²."""
        return self._numbers["area_both_lumens_uncertainty"]

    @property
    def levels(self) -> _Floats:
        """The levels of lumen and background that were fitted, shape (n, 2), in the unit of the volume."""
        return self._levels


def _locked(values: _Floats) -> _Floats:
    values.flags.writeable = False
    return values


def _record_of_columns(state: dict[str, Any]) -> str:
    """Return the record of a profile that was pickled as columns."""
    columns, flags, fwhm_source, wall_source = state["stored"]
    record = {
        "format": 1,
        "flag_names": {},
        "flags": flags.tolist(),
        "columns": {name: list(map(_plain, values.tolist())) for name, values in columns},
        "fwhm_source": fwhm_source,
        "wall_source": wall_source,
        "scan": dict(zip(_SCAN, state["scan"], strict=True)),
    }
    return json.dumps(record)


def _plain(value: float) -> float | str | None:
    """Return a number as stored in records: None if NaN, a text if infinite."""
    if math.isnan(value):
        return None
    return value if math.isfinite(value) else f"{value}inity"
