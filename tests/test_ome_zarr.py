"""OME-Zarr: grids, channels, what is written, and what is rejected."""

import functools
import http.server
import json
import shutil
import socket
import threading
import zipfile

import numpy as np
import pytest
import zarr
from click.testing import CliRunner

import lumencut
from lumencut import (
    FileError,
    FormatError,
    Volume,
    phantom,
)
from lumencut.cli import main
from lumencut.files.ome_zarr import stores
from lumencut.files.ome_zarr.writing import write_ome_zarr
from lumencut.scene.volume_pyramid import VolumePyramid
from zarr_images import halved, write_image


@pytest.fixture(scope="module")
def voxels():
    """Two levels of random voxels."""
    finest = np.random.default_rng(4).integers(-500, 1500, (24, 40, 32), np.int16)
    return [finest, halved(finest)]


@pytest.fixture(scope="module")
def stenosis(tmp_path_factory):
    """A phantom, and the same volume as a pyramid on disk."""
    made = phantom.stenosis()
    path = tmp_path_factory.mktemp("pyramid") / "scan.ome.zarr"
    write_ome_zarr(made.volume, path)
    return made, path


@pytest.mark.parametrize("version", ["0.4", "0.5"])
def test_levels_and_grids_are_those_of_the_metadata(tmp_path, voxels, version):
    write_image(tmp_path / "a.ome.zarr", voxels, version=version)
    read = lumencut.read_volume(tmp_path / "a.ome.zarr")
    assert isinstance(read, VolumePyramid)
    assert read.bytes_read == 0
    assert [level.size for level in read.levels] == [(32, 40, 24), (16, 20, 12)]
    np.testing.assert_allclose(read.spacing, (0.5, 1.0, 2.0))
    np.testing.assert_allclose(read.levels[1].world_from_index[:3, 3], (0.25, 0.5, 1.0))
    assert (read.states_spacing, read.states_orientation) == (True, False)
    np.testing.assert_array_equal(read.array, voxels[0])
    # Corners of both levels lie at the same place.
    ends = [level.world_from_index[:3, 3] - level.spacing / 2 for level in read.levels]
    np.testing.assert_allclose(*ends)


@pytest.mark.parametrize(("unit", "side"), [("micrometer", 1e-3), ("centimeter", 10.0)])
def test_lengths_are_in_the_unit_of_the_axes(tmp_path, voxels, unit, side):
    write_image(tmp_path / "a.zarr", voxels, unit=unit)
    np.testing.assert_allclose(
        lumencut.read_volume(tmp_path / "a.zarr").spacing, np.array([0.5, 1, 2]) * side
    )


def test_without_a_unit_one_millimetre_is_assumed_in_words(tmp_path, voxels, caplog):
    write_image(tmp_path / "a.zarr", voxels, unit=None)
    read = lumencut.read_volume(tmp_path / "a.zarr")
    assert not read.states_spacing
    assert "states no unit of length: 1 mm per unit is assumed" in caplog.text


def test_axes_in_another_order_are_turned(tmp_path, voxels):
    turned = [level.transpose(2, 0, 1) for level in voxels]
    write_image(tmp_path / "a.zarr", turned, axes="xzy")
    read = lumencut.read_volume(tmp_path / "a.zarr")
    np.testing.assert_array_equal(read.array, voxels[0])
    np.testing.assert_allclose(read.spacing, (0.5, 1.0, 2.0))


def test_channels_and_time_points_are_chosen(tmp_path, voxels):
    finest = np.stack([np.stack([voxels[0] + 10 * t + 100 * c for c in range(3)]) for t in range(2)])
    write_image(tmp_path / "a.zarr", [finest], axes="tczyx")
    group = zarr.open_group(tmp_path / "a.zarr")
    labels = [{"label": name} for name in ("vessels", "nuclei", "")]
    group.attrs["ome"] = {**group.attrs["ome"], "omero": {"channels": labels}}
    with pytest.raises(FormatError, match="2 values along t: 0, 1") as error:
        lumencut.read_volume(tmp_path / "a.zarr")
    assert "time_point='0'" in error.value.mend
    with pytest.raises(FormatError, match="3 values along c: vessels, nuclei, 2"):
        lumencut.read_volume(tmp_path / "a.zarr", time_point=1)
    for channel, number in (("nuclei", 1), (1, 1), ("2", 2)):
        read = lumencut.read_volume(tmp_path / "a.zarr", time_point=1, channel=channel)
        np.testing.assert_array_equal(read.array, voxels[0] + 10 + 100 * number)
    with pytest.raises(FormatError, match="the channel 'bone'"):
        lumencut.read_volume(tmp_path / "a.zarr", time_point=1, channel="bone")


def test_a_zip_archive_and_a_server_of_this_machine(tmp_path, voxels):
    write_image(tmp_path / "a.zarr", voxels)
    packed = tmp_path / "a.zarr.zip"
    with zipfile.ZipFile(packed, "w") as archive:
        for path in sorted((tmp_path / "a.zarr").rglob("*")):
            if path.is_file():
                archive.write(path, path.relative_to(tmp_path / "a.zarr"))
    np.testing.assert_array_equal(lumencut.read_volume(packed).array, voxels[0])

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    serve = functools.partial(Quiet, directory=tmp_path)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), serve) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            address = f"http://127.0.0.1:{server.server_port}/a.zarr"
            np.testing.assert_array_equal(lumencut.read_volume(address).array, voxels[0])
            with pytest.raises(LOST):
                lumencut.read_volume(f"http://127.0.0.1:{server.server_port}/none.zarr")
        finally:
            server.shutdown()
            thread.join()


#: What readers raise for something that is not there.
LOST = (FormatError, FileError)


def test_other_machines_are_not_asked():
    with pytest.raises(
        FormatError, match=r"found the host 'example\.org'; expected 127\.0\.0\.1 or localhost"
    ):
        lumencut.read_volume("https://example.org/a.zarr")


def test_a_server_without_an_answer_is_an_error(monkeypatch):
    monkeypatch.setattr(stores, "_PATIENCE", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        address = f"http://127.0.0.1:{silent.getsockname()[1]}/a.zarr"
        with pytest.raises(FileError, match="no answer within"):
            lumencut.read_volume(address)


def test_what_is_written_is_read_back_along_the_axes_of_the_patient(tmp_path):
    voxels = np.random.default_rng(3).normal(size=(70, 9, 12)).astype(np.float32)
    affine = np.array([[0, -2.0, 0, 5], [0.5, 0, 0, -3], [0, 0, 1.0, 2], [0, 0, 0, 1]])
    volume = Volume(voxels, world_from_index=affine)
    assert write_ome_zarr(volume, tmp_path / "a.ome.zarr") == 3
    read = lumencut.read_volume(tmp_path / "a.ome.zarr")
    np.testing.assert_allclose(read.direction, np.eye(3))
    points = np.random.default_rng(4).uniform(volume.corners.min(0) + 1, volume.corners.max(0) - 1, (100, 3))
    np.testing.assert_allclose(read.sample(points), volume.sample(points), atol=1e-5)
    coarse = read.levels[1]
    # The shortest side is halved first.
    np.testing.assert_allclose(coarse.spacing, (2, 1, 1))
    np.testing.assert_allclose(
        coarse.array.read((0, 0, 0), (1, 1, 1))[0, 0, 0], _mean_of_first(read), atol=1e-6
    )


def _mean_of_first(read):
    return read.array[0, :2, 0].mean()


def test_an_oblique_grid_is_not_written(tmp_path):
    angle = np.radians(10)
    turned = [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    with pytest.raises(FormatError, match="expected voxels along the axes of the patient"):
        write_ome_zarr(Volume(np.zeros((4, 4, 4)), direction=turned), tmp_path / "a.zarr")
    assert not list(tmp_path.iterdir())


def test_an_existing_folder_is_kept(tmp_path):
    (tmp_path / "a.zarr").mkdir()
    (tmp_path / "a.zarr" / "kept").write_text("x")
    with pytest.raises(FileError, match="an existing file or folder"):
        write_ome_zarr(Volume(np.zeros((4, 4, 4))), tmp_path / "a.zarr")
    assert (tmp_path / "a.zarr" / "kept").read_text() == "x"


def changed(path, change):
    """Change the attributes of a group of Zarr 3."""
    file = path / "zarr.json"
    stored = json.loads(file.read_text())
    change(stored["attributes"])
    file.write_text(json.dumps(stored))


def first(attributes):
    return attributes["ome"]["multiscales"][0]


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (lambda a: a.clear(), "a Zarr group without multiscales"),
        (lambda a: a["ome"].update(version="0.1"), r"OME-NGFF 0\.1"),
        (lambda a: first(a).update(axes=["z", "y", "x"]), "no axes"),
        (lambda a: first(a)["axes"][0].update(name="y"), "the axes y, y, x"),
        (lambda a: first(a)["axes"][1].update(unit="furlong"), "the unit furlong of y"),
        (lambda a: first(a).update(datasets=[]), "no datasets"),
        (lambda a: first(a)["datasets"].append("x"), "metadata of another form"),
        (lambda a: first(a)["datasets"][1].update(path="7"), "no level '7'"),
        (
            lambda a: first(a)["datasets"][0].pop("coordinateTransformations"),
            "without coordinateTransformations",
        ),
        (
            lambda a: first(a)["datasets"][0]["coordinateTransformations"][0].update(scale=[1, 0, 1]),
            "the scale",
        ),
        (
            lambda a: first(a)["datasets"][0]["coordinateTransformations"][0].update(type="affine"),
            "the transformation affine",
        ),
        (
            lambda a: first(a)["datasets"][1]["coordinateTransformations"][1].update(translation=[90, 0, 0]),
            "level 1 from",
        ),
        (lambda a: first(a)["datasets"].reverse(), "level 1 finer than the level before it"),
    ],
)
def test_metadata_that_are_not_those_of_one_image_are_rejected(tmp_path, voxels, change, found):
    write_image(tmp_path / "a.zarr", voxels)
    changed(tmp_path / "a.zarr", change)
    with pytest.raises(FormatError, match=found):
        lumencut.read_volume(tmp_path / "a.zarr")


def test_a_group_of_images_names_them(tmp_path, voxels):
    zarr.open_group(tmp_path / "a.zarr", mode="w")
    write_image(tmp_path / "a.zarr" / "0", voxels)
    with pytest.raises(FormatError) as error:
        lumencut.read_volume(tmp_path / "a.zarr")
    assert error.value.mend == "name one of its groups: 0"
    assert lumencut.read_volume(tmp_path / "a.zarr" / "0").size == (32, 40, 24)


def test_a_missing_level_is_rejected(tmp_path, voxels):
    write_image(tmp_path / "a.zarr", voxels)
    shutil.rmtree(tmp_path / "a.zarr" / "0")
    with pytest.raises(FormatError, match="no level '0'"):
        lumencut.read_volume(tmp_path / "a.zarr")


def test_a_broken_chunk_is_named(tmp_path, voxels):
    write_image(tmp_path / "a.zarr", voxels)
    (tmp_path / "a.zarr/0/c/1/0/0").write_bytes(b"broken")
    read = lumencut.read_volume(tmp_path / "a.zarr")
    with pytest.raises(FormatError, match="level 0, voxels 16 to 23 × 0 to 15 × 0 to 15"):
        _ = read.array


def test_a_missing_chunk_has_the_fill_value_and_info_reports_it(tmp_path, voxels):
    write_image(tmp_path / "a.zarr", voxels)
    (tmp_path / "a.zarr/0/c/1/0/0").unlink()
    assert (lumencut.read_volume(tmp_path / "a.zarr").array[16:, :16, :16] == 0).all()
    done = CliRunner().invoke(main, ["info", str(tmp_path / "a.zarr")])
    assert done.exit_code == 0, done.output
    assert "11 of 12 chunks are stored" in done.output


def test_an_unknown_codec_is_named(tmp_path, voxels):
    write_image(tmp_path / "a.zarr", voxels)
    file = tmp_path / "a.zarr/0/zarr.json"
    stored = json.loads(file.read_text())
    stored["codecs"] = [{"name": "bytes", "configuration": {"endian": "little"}}, {"name": "jxl-of-2031"}]
    file.write_text(json.dumps(stored))
    with pytest.raises(FormatError, match="jxl-of-2031"):
        lumencut.read_volume(tmp_path / "a.zarr")


def test_options_of_other_files_are_rejected(tmp_path, voxels, stenosis):
    write_image(tmp_path / "a.zarr", voxels)
    with pytest.raises(FormatError, match="found series for a file of another kind"):
        lumencut.read_volume(tmp_path / "a.zarr", series=1)
    done = CliRunner().invoke(main, ["convert", str(tmp_path / "a.zarr"), str(tmp_path / "a.nii")])
    assert done.exit_code == 0, done.output
    with pytest.raises(FormatError, match="found memory for a file of another kind"):
        lumencut.read_volume(tmp_path / "a.nii", memory=10_000_000)


def test_the_commands_convert_render_and_report(tmp_path, voxels, stenosis):
    made, _ = stenosis
    run = CliRunner().invoke
    lumencut.write_centerlines(made.tree, tmp_path / "lines.vtp")
    write_image(tmp_path / "a.zarr", [np.repeat(voxels[0], 3, axis=1)])
    for words in (
        ["convert", tmp_path / "a.zarr", tmp_path / "a.nii.gz"],
        ["convert", tmp_path / "a.nii.gz", tmp_path / "b.ome.zarr"],
        ["info", tmp_path / "b.ome.zarr", "--memory", "2MB"],
    ):
        done = run(main, list(map(str, words)))
        assert done.exit_code == 0, done.output
    assert "level 1" in done.output
    np.testing.assert_array_equal(
        lumencut.read_volume(tmp_path / "b.ome.zarr").array, np.repeat(voxels[0], 3, axis=1)
    )
