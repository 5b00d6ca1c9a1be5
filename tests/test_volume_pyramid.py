"""Volume pyramids: parts, levels, memory, and what functions read of them."""

import pickle

import numpy as np
import pytest
import zarr

import lumencut
from lumencut import (
    Camera,
    Renderer,
    Settings,
    Slab,
    Vessel,
    VesselTree,
    Volume,
    VolumeError,
    Window,
    phantom,
)
from lumencut.files.ome_zarr.writing import write_ome_zarr
from lumencut.scene.view_extent import corners_in_view
from zarr_images import halved, write_image

WINDOW = Window(100, 600)


@pytest.fixture(scope="module")
def stenosis(tmp_path_factory):
    """A phantom, and the same volume as a pyramid on disk."""
    made = phantom.stenosis()
    path = tmp_path_factory.mktemp("pyramid") / "scan.ome.zarr"
    write_ome_zarr(made.volume, path)
    return made, path


def test_parts_hold_what_is_asked_and_no_more(stenosis):
    made, path = stenosis
    read = lumencut.read_volume(path)
    near = np.random.default_rng(1).uniform(-3, 3, (50, 3))
    part = read.part(near)
    np.testing.assert_array_equal(part.sample(near), made.volume.sample(near))
    # 6 mm of 0.5 mm voxels, and two voxels on each side.
    assert max(part.size) <= 6 / 0.5 + 2 * 2 + 2
    assert read.bytes_read < made.volume.array.nbytes
    before = read.bytes_read
    assert read.part(near[:10]) is part
    assert read.bytes_read == before


def test_a_part_has_the_level_that_fits_its_spacing_and_the_memory(stenosis):
    _, path = stenosis
    read = lumencut.read_volume(path)
    assert [read.level_for(spacing) for spacing in (None, 0.1, 0.5, 0.99, 1.0, 1e3)] == [0, 0, 0, 0, 1, 2]
    tight = lumencut.read_volume(path, memory=1_000_000)
    assert tight.whole_level == 1
    whole = [level.bytes for level in tight.levels]
    assert whole[1] <= 500_000 < whole[0]
    np.testing.assert_allclose(tight.part(tight.corners).spacing, 1.0)
    np.testing.assert_allclose(tight.part([[0, 0, 0]], 3.0).spacing, 0.5)


def test_chunks_and_parts_stay_within_the_memory(stenosis):
    _, path = stenosis
    read = lumencut.read_volume(path, memory=1_000_000)
    rng = np.random.default_rng(2)
    for _ in range(20):
        part = read.part(rng.uniform(-15, 15, (2, 3)), 2.0)
        assert read._cache.held + part.array.nbytes <= read.memory


def test_a_memory_below_the_coarsest_level_is_rejected(tmp_path):
    write_image(tmp_path / "a.zarr", [np.zeros((128, 128, 128), np.int16)], chunks=64)
    with pytest.raises(VolumeError, match="expected at least") as error:
        lumencut.read_volume(tmp_path / "a.zarr", memory=1_000_000)
    wanted = int(error.value.mend.rpartition("=")[2])
    assert lumencut.read_volume(tmp_path / "a.zarr", memory=wanted).array.shape == (128, 128, 128)


@pytest.mark.parametrize("context", [None, "mida", "mip"])
@pytest.mark.parametrize("zoom", [1, 6])
@pytest.mark.parametrize("turn", [0.0, 0.6])
def test_pictures_equal_those_of_the_volume_in_memory(stenosis, context, zoom, turn):
    made, path = stenosis
    settings = Settings(context=context, window=WINDOW, context_window=WINDOW)
    camera = Camera.anterior(made.tree, (96, 128)).rotated(turn).rotated(turn, "right").zoomed(zoom)
    read = lumencut.read_volume(path)
    assert read.level_for(camera.pixel_spacing) == 0
    own = Renderer(read, made.tree, "cpu").render(camera, settings)
    expected = Renderer(made.volume, made.tree, "cpu").render(camera, settings)
    np.testing.assert_array_equal(own.value, expected.value)
    assert np.abs(own.image.astype(int) - expected.image).max() <= 1


def test_a_coarse_view_reads_a_coarse_level(stenosis):
    made, path = stenosis
    camera = Camera.anterior(made.tree, (24, 24))
    read = lumencut.read_volume(path)
    level = read.level_for(camera.pixel_spacing)
    assert level == 2
    coarse = Volume(
        zarr.open_group(path)[str(level)][...], world_from_index=read.levels[level].world_from_index
    )
    settings = Settings(context="mip", window=WINDOW, context_window=WINDOW)
    renderer = Renderer(read, made.tree, "cpu")
    before = read.bytes_read
    own = renderer.render(camera, settings)
    expected = Renderer(coarse, made.tree, "cpu").render(camera, settings)
    assert np.abs(own.image.astype(int) - expected.image).max() <= 1
    assert read.bytes_read - before < made.volume.array.nbytes / 8


def test_samples_far_from_the_middle_of_their_pixels_are_read(stenosis, tmp_path):
    made, _ = stenosis
    # A pyramid of one level: its voxels are much smaller than a pixel.
    write_image(tmp_path / "a.zarr", [made.volume.array], scale=(0.5, 0.5, 0.5), chunks=32)
    read = lumencut.read_volume(tmp_path / "a.zarr")
    volume = Volume(made.volume.array, world_from_index=read.world_from_index)
    line = Vessel(made.tree[0].points - made.volume.origin, made.tree[0].radius)
    tree = VesselTree([line])
    settings = Settings(context=None, window=WINDOW, samples=4, background=(255, 0, 0, 255))
    camera = Camera(line.points[60], (0, 1, 0), (0, 0, 1), (3, 3), 6.0)
    own = Renderer(read, tree, "cpu").render(camera, settings)
    expected = Renderer(volume, tree, "cpu").render(camera, settings)
    np.testing.assert_array_equal(own.image, expected.image)


def test_a_thick_cut_reads_its_slab(stenosis):
    made, path = stenosis
    settings = Settings(context=None, window=WINDOW, slab=Slab(8.0, "max"))
    camera = Camera.left(made.tree, (80, 80)).zoomed(4)
    own = Renderer(lumencut.read_volume(path), made.tree, "cpu").render(camera, settings)
    expected = Renderer(made.volume, made.tree, "cpu").render(camera, settings)
    np.testing.assert_array_equal(own.value, expected.value)


def test_measurements_sections_reformations_and_lines_are_the_same(stenosis):
    made, path = stenosis
    vessel, read = made.tree[0], lumencut.read_volume(path)
    own, expected = (lumencut.measure(volume, vessel) for volume in (read, made.volume))
    np.testing.assert_array_equal(own.diameter_equivalent, expected.diameter_equivalent)
    np.testing.assert_array_equal(own.flags, expected.flags)
    own.save(path.parent / "own.csv")
    lines = (path.parent / "own.csv").read_text("utf-8").splitlines()
    assert len(lines) == len(own) + 1
    assert all("level 0" in line for line in lines[1:])
    for at in (5.0, 45.0):
        sections = [lumencut.cross_section(volume, vessel, at).value for volume in (read, made.volume)]
        np.testing.assert_array_equal(*sections)
    for mode in ("projected", "stretched", "straightened"):
        laid = [lumencut.cpr(volume, vessel, mode=mode).value for volume in (read, made.volume)]
        np.testing.assert_array_equal(*laid)
    ends = vessel.points[[8, -8]]
    lines = [lumencut.trace(volume, ends)[0].points for volume in (read, made.volume)]
    np.testing.assert_array_equal(*lines)


def tube_image(folder, radius):
    """Write a straight tube along x in 240 × 160 × 160 voxels of 0.5 mm, and return points of its axis."""
    z, y = np.mgrid[:160, :160]
    disk = np.clip(radius - np.hypot(z - 80.3, y - 79.6) + 0.5, 0, 1)
    voxels = np.repeat((20 + 280 * disk)[:, :, None], 240, axis=2).round().astype(np.int16)
    levels = [voxels, halved(voxels), halved(halved(voxels))]
    write_image(folder, levels, scale=(0.5, 0.5, 0.5), chunks=32)
    return np.array([[10.0, 39.8, 40.15], [110.0, 39.8, 40.15]])


@pytest.mark.parametrize(("radius", "level"), [(24.0, 1), (4.0, 0)])
def test_a_line_is_traced_at_the_level_that_resolves_its_lumen(tmp_path, radius, level):
    ends = tube_image(tmp_path / "tube.ome.zarr", radius)
    read = lumencut.read_volume(tmp_path / "tube.ome.zarr")
    line = lumencut.trace(read, ends)[0]
    # Within a tenth of a voxel of the level, and of the radius.
    side = 0.5 * 2**level
    assert np.abs(line.points[:, 1:] - ends[0, 1:]).max() < 0.1 * side
    np.testing.assert_allclose(np.median(line.radius), radius * 0.5, atol=0.1 * side)
    whole = [one.bytes for one in read.levels]
    # A narrow one is traced in its surroundings.
    assert read.bytes_read <= (whole[1] + whole[2] if level else whole[0] // 2 + whole[1] + whole[2])


def test_the_error_of_a_pyramid_is_that_of_its_finest_level(tmp_path):
    ends = tube_image(tmp_path / "tube.ome.zarr", 4.0)
    read = lumencut.read_volume(tmp_path / "tube.ome.zarr")
    with pytest.raises(lumencut.TracingError, match="expected lumen"):
        lumencut.trace(read, ends + np.array([0, 20, 0]))


def test_the_part_in_view_is_what_the_pixels_cover():
    volume = Volume(np.zeros((30, 20, 10), np.uint8), spacing=(1, 2, 3), origin=(5, 0, 0))
    camera = Camera((9.5, 19, 43.5), (0, 1, 0), (0, 0, 1), (4, 6), 1.0)
    corners = corners_in_view(volume, camera)
    np.testing.assert_allclose(corners.min(axis=0), (7.5, -1, 40.5))
    np.testing.assert_allclose(corners.max(axis=0), (11.5, 39, 46.5))
    away = Camera((1000, 0, 0), (0, 1, 0), (0, 0, 1), (4, 6), 1.0)
    assert corners_in_view(volume, away).shape == (0, 3)


def test_a_view_next_to_the_volume_shows_nothing(stenosis):
    made, path = stenosis
    camera = Camera((500, 0, 0), (0, 1, 0), (0, 0, 1), (20, 20), 1.0)
    frame = Renderer(lumencut.read_volume(path), made.tree, "cpu").render(camera, Settings(context="mip"))
    assert np.isnan(frame.value).all()


def test_a_pickle_holds_the_array(stenosis):
    made, path = stenosis
    restored = pickle.loads(pickle.dumps(lumencut.read_volume(path)))
    assert type(restored) is Volume
    np.testing.assert_array_equal(restored.array, made.volume.array)
