"""Requests for reformations, described once for the function, the command and the recipe."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from lumencut import _lumencut
from lumencut.base.checks import number, numbers
from lumencut.errors import CameraError, SettingsError, VolumeError
from lumencut.reformations.checks import check_vessel
from lumencut.scene.camera import Camera

if TYPE_CHECKING:
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.volume import Volume

#: The default direction upwards in the picture (LPS): to the head.
HEAD = (0.0, 0.0, 1.0)

#: Parameters that must be one of these names.
_NAMES = ("backwards", "keep", "lens", "mode", "roll", "sampling", "show")

#: The shapes of parameters with several numbers.
_SHAPES = {"up": (3,), "normal": (3,), "root": (3,), "band": (2,), "size": (2,)}


class ReformationRequest:
    """The parameters of a reformation, with names, order and defaults of its function in `lumencut`.

    A kind is a frozen dataclass; its `of` makes the image in the scene and window of a renderer.
    """

    #: The command for the reformation, and the name of the reformation in messages.
    kind: ClassVar[str]
    subject: ClassVar[str]
    #: The parameters that the recipe stores, in this order.
    stored: ClassVar[tuple[str, ...]]
    #: Parameters that are settings, with their names in messages. All other parameters position the pixels.
    of_settings: ClassVar[dict[str, str]] = {
        "smoothing": "smoothing of the centerline",
        "amount": "amount of the uncurling",
        "level": "level of the CFA",
        "calcium_level": "calcium_level",
        "band": "band of the lumen map",
    }

    def checked(self, **defaults: Any) -> dict[str, Any]:
        """Return the parameters as stored in a recipe: numbers, lists of numbers, names, or None.

        `defaults` are the values of parameters that are None.
        """
        given = {name: getattr(self, name) for name in self.stored}
        given |= {name: value for name, value in defaults.items() if given[name] is None}
        return {name: self._checked(name, value) for name, value in given.items()}

    def _checked(self, name: str, value: Any) -> Any:
        if name in _NAMES or (value is None and getattr(type(self), name) is None):
            return value
        subject = self.of_settings.get(name, f"{name} of the {self.subject}")
        error = SettingsError if name in self.of_settings else CameraError
        if name in _SHAPES:
            return numbers(error, subject, value, _SHAPES[name]).tolist()
        return number(error, subject, value)

    def _volume(self, renderer: Renderer, vessel: Any) -> Volume:
        """Return the volume of the renderer; reject renderers without one, and anything except a vessel."""
        check_vessel(vessel)
        if renderer.volume is None:
            raise VolumeError(f"volume of the {self.subject}", "None", "a volume to show")
        return renderer.volume

    def _check_camera(self, camera: Any) -> None:
        """Reject anything except a camera or None."""
        if not isinstance(camera, (Camera, type(None))):
            raise CameraError(f"camera of the {self.subject}", type(camera).__name__, "a Camera or None")


def pixel_side(volume: Volume) -> float:
    """Return the default pixel side (mm) of every reformation of a volume."""
    return _lumencut.pixel_side(float(volume.spacing.min()))
