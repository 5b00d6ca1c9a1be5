"""Public functions with valid arguments, and values that no argument accepts."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import lumencut
from lumencut import phantom
from scene_files import write_lines, write_volume


class Unknown:
    """An object of a class that Lumencut does not know."""


#: Values that are passed instead of each argument.
WRONG: list[Any] = [
    None,
    "wrong",
    b"bytes",
    object(),
    Unknown,
    [],
    [None],
    (),
    {},
    set(),
    True,
    0,
    -1,
    2**70,
    float("nan"),
    np.zeros(0),
    np.zeros((2, 2, 2, 2)),
    np.array(["a"]),
    np.array([object()], dtype=object),
    [[1, 2], [3]],
    lambda *given: None,
    slice(None),
    range(3),
    Path("nowhere/at.all"),
]

#: Functions that use the network, change the process, take long, or accept any value.
_LEFT_OUT = {"batch", "show", "set_threads", "devices", "get_threads", "evaluate"}
#: Classes whose methods only store their arguments: errors, notes, results.
_HELD = {"BatchSummary", "Device", "DeviceWarning", "Flag", "Gap", "Mend", "Ostium", "SeriesReport"}
_HELD |= {"Endoscopy", "FlattenedSurface", "NetworkMap", "VolumePyramid"}
_HELD |= {"CenterlineComparison", "CrossSection", "Evaluation", "FeatureAggregation", "Frame", "LumenMap"}
_HELD |= {"PlanarReformation", "Profile", "Reformation", "ScanDetails", "SpiralReformation", "Stenosis"}
_HELD |= {"StraightenedVolume", "TangentialReformation", "Uncurled", "UntangledTree"}


#: Arguments that a call needs although they have defaults.
_ASKED = {
    ("Camera.rotated", "angle"),
    ("PlanarReformation.rotated", "angle"),
    ("Profile.stenosis", "reference"),
}


@dataclasses.dataclass(frozen=True)
class Case:
    """A function with valid arguments by name."""

    name: str
    callable: Callable[..., Any]
    given: dict[str, Any]

    def call(self, **changed: Any) -> None:
        """Call it with some arguments changed; of an iterator take only the first item."""
        made = self.callable(**{**self.given, **changed})
        if isinstance(made, Iterator):
            next(made, None)


def cases(folder: Path) -> Iterator[Case]:
    """Yield every public function, constructor and method with arguments that work."""
    good = _Good(folder)
    for name in lumencut.__all__:
        member = getattr(lumencut, name)
        if name in _LEFT_OUT or not callable(member) or _is_error(member):
            continue
        if not inspect.isclass(member):
            yield Case(name, member, good.arguments(name, member))
            continue
        if name not in _HELD:
            yield Case(name, member, good.arguments(name, member))
        yield from _methods(name, member, good)


def _is_error(member: Any) -> bool:
    return inspect.isclass(member) and issubclass(member, BaseException)


def _methods(name: str, kind: type, good: _Good) -> Iterator[Case]:
    instance = good.instances().get(name)
    for method, found in inspect.getmembers(kind):
        if method.startswith("_") or not callable(found) or isinstance(found, property):
            continue
        whole = f"{name}.{method}"
        if inspect.ismethod(found):
            yield Case(whole, found, good.arguments(whole, found))
        elif instance is not None and not inspect.isclass(found):
            bound = getattr(instance, method)
            yield Case(whole, bound, good.arguments(whole, bound))


class _Good:
    """Valid arguments."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.scan = write_volume(folder / "scan.nii.gz")
        self.lines = write_lines(folder / "lines.vtk")
        made = phantom.stenosis()
        self.tree, self.vessel = made.tree, made.tree[0]
        coarse = made.volume.world_from_index @ np.diag([2, 2, 2, 1])
        self.volume = lumencut.Volume(made.volume.array[::2, ::2, ::2], world_from_index=coarse)
        self.camera = lumencut.Camera.fitted(self.tree, (0, 1, 0), (0, 0, 1), size=(24, 20))
        self.mask = lumencut.Volume(
            (self.volume.array > 200).astype(np.uint8), world_from_index=self.volume.world_from_index
        )
        self._instances: dict[str, Any] = {}

    def instances(self) -> dict[str, Any]:
        """An object of each public class."""
        if self._instances:
            return self._instances
        v, t, one, camera = self.volume, self.tree, self.vessel, self.camera
        profile = lumencut.measure(v, one, 2.0)
        cpr = lumencut.cpr(v, one, pixel_spacing=1.0)
        made = [
            v,
            t,
            one,
            camera,
            profile,
            profile.stenosis(profile.arc_length[len(profile) // 2], reference=[profile.arc_length[2]]),
            lumencut.Renderer(v, t, "cpu").render(camera),
            lumencut.Renderer(v, t, "cpu"),
            lumencut.Settings(),
            lumencut.Measurements(v, t, 2.0),
            lumencut.Tracer(v),
            lumencut.Window(100, 500),
            cpr,
            lumencut.cfa(v, one, pixel_spacing=1.0),
            lumencut.lumen_map(v, one, pixel_spacing=1.0),
            lumencut.spiral(v, one, pixel_spacing=1.0),
            lumencut.endoscopy(v, one, 10.0, size=(24, 20)),
            lumencut.straightened_volume(v, one, 10, 1.0),
            lumencut.uncurl(v, one, camera, 0.5),
            lumencut.untangled(v, t, pixel_spacing=1.0),
            lumencut.compare_centerlines(t, t),
            lumencut.cross_section(v, one, 10.0),
        ]
        self._instances = {type(one).__name__: one for one in made}
        return self._instances

    def arguments(self, name: str, call: Callable[..., Any]) -> dict[str, Any]:
        """Return what the required arguments of a callable are, and all others with their defaults."""
        parameters = inspect.signature(call).parameters.values()
        named = [p for p in parameters if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
        known = {p.name: p.default for p in named}
        asked = {p.name for p in named if p.default is p.empty}
        asked |= {parameter for call, parameter in _ASKED if call == name}
        return {**known, **{parameter: self._value(name, parameter) for parameter in asked}}

    def _value(self, call: str, name: str) -> Any:
        special = {
            ("read_volume", "path"): self.scan,
            ("list_series", "path"): self.folder,
            ("read_centerlines", "path"): self.lines,
            ("Settings.from_file", "path"): self._settings_file(),
            ("trace", "points"): self.vessel.points[::6],
            ("Volume.sample", "points"): self.vessel.points,
            ("trace_mask", "mask"): self.mask,
            ("Settings.look", "name"): "focus",
            ("Vessel", "points"): self.vessel.points,
            ("Volume", "array"): self.volume.array,
            ("Camera", "center"): (0, 0, 0),
            ("Camera.named", "name"): "anterior",
            ("Camera.rotated", "angle"): 0.5,
            ("PlanarReformation.rotated", "angle"): 0.5,
            ("Profile.angle_between", "first"): (5.0, 10.0),
            ("Profile.angle_between", "second"): (15.0, 20.0),
            ("Profile.save", "path"): self.folder / "out.csv",
            ("StraightenedVolume.save", "path"): self.folder / "out.nrrd",
            ("write_centerlines", "path"): self.folder / "out.vtp",
            ("save_animation", "path"): self.folder / "out.webp",
            ("Profile.stenosis", "reference"): [2.0],
            ("save_animation", "frames"): [self.instances()["Frame"]],
            ("Stenosis.group", "vessel"): "carotid",
            ("Window.named", "name"): "cta",
            ("Vessel.named", "name"): "LAD",
            ("Renderer.windowed", "settings"): lumencut.Settings(),
            ("TransferFunction", "points"): [(0.0, (0, 0, 0), 0.0), (9.0, (1, 1, 1), 1.0)],
            ("Camera.panned", "right"): 1.0,
            ("Camera.panned", "up"): 1.0,
            ("Profile.stenosis", "at"): 30.0,
            ("VesselTree.cut", "vessel"): 0,
            ("VesselTree.path", "ids"): [0],
        }
        if call.startswith("Profile.") and name in ("start", "end"):
            return {"start": 5.0, "end": 20.0}[name]
        if (call, name) in special:
            return special[call, name]
        return {
            "renderer": lumencut.Renderer(self.volume, self.tree, "cpu"),
            "scene": self.tree,
            "start": self.camera,
            "end": self.camera,
            "pixel": (12, 10),
            "volume": self.volume,
            "mask": self.mask,
            "direction": (0, 1, 0),
            "up": (0, 0, 1),
            "point": self.vessel.points[12],
            "points": self.vessel.points[:, : 2 if call.endswith("world_from_pixel") else 3],
            "indices": self.vessel.points[:5],
            "traced": self.tree,
            "reference": self.tree,
            "settings": lumencut.Settings(),
            "tree": self.tree,
            "vessel": self.vessel,
            "vessels": [self.vessel],
            "camera": self.camera,
            "path": self.folder / "out.png",
            "at": 10.0,
            "amount": 0.5,
            "seed": self.vessel.points[20],
            "first": self.tree,
            "second": self.tree,
            "width": 400.0,
            "level": 100.0,
            "frames": 3,
            "thickness": 3.0,
            "margin": 2.0,
            "fade": 3.0,
            "opaque": 1.0,
            "transparent": 0.0,
        }.get(name, 1.0)

    def _settings_file(self) -> Path:
        path = self.folder / "settings.toml"
        if not path.exists():
            lumencut.Settings().save(path)
        return path
