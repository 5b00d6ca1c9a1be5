"""All settings with units and defaults.

``make generate`` generates this file from the table of settings in the core.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from lumencut.base.pickles import by_name
from lumencut.scene.checked_settings import CheckedSettings
from lumencut.scene.focus import Focus
from lumencut.scene.slab import Slab
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import Opacity, Window

DistanceRuleName: TypeAlias = Literal["local", "whole curve"]
LevelChoiceName: TypeAlias = Literal["own", "nearest"]
SilhouetteRuleName: TypeAlias = Literal["leap", "gradient"]
RimName: TypeAlias = Literal["diameter", "narrowing", "deviation", "uncertainty"]
TreeName: TypeAlias = Literal["hidden", "wireframe"]
ContextName: TypeAlias = Literal["mida", "dvr", "mip", "minip", "average"]
ContextFromName: TypeAlias = Literal["cut", "whole"]


@by_name
@dataclass(frozen=True)
class Settings(CheckedSettings):
    """Settings of the cut surface (Auzinger et al. 2013, section 3) and of the context behind it.

    Parameters
    ----------
    cost_weight : float, 0 to 10000, default 10
        λ of Eq. 2: the cost of one mm beyond the wall of a vessel (mm of depth per mm).
    distance_rule : {"local", "whole curve"}, default "local"
        Distance that the cost counts (name): to the piece of the vessel that a pixel could show
        (``local``), or to the entire vessel as in Eq. 2 (``whole curve``). With ``whole curve``, a vessel
        that crosses itself hides its farther part. Slow; not with ``lumen_first``.
    preserve_lumen : bool, default True
        Measure distances from the vessel wall instead of the centerline. When off, every vessel counts as
        having no radius; ``lumen_first`` then uses ``unknown_radius``.
    lumen_first : bool, default True
        Order pixels by lumen, wall and surroundings at any depth; only a nearer lumen hides a lumen.
    lumen_margin : float, 0 to 10000, default 1
        Assumed thickness of the wall around a lumen (mm). With ``lumen_first``, the wall ranks after every
        lumen and before all surroundings. With the level choice ``own``, the levels of detail start at its
        outside.
    unknown_radius : float, 0 to 10000, default 1
        Radius that ``lumen_first`` uses for vessels whose radius is missing or 0 (mm).
    level_choice : {"own", "nearest"}, default "own"
        Vessel whose levels of detail a pixel uses (name): the winner at the finest level (``own``), or the
        winner at each level as in the paper (``nearest``).
    centerline_smoothing : float, 0 to 10, default 0
        Standard deviation of the Gaussian that smooths each centerline along its length (radii, 0 to 10).
        Jitter of a centerline folds the cut where a vessel runs towards the viewer. Ends, junctions and
        vessels without radius do not change.
    levels : int, 0 to 15, default 6
        Number of levels of detail beyond the finest (count, 0 to 15). N in the paper.
    level_distance : float, 0.001 to 1000000, default 8
        Width of one level of detail, as distance from the vessels (mm per level). σ in the paper.
    depth_filter : bool, default True
        Smooth the depth with a Gaussian of 7 × 7 pixels.
    zone_filter : bool, default True
        Restrict the depth filter to depths of one vessel on a smooth surface.
    depth_leap : float, 0 to 1000000, default 1
        Largest deviation of a pair of neighbours from a straight line that ``zone_filter`` accepts (mm).
    turning_limit : float, 0.1 to 1000, optional
        Largest change of depth outside lumen and wall while a view turns (mm per degree). Only turntables
        and the turning view of the viewer use it. The surroundings then lag behind those of the still
        picture, by at most half of ``cost_weight`` times their distance from the wall. If not given: no
        limit.
    samples : int, 1 to 4, default 1
        Average N × N samples per pixel (count, 1 to 4). Edges become smoother, and the picture takes N²
        times as long. All other images keep one sample at the centre of each pixel.
    edge_samples : int, 1 to 4, default 3
        Average N × N samples per pixel at silhouettes of the rule ``leap``, unless ``samples`` exceeds 1
        (count, 1 to 4).
    window : Window, or a name of `Window.named`, optional
        Intensities of the cut surface from black to white, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        If not given: from the data.
    opacity : Opacity, optional
        Intensities between which the cut surface changes from transparent to opaque (unit of the volume, HU
        for CT). If not given: all opaque.
    silhouettes : bool, default True
        Draw lines where the depth of the cut surface jumps.
    silhouette_rule : {"leap", "gradient"}, default "leap"
        Rule that places silhouettes (name): where the surface jumps (``leap``), or where the depth is steep
        as in the paper (``gradient``).
    silhouette_slope : float, 0.001 to 1000000, default 24
        Slope at which the rule ``gradient`` draws a silhouette at half strength (mm of depth per mm).
    silhouette_reach : float or None, 0 to 1000000, default 10
        Distance from the nearest wall up to which silhouettes have full strength (mm); they fade over the
        same distance again. Distances are measured in the picture. ``None`` draws silhouettes everywhere,
        as in the paper; far from vessels they only mark borders of zones.
    far_rim : float, 0 to 1, default 0.3
        Darken the farther side of a depth jump where ``silhouette_reach`` hides its line (number, 0 to 1).
    occlusion : float, 0 to 1, default 0
        Darken the cut where it lies deeper than around it (number, 0 to 1), but not lumen and wall.
    silhouette_color : (int, int, int), default (255, 220, 0)
        Colour of the silhouettes. Red, green and blue.
    rim : {"diameter", "narrowing", "deviation", "uncertainty"} or None, optional
        Colour a rim around the vessels by values along them (name): ``diameter`` (mm), ``narrowing`` of
        graded stenoses (%), ``deviation`` from their reference (mm) or ``uncertainty`` of the diameter
        (mm). Lumen, wall, calcium and metal keep their grey. Diameters come from profiles, otherwise from
        radii; all else needs profiles. Labels of the picture explain the colours. If not given: no rim.
    rim_low : float, -10000 to 10000, optional
        Value of the first colour of the ``rim`` (mm, or % for ``narrowing``). If not given: from the
        values.
    rim_high : float, -10000 to 10000, optional
        Value of the last colour of the ``rim`` (mm, or % for ``narrowing``). If not given: from the values.
    tree : {"hidden", "wireframe"}, default "hidden"
        Vessel walls over the picture (name): ``hidden``, or ``wireframe`` for rings across and lines along
        the vessels. Wires show the radii of the centerlines, ``unknown_radius`` where there is none; only
        the picture has them.
    background : (int, int, int, int), default (0, 0, 0, 255)
        Colour of pixels that show nothing else. Red, green, blue and opacity.
    slab : Slab, optional
        Show the largest, mean or smallest value in a slab (mm) centred on the cut surface. If not given: no
        slab.
    focus : Focus, optional
        Show the cut surface only near the vessels, surrounded by the context (mm). It fades over FADE mm,
        starting MARGIN mm beyond the nearest wall; both are measured in the picture. A negative margin lets
        lumens fade too. A fade of 0 is a hard edge; any other is at least two pixels wide. Needs
        centerlines. If not given: the cut surface everywhere.
    focus_vessels : tuple of int or str, default ()
        Show lumen and wall of these vessels in front of all others at any depth (names or ids). Needs
        ``lumen_first``. Silhouettes are then drawn even if ``silhouettes`` is off: without outlines, a
        farther vessel in front looks wrong. All vessels or none: no vessel is highlighted.
    others_strength : float, 0 to 1, default 0.5
        Share of the other vessels that a ``focus`` keeps when ``focus_vessels`` are chosen (number, 0 to
        1). At 0 the context replaces them; at 1 they look like the chosen ones.
    context : {"mida", "dvr", "mip", "minip", "average"} or None, default "mida"
        What to show where the cut surface is outside the volume or transparent (name): ``mida``, ``dvr``,
        ``mip``, ``minip``, ``average``, or only the background (``None``). ``mida`` is maximum intensity
        difference accumulation, ``dvr`` direct volume rendering; ``mip``, ``minip`` and ``average`` are the
        largest, smallest and mean value along each ray.
    context_gamma : float, -1 to 1, default 0
        Blend for ``mida`` (number, -1 to 1): -1 is ``dvr``, 0 ``mida``, 1 ``mip``.
    context_window : Window, or a name of `Window.named`, optional
        Intensities that the context maps to 0 to 1, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        ``mida`` scales its differences by it; ``minip`` and ``average`` show it from black to white; named
        transfer functions lie within it. If not given, it comes from the data whatever ``window`` is:
        ``Window.whole`` for ``minip`` and ``average``, ``Window.for_mip`` for ``mip`` without centerlines,
        otherwise ``Window.from_data``. If not given: from the data.
    context_transfer : {"grey", "angio", "bone", "soft-tissue"} or TransferFunction, optional
        Colours and opacities of ``mida``, ``dvr`` and ``mip``: grey, angio, bone, soft-tissue, or control
        points of intensity (unit of the volume, HU for CT), colour and opacity per mm (0 to 1). If not
        given: grey for mip, otherwise angio.
    context_step : float, 0.001 to 1000, optional
        Longest distance between samples of ``mida`` and ``dvr`` along a ray (mm). If not given: half the
        smallest voxel side, two sides in a preview.
    context_shading : bool, default False
        Shade ``mida`` and ``dvr`` by the gradient, with light from the viewer.
    context_from : {"cut", "whole"} or None, optional
        Start of the context rays around a ``focus`` (name): at the cut surface, or in front of the volume.
        Within the focus they always start at the cut surface. If not given: cut for mida and dvr, otherwise
        whole.
    context_strength : float, 0 to 1, default 1
        Brightness of the context: factor of its colours (number, 0 to 1).
    context_halo : float, 0 to 1, default 0
        Darken the context around a ``focus`` (number, 0 to 1).
    context_body : bool, default False
        Outline the body if the scan shows air around it; not in previews.
    context_preview : bool, default False
        Trace one ray per 6 × 6 pixels: faster and coarser.

    Raises
    ------
    SettingsError
        For a setting outside its range.
    """

    cost_weight: float = 10.0
    distance_rule: DistanceRuleName = "local"
    preserve_lumen: bool = True
    lumen_first: bool = True
    lumen_margin: float = 1.0
    unknown_radius: float = 1.0
    level_choice: LevelChoiceName = "own"
    centerline_smoothing: float = 0.0
    levels: int = 6
    level_distance: float = 8.0
    depth_filter: bool = True
    zone_filter: bool = True
    depth_leap: float = 1.0
    turning_limit: float | None = None
    samples: int = 1
    edge_samples: int = 3
    window: Window | str | None = None
    opacity: Opacity | None = None
    silhouettes: bool = True
    silhouette_rule: SilhouetteRuleName = "leap"
    silhouette_slope: float = 24.0
    silhouette_reach: float | None = 10.0
    far_rim: float = 0.3
    occlusion: float = 0.0
    silhouette_color: tuple[int, int, int] = (255, 220, 0)
    rim: RimName | None = None
    rim_low: float | None = None
    rim_high: float | None = None
    tree: TreeName = "hidden"
    background: tuple[int, int, int, int] = (0, 0, 0, 255)
    slab: Slab | None = None
    focus: Focus | None = None
    focus_vessels: tuple[int | str, ...] = ()
    others_strength: float = 0.5
    context: ContextName | None = "mida"
    context_gamma: float = 0.0
    context_window: Window | str | None = None
    context_transfer: str | TransferFunction | None = None
    context_step: float | None = None
    context_shading: bool = False
    context_from: ContextFromName | None = None
    context_strength: float = 1.0
    context_halo: float = 0.0
    context_body: bool = False
    context_preview: bool = False
