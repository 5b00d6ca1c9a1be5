"""Views along vessels: curved planar, spiral, tangential and untangled reformations, and the unrolled wall.

All names are names of `lumencut` too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lumencut.base.public_names import public_name

if TYPE_CHECKING:
    from lumencut.reformations.endoscopic_view import Endoscopy
    from lumencut.reformations.endoscoping import endoscopy
    from lumencut.reformations.feature_aggregation import FeatureAggregation, cfa
    from lumencut.reformations.flattening import FlattenedSurface, flatten
    from lumencut.reformations.lumen_mapping import lumen_map
    from lumencut.reformations.network_map import NetworkMap, network
    from lumencut.reformations.planar_reformation import PlanarReformation, cpr
    from lumencut.reformations.reformation import Reformation
    from lumencut.reformations.spiral_reformation import SpiralReformation, spiral
    from lumencut.reformations.straightening import StraightenedVolume, straightened_volume
    from lumencut.reformations.tangential import TangentialReformation
    from lumencut.reformations.tree_reformations import cr, mpcpr
    from lumencut.reformations.uncurling import Uncurled, uncurl
    from lumencut.reformations.unrolled_wall import LumenMap, Ostium
    from lumencut.reformations.untangled_tree import UntangledTree
    from lumencut.reformations.untangling import untangled

__all__ = [
    "Endoscopy",
    "FeatureAggregation",
    "FlattenedSurface",
    "LumenMap",
    "NetworkMap",
    "Ostium",
    "PlanarReformation",
    "Reformation",
    "SpiralReformation",
    "StraightenedVolume",
    "TangentialReformation",
    "Uncurled",
    "UntangledTree",
    "cfa",
    "cpr",
    "cr",
    "endoscopy",
    "flatten",
    "lumen_map",
    "mpcpr",
    "network",
    "spiral",
    "straightened_volume",
    "uncurl",
    "untangled",
]


def __getattr__(name: str) -> Any:
    return public_name(__name__, __all__, name)
