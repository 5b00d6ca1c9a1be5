"""The space of centerlines if both spaces fit the volume: decided by values along the lines, or an error."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from conftest import needs_shared_data
from lumencut import FormatError, Renderer, SpaceWarning, Vessel, VesselTree, Volume, phantom
from lumencut.cli import main
from lumencut.files.centerlines import inspect_centerlines, read_centerlines
from lumencut.files.volumes import read_volume
from lumencut.scene.placement import check_space

FLIP = np.array([-1.0, -1.0, 1.0])


def moved(volume: Volume, tree: VesselTree, by):
    """Move the scene elsewhere in world space."""
    affine = volume.world_from_index.copy()
    affine[:3, 3] += by
    vessels = [Vessel(vessel.points + by, vessel.radius, vessel.name) for vessel in tree]
    return Volume(volume.array, world_from_index=affine), VesselTree(vessels)


def silent(folder: Path, points, radius=None) -> Path:
    """Write a file with one line that states no space."""
    path = folder / "line.csv"
    columns = points if radius is None else np.column_stack([points, radius])
    np.savetxt(
        path, columns, delimiter=",", header="x,y,z" + ("" if radius is None else ",radius"), comments=""
    )
    return path


def tube(noise=0):
    """A volume around the origin with a vessel of 4 mm radius beside it, and points of the vessel."""
    _, j, i = np.mgrid[:70, :61, :61]
    x, y = i - 30.0, j - 30.0
    inside = np.hypot(x - 14, y + 8) < 4
    voxels = np.where(inside, 350, 40) + np.random.default_rng(5).normal(0, noise, inside.shape)
    points = np.column_stack([np.full(100, 14.0), np.full(100, -8.0), np.linspace(-30, 30, 100)])
    return Volume(voxels.astype(np.int16), origin=(-30, -30, -35)), points


@pytest.mark.parametrize(("space", "signs"), [("lps", 1.0), ("ras", FLIP)])
def test_values_along_the_lines_tell_the_space_with_a_warning(space, signs, tmp_path):
    volume, points = tube(noise=30)
    path = silent(tmp_path, points * signs, np.full(len(points), 4.0))
    counts = (
        rf"\d+ look like lumen in {space} and \d+ in \w+: read in {space}; coordinates=\"{space}\" confirms"
    )
    with pytest.warns(SpaceWarning, match=counts):
        tree = read_centerlines(path, volume=volume)
    np.testing.assert_allclose(tree[0].points, points, atol=1e-9)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report = inspect_centerlines(path, volume=volume)
        read_centerlines(path, space, volume=volume)
        # A second use gives no second warning.
        Renderer(volume, tree)
    assert (report.space, report.space_from, report.unit_from, report.is_unusual) == (
        space,
        "values",
        "volume",
        True,
    )


@pytest.mark.parametrize(("space", "signs"), [("lps", 1.0), ("ras", FLIP)])
def test_a_stated_space_is_kept_and_warned_about_where_the_values_speak_against_it(space, signs, tmp_path):
    volume, points = tube()
    rows = "\n".join(" ".join(map(str, p)) for p in points * signs)
    ids = " ".join(map(str, range(len(points))))
    for stated in ("lps", "ras"):
        path = tmp_path / f"{stated}.vtk"
        head = (
            f"# vtk DataFile Version 3.0\n3D Slicer output. SPACE={stated.upper()}\nASCII\nDATASET POLYDATA"
        )
        body = f"POINTS {len(points)} double\n{rows}\nLINES 1 {len(points) + 1}\n{len(points)} {ids}\n"
        path.write_text(f"{head}\n{body}")
        read = points * signs * (FLIP if stated == "ras" else 1.0)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            tree = read_centerlines(path, volume=volume)
        np.testing.assert_allclose(tree[0].points, read, atol=1e-9)
        texts = [str(one.message) for one in told]
        if stated == space:
            assert texts == []
        else:
            (text,) = texts
            assert re.search(r"\d+ look like lumen as read, but \d+ with x and y negated", text), text


def test_a_tree_that_was_read_before_is_compared_by_values_too():
    volume, points = tube()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_space(VesselTree([Vessel(points, 4.0)]), volume)
    with pytest.warns(SpaceWarning, match="look like lumen as read, but"):
        check_space(VesselTree([Vessel(points * FLIP, 4.0)]), volume)


def test_info_tells_the_same_decision(tmp_path):
    volume, points = tube()
    from SimpleITK import GetImageFromArray, WriteImage

    image = GetImageFromArray(volume.array)
    image.SetOrigin((-30.0, -30.0, -35.0))
    WriteImage(image, str(tmp_path / "scan.nrrd"))
    path = silent(tmp_path, points * FLIP, np.full(len(points), 4.0))
    result = CliRunner().invoke(main, ["info", str(tmp_path / "scan.nrrd"), str(path)])
    assert result.exit_code == 0, result.output
    assert "ras (the values of the volume decide)" in result.stdout
    counts = re.search(
        r"\d+ look like lumen in ras and \d+ in lps", inspect_centerlines(path, volume=volume).decision
    )
    assert counts[0] in " ".join(result.stdout.split())


@pytest.mark.parametrize("name", ["crossing", "y_junction", "stenosis", "straight_tube", "helix", "trefoil"])
def test_phantoms_are_never_read_mirrored(name, tmp_path):
    made = getattr(phantom, name)()
    volume, tree = made.volume, made.tree
    for vessel in tree:
        for signs, space in ((1.0, "lps"), (FLIP, "ras")):
            path = silent(tmp_path, vessel.points * signs, vessel.radius)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    report = inspect_centerlines(path, volume=volume)
                except FormatError:
                    continue
            assert report.space == space, (name, report.decision)


REAL = [
    ("stent-cta/stent_cta.nii.gz", "stent-cta/centerlines.vtp"),
    ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/true_lumen_centerline_LPS.vtp"),
    ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/aorta_arch_centerlines_LPS.vtp"),
    ("aorta-mra/aorta.mha", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
]


@needs_shared_data
@pytest.mark.parametrize(("volume", "lines"), REAL)
def test_real_lumens_are_told_or_asked_for_wherever_the_scanner_has_its_origin(
    volume, lines, shared_data, tmp_path
):
    read = read_volume(shared_data / volume)
    tree = read_centerlines(shared_data / lines, "lps", unit="mm")
    middle = (read.world_from_index @ [*(np.asarray(read.size) - 1) / 2, 1.0])[:3] * [1, 1, 0]
    by_values = 0
    for aside in ((0, 0, 0), (10, -10, 0), (-10, 20, 0), (20, 10, 0)):
        scan, moved_tree = moved(read, tree, np.array(aside) - middle)
        points = np.concatenate([vessel.points for vessel in moved_tree])
        radius = np.concatenate([vessel.radius for vessel in moved_tree])
        for signs, space in ((1.0, "lps"), (FLIP, "ras")):
            path = silent(tmp_path, points * signs, radius)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    report = inspect_centerlines(path, volume=scan)
                except FormatError:
                    continue
            assert report.space == space, report.decision
            by_values += report.space_from == "values"
    assert by_values >= 2
