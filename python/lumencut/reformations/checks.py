"""Checks of the arguments of reformations of one vessel: vessel, angles, and settings with a slab."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, TypeAlias

from lumencut.base.checks import number
from lumencut.errors import CameraError, SettingsError, VesselTreeError
from lumencut.scene.checked_settings import checked
from lumencut.scene.line_doubts import check_lines_once
from lumencut.scene.settings import Settings
from lumencut.scene.slab import Slab
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

#: A slab in the forms that users pass: a Slab, a thickness (mm) with a mode, or a thickness (mm).
SlabArgument: TypeAlias = "Slab | tuple[float, str] | float | None"


def check_vessel(vessel: Any) -> None:
    """Reject anything except a vessel, and warn once if the order of its points or its line is doubtful."""
    if not isinstance(vessel, Vessel):
        mend = (
            "take one of its vessels, or several as one by its path()"
            if isinstance(vessel, VesselTree)
            else ""
        )
        raise VesselTreeError("vessel of the CPR", type(vessel).__name__, "a Vessel", mend)
    check_lines_once([vessel], "vessel of the CPR")


def flat_settings(settings: Any, slab: SlabArgument = None) -> Settings:
    """Return settings for an image without context and with one sample per pixel, with this slab.

    Raises
    ------
    SettingsError
        For invalid settings, a slab that is not thicker than 0, or a focus.
    """
    if not isinstance(settings, (Settings, type(None))):
        raise SettingsError("settings", type(settings).__name__, "Settings or None")
    given = replace(_thick(settings or Settings(), slab), context=None, samples=1)
    checked(given).refuse_focus()
    return given


def _thick(settings: Settings, slab: SlabArgument) -> Settings:
    """Return the settings with the slab that the caller passed."""
    if slab is None:
        return settings
    if not isinstance(slab, Slab):
        slab = Slab(*slab) if isinstance(slab, tuple) and len(slab) == 2 else Slab(slab)  # type: ignore[arg-type]
    if not slab.thickness > 0:
        raise SettingsError("slab thickness", f"{slab.thickness:g} mm", "a thickness above 0 mm, or no slab")
    return replace(settings, slab=slab)


def radians(subject: str, angle: float | None, degrees: float | None) -> float:
    """Return the angle in radians; exactly one of both units must be given."""
    if degrees is not None:
        return math.radians(number(CameraError, subject.replace("angle", "degrees"), degrees))
    return number(CameraError, subject, angle)


def rotation(angle: float | None, degrees: float | None) -> float:
    """Return the rotation (radians) from one of two angles.

    Raises
    ------
    CameraError
        If both angles or none are given, or if the angle is not a finite number.
    """
    if (angle is None) == (degrees is None):
        found = "neither" if angle is None else "an angle in radians and one in degrees"
        raise CameraError("angle of the rotation", found, "one of angle= (radians) and degrees=")
    return radians("angle of the rotation", angle, degrees)
