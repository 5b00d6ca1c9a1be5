"""All settings with units and defaults.

``make settings`` generates this file from the table of settings in the core.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from lumencut._checked_settings import CheckedSettings
from lumencut._pickles import by_name
from lumencut.focus import Focus
from lumencut.slab import Slab
from lumencut.transfer import TransferFunction
from lumencut.window import Opacity, Window

LevelChoiceName: TypeAlias = Literal["own", "nearest"]
SilhouetteRuleName: TypeAlias = Literal["leap", "gradient"]
ContextName: TypeAlias = Literal["mida", "dvr", "mip", "minip", "average"]
ContextFromName: TypeAlias = Literal["cut", "whole"]


@by_name
@dataclass(frozen=True)
class Settings(CheckedSettings):
    """Settings of the cut surface (Auzinger et al. 2013, section 3) and of the context behind it.

    Parameters
    ----------
    cost_weight : float, 0 to 10000, default 10
        λ of Eq. 2: what one mm beyond a vessel's wall costs (mm of depth per mm).
    preserve_lumen : bool, default True
        Measure distance from the wall, or from the centerline. From the centerline it is measured as if no
        vessel had a radius: under ``lumen_first`` each then has the ``unknown_radius``.
    lumen_first : bool, default True
        Show every lumen unless a nearer lumen hides it: lumen before wall before surroundings, whatever the
        depth.
    lumen_margin : float, 0 to 10000, default 1
        How thick the wall around a lumen is taken to be (mm). With ``lumen_first`` the wall comes after
        every lumen and before all surroundings. With the level choice ``own`` the levels of detail are
        counted from its outside.
    unknown_radius : float, 0 to 10000, default 1
        Radius that ``lumen_first`` takes for vessels without radius, or where it is 0 (mm).
    level_choice : {"own", "nearest"}, default "own"
        Which vessel the levels of detail of a pixel belong to (name): the one that wins the pixel at the
        finest level, or whichever wins at each level, as in the paper.
    centerline_smoothing : float, 0 to 10, default 0
        Smooth each centerline along its length by a Gaussian of this many radii (radii, 0 to 10). Jitter of
        the centerline folds the cut where a vessel runs towards the viewer. Ends, places where vessels meet
        and vessels without radius stay as they are.
    levels : int, 0 to 15, default 6
        Levels of detail beyond the finest (count, 0 to 15).
    level_distance : float, 0.001 to 1000000, default 8
        How far from the vessels one level of detail reaches (mm per level). σ in the paper, as ``levels``
        is N.
    depth_filter : bool, default True
        Smooth the depth with a Gaussian of 7 × 7 pixels.
    zone_filter : bool, default True
        Let the depth filter mix only depths of one vessel that lie on an even surface.
    depth_leap : float, 0 to 1000000, default 1
        How far a pair of neighbours may lie off a straight line before ``zone_filter`` leaves it out (mm).
    samples : int, 1 to 4, default 1
        N × N samples in each pixel, averaged in the picture (count, 1 to 4). Edges become smoother, and the
        picture takes N² times as long. All other images stay those of one sample in the middle of each
        pixel.
    window : Window | {"auto", "cta", "soft-tissue", "bone", "lung", "full", "mra", "stent"}, optional
        Intensities of the cut surface from black to white, LEVEL ± WIDTH/2 (unit of the volume, HU for CT).
        If not given: from the data.
    opacity : Opacity, optional
        Ramp of opacity of the cut surface over intensities (unit of the volume, HU for CT). If not given:
        all opaque.
    silhouettes : bool, default True
        Draw lines where the cut surface leaps.
    silhouette_rule : {"leap", "gradient"}, default "leap"
        Where silhouettes are drawn (name): where the surface leaps, or where the depth is steep, as in the
        paper.
    silhouette_slope : float, 0.001 to 1000000, default 24
        Slope at which a silhouette of the rule ``gradient`` has half its strength (mm of depth per mm).
    silhouette_reach : float or None, 0 to 1000000, default 10
        How far from the nearest wall silhouettes are drawn in full (mm); from there they fade over the same
        length again. Far from all vessels the lines follow borders of zones that mean nothing to a reader.
        Measured in the picture. ``None`` draws them everywhere, as in the paper.
    silhouette_color : (int, int, int), default (255, 220, 0)
        Colour of the silhouettes. Red, green and blue.
    background : (int, int, int, int), default (0, 0, 0, 255)
        Colour behind it all. Red, green, blue and opacity, where there is nothing to show.
    slab : Slab, optional
        Show the largest, mean or smallest value of a slab around the cut surface (mm, from its near to its
        far side). If not given: one point deep.
    focus : Focus, optional
        Show the cut surface around the vessels alone, amid the context (mm). From MARGIN mm beyond the
        nearest wall it fades over FADE mm; both are measured in the picture. A negative margin lets lumens
        fade too. A fade of 0 is a hard edge, any other is at least two pixels wide. It needs centerlines.
        If not given: the cut surface everywhere.
    focus_vessels : tuple of int or str, default ()
        Show lumen and wall of these vessels before all others, whatever the depth (names or ids). It needs
        ``lumen_first``. Silhouettes are drawn then even where ``silhouettes`` leaves them out: a vessel
        that is shown before one nearer to the viewer looks wrong without its outline. All vessels, or none,
        set none apart.
    others_strength : float, 0 to 1, default 0.5
        How much of the other vessels a ``focus`` leaves where ``focus_vessels`` are chosen (number, 0 to
        1). With 0 the context takes their place, with 1 they are shown as the chosen ones are.
    context : {"mida", "dvr", "mip", "minip", "average"} or None, default "mida"
        What is shown where the cut surface is outside the volume or transparent (name): maximum intensity
        difference accumulation, direct volume rendering, largest, smallest or mean value, or the background
        alone.
    context_gamma : float, -1 to 1, default 0
        For mida: -1 is dvr, 0 mida, 1 mip, between them a blend (number, -1 to 1).
    context_window : Window | {"auto", "cta", "soft-tissue", "bone", "lung", "full", "mra", "stent"}, optional
        Intensities that the context takes as 0 to 1, LEVEL ± WIDTH/2 (unit of the volume, HU for CT). They
        are 0 to 1 for the differences of mida, and black to white for minip and average; the named transfer
        functions lie within them. From the data they are taken whatever ``window`` is: as ``Window.whole``
        does for minip and average, as ``Window.for_mip`` does for mip where there are no centerlines, as
        ``Window.from_data`` does for the others. If not given: from the data.
    context_transfer : {"grey", "angio", "bone", "soft-tissue"} or TransferFunction, optional
        Colours and opacities of mida, dvr and mip: grey, angio, bone, soft-tissue, or control points of
        intensity (unit of the volume, HU for CT), colour and opacity of one mm (0 to 1). If not given: grey
        for mip, else angio.
    context_step : float, 0.001 to 1000, optional
        Longest distance between the samples of mida and dvr along a ray (mm). If not given: half the
        smallest side of a voxel, all of it in a preview.
    context_shading : bool, default False
        Shade mida and dvr by the gradient, with light from the viewer.
    context_from : {"cut", "whole"} or None, optional
        Where the rays of the context start around a ``focus`` (name): at the cut surface, or in front of
        the volume. Within the focus they start at the cut surface, wherever they start around it. If not
        given: cut for mida and dvr, else whole.
    context_strength : float, 0 to 1, default 1
        How bright the context is in the picture: what its colours are multiplied by (number, 0 to 1).
    context_preview : bool, default False
        Trace one ray for each square of four pixels: quicker and coarser.

    Raises
    ------
    SettingsError
        For a setting outside its range.
    """

    cost_weight: float = 10.0
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
    samples: int = 1
    window: Window | str | None = None
    opacity: Opacity | None = None
    silhouettes: bool = True
    silhouette_rule: SilhouetteRuleName = "leap"
    silhouette_slope: float = 24.0
    silhouette_reach: float | None = 10.0
    silhouette_color: tuple[int, int, int] = (255, 220, 0)
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
    context_preview: bool = False
