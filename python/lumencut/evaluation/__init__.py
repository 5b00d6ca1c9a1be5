"""Evaluation: how much of the truth each method shows, over views from all sides."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

from lumencut.base.checks import integers, number
from lumencut.errors import CameraError, SettingsError, VesselTreeError, VolumeError
from lumencut.evaluation.amounts import Amounts, Columns, pooled
from lumencut.evaluation.centerline import Centerline, Stations, centerline_of, width_stations
from lumencut.evaluation.measures import MEASURES, columns_of, criteria_of
from lumencut.evaluation.methods import METHODS, USUAL, Method, checked_methods, shown_by
from lumencut.evaluation.own_pictures import COUNTED, nothing_shown, own_amounts
from lumencut.evaluation.result import Evaluation, Row
from lumencut.evaluation.truth import Truth, truth_of
from lumencut.evaluation.views import cameras
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree

__all__ = ["Evaluation", "evaluate"]

_MOST_VIEWS = 10_000

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

    The truth is the depth of the nearest lumen at each pixel, computed in 64-bit floats from the given
    centerline, without code of the engine. If a vessel has no radius, or 0, ``unknown_radius`` is used.
    Shares are over all views together.

    Parameters
    ----------
    volume : Volume, an image of SimpleITK, itk, nibabel or vtk, datasets of pydicom, or None
        The angiography; needed for surroundings and pictures.
    tree : VesselTree
        Its centerlines.
    methods : iterable of str, default ("csr", "csr-paper", "cpr", "mpcpr", "cr")
        ``"csr"``: Curved Surface Reformation with the settings. ``"csr-paper"``: the same with the paper's
        rules, see :meth:`Settings.paper`. ``"mpcpr"`` and ``"cr"``: :func:`lumencut.mpcpr` and
        :func:`lumencut.cr` with default thresholds. ``"cpr"``: the projected CPR of each vessel in its own
        image, compared with the truth about that vessel only; the numbers cover all images, so crossings are
        of a vessel with itself and no other vessel hides it. ``"untangled"``: :func:`lumencut.untangled`,
        which needs a volume. Its pixels are not those of the view, so only tissue and all centerline points
        are counted; other numbers are None.
    views : int, default 12
        Number of views, evenly spread over the sphere; the same number gives the same views.
    settings : Settings, optional
        Rendering settings; default: ``Settings()``.
    size : (int, int), default (512, 512)
        Width and height of the views (pixels).
    pixel_spacing : float, optional
        Side of a pixel (mm); default: each view fits the tree.
    device : {"auto", "cpu", "gpu"}, default "auto"
        Device for rendering, as for :class:`Renderer`.
    progress : function of (done, total), optional
        Called with the numbers of finished frames and of all frames, over all methods.

    Returns
    -------
    Evaluation
        Its ``table`` has a row for each method with these numbers, in the order of the five criteria of the
        questionnaire in section 5 of the paper; docs/results/accuracy.md explains them. A number is None if
        it is undefined.

        Lumen: lumen_within_0.05_mm_percent, lumen_within_0.5_mm_percent, lumen_within_2_mm_percent
            Share of lumen_pixels whose depth is that of the nearest lumen within 0.05, 0.5 and 2 mm. The
            depth of a lumen is that of the nearest point of its projected centerline, as in CSR; CPR and
            mpCPR cut lumens at other depths.
        Lumen: width_error_mean_mm, width_error_95_percent_mm, width_error_max_mm, width_bias_mm
            Mean, 95th percentile and maximum of the absolute error of vessel widths, and mean of the signed
            error (mm), at width_stations stations; width_stations_left_out could not be measured.
        Surroundings: tissue_percent
            Pixels whose position has a value of the volume; None without a volume.
        Surroundings: unbroken_surroundings_percent
            Pixels across the vessel, up to 20 mm from the wall and up to the next lumen, that the cut reaches
            from the vessel without a jump in depth.
        Surroundings: blended_sheets_percent
            Pixels that blend sheets of different vessels, or of one vessel more than 20 mm of arc length
            apart.
        Visibility: lumen_shown_percent
            Share of lumen_pixels that show some point within the lumen of the nearest vessel.
        Visibility: visible_centerline_percent
            Share of centerline_points, which no nearer lumen hides, shown within 0.05 mm. Not counted:
            hidden_centerline_points lie behind a nearer lumen, centerline_points_off_lumen have a pixel whose
            centre lies in no lumen, centerline_points_outside lie outside the picture.
        Depth: crossings_in_order_percent, crossings, crossings_left_out
            Share of crossings in projection that show the nearer vessel, their number, and the number not
            counted.
        Depth: depth_change_per_degree_mm, jumps_per_degree_percent, zone_changes_per_degree_percent
            When the camera turns by one degree: mean change of depth (mm) and share of pixels that change by
            more than 5 mm, where both depths exist; share of pixels that change their vessel.
        Depth: slides_per_degree_percent, slides_per_degree_max_percent
            Share of pixels whose depth then jumps by more than 5 mm beyond the motion of the surface, as
            zones slide. Of all views together, and of the worst view.
        Silhouettes: leaps_with_line_percent, lines_elsewhere_mm_per_mm2, leaps
            Share of depth jumps with a silhouette, length of silhouettes elsewhere (mm per mm²), and number
            of jumps; None for methods without silhouettes.

    Raises
    ------
    SettingsError
        For an unknown, missing or repeated method, or a number of views out of range.
    CameraError
        For a size or pixel spacing out of range.
    VesselTreeError, VolumeError, DeviceError
        As for :class:`Renderer`.
    KeyboardInterrupt
        At Ctrl-C.
    """
    names = checked_methods(methods)
    renderer = _renderer(volume, tree, device)
    seen_from = _cameras(tree, views, size, pixel_spacing)
    if not isinstance(settings, (Settings, type(None))):
        raise SettingsError("settings", type(settings).__name__, "Settings or None")
    if volume is None and any(METHODS[name].own_picture for name in names):
        raise VolumeError("volume of the evaluation", "None", "a volume for the method 'untangled'")
    chosen = {name: METHODS[name].settings(settings or Settings()) for name in names}
    counts = _counts(renderer, tree, seen_from, chosen, progress or (lambda done, total: None))
    table: list[Row] = [
        {"method": name, "views": len(seen_from), **_columns(name, _pooled(counts[name]))} for name in names
    ]
    rows: list[Row] = [
        {"method": name, "view": view, **_columns(name, found)}
        for name in names
        for view, found in enumerate(counts[name])
    ]
    criteria = criteria_of(_pooled(counts[names[0]]))
    first = {next(iter(columns)): criterion for criterion, columns in criteria.items()}
    return Evaluation(table, rows, seen_from, chosen, renderer, first)


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
    """The vessels of one image: either the entire tree or a single vessel."""

    renderer: Renderer
    line: Centerline
    stations: tuple[Stations, int]

    def truth(self, camera: Camera) -> Truth:
        """Return the truth about these vessels in a view."""
        return truth_of(self.line, camera, self.stations)


def _part(renderer: Renderer, tree: VesselTree, unknown_radius: float) -> _Part:
    line = centerline_of(tree, unknown_radius)
    return _Part(renderer, line, width_stations(line))


def _counts(
    renderer: Renderer,
    tree: VesselTree,
    views: tuple[Camera, ...],
    chosen: dict[str, Settings],
    progress: Callable[[int, int], object],
) -> dict[str, list[_Counts]]:
    """Return the counts of each view, for all methods compared with the same truth."""
    # All methods use the same unknown radius.
    unknown = next(iter(chosen.values())).unknown_radius
    whole = _part(renderer, tree, unknown)
    single = []
    if any(METHODS[name].has_image_per_vessel for name in chosen):
        parts = (VesselTree([vessel]) for vessel in tree)
        single = [_part(renderer._with_part(part), part, unknown) for part in parts]
    counts: dict[str, list[_Counts]] = {name: [] for name in chosen}
    total = len(views) * len(chosen)
    for done, camera in enumerate(views):
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
    """Return the counts of one image."""
    has_frame = method.own_picture is None
    shown = shown_by(method, renderer, camera, settings) if has_frame else nothing_shown(truth)
    counts = {key: measure.amounts(truth, shown) for key, measure in MEASURES.items()}
    if method.own_picture is None:
        return counts
    return {**counts, **own_amounts(method.own_picture(renderer, camera, settings), truth)}


def _columns(name: str, counts: _Counts) -> Columns:
    """Return the numbers of a method; None for numbers that need the pixels of the view."""
    return columns_of(counts, None if METHODS[name].own_picture is None else COUNTED)


def _pooled(views: list[_Counts]) -> _Counts:
    return {name: pooled([view[name] for view in views]) for name in MEASURES}
