"""The compiled part of the package, kept by hand; `mypy.stubtest` compares names, parameters and defaults.

The stubs that PyO3 0.30 makes know no NumPy arrays, callbacks, constants and typed dictionaries.
"""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Protocol, TypedDict, final

import numpy as np
import numpy.typing as npt
from typing_extensions import disjoint_base

from lumencut.base.mends import MendName, Told
from lumencut.scene.placement import Coordinates, Unit

_Axis = str | npt.NDArray[np.float64]
_Arrays = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None]
_LineDoubt = tuple[int, int | None, str, Told]
_WrittenArrays = tuple[
    npt.NDArray[np.float64], npt.NDArray[np.float64] | None, str | None, npt.NDArray[np.float64] | None
]
_FoundArrays = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64], str]
_FoundParts = tuple[list[_FoundArrays], list[list[int]], list[str]]
_MeasuredParts = tuple[str, str | None, str | None, Profile, Grade | None]
_Pair = tuple[float, float]
#: Ends of a change, both places, diameters and uncertainties, difference and uncertainty (mm).
_ChangeParts = tuple[_Pair, _Pair, _Pair, _Pair, _Pair]
#: Name, named stretches with their ends (mm), and whether the vessel seems to be a vein or the heart.
_Suggested = tuple[str | None, list[tuple[str, tuple[float, float]]], bool]
_MarkParts = tuple[str, float, float, bool, str]
_StoredStenosis = tuple[list[float], list[list[float]], str, tuple[int, bool]]
_NamedArrays = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None, str | None]

class _Marked(Protocol):
    @property
    def at(self) -> float | None: ...
    @property
    def references(self) -> Sequence[float]: ...
    @property
    def method(self) -> str: ...
    @property
    def original(self) -> float | None: ...
    @property
    def comparison(self) -> float | None: ...
    @property
    def diameters(self) -> Sequence[float]: ...
    @property
    def group(self) -> str | None: ...

__all__ = [
    "CENTERLINE_FILES",
    "CHART_FRAME",
    "DEFAULTS",
    "DICOM_ATTRIBUTES",
    "FILE_HEAD",
    "FILE_KINDS",
    "LARGEST_EXTENT",
    "LOOKS",
    "LOOK_SENTENCES",
    "MEASURING_FLAGS",
    "MEASURING_NOTICE",
    "MENDS",
    "MILLIMETRES",
    "PAPER",
    "PIXEL_SIDE",
    "POINT_DISTANCE",
    "QUANTITIES",
    "REORDERED",
    "SECTION_PIXELS",
    "SETTINGS",
    "SIGNS",
    "SMALLEST_EXTENT",
    "SMALLEST_RADIUS",
    "STENOSIS_METHODS",
    "STENOSIS_TERRITORIES",
    "VESSEL_NAMES",
    "VIEWS",
    "VIEW_METHODS",
    "VOLUME_FILES",
    "WINDOW_PRESETS",
    "WRITTEN_CENTERLINES",
    "WRITTEN_VOLUMES",
    "CenterlineFile",
    "Comparison",
    "Cpr",
    "Flattened",
    "Grade",
    "GzipPacker",
    "KeptProfiles",
    "Layout",
    "LumenMap",
    "LumenWall",
    "Profile",
    "Renderer",
    "Setting",
    "Settings",
    "Spiral",
    "Stenosis",
    "Tracer",
    "TreeFindings",
    "Uncurl",
    "Untangled",
    "ValuesAlong",
    "VolumeFill",
    "VolumeOpening",
    "VolumePlan",
    "__version__",
    "about",
    "axes_words",
    "better_place",
    "brightest",
    "c_arm_words",
    "chart_ticks",
    "check_camera",
    "check_cr",
    "check_focus",
    "check_opacity",
    "check_slab",
    "check_transfer_function",
    "check_vessel",
    "check_window",
    "coloured",
    "compare_scans",
    "comparison_report",
    "contains",
    "context_window",
    "correspondence",
    "cross_section",
    "cut",
    "cut_diameter",
    "cut_off_note",
    "describe_dicom",
    "devices",
    "diameter_chart",
    "dicom_directions",
    "doubted_grid",
    "dragged",
    "dragged_window",
    "edge_letters",
    "feature_window",
    "file_kind",
    "find_vessels",
    "find_window",
    "fits_nowhere",
    "fitted",
    "fitted_turn",
    "fitted_uncurling",
    "flag_words",
    "flight",
    "frame_angles",
    "grade",
    "grid_fault",
    "grid_letters",
    "is_session_file",
    "join",
    "judge_dicom",
    "levels",
    "line_doubts",
    "make_phantom",
    "marked_places",
    "meant_place",
    "measure",
    "measured_radii",
    "nifti_units",
    "not_measured_stretches",
    "not_suggested_places",
    "panned",
    "part_name",
    "parts",
    "path",
    "picture",
    "pixel_side",
    "place_mask",
    "placement",
    "positions",
    "profile_csv",
    "profile_from_record",
    "profile_json",
    "profile_marks",
    "profile_record",
    "radius_at",
    "read_session_file",
    "refocused",
    "report_html",
    "report_plan",
    "restored_stenosis",
    "rotated",
    "sample",
    "sampled",
    "scale_bar",
    "scale_end",
    "scan_of",
    "scan_words",
    "section_spacing",
    "set_threads",
    "shows_cut",
    "sides",
    "smoothed",
    "spiral_pitch",
    "spiral_reach",
    "spun",
    "stored_stenosis",
    "straightened_mark",
    "suggest_names",
    "suggested_for",
    "tangential_layout",
    "threads",
    "trace_from",
    "trace_mask",
    "trackballed",
    "tree_findings",
    "vessel_code",
    "vessels_csv",
    "vessels_json",
    "volume_header",
    "write_centerlines",
    "zoomed",
    "zoomed_at",
]

__version__: str

# The table of settings by name, in the order to show them to users.
SETTINGS: dict[str, Setting]
LOOKS: dict[str, dict[str, Any]]
LOOK_SENTENCES: dict[str, str]
PAPER: dict[str, Any]
VESSEL_NAMES: list[str]
WINDOW_PRESETS: list[tuple[str, str, tuple[float, float] | None]]

@final
class Setting:
    @property
    def kind(self) -> str: ...
    @property
    def optional(self) -> bool: ...
    @property
    def default(self) -> Any: ...
    @property
    def range(self) -> tuple[float, float] | None: ...
    @property
    def unit(self) -> str | None: ...
    @property
    def choices(self) -> tuple[str, ...]: ...
    @property
    def open(self) -> str | None: ...
    @property
    def sentence(self) -> str: ...
    @property
    def details(self) -> str: ...

@final
class Settings:
    def __new__(cls, attributes: Any) -> Settings: ...
    def refuse_focus(self) -> None: ...

# The attributes that DICOM series are judged by, and the functional groups that may have each.
DICOM_ATTRIBUTES: dict[str, list[str]]

# The views of the body: direction from the viewer into the scene, and up (LPS).
VIEWS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]]

# The names of all mends of errors.
MENDS: tuple[MendName, ...]

# Of centerlines: millimetres per unit, what brings each space to LPS, which extents (mm) pass for vessels.
MILLIMETRES: dict[Unit, float]
SIGNS: dict[Coordinates, tuple[float, float, float]]
CHART_FRAME: dict[Literal["left", "right", "above", "below", "deviations"], float]
SECTION_PIXELS: dict[Literal["report", "sheet"], int]
MEASURING_FLAGS: list[tuple[str, int, str, str, str, str]]
MEASURING_NOTICE: str
STENOSIS_METHODS: list[tuple[str, str]]
STENOSIS_TERRITORIES: list[str]
VIEW_METHODS: list[tuple[str, str]]
#: By function and parameter, such as ``untangled.width``.
DEFAULTS: dict[str, float]
#: Name, other functions with the parameter, unit, range, default and sentence.
QUANTITIES: list[tuple[str, list[str], str, tuple[float, float], float, str]]
POINT_DISTANCE: float
PIXEL_SIDE: str
SMALLEST_RADIUS: str
#: Identifier, role, format, extensions, and those that are written.
FILE_KINDS: list[tuple[str, str, str, list[str], list[str]]]
FILE_HEAD: int
VOLUME_FILES: str
CENTERLINE_FILES: str
WRITTEN_CENTERLINES: str
WRITTEN_VOLUMES: str
SMALLEST_EXTENT: float
LARGEST_EXTENT: float
#: How the note ends that says of a line that its points were moved.
REORDERED: str

@final
class CenterlineFile:
    def __new__(cls, content: bytes, name: str) -> CenterlineFile: ...
    @property
    def format(self) -> str: ...
    @property
    def space(self) -> str | None: ...
    @property
    def unit(self) -> str | None: ...
    @property
    def conventional_unit(self) -> str: ...
    def parted_doubts(self) -> list[_LineDoubt]: ...
    def vessels(
        self, mm_per_unit: float, reorder: bool
    ) -> tuple[
        list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None, str | None]], list[str]
    ]: ...

@disjoint_base
class Layout:
    @property
    def size(self) -> list[int]: ...
    @property
    def pixel_spacing(self) -> float: ...
    def position(self) -> npt.NDArray[np.float64]: ...
    def arc_length(self) -> npt.NDArray[np.float64]: ...
    def folded(self) -> npt.NDArray[np.bool_]: ...
    def world_from_pixel(self, pixels: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
    def pixel_from_world(self, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...

@final
class Cpr(Layout):
    def __new__(
        cls,
        points: npt.NDArray[np.float64],
        smoothing: float,
        mode: str,
        view: tuple[npt.NDArray[np.float64], float, npt.NDArray[np.float64] | None],
        pixels: tuple[float | None, float],
    ) -> Cpr: ...
    def rotated(self, angle: float) -> Cpr: ...
    def rolled(self, at: npt.NDArray[np.float64], angle: npt.NDArray[np.float64]) -> Cpr: ...
    def world_from_straightened(self, places: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
    def straightened_from_world(self, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
    def straightened_sides(self, step: float, is_stated: bool) -> tuple[list[list[float]], str]: ...

@final
class Flattened(Layout):
    def __new__(cls, curves: list[npt.NDArray[np.float64]], keep: str, pixel_spacing: float) -> Flattened: ...

@final
class Spiral(Layout):
    def __new__(
        cls,
        points: npt.NDArray[np.float64],
        smoothing: float,
        up: Sequence[float],
        lengths: Sequence[float],
        sampling: str,
        angle: float,
    ) -> Spiral: ...

@final
class VolumeOpening:
    def __new__(cls, path: os.PathLike[str], name: str, chosen: list[int] | None, /) -> VolumeOpening: ...
    def add_size(self, name: str, size: int | None, is_outside: bool, /) -> None: ...
    def add_bytes(self, name: str, start: int, content: bytes, /) -> None: ...
    def next(self) -> VolumePlan | list[str] | tuple[str, int, int] | None: ...

@final
class VolumePlan:
    @property
    def format(self) -> str: ...
    @property
    def size(self) -> list[int]: ...
    @property
    def world_from_index(self) -> list[list[float]]: ...
    @property
    def states_spacing(self) -> bool: ...
    @property
    def states_orientation(self) -> bool: ...
    @property
    def space(self) -> str: ...
    @property
    def stored(self) -> tuple[str, bool]: ...
    @property
    def settled(self) -> str | None: ...
    @property
    def voxels(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def remarks(self) -> list[str]: ...
    @property
    def description(self) -> str: ...
    @property
    def label_names(self) -> list[tuple[int, str]]: ...
    @property
    def segmentation(self) -> list[str] | None: ...
    def missing(self) -> Exception: ...
    def fill(self, size: int, /) -> VolumeFill: ...

@final
class VolumeFill:
    def step(
        self, start: int, content: bytes, output: npt.NDArray[np.uint8], /
    ) -> tuple[int, tuple[Any, ...]]: ...

@final
class GzipPacker:
    def __new__(cls) -> GzipPacker: ...
    def pack(self, content: bytes, /) -> bytes: ...
    def end(self) -> bytes: ...

def grid_fault(size: tuple[int, int, int], affine_rows: list[list[float]], /) -> tuple[str, str] | None: ...
def nifti_units(header: bytes, /) -> tuple[float, bool, bool] | None: ...
def volume_header(
    file_format: str,
    size: Sequence[int],
    world_from_index: Sequence[Sequence[float]],
    kind: str,
    mark: str,
    /,
) -> bytes: ...

@final
class LumenWall:
    def __new__(
        cls,
        volume: Any,
        vessel: _Arrays,
        smoothing: float,
        up: Sequence[float],
        profile: Profile | None = None,
    ) -> LumenWall: ...
    @property
    def calcium_level(self) -> float | None: ...
    @property
    def mean_radius(self) -> float: ...
    def roll(self, side: str) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
    def map(
        self,
        volume: Any,
        pixel_spacing: float,
        directions: tuple[float | None, float],
        band: tuple[float, float],
        calcium_level: float | None,
    ) -> LumenMap: ...

@final
class LumenMap(Layout):
    @property
    def angle(self) -> float: ...
    @property
    def overlap(self) -> int: ...
    def wall(self) -> npt.NDArray[np.float64]: ...
    def open(self) -> npt.NDArray[np.bool_]: ...
    def shades(self) -> npt.NDArray[np.float32]: ...
    def thickness(self, volume: Any, band: tuple[float, float], level: float) -> npt.NDArray[np.float32]: ...
    def ostia(
        self, tree: list[_Arrays]
    ) -> list[tuple[int, float, tuple[float, float, float], tuple[float, float]]]: ...

@final
class Untangled(Layout):
    def __new__(
        cls,
        vessels: list[_Arrays],
        camera: Any,
        lengths: tuple[float, ...],
        root: Sequence[float] | None,
    ) -> Untangled: ...
    @property
    def rotations(self) -> list[float]: ...
    @property
    def ends(self) -> list[list[float]]: ...
    @property
    def overlaps(self) -> list[int]: ...
    @property
    def closures(self) -> list[tuple[tuple[float, float], tuple[float, float]]]: ...
    def network(self, along: ValuesAlong) -> npt.NDArray[np.uint8]: ...
    def vessel(self) -> npt.NDArray[np.int32]: ...
    def laid_out(
        self,
    ) -> list[tuple[int, npt.NDArray[np.float64], npt.NDArray[np.float64], float, bool]]: ...

@final
class Uncurl(Layout):
    def __new__(
        cls,
        points: npt.NDArray[np.float64],
        smoothing: float,
        camera: Any,
        amount: float,
        width: float | None = None,
    ) -> Uncurl: ...

def axes_words(reformation: str, number: float = 0.0) -> str: ...
def coloured(
    value: npt.NDArray[np.float32], ends: tuple[float, float], colours: str
) -> npt.NDArray[np.uint8]: ...
def fitted_uncurling(camera: Any, points: npt.NDArray[np.float64], smoothing: float) -> dict[str, Any]: ...
def scale_end(value: npt.NDArray[np.float32]) -> float: ...
def pixel_side(smallest_side: float) -> float: ...
def file_kind(head: bytes | None, name: str = "") -> tuple[str, str, str, str]: ...
def spiral_pitch(
    usual: float, smallest_side: float, radius: float, pixel_spacing: float, columns: float
) -> float: ...
def spiral_reach(largest: float) -> float: ...
def profile_record(profile: Profile) -> str: ...
def stored_stenosis(stenosis: Stenosis) -> _StoredStenosis: ...
def tangential_layout(points: npt.NDArray[np.float64], smoothing: float, camera: Any) -> Layout: ...
def feature_window(feature: str, level: float | None, window: list[float]) -> list[float]: ...

@final
class Tracer:
    def __new__(cls) -> Tracer: ...
    def trace(
        self,
        volume: Any,
        vessels: Sequence[npt.NDArray[np.float64]],
        stoppers: Sequence[tuple[tuple[float, ...], float]],
        bridge: bool,
        callback: Callable[[int, int], object] | None = None,
    ) -> list[
        tuple[
            npt.NDArray[np.float64],
            npt.NDArray[np.float64],
            npt.NDArray[np.float64],
            npt.NDArray[np.bool_],
            list[str],
        ]
    ]: ...

@final
class KeptProfiles:
    def __new__(cls) -> KeptProfiles: ...
    def profile(
        self,
        volume: Any,
        tree: list[_Arrays],
        measured: _Arrays,
        step: float,
        fwhm: float | None = None,
        wall: tuple[float, float] | None = None,
        callback: Callable[[int, int], object] | None = None,
    ) -> Profile: ...

@final
class Comparison:
    @property
    def at(self) -> npt.NDArray[np.float64]: ...
    @property
    def diameter(self) -> npt.NDArray[np.float64]: ...
    @property
    def uncertainty(self) -> npt.NDArray[np.float64]: ...
    @property
    def difference(self) -> npt.NDArray[np.float64]: ...
    @property
    def changes(self) -> list[_ChangeParts]: ...
    @property
    def typical(self) -> float: ...
    @property
    def motion(self) -> npt.NDArray[np.float64]: ...
    @property
    def matched(self) -> tuple[str, float]: ...
    @property
    def lines(self) -> list[str]: ...
    def csv(self) -> str: ...
    def json(self) -> str: ...

@final
class Profile:
    def numbers(self) -> list[tuple[str, npt.NDArray[np.float64]]]: ...
    def uncertainty_parts(self) -> list[tuple[str, npt.NDArray[np.float64]]]: ...
    @property
    def flags(self) -> npt.NDArray[np.uint32]: ...
    @property
    def counts(self) -> npt.NDArray[np.bool_]: ...
    def nearest(self, at: float) -> int: ...
    @property
    def center(self) -> npt.NDArray[np.float64]: ...
    @property
    def normal(self) -> npt.NDArray[np.float64]: ...
    @property
    def axes(self) -> npt.NDArray[np.float64]: ...
    @property
    def contour(self) -> npt.NDArray[np.float64]: ...
    @property
    def outer_contour(self) -> npt.NDArray[np.float64]: ...
    @property
    def outer_wall(self) -> list[str]: ...
    @property
    def own_lumen(self) -> npt.NDArray[np.float64]: ...
    @property
    def other_lumen(self) -> npt.NDArray[np.float64]: ...
    @property
    def flap(self) -> list[str]: ...
    def flap_stretch(self) -> str | None: ...
    def lumens_at(self, n: int) -> str | None: ...
    def outer_volume(self, ends: tuple[float, float]) -> tuple[float, float]: ...
    def outer_stretch(self) -> str | None: ...
    def outer_at(self, n: int) -> str | None: ...
    @property
    def levels(self) -> npt.NDArray[np.float64]: ...
    @property
    def noise(self) -> float: ...
    @property
    def fwhm(self) -> tuple[float, str]: ...
    @property
    def wall_source(self) -> str: ...
    def stenosis(
        self,
        at: float,
        method: str,
        reference: Sequence[float],
        original: float | None = None,
        comparison: float | None = None,
    ) -> Stenosis: ...
    def narrowest(self) -> tuple[float, float] | None: ...
    def throat(self) -> tuple[float, float] | None: ...
    def widest(self) -> tuple[float, float] | None: ...
    def offered_widest(self) -> tuple[float, float] | None: ...
    def suggested_references(
        self, at: float
    ) -> tuple[tuple[float, float] | None, tuple[float, float] | None]: ...
    def diameter_at(self, at: float) -> tuple[float, float]: ...
    def stretch(self, ends: tuple[float, float]) -> tuple[float, float]: ...
    def direction(self, ends: tuple[float, float]) -> list[float]: ...
    def angle_between(self, first: tuple[float, float], second: tuple[float, float]) -> float: ...
    def c_arm(self, ends: tuple[float, float], lao: float | None = None) -> tuple[float, float]: ...

@final
class TreeFindings: ...

@final
class Stenosis:
    def numbers(self) -> tuple[float, float, float, float, float, float]: ...
    @property
    def references(self) -> list[tuple[float, float]]: ...
    @property
    def method(self) -> Literal["nascet", "ecst", "area"]: ...
    @property
    def doubts(self) -> list[str]: ...
    def words(self) -> str: ...
    def doubtful_words(self) -> str: ...
    def group(self, vessel: str) -> str: ...

@final
class ValuesAlong:
    def __new__(
        cls, kind: str, vessels: list[_Arrays], measured: list[tuple[Profile, list[Stenosis]]]
    ) -> ValuesAlong: ...
    @property
    def legend(self) -> tuple[str, str, float, float, str]: ...
    def ranged(self, low: float | None, high: float | None) -> ValuesAlong: ...
    def values(self) -> list[npt.NDArray[np.float32]]: ...

@final
class Grade:
    @property
    def stenosis(self) -> Stenosis | None: ...
    @property
    def group(self) -> str | None: ...
    @property
    def not_graded(self) -> str | None: ...
    def lines(self, profile: Profile) -> list[str]: ...

@final
class Renderer:
    def __new__(cls, vessels: list[_Arrays] | None, device: str) -> Renderer: ...
    @property
    def device(self) -> str: ...
    def with_tree(self, vessels: list[_Arrays] | None) -> Renderer: ...
    def with_other_volume(self) -> Renderer: ...
    def look(self, volume: Any, layout: Layout, settings: Settings, images: list[str]) -> dict[str, Any]: ...
    def aggregate(
        self,
        volume: Any,
        cpr: Cpr,
        settings: Settings,
        feature: tuple[str, float | None],
        pixel_spacing: float,
    ) -> tuple[npt.NDArray[np.float32], int]: ...
    def details(
        self, camera: Any, settings: Settings, before: tuple[Any, npt.NDArray[np.float32]] | None = None
    ) -> dict[str, npt.NDArray[np.float32]]: ...
    def render(
        self,
        volume: Any,
        camera: Any,
        settings: Settings,
        images: list[str] | None = None,
        callback: Callable[[int, int], object] | None = None,
        method: tuple[Any, ...] | None = None,
        along: ValuesAlong | None = None,
        before: tuple[Any, npt.NDArray[np.float32]] | None = None,
    ) -> dict[str, Any]: ...
    def strength(
        self, camera: Any, settings: Settings, method: tuple[Any, ...]
    ) -> npt.NDArray[np.float32]: ...

def about(
    vessel: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None],
    at: float,
    angle: float,
    size: tuple[int, int],
) -> dict[str, Any]: ...
def better_place(
    points: npt.NDArray[np.float64], radii: npt.NDArray[np.float64], volume: Any
) -> tuple[str, tuple[Coordinates, Unit]] | None: ...
def brightest(
    volume: Any, camera: Any, pixel: tuple[float, ...], depths: tuple[float, ...]
) -> list[float]: ...
def c_arm_words(lao: float, cranial: float) -> str: ...
def check_camera(camera: Any) -> list[list[float]]: ...
def check_cr(radius_offset: float, arc_threshold: float) -> None: ...
def check_focus(margin: float, fade: float) -> None: ...
def check_opacity(transparent: float, opaque: float) -> None: ...
def check_slab(thickness: float, mode: str) -> None: ...
def check_transfer_function(points: Sequence[tuple[float, tuple[int, int, int], float]]) -> None: ...
def check_vessel(points: npt.NDArray[np.float64], radius: npt.NDArray[np.float64] | None = None) -> None: ...
def check_window(level: float, width: float) -> None: ...
def context_window(context: str, has_tree: bool) -> str: ...
def contains(volume: Any, points: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]: ...
def correspondence(
    first: npt.NDArray[np.float64], second: npt.NDArray[np.float64]
) -> npt.NDArray[np.int64]: ...
def cross_section(
    volume: Any,
    measured: _Arrays,
    at: float,
    image: tuple[float, float],
    profile: Profile | None = None,
) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float64], list[float], float]: ...
def cut(vessel: tuple[Any, ...], at: float) -> list[tuple[Any, ...]]: ...
def cut_diameter(volume: Any, camera: Any, radius: float) -> float: ...
def join(first: tuple[Any, ...], second: tuple[Any, ...]) -> tuple[Any, ...]: ...
def judge_dicom(headers: bytes, wanted: bytes, /) -> str: ...
def describe_dicom(headers: bytes, /) -> str: ...
def dicom_directions(cosines: tuple[float, ...], line: tuple[float, ...], /) -> tuple[float, ...] | None: ...
def devices() -> list[dict[str, Any]]: ...
def cut_off_note(volume: Any) -> str | None: ...
def doubted_grid(size: tuple[int, int, int], affine_rows: list[list[float]]) -> str | None: ...
def edge_letters(
    right: Sequence[float] | npt.NDArray[np.float64], down: Sequence[float] | npt.NDArray[np.float64]
) -> list[tuple[str, str]]: ...
def fitted(camera: Any, points: npt.NDArray[np.float64]) -> dict[str, Any]: ...
def fitted_turn(
    camera: Any, points: npt.NDArray[np.float64], degrees: float, axis: _Axis
) -> dict[str, Any]: ...
def find_vessels(
    volume: Any,
    smallest_radius: float | None,
    callback: Callable[[int, int], object] | None = None,
) -> _FoundParts: ...
def find_window(name: str, volume: Any, vessels: list[_Arrays] | None) -> tuple[float, float]: ...
def fits_nowhere(points: npt.NDArray[np.float64], volume: Any) -> bool: ...
def flag_words(flags: int) -> list[str]: ...
def flight(start: Any, end: Any, frames: int) -> list[dict[str, Any]]: ...
def frame_angles(frames: int, degrees: float) -> list[float]: ...
def grade(profile: Profile, marked: _Marked) -> Grade | None: ...
def is_session_file(content: bytes) -> bool: ...
def levels(vessels: list[_Arrays], count: int) -> list[list[_Arrays]]: ...
def line_doubts(vessels: list[tuple[_Arrays, str | None]], beside: bool) -> list[_LineDoubt]: ...
def marked_places(profile: Profile, marked: _Marked) -> list[_MarkParts]: ...
def measure(
    volume: Any,
    measured: _Arrays,
    step: float,
    fwhm: float | None = None,
    tree: list[_Arrays] | None = None,
    wall: tuple[float, float] | None = None,
    estimates: TreeFindings | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Profile: ...
def measured_radii(
    volume: Any,
    vessels: list[_Arrays],
    step: float,
    fwhm: float | None = None,
    wall: tuple[float, float] | None = None,
    callback: Callable[[int, int], object] | None = None,
) -> list[tuple[npt.NDArray[np.float64] | None, int, int]]: ...
def meant_place(vessel: _Arrays, point: tuple[float, ...], pixel_spacing: float) -> tuple[float, bool]: ...
def not_measured_stretches(profile: Profile) -> list[str]: ...
def not_suggested_places(profile: Profile, at: float | None, references: Sequence[float]) -> list[str]: ...
def panned(camera: Any, right: float, up: float) -> dict[str, Any]: ...
def grid_letters(directions: npt.NDArray[np.float64]) -> tuple[str, float]: ...
def picture(value: npt.NDArray[np.float32], settings: Settings) -> npt.NDArray[np.uint8]: ...
def placement(
    subject: str,
    points: npt.NDArray[np.float64],
    radii: npt.NDArray[np.float64],
    known: Mapping[str, str | None],
    volume: Any,
) -> dict[str, Any]: ...
def positions(camera: Any, depth: npt.NDArray[np.float32]) -> npt.NDArray[np.float64]: ...
def chart_ticks(low: float, high: float, length: float, is_along: bool) -> list[float]: ...
def diameter_chart(profile: Profile, height: float) -> _DiameterChart: ...
def section_spacing(profile: Profile, pixels: int) -> float: ...
def profile_csv(profile: Profile) -> str: ...
def profile_json(profile: Profile) -> str: ...
def profile_marks(profile: Profile, at: float | None, references: Sequence[float]) -> list[_MarkParts]: ...
def read_session_file(content: bytes, name: str) -> str: ...
def part_name(taken: list[str], whole: str) -> str: ...
def compare_scans(
    profiles: tuple[Profile, Profile],
    pairs: Sequence[tuple[float, float]],
    vessel: str,
    scans: tuple[str, str],
    stated: tuple[tuple[str, str, str], tuple[str, str, str]],
    other_patient: bool,
) -> Comparison: ...
def comparison_report(vessels: Sequence[Comparison]) -> str: ...
def suggest_names(vessels: list[_Arrays], volume: Any = None) -> list[_Suggested]: ...
def suggested_for(name: str, suggested: str) -> str | None: ...
def parts(lines: list[npt.NDArray[np.float64]]) -> list[list[int]]: ...
def path(vessels: list[_Arrays], words: list[str]) -> _Arrays: ...
def radius_at(vessel: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None], at: float) -> float: ...
def refocused(
    camera: Any, vessel: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None]
) -> dict[str, Any]: ...
def report_html(
    options: Mapping[str, Any], window: tuple[float, float], pages: Sequence[Mapping[str, Any]]
) -> str: ...
def report_plan(
    profile: Profile, places: Sequence[tuple[str, float, bool]]
) -> tuple[float, float, list[float]]: ...
def rotated(camera: Any, angle: float, axis: _Axis) -> dict[str, Any]: ...
def sample(volume: Any, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float32]: ...
def scale_bar(width: float, pixel_spacing: float) -> tuple[float, str, float] | None: ...
def profile_from_record(text: str) -> Profile: ...
def restored_stenosis(stored: _StoredStenosis) -> Stenosis: ...
def scan_of(profile: Profile) -> tuple[str | None, str | None, str | None, float | None, str | None]: ...
def scan_words(scan: Any) -> str: ...
def set_threads(count: int) -> None: ...
def shows_cut(
    renderer: Renderer, volume: Any, camera: Any, settings: Settings, pixel: tuple[float, ...]
) -> bool: ...
def sides(direction: Sequence[float] | npt.NDArray[np.float64]) -> str: ...
def straightened_mark(text: str) -> tuple[str, list[str]] | None: ...
def smoothed(vessels: list[_Arrays], radii: float) -> list[npt.NDArray[np.float64]]: ...
def threads() -> int: ...
def tree_findings(
    volume: Any,
    tree: list[_Arrays],
    step: float,
    fwhm: float | None = None,
    wall: tuple[float, float] | None = None,
) -> TreeFindings: ...
def trace_from(
    volume: Any,
    seed: tuple[float, float, float],
    smallest_radius: float | None,
    callback: Callable[[int, int], object] | None = None,
) -> _FoundParts: ...
def place_mask(
    mask: tuple[list[int], list[list[float]]], volume: tuple[list[int], list[list[float]]], always: bool
) -> tuple[list[int], list[bool], list[int], str] | None: ...
def trace_mask(
    mask: Any,
    volume: Any | None,
    labels: list[int] | None,
    lengths: tuple[float, float, float],
    callback: Callable[[int, int], object] | None = None,
) -> _TracedMask: ...
def vessel_code(name: str) -> tuple[tuple[str, str], tuple[str, str] | None] | None: ...
def vessels_csv(measured: list[_MeasuredParts]) -> str: ...
def vessels_json(options: Mapping[str, Any], measured: list[_MeasuredParts]) -> str: ...
def write_centerlines(vessels: list[_WrittenArrays], kind: str) -> bytes: ...
def zoomed(camera: Any, factor: float) -> dict[str, Any]: ...
def trackballed(camera: Any, pivot: npt.NDArray[np.float64], drag: tuple[float, float]) -> dict[str, Any]: ...
def spun(
    camera: Any, pivot: npt.NDArray[np.float64], axis: npt.ArrayLike, right: float
) -> dict[str, Any]: ...
def dragged(camera: Any, drag: tuple[float, float]) -> dict[str, Any]: ...
def zoomed_at(camera: Any, factor: float, pixel: tuple[float, float]) -> dict[str, Any]: ...
def sampled(camera: Any, share: float) -> tuple[tuple[int, int], float]: ...
def dragged_window(window: tuple[float, float], drag: tuple[float, float]) -> tuple[float, float]: ...

class _DiameterChart(TypedDict):
    width: list[float]
    range: list[list[float]]
    spread: list[list[float]]
    isolated: list[int]
    left_out: list[list[float]]
    top: float
    limit: tuple[float, str] | None
    flags: list[tuple[str, str, list[list[float]]]]
    row: float

class _TracedMask(TypedDict):
    vessels: list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64], int, bool]]
    gaps: list[
        tuple[float, tuple[int, int], tuple[tuple[float, float, float], tuple[float, float, float]], bool]
    ]
    notes: list[str]

class _Phantom(TypedDict):
    name: str
    array: npt.NDArray[np.int16]
    world_from_index: npt.NDArray[np.float64]
    vessels: list[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], str]]
    reference_radius: list[npt.NDArray[np.float64]]
    stenoses: list[dict[str, Any]]
    plaques: list[dict[str, Any]]

def make_phantom(name: str, *, percent: float = 50.0, seed: int = 0, scale: float = 1.0) -> _Phantom:
    """The phantom that the function of this name in `lumencut.phantom` returns, in plain parts."""
