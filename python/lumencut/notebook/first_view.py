"""What a notebook shows first, checked: scene, camera and settings from the arguments of `show`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from lumencut._checks import integers
from lumencut.camera import Camera
from lumencut.errors import CameraError, SettingsError
from lumencut.notebook.scene import DeviceName, Scene
from lumencut.settings import Settings
from lumencut.vessel_tree import VesselTree

#: The longest side of a picture (pixels): more than a screen has, and what a browser takes at once.
MOST_PIXELS = 4096


@dataclass(frozen=True)
class FirstView:
    """A scene, the camera that looks at it, and the settings."""

    scene: Scene
    camera: Camera
    settings: Settings

    @classmethod
    def of(
        cls,
        volume: Any,
        tree: VesselTree | None,
        camera: Camera | None,
        settings: Settings | None,
        size: tuple[int, int],
        device: DeviceName,
        changes: Mapping[str, Any],
        *,
        is_traced: bool,
    ) -> FirstView:
        """Return what the arguments of :func:`lumencut.show` ask for; errors as told there."""
        chosen = _changed(settings, changes, is_traced=is_traced)
        scene = Scene(volume, tree, device)
        if camera is None:
            camera = Camera.anterior(scene.renderer.scene, checked_size(size))
        return cls(scene, checked_camera(camera), chosen)


def _changed(settings: Settings | None, changes: Mapping[str, Any], *, is_traced: bool) -> Settings:
    """The settings with those that were given by name."""
    if not isinstance(settings, (Settings, type(None))):
        raise SettingsError("settings", type(settings).__name__, "Settings or None")
    known = [field.name for field in fields(Settings)]
    for name in changes:
        if name not in known:
            expected = f"an argument of show, or a setting: {', '.join(known)}"
            raise SettingsError("argument of show", repr(name), expected)
    # Cut open, vessels would hide those that are not traced yet.
    first = Settings(context="mip") if is_traced else Settings()
    return replace(settings or first, **changes)


def checked_size(size: Any) -> tuple[int, int]:
    """Return a size of a picture (pixels), refused where it is larger than a notebook shows."""
    width, height = integers(CameraError, "size of the picture", size, 1, 32768, 2)
    if max(width, height) > MOST_PIXELS:
        found, expected = f"{width} × {height} pixels", f"at most {MOST_PIXELS} along each side"
        raise CameraError("size of the picture", found, expected, "render writes larger pictures to files")
    return width, height


def checked_camera(camera: Any) -> Camera:
    """Return a camera whose picture a notebook shows."""
    if not isinstance(camera, Camera):
        raise CameraError("camera", type(camera).__name__, "a Camera or None")
    checked_size(camera.size)
    return camera
