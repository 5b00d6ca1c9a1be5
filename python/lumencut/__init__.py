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
    from lumencut.centerline_writers import write_centerlines
    from lumencut.centerlines import read_centerlines
    from lumencut.device import Device, devices
    from lumencut.errors import (
        CameraError,
        DeviceError,
        DeviceWarning,
        FileError,
        FormatError,
        LumencutError,
        MissingPackageError,
        SeriesError,
        SettingsError,
        SpaceWarning,
        TracingError,
        VesselTreeError,
        VolumeError,
    )
    from lumencut.evaluation import Evaluation, evaluate
    from lumencut.frame import Frame
    from lumencut.renderer import Renderer, render
    from lumencut.settings import Settings
    from lumencut.slab import Slab
    from lumencut.threads import get_threads, set_threads
    from lumencut.tracing import Tracer, trace
    from lumencut.transfer import TransferFunction
    from lumencut.turntables import fitted_turn, save_animation, turntable
    from lumencut.vessel_tree import Vessel, VesselTree
    from lumencut.volume import Volume
    from lumencut.volume_files import SeriesReport, list_series, read_volume
    from lumencut.window import Opacity, Window

#: Where each public name lives; modules are imported on first use, so that ``import lumencut`` is quick.
_HOME = {
    "_lumencut": ("__version__",),
    "camera": ("VIEWS", "Camera"),
    "centerline_writers": ("write_centerlines",),
    "centerlines": ("read_centerlines",),
    "device": ("Device", "devices"),
    "errors": (
        "CameraError",
        "DeviceError",
        "DeviceWarning",
        "FileError",
        "FormatError",
        "LumencutError",
        "MissingPackageError",
        "SeriesError",
        "SettingsError",
        "SpaceWarning",
        "TracingError",
        "VesselTreeError",
        "VolumeError",
    ),
    "evaluation": ("Evaluation", "evaluate"),
    "frame": ("Frame",),
    "renderer": ("Renderer", "render"),
    "settings": ("Settings",),
    "slab": ("Slab",),
    "threads": ("get_threads", "set_threads"),
    "tracing": ("Tracer", "trace"),
    "transfer": ("TransferFunction",),
    "turntables": ("fitted_turn", "save_animation", "turntable"),
    "vessel_tree": ("Vessel", "VesselTree"),
    "volume": ("Volume",),
    "volume_files": ("SeriesReport", "list_series", "read_volume"),
    "window": ("Opacity", "Window"),
}
_MODULE = {name: module for module, names in _HOME.items() for name in names}

__all__ = [
    "VIEWS",
    "Camera",
    "CameraError",
    "Device",
    "DeviceError",
    "DeviceWarning",
    "Evaluation",
    "FileError",
    "FormatError",
    "Frame",
    "LumencutError",
    "MissingPackageError",
    "Opacity",
    "Renderer",
    "SeriesError",
    "SeriesReport",
    "Settings",
    "SettingsError",
    "Slab",
    "SpaceWarning",
    "Tracer",
    "TracingError",
    "TransferFunction",
    "Vessel",
    "VesselTree",
    "VesselTreeError",
    "Volume",
    "VolumeError",
    "Window",
    "__version__",
    "devices",
    "evaluate",
    "fitted_turn",
    "get_threads",
    "list_series",
    "read_centerlines",
    "read_volume",
    "render",
    "save_animation",
    "set_threads",
    "trace",
    "turntable",
    "write_centerlines",
]


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module 'lumencut' has no attribute {name!r}")
    return getattr(importlib.import_module(f"lumencut.{_MODULE[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
