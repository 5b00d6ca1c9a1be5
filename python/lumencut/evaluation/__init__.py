"""Evaluations: how much of the truth methods show, in numbers, over views from all sides."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Literal

from lumencut._checks import integers, number
from lumencut.camera import Camera
from lumencut.errors import CameraError, SettingsError, VesselTreeError
from lumencut.evaluation.amounts import Amounts, pooled
from lumencut.evaluation.centerline import centerline_of, width_stations
from lumencut.evaluation.engine import shown_by
from lumencut.evaluation.measures import MEASURES, columns_of
from lumencut.evaluation.methods import METHODS, checked_methods
from lumencut.evaluation.result import Evaluation, Row
from lumencut.evaluation.truth import truth_of
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
    methods: Iterable[str] = ("csr", "csr-paper"),
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
    methods : iterable of str, default ("csr", "csr-paper")
        ``"csr"``: Curved Surface Reformation with the settings; ``"csr-paper"``: with the paper's rules,
        see :meth:`Settings.paper`, and the settings for all others.
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
        Its ``table`` has a row for each method with these numbers; METHOD.md, `evaluate`, defines each. A
        number is None where there is nothing that it could be of.

        visible_centerline_percent
            Points of the centerline without a nearer lumen before them that are shown within 0.05 mm;
            centerline_points of them were judged. hidden_centerline_points are behind a nearer lumen,
            centerline_points_off_lumen have a pixel whose centre lies in no lumen, and
            centerline_points_outside are beside the picture.
        lumen_within_0.05_mm_percent, lumen_within_0.5_mm_percent, lumen_within_2_mm_percent
            Pixels within a lumen whose depth is that of the nearest one within 0.05, 0.5 and 2 mm, of
            lumen_pixels.
        width_error_mean_mm, width_error_95_percent_mm, width_error_max_mm, width_bias_mm
            Mean, 95th percentile and maximum of the absolute error of the width of vessels (mm), and the mean
            of the signed one, at width_stations stations; width_stations_left_out could not be judged.
        blended_sheets_percent
            Pixels that blend sheets of different vessels, or of one vessel more than 20 mm of arc length
            apart.
        tissue_percent
            Pixels that show a value of the volume on the cut surface; None without a volume.
        depth_change_per_degree_mm, jumps_per_degree_percent, zone_changes_per_degree_percent
            When the camera turns by one degree: mean change of the depth (mm), pixels whose depth changes by
            more than 5 mm, and pixels that come into the zone of another vessel.
        leaps_with_line_percent, lines_elsewhere_mm_per_mm2, leaps
            Leaps of the depth with a silhouette, the length of silhouettes elsewhere (mm per mm²), and how
            many leaps there are; None for methods without silhouettes.
        crossings_in_order_percent, crossings, crossings_left_out
            Crossings in projection at which the nearer vessel is shown, how many there are, and how many
            could not be judged.

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
    chosen = {name: METHODS[name].settings(settings or Settings()) for name in names}
    counts = _counts(renderer, tree, looks, chosen, progress or (lambda done, total: None))
    table: list[Row] = [
        {"method": name, "views": len(looks), **columns_of(_pooled(counts[name]))} for name in names
    ]
    rows: list[Row] = [
        {"method": name, "view": view, **columns_of(found)}
        for name in names
        for view, found in enumerate(counts[name])
    ]
    return Evaluation(table, rows, looks, chosen, renderer)


def _renderer(volume: Any, tree: Any, device: Literal["auto", "cpu", "gpu"]) -> Renderer:
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("tree", type(tree).__name__, "a VesselTree, such as read_centerlines returns")
    return Renderer(volume, tree, device)


def _cameras(tree: VesselTree, views: Any, size: Any, pixel_spacing: Any) -> tuple[Camera, ...]:
    (count,) = integers(SettingsError, "views", [views], 1, _MOST_VIEWS, 1)
    spacing = None if pixel_spacing is None else number(CameraError, "pixel_spacing", pixel_spacing)
    return cameras(tree, count, size, spacing)


def _counts(
    renderer: Renderer,
    tree: VesselTree,
    looks: tuple[Camera, ...],
    chosen: dict[str, Settings],
    progress: Callable[[int, int], object],
) -> dict[str, list[_Counts]]:
    """Count everything in each view, for all methods by the same truth."""
    # No method changes the unknown radius.
    line = centerline_of(tree, next(iter(chosen.values())).unknown_radius)
    stations = width_stations(line)
    counts: dict[str, list[_Counts]] = {name: [] for name in chosen}
    total = len(looks) * len(chosen)
    for done, camera in enumerate(looks):
        truth = truth_of(line, camera, stations)
        for further, (name, settings) in enumerate(chosen.items(), 1):
            shown = shown_by(METHODS[name], renderer, camera, settings)
            counts[name].append({key: measure.amounts(truth, shown) for key, measure in MEASURES.items()})
            progress(done * len(chosen) + further, total)
    return counts


def _pooled(views: list[_Counts]) -> _Counts:
    return {name: pooled([view[name] for view in views]) for name in MEASURES}
