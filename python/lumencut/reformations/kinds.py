"""The reformations of vessels, by the names of their commands."""

from __future__ import annotations

from lumencut.reformations.feature_aggregation import CfaRequest
from lumencut.reformations.lumen_mapping import LumenMapRequest
from lumencut.reformations.planar_reformation import CprRequest
from lumencut.reformations.spiral_reformation import SpiralRequest

#: Reformations that show each vessel in separate rows.
KINDS = {asked.kind: asked for asked in (CprRequest, CfaRequest, SpiralRequest, LumenMapRequest)}
