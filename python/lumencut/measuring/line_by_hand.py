"""Flags the sections of a centerline that a reader moved in the viewer."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np

from lumencut.measuring.flags import Flag
from lumencut.measuring.profile import Profile
from lumencut.scene.vessel import Vessel


def with_line_by_hand(profile: Profile, vessel: Vessel, moved: Sequence[bool]) -> Profile:
    """Return a profile whose sections near moved points of the centerline are flagged.

    Parameters
    ----------
    profile : Profile
        The profile of the vessel.
    vessel : Vessel
        The measured vessel.
    moved : sequence of bool
        Whether the reader moved each point of the vessel.
    """
    steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
    places = np.append(0.0, np.cumsum(steps))[np.asarray(moved, dtype=bool)]
    state = profile.__getstate__()
    record = json.loads(state["record"])
    for number in {profile._core.nearest(float(place)) for place in places}:
        record["flags"][number] |= int(Flag.LINE_BY_HAND)
    made = Profile.__new__(Profile)
    made.__setstate__({**state, "record": json.dumps(record)})
    return made
