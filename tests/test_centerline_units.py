"""Units of lines and scans: none is silently wrong, and the proposed remedy gives the right lines."""

import json
import logging
import warnings
from pathlib import Path

import nibabel
import numpy as np
import pytest
from click.testing import CliRunner

from lumencut.base.mends import as_option
from lumencut.cli import main
from lumencut.errors import FormatError, SpaceWarning
from lumencut.files.centerlines import inspect_centerlines, read_centerlines
from lumencut.files.volumes import inspect_volume, read_volume
from lumencut.pictures.renderer import Renderer
from lumencut.scene.images import as_volume
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume


def line(length: float) -> np.ndarray:
    """A bent line of about this length near the origin (mm, LPS)."""
    z = np.linspace(-0.4, 0.6, 60) * length
    return np.stack([6 + 5 * np.sin(z / 20), -3 + 4 * np.cos(z / 25), z], axis=-1)


def volume_around(points: np.ndarray, *, is_bright: bool) -> Volume:
    """A volume with voxels of 1 mm around the origin, with or without a bright lumen along the points."""
    low = np.floor(np.minimum(points.min(axis=0), 0) - 40)
    size = np.ceil(np.maximum(points.max(axis=0), 0) + 40 - low).astype(int)
    values = np.zeros(size[::-1], np.int16)
    if is_bright:
        k, j, i = np.indices(values.shape)
        x, y = (np.interp(k + low[2], points[:, 2], points[:, axis]) for axis in (0, 1))
        inside = (np.hypot(i + low[0] - x, j + low[1] - y) < 3) & (k + low[2] >= points[0, 2])
        values[inside & (k + low[2] <= points[-1, 2])] = 400
    return Volume(values, origin=low)


def write(folder: Path, kind: str, points: np.ndarray) -> Path:
    """Write lines to a file that states nothing, its space, or its space and mm."""
    path = folder / ("line.mrk.json" if kind == "mrk" else "line.csv")
    if kind == "mrk":
        controls = [{"position": point.tolist()} for point in points]
        curve = {"type": "Curve", "coordinateSystem": "LPS", "controlPoints": controls}
        path.write_text(json.dumps({"markups": [curve]}))
    else:
        rows = "\n".join(",".join(map(repr, point.tolist())) for point in points)
        path.write_text(f"{kind}\n{rows}\n")
    return path


def read(path: Path, volume: Volume, **stated: str):
    """Return the lines and the warnings, or the error."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            return read_centerlines(path, volume=volume, **stated), [str(one.message) for one in caught]
        except FormatError as error:
            return error, []


def is_true(tree: VesselTree, points: np.ndarray) -> bool:
    return np.allclose(tree[0].points, points, atol=1e-6)


def test_advice_for_lines_in_metres_beside_a_scan_with_the_origin_is_right(tmp_path):
    points = line(72.0)
    volume = volume_around(points, is_bright=False)
    path = write(tmp_path, "x,y,z", points / 1000)
    with pytest.raises(FormatError, match=r"lps in m .* across") as caught:
        read_centerlines(path, volume=volume)
    assert 'coordinates="lps" and unit="m"' in str(caught.value)
    assert "--coordinates ras and --unit m" in caught.value.written(as_option)
    with pytest.warns(SpaceWarning, match="across, but 60 in lps in m"):
        tree = read_centerlines(path, "lps", volume=volume)
    assert is_true(tree, points)


def test_what_a_file_states_is_believed_and_doubted(tmp_path, caplog):
    points = line(72.0)
    volume = volume_around(points, is_bright=False)
    path = write(tmp_path, "mrk", points / 10)
    with pytest.warns(
        SpaceWarning, match=r'the lines are 7\.\d+ mm across in mm, .*7\d\.?\d* mm.* unit="cm"'
    ) as caught:
        tree = read_centerlines(path, volume=volume)
    assert len(caught) == 1
    assert caught[0].filename == __file__
    np.testing.assert_allclose(tree[0].points, points / 10)
    assert 'unit="cm"' in inspect_centerlines(path, volume=volume).doubt
    read_centerlines(path)
    assert "the lines are 7" in caplog.text
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_centerlines(path, unit="mm", volume=volume)
        assert is_true(read_centerlines(path, unit="cm", volume=volume), points)


def test_the_command_line_doubts_units_too(tmp_path):
    points = line(72.0)
    volume = volume_around(points, is_bright=True)
    affine = np.diag([-1.0, -1, 1, 1]) @ volume.world_from_index
    scan = tmp_path / "ct.nii.gz"
    nibabel.save(nibabel.Nifti1Image(volume.array.T, affine), scan)
    path = write(tmp_path, "mrk", points / 10)
    info = CliRunner().invoke(main, ["info", str(scan), str(path)])
    assert "! the lines are 7" in info.output
    assert "--unit cm" in info.output
    measured = CliRunner().invoke(main, ["measure", str(scan), str(path), "-o", str(tmp_path / "out.csv")])
    assert "the lines are 7" in measured.output
    assert "--unit cm" in measured.output


def test_a_tree_of_a_few_voxels_is_doubted_where_it_meets_a_volume():
    points = line(72.0)
    tree = VesselTree([Vessel(points / 1000)])
    with pytest.warns(
        SpaceWarning, match=r"60 of 60 points .* as read, 0\.07\d* mm across, but 60 1000.* times"
    ):
        Renderer(volume_around(points, is_bright=False), tree)


def scan_in(folder: Path, unit: int, spacing: float) -> Path:
    image = nibabel.Nifti1Image(np.zeros((8, 9, 40), np.int16), np.diag([spacing, spacing, spacing, 1.0]))
    image.header["xyzt_units"] = unit
    path = folder / "scan.nii"
    nibabel.save(image, path)
    return path


@pytest.mark.parametrize(
    ("unit", "spacing", "words"),
    [
        (1, 0.5, "20000 mm long by its header; perhaps it is 20 mm long"),
        (2, 0.005, "0.2 mm long by its header; perhaps it is 200 mm long"),
        (2, 0.5, None),
        (3, 500.0, None),
    ],
)
def test_a_scan_of_no_size_of_a_body_is_doubted(unit, spacing, words, tmp_path, caplog):
    path = scan_in(tmp_path, unit, spacing)
    read_volume(path)
    told = [
        caplog.text,
        "\n".join(inspect_volume(path).notes),
        CliRunner().invoke(main, ["info", str(path)]).output,
    ]
    caplog.clear()
    as_volume(nibabel.load(path))
    for text in [*told, caplog.text]:
        assert (words or "long by its header") in text if words else "by its header" not in text


def test_a_scan_in_metres_by_nrrd_is_doubted(tmp_path, caplog):
    head = (
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 40\nencoding: raw\nspace: left-posterior-superior\n"
    )
    grid = (
        'space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nspace origin: (0,0,0)\nspace units: "m" "m" "m"\n\n'
    )
    path = tmp_path / "scan.nrrd"
    path.write_bytes((head + grid).encode() + bytes(8 * 8 * 40))
    with caplog.at_level(logging.WARNING, "lumencut"):
        read_volume(path)
    assert "the scan is 20000 mm long" in caplog.text
