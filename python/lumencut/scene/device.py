"""The GPUs of this machine."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass

from lumencut import _lumencut
from lumencut.base.pickles import by_name


@by_name
@dataclass(frozen=True)
class Device:
    """A GPU as its driver describes it.

    Parameters
    ----------
    name : str
        Its name.
    backend : str
        Its graphics interface, such as ``"vulkan"``.
    driver : str
        Its driver and the driver's version.
    is_software : bool
        Whether the GPU is emulated in software. Such a device is used only by ``device="gpu"`` if there is no
        other, never by ``"auto"``: the CPU kernels are faster.
    volume_side : int
        Largest number of voxels along each side of a volume.
    buffer_bytes : int
        The largest buffer (bytes), which bounds the size of a picture and a tree.
    """

    name: str
    backend: str
    driver: str
    is_software: bool
    volume_side: int
    buffer_bytes: int


def devices() -> list[Device]:
    """Return the GPUs of this machine; ``device="gpu"`` uses the first one.

    The list is empty without a GPU that has a driver for Vulkan, Metal or DirectX 12.
    """
    look_for_no_display()
    return [Device(**fields) for fields in _lumencut.devices()]


def look_for_no_display() -> None:
    """Suppress a message on stderr: a Mesa layer complains that no display is there to choose a GPU."""
    screens = ("DISPLAY", "WAYLAND_DISPLAY", "MESA_VK_DEVICE_SELECT")
    if sys.platform == "linux" and not any(os.environ.get(name) for name in screens):
        os.environ.setdefault("NODEVICE_SELECT", "1")
