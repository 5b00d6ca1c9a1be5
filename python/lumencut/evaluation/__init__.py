"""Evaluations: how much of the truth methods show, in numbers, over views from all sides."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

from lumencut._checks import integers, number
from lumencut.camera import Camera
from lumencut.errors import CameraError, SettingsError, VesselTreeError, VolumeError
from lumencut.evaluation.amounts import Amounts, Columns, pooled
from lumencut.evaluation.centerline import Centerline, Stations, centerline_of, width_stations
from lumencut.evaluation.engine import shown_by
from lumencut.evaluation.measures import MEASURES, columns_of, criteria_of
from lumencut.evaluation.methods import METHODS, USUAL, Method, checked_methods
from lumencut.evaluation.own_pictures import COUNTED, nothing_shown, own_amounts
from lumencut.evaluation.result import Evaluation, Row
from lumencut.evaluation.truth import Truth, truth_of
from lumencut.evaluation.views import cameras
from lumencut.renderer import Renderer
from lumencut.settings import Settings
from lumencut.vessel_tree import VesselTree

__all__ = ["Evaluation", "evaluate"]

_MOST_VIEWS = 10_000

#: What is counted of a method in one view, by measure.
_Counts = dict[str, Amounts]


def evaluate(
    volume: Any,
    tree: VesselTree,
    methods: Iterable[str] = USUAL,
    views: int = 12,
    settings: Settings | None = None,
    size: tuple[int, int] = (512, 512),
    pixel_spacing: float | None = None,
    *,
    device: Literal["auto", "cpu", "gpu"] = "auto",
    progress: Callable[[int, int], object] | None = None,
) -> Evaluation:
    """Measure how much of the truth methods show of a vessel tree, over views from all sides.

    The truth is computed anew in 64-bit floats from the centerline as it is given: at each pixel the depth of
    the nearest lumen. Vessels without radius, or where it is 0, count as lumen to ``unknown_radius``. Shares
    are those of all views together.

    Parameters
    ----------
    volume : Volume, an image of SimpleITK, itk, nibabel or vtk, datasets of pydicom, or None
        The angiography; without it there are neither surroundings nor pictures.
    tree : VesselTree
        Its centerlines.
    methods : iterable of str, default ("csr", "csr-paper", "cpr", "mpcpr", "cr")
        ``"csr"``: Curved Surface Reformation with the settings; ``"csr-paper"``: with the paper's rules,
        see :meth:`Settings.paper`, and the settings for all others; ``"mpcpr"`` and ``"cr"``: those of
        :func:`lumencut.mpcpr` and of :func:`lumencut.cr` with its usual thresholds; ``"cpr"``: the projected
        CPR of each vessel by itself, an image for each vessel, of which each is compared with the truth about
        that vessel alone. Its numbers are those of all these images together: a crossing is one of a vessel
        with itself, and nothing is hidden by another vessel. ``"untangled"``, not among the defaults, is
        :func:`lumencut.untangled`, whose pixels are not those of the view: of it the tissue and the points of
        the centerline are counted, all of them, and all other numbers are None. It needs a volume.
    views : int, default 12
        How many views, spread evenly over the sphere; the same number gives the same views.
    settings : Settings, optional
        The knobs; their defaults where not given.
    size : (int, int), default (512, 512)
        Width and height of the views (pixels).
    pixel_spacing : float, optional
        Side of a pixel (mm); the tree fits each view where not given.
    device : {"auto", "cpu", "gpu"}, default "auto"
        What computes, as for :class:`Renderer`.
    progress : function of (done, total), optional
        Called with the number of frames that are done, of all methods, and how many there are.

    Returns
    -------
    Evaluation
        Its ``table`` has a row for each method with these numbers, in the order of the five criteria of the
        questionnaire in section 5 of the paper; docs/method/measuring.md defines each. A number is None where
        there is nothing that it could be of.

        Lumen: lumen_within_0.05_mm_percent, lumen_within_0.5_mm_percent, lumen_within_2_mm_percent
            Pixels within a lumen whose depth is that of the nearest one within 0.05, 0.5 and 2 mm, of
            lumen_pixels. The depth of a lumen is that of its centerline at the nearest place in the image, as
            CSR shows it; CPR and mpCPR cut through a lumen at other depths.
        Lumen: width_error_mean_mm, width_error_95_percent_mm, width_error_max_mm, width_bias_mm
            Mean, 95th percentile and maximum of the absolute error of the width of vessels (mm), and the mean
            of the signed one, at width_stations stations; width_stations_left_out could not be judged.
        Surroundings: tissue_percent
            Pixels that show a value of the volume where they look; None without a volume.
        Surroundings: unbroken_surroundings_percent
            Pixels straight beside vessels, up to 20 mm from the wall and up to the next lumen, that the cut
            reaches from the vessel without a leap.
        Surroundings: blended_sheets_percent
            Pixels that blend sheets of different vessels, or of one vessel more than 20 mm of arc length
            apart.
        Visibility: lumen_shown_percent
            Pixels within a lumen, of lumen_pixels, that show a point within the lumen of the nearest vessel
            there, wherever in it.
        Visibility: visible_centerline_percent
            Points of the centerline without a nearer lumen before them that are shown within 0.05 mm;
            centerline_points of them were judged. hidden_centerline_points are behind a nearer lumen,
            centerline_points_off_lumen have a pixel whose centre lies in no lumen, and
            centerline_points_outside are beside the picture.
        Depth: crossings_in_order_percent, crossings, crossings_left_out
            Crossings in projection at which the nearer vessel is shown, how many there are, and how many
            could not be judged.
        Depth: depth_change_per_degree_mm, jumps_per_degree_percent, zone_changes_per_degree_percent
            When the camera turns by one degree: mean change of the depth (mm) and pixels whose depth changes
            by more than 5 mm, both where there is a depth before and after, and pixels that come into the
            zone of another vessel.
        Silhouettes: leaps_with_line_percent, lines_elsewhere_mm_per_mm2, leaps
            Leaps of the depth with a silhouette, the length of silhouettes elsewhere (mm per mm²), and how
            many leaps there are; None for methods without silhouettes.

    Raises
    ------
    SettingsError
        For an unknown method, none, one named twice, or a number of views beyond its range.
    CameraError
        For a size or pixel spacing out of range.
    VesselTreeError, VolumeError, DeviceError
        As for :class:`Renderer`.
    KeyboardInterrupt
        At Ctrl-C.
    """
    names = checked_methods(methods)
    renderer = _renderer(volume, tree, device)
    looks = _cameras(tree, views, size, pixel_spacing)
    if not isinstance(settings, (Settings, type(None))):
        raise SettingsError("settings", type(settings).__name__, "Settings or None")
    if volume is None and any(METHODS[name].own_picture for name in names):
        raise VolumeError("volume of the evaluation", "None", "a volume for the method 'untangled'")
    chosen = {name: METHODS[name].settings(settings or Settings()) for name in names}
    counts = _counts(renderer, tree, looks, chosen, progress or (lambda done, total: None))
    table: list[Row] = [
        {"method": name, "views": len(looks), **_columns(name, _pooled(counts[name]))} for name in names
    ]
    rows: list[Row] = [
        {"method": name, "view": view, **_columns(name, found)}
        for name in names
        for view, found in enumerate(counts[name])
    ]
    criteria = criteria_of(_pooled(counts[names[0]]))
    first = {next(iter(columns)): criterion for criterion, columns in criteria.items()}
    return Evaluation(table, rows, looks, chosen, renderer, first)


def _renderer(volume: Any, tree: Any, device: Literal["auto", "cpu", "gpu"]) -> Renderer:
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("tree", type(tree).__name__, "a VesselTree, such as read_centerlines returns")
    return Renderer(volume, tree, device)


def _cameras(tree: VesselTree, views: Any, size: Any, pixel_spacing: Any) -> tuple[Camera, ...]:
    (count,) = integers(SettingsError, "views", [views], 1, _MOST_VIEWS, 1)
    spacing = None if pixel_spacing is None else number(CameraError, "pixel_spacing", pixel_spacing)
    return cameras(tree, count, size, spacing)


@dataclass(frozen=True, eq=False)
class _Part:
    """Vessels of which a method makes an image: all of the tree, or a single one."""

    renderer: Renderer
    line: Centerline
    stations: tuple[Stations, int]

    def truth(self, camera: Camera) -> Truth:
        """What is true of them in a view."""
        return truth_of(self.line, camera, self.stations)


def _part(renderer: Renderer, tree: VesselTree, unknown_radius: float) -> _Part:
    line = centerline_of(tree, unknown_radius)
    return _Part(renderer, line, width_stations(line))


def _counts(
    renderer: Renderer,
    tree: VesselTree,
    looks: tuple[Camera, ...],
    chosen: dict[str, Settings],
    progress: Callable[[int, int], object],
) -> dict[str, list[_Counts]]:
    """Count everything in each view, for all methods by the same truth."""
    # No method changes the unknown radius.
    unknown = next(iter(chosen.values())).unknown_radius
    whole = _part(renderer, tree, unknown)
    single = []
    if any(METHODS[name].has_image_per_vessel for name in chosen):
        parts = (VesselTree([vessel]) for vessel in tree)
        single = [_part(renderer._with_part(part), part, unknown) for part in parts]
    counts: dict[str, list[_Counts]] = {name: [] for name in chosen}
    total = len(looks) * len(chosen)
    for done, camera in enumerate(looks):
        truth = whole.truth(camera)
        for further, (name, settings) in enumerate(chosen.items(), 1):
            method = METHODS[name]
            if method.has_image_per_vessel:
                images = (
                    _counted(method, part.renderer, camera, part.truth(camera), settings) for part in single
                )
                counts[name].append(_pooled(list(images)))
            else:
                counts[name].append(_counted(method, renderer, camera, truth, settings))
            progress(done * len(chosen) + further, total)
    return counts


def _counted(method: Method, renderer: Renderer, camera: Camera, truth: Truth, settings: Settings) -> _Counts:
    """Count everything in one image."""
    has_frame = method.own_picture is None
    shown = shown_by(method, renderer, camera, settings) if has_frame else nothing_shown(truth)
    counts = {key: measure.amounts(truth, shown) for key, measure in MEASURES.items()}
    if method.own_picture is None:
        return counts
    return {**counts, **own_amounts(method.own_picture(renderer, camera, settings), truth)}


def _columns(name: str, counts: _Counts) -> Columns:
    """The numbers of a method; None for those that only pixels of the view have."""
    return columns_of(counts, None if METHODS[name].own_picture is None else COUNTED)


def _pooled(views: list[_Counts]) -> _Counts:
    return {name: pooled([view[name] for view in views]) for name in MEASURES}
