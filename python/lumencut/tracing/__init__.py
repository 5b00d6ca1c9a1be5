"""Centerlines from a volume: traced between clicks, grown from a seed, found in all of it, or from a mask.

All names are names of `lumencut` too.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lumencut.base.public_names import public_name

if TYPE_CHECKING:
    from lumencut.tracing.centerline_comparison import CenterlineComparison, compare_centerlines
    from lumencut.tracing.mask_tracing import trace_mask
    from lumencut.tracing.seed_tracing import trace_from
    from lumencut.tracing.suggested_names import SuggestedName, suggest_names
    from lumencut.tracing.tracer import Tracer, trace
    from lumencut.tracing.vessel_finding import find_vessels

__all__ = [
    "CenterlineComparison",
    "SuggestedName",
    "Tracer",
    "compare_centerlines",
    "find_vessels",
    "suggest_names",
    "trace",
    "trace_from",
    "trace_mask",
]


def __getattr__(name: str) -> Any:
    return public_name(__name__, __all__, name)
