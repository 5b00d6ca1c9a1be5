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
    from lumencut.base.mends import Mend
    from lumencut.base.threads import get_threads, set_threads
    from lumencut.cohort.batch import BatchSummary, batch
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
    from lumencut.files.centerline_writers import write_centerlines
    from lumencut.files.centerlines import read_centerlines
    from lumencut.files.volumes import SeriesReport, list_series, read_volume
    from lumencut.measuring.comparison import Change, Comparison, compare_scans
    from lumencut.measuring.flags import Flag
    from lumencut.measuring.measurements import Measurements
    from lumencut.measuring.profile import Profile
    from lumencut.measuring.sections import CrossSection, cross_section, measure
    from lumencut.measuring.stenosis import Stenosis
    from lumencut.notebook import show
    from lumencut.pictures.flights import flight
    from lumencut.pictures.frame import Frame
    from lumencut.pictures.one_view import render
    from lumencut.pictures.renderer import Renderer
    from lumencut.pictures.turntables import fitted_turn, save_animation, turntable
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
    from lumencut.reports.vessel_sheet import sheet
    from lumencut.scene.camera import VIEWS, Camera
    from lumencut.scene.device import Device, devices
    from lumencut.scene.focus import Focus
    from lumencut.scene.picking import brightest
    from lumencut.scene.scan_details import ScanDetails
    from lumencut.scene.settings import Settings
    from lumencut.scene.slab import Slab
    from lumencut.scene.transfer import TransferFunction
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.vessel_gap import Gap
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume
    from lumencut.scene.volume_pyramid import VolumePyramid
    from lumencut.scene.window import Opacity, Window
    from lumencut.tracing.centerline_comparison import CenterlineComparison, compare_centerlines
    from lumencut.tracing.mask_tracing import trace_mask
    from lumencut.tracing.seed_tracing import trace_from
    from lumencut.tracing.suggested_names import SuggestedName, suggest_names
    from lumencut.tracing.tracer import Tracer, trace
    from lumencut.tracing.vessel_finding import find_vessels

#: Module of each public name; modules are imported on first use, so that ``import lumencut`` is fast.
_HOME = {
    "_lumencut": ("__version__",),
    "base.mends": ("Mend",),
    "base.threads": ("get_threads", "set_threads"),
    "cohort.batch": ("BatchSummary", "batch"),
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
    "files.centerline_writers": ("write_centerlines",),
    "files.centerlines": ("read_centerlines",),
    "files.volumes": ("SeriesReport", "list_series", "read_volume"),
    "measuring.comparison": ("Change", "Comparison", "compare_scans"),
    "measuring.flags": ("Flag",),
    "measuring.measurements": ("Measurements",),
    "measuring.profile": ("Profile",),
    "measuring.sections": ("CrossSection", "cross_section", "measure"),
    "measuring.stenosis": ("Stenosis",),
    "notebook": ("show",),
    "pictures.flights": ("flight",),
    "pictures.frame": ("Frame",),
    "pictures.one_view": ("render",),
    "pictures.renderer": ("Renderer",),
    "pictures.turntables": ("fitted_turn", "save_animation", "turntable"),
    "reformations.endoscoping": ("endoscopy",),
    "reformations.endoscopic_view": ("Endoscopy",),
    "reformations.feature_aggregation": ("FeatureAggregation", "cfa"),
    "reformations.flattening": ("FlattenedSurface", "flatten"),
    "reformations.lumen_mapping": ("lumen_map",),
    "reformations.network_map": ("NetworkMap", "network"),
    "reformations.planar_reformation": ("PlanarReformation", "cpr"),
    "reformations.reformation": ("Reformation",),
    "reformations.spiral_reformation": ("SpiralReformation", "spiral"),
    "reformations.straightening": ("StraightenedVolume", "straightened_volume"),
    "reformations.tangential": ("TangentialReformation",),
    "reformations.tree_reformations": ("cr", "mpcpr"),
    "reformations.uncurling": ("Uncurled", "uncurl"),
    "reformations.unrolled_wall": ("LumenMap", "Ostium"),
    "reformations.untangled_tree": ("UntangledTree",),
    "reformations.untangling": ("untangled",),
    "scene.camera": ("VIEWS", "Camera"),
    "scene.device": ("Device", "devices"),
    "scene.focus": ("Focus",),
    "scene.picking": ("brightest",),
    "scene.scan_details": ("ScanDetails",),
    "scene.settings": ("Settings",),
    "scene.slab": ("Slab",),
    "scene.transfer": ("TransferFunction",),
    "scene.vessel": ("Vessel",),
    "scene.vessel_gap": ("Gap",),
    "scene.vessel_tree": ("VesselTree",),
    "reports.vessel_sheet": ("sheet",),
    "scene.volume": ("Volume",),
    "scene.volume_pyramid": ("VolumePyramid",),
    "scene.window": ("Opacity", "Window"),
    "tracing.centerline_comparison": ("CenterlineComparison", "compare_centerlines"),
    "tracing.mask_tracing": ("trace_mask",),
    "tracing.seed_tracing": ("trace_from",),
    "tracing.suggested_names": ("SuggestedName", "suggest_names"),
    "tracing.tracer": ("Tracer", "trace"),
    "tracing.vessel_finding": ("find_vessels",),
}
_MODULE = {name: module for module, names in _HOME.items() for name in names}

__all__ = [
    "VIEWS",
    "BatchSummary",
    "Camera",
    "CameraError",
    "CenterlineComparison",
    "Change",
    "Comparison",
    "CrossSection",
    "Device",
    "DeviceError",
    "DeviceWarning",
    "Endoscopy",
    "Evaluation",
    "FeatureAggregation",
    "FileError",
    "Flag",
    "FlattenedSurface",
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
    "NetworkMap",
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
    "SuggestedName",
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
    "VolumePyramid",
    "Window",
    "__version__",
    "batch",
    "brightest",
    "cfa",
    "compare_centerlines",
    "compare_scans",
    "cpr",
    "cr",
    "cross_section",
    "devices",
    "endoscopy",
    "evaluate",
    "find_vessels",
    "fitted_turn",
    "flatten",
    "flight",
    "get_threads",
    "list_series",
    "lumen_map",
    "measure",
    "mpcpr",
    "network",
    "read_centerlines",
    "read_volume",
    "render",
    "save_animation",
    "set_threads",
    "sheet",
    "show",
    "spiral",
    "straightened_volume",
    "suggest_names",
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
    from lumencut.base.pickles import part

    kind = __getattr__(name) if name in _MODULE else part(name)
    return kind.__new__(kind, *arguments)


def __dir__() -> list[str]:
    return sorted(__all__)
