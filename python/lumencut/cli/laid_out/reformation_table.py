"""A table of the commands of reformations, with their help texts and options."""

from __future__ import annotations

from functools import partial

import click

from lumencut._lumencut import SETTINGS, WRITTEN_VOLUMES
from lumencut.cli import options
from lumencut.cli.dicom import grey_option
from lumencut.cli.laid_out import reformation_options as shared
from lumencut.cli.laid_out.cfa import FEATURES, show_cfa
from lumencut.cli.laid_out.cpr import MODES, show_cpr
from lumencut.cli.laid_out.each import show_each
from lumencut.cli.laid_out.flatten import show_flattened
from lumencut.cli.laid_out.inside_table import ENDOSCOPY, FLY
from lumencut.cli.laid_out.reformation_options import command, option
from lumencut.cli.laid_out.uncurl import show_uncurled
from lumencut.cli.laid_out.untangled import show_network, show_untangled
from lumencut.cli.parameters import SIZE, VECTOR, Parts
from lumencut.cli.settings import rim_option

#: `MODES` of `lumencut.reformations.unrolled_wall`; copied so that `--help` does not import numpy.
MAP_MODES = ("wall", "radius", "thickness", "shaded")

VALUES = tuple(SETTINGS["rim"].choices)


_CPR = command(
    "cpr",
    show_cpr,
    "Lay vessels out as images (CPR).",
    """Lay out the vessels of CENTERLINES with their surroundings in VOLUME: Curved Planar Reformation.

    All vessels are shown side by side, each below its id and name, unless --vessel, --exclude or --path
    choose among them.

    \b
    lumencut cpr ct.nii.gz centerlines.vtp -o vessels.png
    lumencut cpr ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --angle 45 --slab 2mm:mean
    lumencut cpr ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --mode tangential --view left
    lumencut cpr ct.nii.gz lines.vtp -o leg.png --path 0,1,4 --mode stretched --volume-out leg.nrrd
    """,
    (
        shared.PICTURES,
        option(
            "--mode",
            MODES,
            "projected: as the viewer sees the vessel; stretched: the surface through it unrolled; "
            "straightened: along its length; tangential: in the picture of a view, with the tissue at the "
            "same depth. Distances are true in stretched and straightened images.",
            "straightened",
        ),
        option(
            "--view",
            options.VIEW,
            f"The view of --mode tangential, default anterior: {', '.join(options.VIEW_NAMES)}, or "
            "the direction from the viewer into the scene (LPS).",
            metavar="NAME|X,Y,Z",
        ),
        option(
            "--size",
            SIZE,
            "Size of the picture of --mode tangential (pixels); default: 768x768.",
            metavar=SIZE.name,
        ),
        *shared.VESSELS,
        option(
            "--angle",
            "DEGREES",
            "Move the viewer to the right from the front: around the up axis, or around the vessel where it "
            "is straightened.",
            0.0,
            is_shown=False,
        ),
        option(
            "--roll",
            ("narrowest", "widest"),
            "See each section of the straightened vessel from the angle at which its lumen is narrowest or "
            "widest, so that an eccentric stenosis stays visible; a strip next to the picture shows the "
            "angle.",
        ),
        shared.UP,
        option("--width", "MM", "Width of the image (mm); default: 25 mm on each side of the vessel."),
        shared.SIDE,
        shared.SMOOTHING,
        option(
            "--volume-out",
            options.FILE,
            f"Write the sections across one vessel as a volume too ({WRITTEN_VOLUMES}, or a name without "
            "an ending: a new folder for a DICOM series).",
        ),
    ),
)

_CFA = command(
    "cfa",
    show_cfa,
    "Show all around vessels, straightened (CFA).",
    """Show what surrounds the vessels of CENTERLINES, straightened: curvicircular feature aggregation.

    Each pixel next to a vessel stands for the half circle around it on that side, so one picture shows all
    around the vessel. All vessels are shown side by side, each below its id and name, unless --vessel,
    --exclude or --path choose among them.

    \b
    lumencut cfa ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --radius 8
    lumencut cfa ct.nii.gz centerlines.vtp -o sheet.png --path 0,1,4 --beside cpr
    lumencut cfa ct.nii.gz centerlines.vtp -o calcium.png --feature share --level 500
    """,
    (
        shared.PICTURES,
        option(
            "--feature",
            FEATURES,
            "What to show of a half circle. max: calcium and metal; min: whether the lumen is open; mean; "
            "range: how uneven the surroundings are; share: the part above --level.",
            "max",
        ),
        option("--radius", "MM", "The largest circle (mm).", 10.0),
        option("--level", "VALUE", "--feature share counts values above this level."),
        option(
            "--beside",
            ("cpr",),
            "Show the straightened CPR, CFA max and CFA min of each vessel side by side.",
        ),
        *(*shared.VESSELS, shared.UP, shared.SIDE, shared.SMOOTHING),
    ),
)

_SPIRAL = command(
    "spiral",
    partial(show_each, "spiral"),
    "Show vessels as spirals of their sections (spiral CPR).",
    """Show the vessels of CENTERLINES as spirals of their sections: all around a vessel in one still picture.

    The width of anything in a row is its area in the section, divided by the pitch.

    \b
    lumencut spiral ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD
    lumencut spiral ct.nii.gz centerlines.vtp -o graft.png --path 0,1,2 --pitch 2
    """,
    (
        shared.PICTURES,
        *shared.VESSELS,
        option(
            "--pitch",
            "MM",
            "Distance between neighbouring windings (mm); default: a quarter of the median radius, at least "
            "the smallest side of a voxel.",
        ),
        option(
            "--radius",
            "MM",
            "How far the spiral reaches from the vessel (mm); default: 1.25 times its largest radius plus "
            "2 mm.",
        ),
        option(
            "--sampling",
            ("arc", "angle"),
            "arc: samples a pixel apart, so that widths are areas; angle: every winding has the same width.",
            "arc",
        ),
        option("--angle", "DEGREES", "Turn the sections.", 0.0),
        shared.UP,
        shared.SIDE,
        shared.SMOOTHING,
    ),
)

_UNCURL = command(
    "uncurl",
    show_uncurled,
    "Show a vessel being straightened (film).",
    """Show a vessel of CENTERLINES with its surroundings as it is straightened: from the body to its CPR.

    Its lengths stay true throughout. Of several vessels the longest is shown, unless --vessel or --path name
    one.

    \b
    lumencut uncurl ct.nii.gz centerlines.vtp -o film.webp --path 0,1,4
    lumencut uncurl ct.nii.gz centerlines.vtp -o half.png --vessel LAD --amount 0.5 --view left
    """,
    (
        shared.output(
            "Film (.webp, .apng, .mp4, .dcm, frame-%03d.png or a folder), or with --amount a picture (.png, "
            ".dcm, .npz, …)."
        ),
        option(
            "--amount",
            click.FloatRange(0, 1),
            "One picture at this amount: 0 as in the body, 1 straight.",
            metavar="0..1",
        ),
        option("--frames", click.IntRange(2, 10000), "Number of frames.", 48),
        option("--fps", click.FloatRange(0.1, 100), "Frames per second.", 24),
        *shared.VESSELS,
        option(
            "--width",
            "MM",
            "Show the tissue within half of this on each side of the vessel; default: all of the picture.",
        ),
        *(
            options.view_options,
            shared.SMOOTHING,
        ),
    ),
    (grey_option,),
)

_MAP = command(
    "map",
    partial(show_each, "map"),
    "Unroll the walls of vessels (lumen map).",
    """Cut the walls of the vessels of CENTERLINES open and unroll them: the lumen map.

    Rows are along the vessel, columns go once around it. Branches open as holes. All vessels are shown side
    by side, each below its id and name, unless --vessel, --exclude or --path choose among them.

    \b
    lumencut map ct.nii.gz centerlines.vtp -o stent.png --path 0,1,2
    lumencut map ct.nii.gz centerlines.vtp -o calcium.png --vessel LAD --mode thickness
    """,
    (
        shared.PICTURES,
        option(
            "--mode",
            MAP_MODES,
            "wall: the volume at the wall, such as calcium and struts; radius: how far the wall is from the "
            "centerline, in colour; thickness: thickness of calcium or metal at the wall, in colour; shaded: "
            "the wall as a surface lit from within.",
            "wall",
        ),
        *shared.VESSELS,
        option(
            "--angle",
            "DEGREES",
            "The direction around the vessel in the middle; 0 is to the right of the straightened CPR. "
            "Default: the side with most calcium, so that the cut does not run through it.",
        ),
        option(
            "--overlap", "DEGREES", "How much of the other side is repeated beyond each edge, dimmed.", 15.0
        ),
        option(
            "--band",
            Parts("FROM:TO", ":", float),
            "The band beyond the wall that is searched (mm).",
            "-1:3",
        ),
        option("--show", ("max", "mean", "min"), "Which value of this band --mode wall shows.", "max"),
        option(
            "--calcium-level",
            "LEVEL",
            "Calcium or metal at the wall begins at this level; default: the lumen's level plus half "
            "of its contrast, at least 130.",
        ),
        shared.UP,
        shared.SIDE,
        shared.SMOOTHING,
    ),
)

_UNTANGLED = command(
    "untangled",
    show_untangled,
    "Show a vessel tree without overlap (untangled CPR).",
    """Cut every vessel of CENTERLINES open in one picture without overlap: untangled CPR.

    Each vessel keeps its direction in the view and its true length. Branches that would overlap are turned at
    their origin by the smallest angle that separates them; arcs show turns of more than 5°. With more than
    about 15 vessels, choose among them by --vessel or --exclude.

    \b
    lumencut untangled ct.nii.gz centerlines.vtp -o tree.png
    lumencut untangled ct.nii.gz centerlines.vtp -o legs.png --view left --exclude SMA --slab 4mm:mean
    """,
    (
        shared.output("Picture (.png, .tif, .webp, …), or .npz for the arrays."),
        *(options.shown_vessel_options, options.direction_options),
        option(
            "--width", "MM", "How far from each vessel its surroundings are shown (mm), on each side.", 25.0
        ),
        option("--hull-margin", "MM", "Margin around the lumen that no other vessel may enter (mm).", 2.0),
        option(
            "--smoothing",
            "MM",
            "Smooth the directions of vessels in the view by a Gaussian with this standard deviation (mm).",
            4.0,
        ),
        shared.SIDE,
        option(
            "--root",
            VECTOR,
            "Point (mm, LPS) near the end of the vessel from which the tree grows; default: the free end "
            "with the largest radius.",
        ),
        option("--unknown-radius", "MM", "Radius of vessels that have none (mm); default: 1."),
    ),
)

_NETWORK = command(
    "network",
    show_network,
    "Map a vessel tree, coloured by diameter.",
    """Draw the vessels of CENTERLINES as lines of true length, as wide as the vessels: a network map.

    Colours show the diameter, or another value that the command measures in VOLUME. The layout is that of
    lumencut untangled.

    \b
    lumencut network ct.nii.gz centerlines.vtp -o map.png
    lumencut network ct.nii.gz session.lumencut.json -o map.png --value narrowing
    """,
    (
        shared.output("Picture (.png, .tif, .webp, …), .dcm (DICOM), or .npz for the arrays."),
        *(options.shown_vessel_options, options.direction_options),
        option("--value", VALUES, "What the colours show.", "diameter"),
        rim_option,
        option("--hull-margin", "MM", "Margin around each vessel that no other may enter (mm).", 4.0),
        shared.SIDE,
    ),
)

_FLATTEN = command(
    "flatten",
    show_flattened,
    "Show the surface through several curves as a flat image.",
    """Show the surface through the curves of CENTERLINES as a flat image, such as both rims of a jaw.

    The curves stand in their order in the file, from one side of the surface to the other. Lines cross all
    of them at equal shares of their lengths. Lengths are true along what is kept, and in the middle
    across it.

    \b
    lumencut flatten ct.nii.gz rims.mrk.json -o jaw.png --slab 4mm:mean
    """,
    (
        shared.output("Picture (.png, .tif, .webp, …), or .npz for the arrays."),
        option("--keep", ("lines", "rows"), "Keep the lengths along lines, or along the curves.", "lines"),
        shared.SIDE,
    ),
)

COMMANDS = (_CPR, _CFA, _SPIRAL, _UNCURL, _MAP, _UNTANGLED, _NETWORK, _FLATTEN, ENDOSCOPY, FLY)
