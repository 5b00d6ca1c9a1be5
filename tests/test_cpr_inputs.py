"""What CPR rejects, paths through a tree, straightened volumes, and aggregated features."""

from __future__ import annotations

import nibabel
import nrrd
import numpy as np
import pytest

import lumencut
from cpr_scenes import grid, noise, trilinear, vessel, wave
from lumencut import (
    CameraError,
    FileError,
    FormatError,
    Settings,
    SettingsError,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
    VolumeError,
    Window,
    cfa,
    cpr,
    read_volume,
    straightened_volume,
)

STRAIGHT = vessel([[0, 0, 20], [0, 0, -20]])


@pytest.fixture(scope="module")
def volume():
    return noise()


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"mode": "curled"}, SettingsError, "mode of the CPR: found 'curled'; expected one of 'projected'"),
        ({"width": 0}, CameraError, "width of the CPR: found 0 mm; expected a width above 0 mm"),
        ({"width": -3}, CameraError, "width of the CPR"),
        ({"width": float("nan")}, CameraError, "width of the CPR"),
        ({"width": 1000}, CameraError, "the diagonal of the volume"),
        ({"width": "wide"}, CameraError, "width of the CPR"),
        ({"pixel_spacing": 0}, CameraError, "pixel_spacing of the CPR: found 0 mm"),
        ({"pixel_spacing": 1e-5}, CameraError, "size of the CPR.*a larger pixel_spacing"),
        ({"angle": float("inf")}, CameraError, "angle of the CPR: found inf"),
        ({"angle": 1.0, "degrees": 3}, CameraError, "one of angle= .radians. and degrees="),
        ({"up": (0, 0, 0)}, CameraError, "up of the CPR.*other than zero"),
        ({"up": (0, 1)}, CameraError, "up of the CPR"),
        ({"up": (1, 0, 0)}, CameraError, "lies in one row of the projected CPR.*choose another up"),
        (
            {"up": (1, 0, 0), "mode": "stretched", "degrees": 0},
            CameraError,
            "lies in one row of the stretched",
        ),
        (
            {"mode": "straightened", "normal": (0, 0, 1)},
            CameraError,
            "normal of the CPR.*not parallel to the vessel",
        ),
        ({"mode": "straightened", "normal": (0, 0, 0)}, CameraError, "normal of the CPR"),
        ({"normal": (0, -1, 0)}, CameraError, "normal of the CPR: found a normal with the mode 'projected'"),
        ({"slab": 0}, SettingsError, "slab thickness: found 0 mm; expected a thickness above 0 mm"),
        ({"slab": -1}, SettingsError, "slab thickness"),
        ({"slab": (3, "median")}, SettingsError, "slab mode"),
        ({"slab": "thick"}, SettingsError, "slab thickness"),
        (
            {"smoothing": -1},
            SettingsError,
            "smoothing of the centerline: found -1; expected between 0 and 1000 mm",
        ),
        ({"settings": {}}, SettingsError, "settings: found dict"),
        ({"device": "abacus"}, SettingsError, "device"),
        (
            {"vessel": VesselTree([STRAIGHT])},
            VesselTreeError,
            "found VesselTree; expected a Vessel; take one",
        ),
        ({"vessel": [[0, 0, 0], [0, 0, 1]]}, VesselTreeError, "vessel of the CPR: found list"),
        ({"vessel": vessel([[1, 2, 3]] * 3)}, VesselTreeError, "without length"),
        (
            {"vessel": vessel([[900, 0, 0], [901, 0, 0]])},
            VesselTreeError,
            "none of its 2 points inside the volume",
        ),
        ({"volume": None}, VolumeError, "volume of the CPR"),
        ({"volume": np.zeros((3, 3, 3))}, VolumeError, "a bare array of shape"),
    ],
)
def test_bad_arguments(volume, changes, error, words):
    arguments = {"volume": volume, "vessel": STRAIGHT, **changes}
    with pytest.raises(error, match=words) as raised:
        cpr(**arguments)
    assert isinstance(raised.value, lumencut.LumencutError)


def test_a_vessel_of_one_point_is_none():
    with pytest.raises(VesselTreeError, match="points of the vessel: found 1 point"):
        Vessel([[1, 2, 3]])


@pytest.mark.parametrize("points", [[1, 2, 3, 4], [[1, 2, 3, 4]], [["a", "b"]], [[np.nan, 0]]])
def test_places_that_are_none(volume, points):
    made = cpr(volume, STRAIGHT)
    with pytest.raises(CameraError, match="points of the reformation"):
        made.world_from_pixel(points)
    with pytest.raises(CameraError, match="points of the reformation"):
        made.pixel_from_world([*points, [1]] if len(points) == 1 else points)


@pytest.mark.parametrize(
    "angles", [{}, {"angle": 1.0, "degrees": 3.0}, {"angle": float("nan")}, {"degrees": "much"}]
)
def test_rotations_that_are_none(volume, angles):
    with pytest.raises(CameraError, match=r"of the (rotation|CPR)"):
        cpr(volume, STRAIGHT).rotated(**angles)


def test_repeated_points_change_nothing(volume):
    line = wave().points
    for mode in ("projected", "stretched", "straightened"):
        one = cpr(volume, vessel(line), mode)
        np.testing.assert_array_equal(
            one.position, cpr(volume, vessel(np.repeat(line, 2, axis=0)), mode).position
        )


def test_defaults(volume):
    made = cpr(volume, STRAIGHT)
    assert (made.mode, made.angle, made.pixel_spacing) == ("projected", 0.0, 0.25)
    assert made.size[0] == 2 * int(25 / made.pixel_spacing) + 1
    assert made.timings == {}
    assert made.image.shape == (*made.size[::-1], 4)
    assert made.image.dtype == np.uint8
    assert list(made.timings) == ["places", "surface", "composite"]
    assert made.value.shape == made.folded.shape == made.position.shape[:2] == made.size[::-1]
    assert (made.value.dtype, made.folded.dtype, made.position.dtype) == (np.float32, bool, np.float64)
    assert made.arc_length.shape == (made.size[1],)
    pixels = f"{made.size[0]} × {made.size[1]} pixels of {made.pixel_spacing:.4g} mm"
    assert repr(made) == f"PlanarReformation(projected CPR, {pixels})"


def test_the_window_is_that_of_the_settings(volume):
    made = cpr(volume, STRAIGHT, settings=Settings(window=Window(500, 100)))
    inside = ~np.isnan(made.value)
    grey = np.clip((made.value[inside] - 450) / 100, 0, 1) * 255
    assert np.abs(made.image[inside][:, 0] - grey).max() < 1.01
    without = cpr(volume, STRAIGHT)
    assert isinstance(without.settings.window, Window)


def test_smoothing_keeps_the_ends_and_shortens_the_way(volume):
    random = np.random.default_rng(3)
    points = np.stack(
        [random.normal(0, 0.7, 60), random.normal(0, 0.7, 60), np.linspace(20, -20, 60)], axis=1
    )
    rough, quiet = (cpr(volume, vessel(points), "straightened", smoothing=s) for s in (0.0, 4.0))
    assert quiet.arc_length[-1] < 42 < rough.arc_length[-1]
    np.testing.assert_allclose(quiet.position[0, quiet.size[0] // 2], points[0], atol=1e-9)


def test_files(volume, tmp_path):
    made = cpr(volume, STRAIGHT)
    made.save(tmp_path / "one.png")
    made.save(tmp_path / "one.npz")
    with np.load(tmp_path / "one.npz") as file:
        arrays = dict(file)
    assert sorted(arrays) == ["arc_length", "folded", "image", "position", "value"]
    np.testing.assert_array_equal(arrays["position"], made.position)
    with pytest.raises(FormatError, match="extension"):
        made.save(tmp_path / "one.txt")
    with pytest.raises(FileError):
        made.save(tmp_path / "nowhere" / "one.png")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.npz", "one.png"]


def test_labels(volume):
    fine = cpr(volume, STRAIGHT, "stretched", pixel_spacing=0.1)
    labelled = fine.annotated()
    assert labelled.shape == fine.image.shape
    assert (labelled != fine.image).any()
    small = cpr(volume, STRAIGHT)
    np.testing.assert_array_equal(small.annotated(), small.image)
    assert fine._edges() == {"left": "R", "right": "L"}
    assert cpr(volume, STRAIGHT, degrees=90)._edges() == {
        "left": "A",
        "right": "P",
        "top": "S",
        "bottom": "I",
    }
    assert cpr(volume, STRAIGHT, "straightened")._edges() == {}


def test_contact_sheets():
    from lumencut.pictures.contact_sheet import contact_sheet

    random = np.random.default_rng(2)
    pictures = [
        random.integers(0, 255, (h, w, 4)).astype(np.uint8)
        for h, w in ((90, 60), (30, 80), (250, 40), (90, 9))
    ]
    for one in pictures:
        one[..., 3] = 255
    sheet = contact_sheet(pictures, ["a", "b", "Truncus brachiocephalicus dexter", "ü"])
    windows = np.lib.stride_tricks.sliding_window_view
    for one in pictures:
        found = (windows(sheet[..., 0], one.shape[:2]) == one[..., 0]).all(axis=(2, 3))
        assert found.sum() == 1
    assert (sheet[..., 3] == 255).all()


@pytest.fixture(scope="module")
def tree():
    trunk = Vessel([[0, 0, 30], [0, 0, 20], [0, 0, 10]], [4, 4, 3], "trunk")
    left = Vessel([[8, 0, -5], [5, 0, 0], [0, 0, 10.05]], [1, 2, 2.5], "left")
    foot = Vessel([[8, 0, -5], [8, 0, -20]], [1, 1], "foot")
    return VesselTree([trunk, left, foot, Vessel([[50, 0, 0], [60, 0, 0]])])


def test_a_path_joins_vessels_in_their_order(tree):
    path = tree.path([0, "left", 2])
    expected = [[0, 0, 30], [0, 0, 20], [0, 0, 10], [5, 0, 0], [8, 0, -5], [8, 0, -20]]
    np.testing.assert_array_equal(path.points, expected)
    np.testing.assert_array_equal(path.radius, [4, 4, 3, 2, 1, 1])
    assert path.name == "trunk + left + foot"
    np.testing.assert_array_equal(tree.path(["foot", 1, 0]).points[[0, -1]], [[8, 0, -20], [0, 0, 30]])
    assert tree.path([1]) == tree[1]


def test_a_path_of_vessels_of_which_some_have_no_radius_has_none():
    tree = VesselTree([Vessel([[0, 0, 0], [1, 0, 0]], 2.0), Vessel([[1, 0, 0], [2, 0, 0]])])
    assert tree.path([0, 1]).radius is None
    assert tree.path([0, 1]).name is None


def test_a_path_leaves_a_whole_vessel_where_a_branch_begins_and_comes_back_to_its_root():
    trunk = Vessel([[0, 0, 10 * k] for k in range(6)], [6, 5, 4, 3, 2, 1], "trunk")
    branch = Vessel([[0, 0, 20], [10, 0, 20], [20, 0, 20]], 1.5, "branch")
    twig = Vessel([[10, 0, 20], [10, 30, 20]], 1.0, "twig")
    tree = VesselTree([trunk, branch, twig])
    assert tree.parts == ((0, 1, 2),)
    out = tree.path(["trunk", "branch", "twig"])
    np.testing.assert_array_equal(out.points, [[0, 0, 0], [0, 0, 10], [0, 0, 20], [10, 0, 20], [10, 30, 20]])
    np.testing.assert_array_equal(out.radius, [6, 5, 4, 1.5, 1])
    assert out.length == 20 + 10 + 30
    back = tree.path(["twig", "branch", "trunk"])
    np.testing.assert_array_equal(back.points, out.points[::-1])
    with pytest.raises(VesselTreeError, match="a gap of 10 mm between vessel 0 and vessel 2"):
        tree.path([0, 2])


@pytest.mark.parametrize(
    ("ids", "words"),
    [
        (
            [0, 2],
            "found a gap of 17 mm between vessel 0 and vessel 2; expected vessels in order along the path",
        ),
        (["trunk", 1, 3], "between vessel 1 and vessel 3"),
        ([], "found no vessels"),
        ([0, 1, 0], "found vessel 0 twice"),
        ([0, 9], "expected an id from 0 to 3"),
        (["tronk"], "perhaps 'trunk' is meant"),
        ("trunk", "expected several ids or names"),
        (3, "expected several ids or names"),
    ],
)
def test_paths_that_are_none(tree, ids, words):
    with pytest.raises(VesselTreeError, match=words):
        tree.path(ids)


@pytest.fixture(scope="module")
def straightened(volume):
    return straightened_volume(volume, wave(), 12, 0.8, angle=0.7, smoothing=1.0)


def test_its_voxels_are_those_of_the_volume(volume, straightened):
    made = straightened.volume
    assert made.size[:2] == (15, 15)
    index = np.stack(np.meshgrid(*map(np.arange, made.size), indexing="ij"), axis=-1).reshape(-1, 3)
    world = straightened.world_from_index(index)
    expected, found = trilinear(volume, world), made.array[tuple(index.T[::-1])]
    sure = ~np.isnan(expected)
    assert sure.mean() > 0.8
    assert np.abs(found - expected)[sure].max() < 0.05
    # Far from the axis, sections intersect if the vessel bends strongly; near the axis they do not.
    near = np.hypot(*(index[:, :2] - 7).T) < 3
    np.testing.assert_allclose(straightened.index_from_world(world[near]), index[near], atol=1e-6)
    np.testing.assert_allclose(straightened.arc_length, 0.8 * np.arange(made.size[2]), atol=1e-9)


def test_its_middle_is_the_straightened_cpr(volume, straightened):
    made = cpr(volume, wave(), "straightened", 12, 0.8, angle=0.7, smoothing=1.0)
    np.testing.assert_array_equal(straightened.volume.array[:, 7], made.value)
    pixels = np.array([[3.0, 5.0], [11.5, 20.25]])
    world = straightened.world_from_index(np.insert(pixels, 1, 7, axis=1))
    np.testing.assert_allclose(world, made.world_from_pixel(pixels), atol=1e-9)


@pytest.mark.parametrize("ending", [".nrrd", ".nii", ".nii.gz"])
def test_its_files_are_read_back(straightened, tmp_path, ending):
    path = tmp_path / f"vessel{ending}"
    straightened.save(path)
    again = read_volume(path)
    np.testing.assert_array_equal(again.array, straightened.volume.array)
    np.testing.assert_allclose(again.world_from_index, straightened.volume.world_from_index, atol=1e-6)
    if ending == ".nrrd":
        array, header = nrrd.read(str(path))
        assert header["space"] == "left-posterior-superior"
    else:
        image = nibabel.load(path)
        array = np.asarray(image.dataobj)
        assert image.header.get_xyzt_units()[0] == "mm"
    np.testing.assert_array_equal(array.T, straightened.volume.array)


def test_the_straightened_volume_is_checked(volume, straightened, tmp_path):
    with pytest.raises(FormatError, match=r"expected \.nrrd, \.nii or \.nii\.gz"):
        straightened.save(tmp_path / "vessel.png")
    with pytest.raises(FileError):
        straightened.save(tmp_path / "nowhere" / "vessel.nrrd")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(CameraError, match="size of the straightened volume"):
        straightened_volume(volume, wave(), 40, 0.02)
    with pytest.raises(CameraError, match="indices of the straightened volume"):
        straightened.world_from_index([[1, 2]])
    with pytest.raises(CameraError, match="width of the CPR"):
        straightened_volume(volume, wave(), -1)


def test_features_are_aggregated_over_half_circles():
    # A bright rod next to a straight vessel, to the patient's left and behind: only the right side shows it.
    size = (61, 61, 61)
    affine = grid("straight", size)
    index = np.stack(np.meshgrid(*map(np.arange, size), indexing="ij"), axis=-1)
    world = index @ affine[:3, :3].T + affine[:3, 3]
    rod = np.hypot(world[..., 0] - 4, world[..., 1] - 5) < 1.5
    volume = Volume(np.where(rod, 1000, 0).astype(np.float32).T, world_from_index=affine)
    made = cfa(volume, STRAIGHT, 12, "max", 0.5)
    assert made.value.shape == (81, 49)
    assert made.angles == 77
    middle = made.value[40]
    shown = made.radius[middle > 500]
    assert shown.min() > np.hypot(4, 5) - 2.5
    assert shown.max() < np.hypot(4, 5) + 2.5
    np.testing.assert_array_equal(cfa(volume, STRAIGHT, 12, "min", 0.5).value, 0)
    mean = cfa(volume, STRAIGHT, 12, "mean", 0.5).value[40]
    # A circle of 6.5 mm meets the rod over about 3 of the 20 mm of its half.
    at = np.argmin(np.abs(made.radius - 6.5))
    assert 100 < mean[at] < 250
    assert mean[48 - at] == 0


def test_aggregated_values_are_those_of_turned_pictures(volume):
    line = wave()
    for feature, reduce in (("max", np.nanmax), ("mean", np.nanmean), ("min", np.nanmin)):
        made = cfa(volume, line, 5, feature, 1.0)
        angles = ((np.arange(made.angles) + 0.5) / made.angles - 0.5) * np.pi
        turned = [cpr(volume, line, "straightened", 10, 1.0, angle=angle).value for angle in angles]
        np.testing.assert_allclose(made.value, reduce(np.stack(turned), axis=0), rtol=1e-6, atol=1e-3)


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"radius": 0}, CameraError, "radius of the CFA"),
        ({"radius": float("inf")}, CameraError, "radius of the CFA"),
        ({"feature": "median"}, SettingsError, "feature of the CFA"),
        ({"vessel": 3}, VesselTreeError, "vessel of the CPR"),
    ],
)
def test_features_that_are_none(volume, changes, error, words):
    with pytest.raises(error, match=words):
        cfa(**{"volume": volume, "vessel": STRAIGHT, **changes})


def test_files_of_features(volume, tmp_path):
    made = cfa(volume, STRAIGHT, 5, pixel_spacing=1)
    for name in ("one.png", "one.npz"):
        made.save(tmp_path / name)
    with np.load(tmp_path / "one.npz") as arrays:
        assert sorted(arrays) == ["arc_length", "folded", "image", "position", "radius", "value"]
    assert (made.image[np.isnan(made.value)] == 0).all()
