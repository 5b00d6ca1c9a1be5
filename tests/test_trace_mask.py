"""Centerlines of masks: topology by independent counts, middle and radius by closed forms and phantoms."""

import numpy as np
import pytest

import lumencut
from conftest import needs_shared_data
from lumencut import Volume, compare_centerlines, phantom, read_centerlines, read_volume, trace_mask
from mask_scenes import betti, betti_of, lumen_mask, parts, tubes

RING = [(20 + 12 * np.cos(t), 20 + 12 * np.sin(t), 20) for t in np.linspace(0, 2 * np.pi, 60)]
CROSS = [[(20, 5, 20), (20, 35, 20)], [(5, 20, 20), (35, 20, 20)]]


def nearest(points, tree):
    """The distance of each point to the lines of a tree."""
    best = np.full(len(points), np.inf)
    for vessel in tree:
        a, b = vessel.points[:-1], vessel.points[1:]
        share = np.clip(((points[:, None] - a) * (b - a)).sum(-1) / ((b - a) ** 2).sum(-1), 0, 1)
        place = a + share[..., None] * (b - a)
        best = np.minimum(best, np.linalg.norm(points[:, None] - place, axis=-1).min(axis=1))
    return best


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ([[(5, 20, 20), (35, 20, 20)]], (1, 0)),
        ([RING], (1, 1)),
        ([RING, [(8, 20, 20), (32, 20, 20)]], (1, 2)),
        (CROSS, (1, 0)),
        ([[(20, 20, 4), (20, 20, 20), (32, 20, 35)], [(20, 20, 20), (8, 20, 35)]], (1, 0)),
        ([[(5, 8, 8), (35, 8, 8)], [(5, 30, 30), (35, 30, 30)]], (2, 0)),
    ],
)
def test_pieces_and_cycles_stay(lines, expected):
    mask = tubes(lines, 2.6)
    assert betti(mask) == expected
    tree = trace_mask(mask)
    assert betti_of(tree) == expected
    assert len(tree.gaps) == expected[0] - 1


def test_pieces_and_cycles_of_random_masks_stay():
    random = np.random.default_rng(3)
    cycles = 0
    for _ in range(12):
        blurred = random.random(random.integers(16, 30, 3))
        for axis in range(3):
            blurred = np.roll(blurred, 1, axis) + blurred + np.roll(blurred, -1, axis)
        mask = Volume(
            (blurred > np.quantile(blurred, 0.55)).astype(np.uint8), spacing=random.uniform(0.5, 2, 3)
        )
        pieces, wanted = betti(mask)
        tree = trace_mask(mask, shortest_branch=0)
        found = betti_of(tree)
        # A piece without a line, such as a sphere or a single voxel, is left out with a note.
        assert found[1] == wanted
        left_out = next((int(note.split()[0]) for note in tree.notes if "left out" in note), 0)
        assert found[0] + left_out == pieces
        cycles += wanted
    assert cycles > 40


def test_points_are_close_and_ends_reach_the_caps():
    (vessel,) = trace_mask(tubes([[(6, 20, 20), (34, 20, 20)]], 4.3))
    steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
    assert steps.max() <= 0.5 + 1e-9
    assert sorted(vessel.points[[0, -1], 0]) == pytest.approx([6 - 4.5, 34 + 4.5], abs=0.5)
    assert np.abs(vessel.points[:, 1:] - 20).max() < 0.02
    inner = (vessel.points[:, 0] > 8) & (vessel.points[:, 0] < 32)
    assert vessel.radius[inner] == pytest.approx(4.3, abs=0.2)
    assert not vessel.bridged.any()


def test_vessels_that_meet_share_their_ends():
    tree = trace_mask(tubes(CROSS, 2.6))
    ends = [tuple(vessel.points[n]) for vessel in tree for n in (0, -1)]
    (shared,) = {end for end in ends if ends.count(end) > 1}
    assert ends.count(shared) == 4
    assert np.array(shared) == pytest.approx([20, 20, 20], abs=0.5)


def test_cavities_are_filled_and_told():
    solid = tubes([[(5, 20, 20), (35, 20, 20)]], 5)
    hollow = solid.array.copy()
    hollow[19:22, 19:22, 12:15] = 0
    hollow[20, 20, 25] = 0
    tree = trace_mask(Volume(hollow))
    assert tree == trace_mask(solid)
    assert tree.notes[0] == "2 cavities of 28 voxels filled"
    assert not any("filled" in note for note in trace_mask(solid).notes)


def test_branches_stay_and_bumps_go():
    trunk = [(30, 30, 4), (30, 30, 56)]
    random = np.random.default_rng(0)
    for reach in (2.3, 3.0):
        end = (30 + reach * 5.3, 30, 30)
        narrow = tubes([[(30, 30, 30), end]], 2.2, (60, 60, 60))
        wide = tubes([trunk], 5.3, (60, 60, 60))
        tree = trace_mask(Volume(wide.array | narrow.array))
        assert len(tree) == 3, reach
        assert betti_of(tree) == (1, 0)
    lumpy = wide.array.copy()
    for _ in range(60):
        turn, z = random.uniform(0, 2 * np.pi), random.uniform(8, 52)
        place = np.round([z, 30 + 5.3 * np.sin(turn), 30 + 5.3 * np.cos(turn)]).astype(int)
        lumpy[tuple(place)] ^= 1
    assert len(trace_mask(Volume(lumpy))) == 1


def test_a_flat_cut_leaves_no_fork():
    mask = tubes([[(20, 20, -20), (20, 20, 60)]], 6.4)
    (vessel,) = trace_mask(mask)
    assert sorted(vessel.points[[0, -1], 2]) == pytest.approx([-0.5, 39.5], abs=0.05)
    assert vessel.radius == pytest.approx(6.4, abs=0.25)


@pytest.fixture(scope="module")
def star():
    """Five arms that meet at one point."""
    return tubes([*CROSS, [(20, 20, 20), (31, 27, 35)]], 2.6)


@pytest.mark.parametrize("axes", [(0,), (1,), (2,), (0, 2), (0, 1, 2)])
def test_the_storage_of_the_axes_does_not_matter(star, axes):
    expected = trace_mask(star)
    flipped = trace_mask(Volume(np.flip(star.array, axes), world_from_index=star.world_from_index))
    turned = np.eye(4)
    for axis in axes:
        turned[2 - axis, 2 - axis], turned[2 - axis, 3] = -1, star.array.shape[axis] - 1
    same_place = Volume(np.ascontiguousarray(np.flip(star.array, axes)), world_from_index=turned)
    assert [len(vessel) for vessel in flipped] == [len(vessel) for vessel in expected]
    for mirrored, stored, vessel in zip(flipped, trace_mask(same_place), expected, strict=True):
        assert stored.points == pytest.approx(vessel.points, abs=1e-9)
        assert stored.radius == pytest.approx(vessel.radius, abs=1e-9)
        back = mirrored.points @ turned[:3, :3].T + turned[:3, 3]
        # A mirror image rounds differently: a ray that barely touches the wall may end elsewhere.
        assert back == pytest.approx(vessel.points, abs=0.01)


def test_the_number_of_threads_does_not_matter(star):
    expected = trace_mask(star)
    threads = lumencut.get_threads()
    try:
        for count in (1, 3):
            lumencut.set_threads(count)
            assert trace_mask(star) == expected
    finally:
        lumencut.set_threads(threads)


@pytest.mark.parametrize(
    "columns",
    [
        [(0.6, 0, 0), (0, 0.6, 0), (0, 0, 1.5)],
        [(0.8, 0, 0), (0, 0.8, 0.3), (0, 0, 1.0)],
        [(0.5, 0.1, 0), (-0.2, 0.6, 0), (0.3, 0.1, 0.9)],
    ],
)
def test_grids_that_are_anisotropic_or_sheared(columns):
    world = np.eye(4)
    world[:3, :3] = np.transpose(columns)
    world[:3, 3] = (-10, 4, 30)
    truth = np.array([(12, 20, 20), (30, 22, 24)]) @ world[:3, :3].T + world[:3, 3]
    line = lumencut.Vessel(truth, 3.0)
    grid = Volume(np.zeros((44, 44, 44), np.uint8), world_from_index=world)
    (vessel,) = trace_mask(lumen_mask([line], grid))
    found = compare_centerlines(vessel, line)
    assert found.of == 1
    assert found.ai < grid.spacing.min() / 2
    middle = np.linalg.norm(vessel.points - truth.mean(axis=0), axis=1) < 4
    assert vessel.radius[middle] == pytest.approx(3, abs=0.3)
    assert vessel.radius[middle].mean() == pytest.approx(3, abs=0.15)


@pytest.mark.parametrize("name", ["helix", "y_junction", "trefoil"])
def test_phantoms_in_their_middle(name):
    made = getattr(phantom, name)()
    mask = lumen_mask(made.tree, made.volume)
    tree = trace_mask(mask)
    assert betti_of(tree) == betti(mask)
    found = compare_centerlines(tree, made.tree, sampling=0.05)
    assert found.of == 1
    assert found.ov > 0.999
    assert found.ai <= mask.spacing.min() / 2
    assert found.false_length == 0


# In larger voxels arteries of the aorta would touch, those of the neck do not. Bounds are in voxels.
@pytest.mark.each_value(most=1)
@pytest.mark.parametrize(("name", "scale", "cycles"), [("cervical", 0.55, 6), ("aorta", 1.0, 0)])
def test_workloads_in_their_middle(name, scale, cycles):
    made = getattr(phantom, name)(scale=scale)
    mask = lumen_mask(made.tree, made.volume)
    tree = trace_mask(mask)
    assert betti_of(tree) == betti(mask) == (1, cycles)
    found = compare_centerlines(tree, made.tree, sampling=0.1)
    assert found.ov >= 0.97
    assert found.ai <= mask.spacing.min() / 2
    assert found.false_length <= 0.02 * sum(vessel.length for vessel in tree)


@needs_shared_data
@pytest.mark.parametrize(
    ("mask", "lines"),
    [
        ("stent-cta/stent_lumen_mask.nii.gz", "stent-cta/centerlines.vtp"),
        ("aorta-mra/aorta_lumen_mask.nii.gz", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
        ("dissection-cta/aorta_true_lumen.nii.gz", "dissection-cta/true_lumen_centerline_LPS.vtp"),
    ],
)
def test_masks_of_patients_beside_lines_of_vmtk(shared_data, mask, lines):
    volume = read_volume(shared_data / mask)
    tree = trace_mask(volume)
    assert betti_of(tree) == betti(volume)
    found = compare_centerlines(tree, read_centerlines(shared_data / lines, coordinates="lps"), sampling=0.1)
    assert found.ov >= 0.97
    assert found.ai <= volume.spacing.max()
    assert parts(volume, by_corners=True) == len(tree.gaps) + 1
