"""Curved Surface Reformation: the lumen of all vessels of an angiography in one freely rotatable view.

>>> import lumencut
>>> volume = lumencut.read_volume("ct.nii.gz")
>>> tree = lumencut.read_centerlines("centerlines.vtp", volume=volume)
>>> lumencut.render(volume, tree).save("anterior.png")

Lumencut is not a medical device.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lumencut._lumencut import __version__
    from lumencut.camera import VIEWS, Camera
    from lumencut.centerline_comparison import CenterlineComparison, compare_centerlines
    from lumencut.centerline_writers import write_centerlines
    from lumencut.centerlines import read_centerlines
    from lumencut.cohort.batch import BatchSummary, batch
    from lumencut.device import Device, devices
    from lumencut.errors import (
        CameraError,
        DeviceError,
        DeviceWarning,
        FileError,
        FormatError,
        LineWarning,
        LumencutError,
        MeasuringError,
        MissingPackageError,
        PacsError,
        SeriesError,
        SettingsError,
        SpaceWarning,
        StudyWarning,
        TracingError,
        VesselTreeError,
        VolumeError,
    )
    from lumencut.evaluation import Evaluation, evaluate
    from lumencut.feature_aggregation import FeatureAggregation, cfa
    from lumencut.flags import Flag
    from lumencut.flights import flight
    from lumencut.focus import Focus
    from lumencut.frame import Frame
    from lumencut.lumen_mapping import lumen_map
    from lumencut.mask_tracing import trace_mask
    from lumencut.measurements import Measurements
    from lumencut.measuring import CrossSection, cross_section, measure
    from lumencut.mends import Mend
    from lumencut.notebook import show
    from lumencut.picking import brightest
    from lumencut.planar_reformation import PlanarReformation, cpr
    from lumencut.profile import Profile
    from lumencut.reformation import Reformation
    from lumencut.renderer import Renderer, render
    from lumencut.scan_details import ScanDetails
    from lumencut.seed_tracing import trace_from
    from lumencut.settings import Settings
    from lumencut.slab import Slab
    from lumencut.spiral_reformation import SpiralReformation, spiral
    from lumencut.stenosis import Stenosis
    from lumencut.straightening import StraightenedVolume, straightened_volume
    from lumencut.tangential import TangentialReformation
    from lumencut.threads import get_threads, set_threads
    from lumencut.tracing import Tracer, trace
    from lumencut.transfer import TransferFunction
    from lumencut.tree_reformations import cr, mpcpr
    from lumencut.turntables import fitted_turn, save_animation, turntable
    from lumencut.uncurling import Uncurled, uncurl
    from lumencut.unrolled_wall import LumenMap, Ostium
    from lumencut.untangled_tree import UntangledTree
    from lumencut.untangling import untangled
    from lumencut.vessel import Vessel
    from lumencut.vessel_finding import find_vessels
    from lumencut.vessel_gap import Gap
    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume
    from lumencut.volume_files import SeriesReport, list_series, read_volume
    from lumencut.window import Opacity, Window

#: Module of each public name; modules are imported on first use, so that ``import lumencut`` is fast.
_HOME = {
    "_lumencut": ("__version__",),
    "camera": ("VIEWS", "Camera"),
    "centerline_comparison": ("CenterlineComparison", "compare_centerlines"),
    "centerline_writers": ("write_centerlines",),
    "centerlines": ("read_centerlines",),
    "cohort.batch": ("BatchSummary", "batch"),
    "device": ("Device", "devices"),
    "errors": (
        "CameraError",
        "DeviceError",
        "DeviceWarning",
        "FileError",
        "FormatError",
        "LineWarning",
        "LumencutError",
        "MeasuringError",
        "MissingPackageError",
        "PacsError",
        "SeriesError",
        "SettingsError",
        "SpaceWarning",
        "StudyWarning",
        "TracingError",
        "VesselTreeError",
        "VolumeError",
    ),
    "evaluation": ("Evaluation", "evaluate"),
    "feature_aggregation": ("FeatureAggregation", "cfa"),
    "flags": ("Flag",),
    "flights": ("flight",),
    "focus": ("Focus",),
    "frame": ("Frame",),
    "lumen_mapping": ("lumen_map",),
    "untangled_tree": ("UntangledTree",),
    "untangling": ("untangled",),
    "unrolled_wall": ("LumenMap", "Ostium"),
    "mask_tracing": ("trace_mask",),
    "measurements": ("Measurements",),
    "measuring": ("CrossSection", "cross_section", "measure"),
    "mends": ("Mend",),
    "notebook": ("show",),
    "picking": ("brightest",),
    "planar_reformation": ("PlanarReformation", "cpr"),
    "profile": ("Profile",),
    "reformation": ("Reformation",),
    "renderer": ("Renderer", "render"),
    "scan_details": ("ScanDetails",),
    "seed_tracing": ("trace_from",),
    "settings": ("Settings",),
    "slab": ("Slab",),
    "spiral_reformation": ("SpiralReformation", "spiral"),
    "stenosis": ("Stenosis",),
    "straightening": ("StraightenedVolume", "straightened_volume"),
    "tangential": ("TangentialReformation",),
    "threads": ("get_threads", "set_threads"),
    "tracing": ("Tracer", "trace"),
    "transfer": ("TransferFunction",),
    "tree_reformations": ("cr", "mpcpr"),
    "turntables": ("fitted_turn", "save_animation", "turntable"),
    "uncurling": ("Uncurled", "uncurl"),
    "vessel_gap": ("Gap",),
    "vessel": ("Vessel",),
    "vessel_finding": ("find_vessels",),
    "vessel_tree": ("VesselTree",),
    "volume": ("Volume",),
    "volume_files": ("SeriesReport", "list_series", "read_volume"),
    "window": ("Opacity", "Window"),
}
_MODULE = {name: module for module, names in _HOME.items() for name in names}

__all__ = [
    "VIEWS",
    "BatchSummary",
    "Camera",
    "CameraError",
    "CenterlineComparison",
    "CrossSection",
    "Device",
    "DeviceError",
    "DeviceWarning",
    "Evaluation",
    "FeatureAggregation",
    "FileError",
    "Flag",
    "Focus",
    "FormatError",
    "Frame",
    "Gap",
    "LineWarning",
    "LumenMap",
    "LumencutError",
    "Measurements",
    "MeasuringError",
    "Mend",
    "MissingPackageError",
    "Opacity",
    "Ostium",
    "PacsError",
    "PlanarReformation",
    "Profile",
    "Reformation",
    "Renderer",
    "ScanDetails",
    "SeriesError",
    "SeriesReport",
    "Settings",
    "SettingsError",
    "Slab",
    "SpaceWarning",
    "SpiralReformation",
    "Stenosis",
    "StraightenedVolume",
    "StudyWarning",
    "TangentialReformation",
    "Tracer",
    "TracingError",
    "TransferFunction",
    "Uncurled",
    "UntangledTree",
    "Vessel",
    "VesselTree",
    "VesselTreeError",
    "Volume",
    "VolumeError",
    "Window",
    "__version__",
    "batch",
    "brightest",
    "cfa",
    "compare_centerlines",
    "cpr",
    "cr",
    "cross_section",
    "devices",
    "evaluate",
    "find_vessels",
    "fitted_turn",
    "flight",
    "get_threads",
    "list_series",
    "lumen_map",
    "measure",
    "mpcpr",
    "read_centerlines",
    "read_volume",
    "render",
    "save_animation",
    "set_threads",
    "show",
    "spiral",
    "straightened_volume",
    "trace",
    "trace_from",
    "trace_mask",
    "turntable",
    "uncurl",
    "untangled",
    "write_centerlines",
]


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module 'lumencut' has no attribute {name!r}")
    return getattr(importlib.import_module(f"lumencut.{_MODULE[name]}"), name)


def _restored(name: str, *arguments: Any) -> Any:
    """Create an object of a class by name; pickles refer only to this function, so modules can move."""
    from lumencut._pickles import part

    kind = __getattr__(name) if name in _MODULE else part(name)
    return kind.__new__(kind, *arguments)


def __dir__() -> list[str]:
    return sorted(__all__)
