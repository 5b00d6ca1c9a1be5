"""The first view of a notebook: scene, camera and settings from the checked arguments of `show`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from lumencut.base.checks import integers
from lumencut.errors import CameraError, SettingsError
from lumencut.notebook.scene import Scene
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings

#: Longest side of a picture (pixels): larger than a screen, and accepted by browsers.
MOST_PIXELS = 4096


@dataclass(frozen=True)
class FirstView:
    """A scene, its camera and the settings."""

    scene: Scene
    camera: Camera
    settings: Settings

    @classmethod
    def of(
        cls,
        scene: Scene,
        camera: Camera | None,
        settings: Settings | None,
        size: tuple[int, int],
        changes: Mapping[str, Any],
        *,
        is_traced: bool,
    ) -> FirstView:
        """Return the view of the arguments of :func:`lumencut.show`, with the same errors."""
        chosen = _changed(settings, changes, is_traced=is_traced)
        if camera is None:
            camera = Camera.anterior(scene.renderer.scene, checked_size(size))
        return cls(scene, checked_camera(camera), chosen)


def _changed(settings: Settings | None, changes: Mapping[str, Any], *, is_traced: bool) -> Settings:
    """Return the settings, changed by those given by name."""
    if not isinstance(settings, (Settings, type(None))):
        raise SettingsError("settings", type(settings).__name__, "Settings or None")
    known = [field.name for field in fields(Settings)]
    for name in changes:
        if name not in known:
            expected = f"an argument of show, or a setting: {', '.join(known)}"
            raise SettingsError("argument of show", repr(name), expected)
    # In a cut view, other vessels would be hidden that are still to be traced.
    first = Settings(context="mip") if is_traced else Settings()
    return replace(settings or first, **changes)


def checked_size(size: Any) -> tuple[int, int]:
    """Return a checked size of a picture (pixels)."""
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
