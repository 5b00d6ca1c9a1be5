"""Centerlines of masks: topology by independent counts, middle and radius by closed forms and phantoms."""

import numpy as np
import pytest

from conftest import needs_shared_data
from lumencut import Volume, compare_centerlines, phantom, read_centerlines, read_volume, trace_mask
from mask_scenes import betti, betti_of, lumen_mask, parts, tubes

RING = [(20 + 12 * np.cos(t), 20 + 12 * np.sin(t), 20) for t in np.linspace(0, 2 * np.pi, 60)]
CROSS = [[(20, 5, 20), (20, 35, 20)], [(5, 20, 20), (35, 20, 20)]]


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
