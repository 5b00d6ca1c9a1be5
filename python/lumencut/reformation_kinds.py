"""The reformations of vessels, by the name of the command that makes them."""

from __future__ import annotations

from lumencut.feature_aggregation import CfaRequest
from lumencut.lumen_mapping import LumenMapRequest
from lumencut.planar_reformation import CprRequest
from lumencut.spiral_reformation import SpiralRequest

#: Those that show one vessel in rows of their own.
KINDS = {asked.kind: asked for asked in (CprRequest, CfaRequest, SpiralRequest, LumenMapRequest)}
