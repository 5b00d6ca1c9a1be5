"""The reformations of vessels, by the names of their commands."""

from __future__ import annotations

from lumencut.feature_aggregation import CfaRequest
from lumencut.lumen_mapping import LumenMapRequest
from lumencut.planar_reformation import CprRequest
from lumencut.spiral_reformation import SpiralRequest

#: Reformations that show each vessel in separate rows.
KINDS = {asked.kind: asked for asked in (CprRequest, CfaRequest, SpiralRequest, LumenMapRequest)}
