"""The truth stated by phantoms agrees with their voxels."""

from __future__ import annotations

import os
import subprocess
import sys
from hashlib import sha256

import numpy as np
import pytest

from lumencut import phantom
from lumencut.errors import SettingsError

SMALL = [
    "straight_tube",
    "helix",
    "y_junction",
    "crossing",
    "trefoil",
    "collinear_run",
    "stenosis",
    "calcified_wall",
]
WORKLOADS = {
    "aorta": (800, (512, 512, 256)),
    "runoff": (2200, (512, 512, 1305)),
    "cervical": (1100, (512, 512, 575)),
}
LUMEN, WALL, SOFT, FAT = 350, 60, 40, -100


def sample(volume, points):
    """Trilinear values of the volume at world points inside it."""
    inverse = np.linalg.inv(volume.world_from_index)
    index = np.asarray(points, float) @ inverse[:3, :3].T + inverse[:3, 3]
    low = np.clip(np.floor(index).astype(int), 0, np.asarray(volume.size) - 2)
    t = index - low
    value = 0.0
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, t, 1 - t), axis=-1)
        i, j, k = (low + corner).T
        value = value + weight * volume.array[k, j, i]
    return value


def measured_radius(volume, point, tangent, threshold, reach=8.0):
    """Return the mean distance (mm) from `point`, across the vessel, where values fall below `threshold`."""
    tangent = tangent / np.linalg.norm(tangent)
    u = np.cross(tangent, [0.3, 0.5, 0.81])
    u /= np.linalg.norm(u)
    v = np.cross(tangent, u)
    distance = np.arange(0.0, reach, 0.02)
    turns = np.linspace(0, 2 * np.pi, 36, endpoint=False)
    rays = np.cos(turns)[:, None] * u + np.sin(turns)[:, None] * v
    values = sample(volume, (point + distance[:, None, None] * rays).reshape(-1, 3)).reshape(
        len(distance), -1
    )
    return distance[np.argmax(values < threshold, axis=0)].mean()


def segments(made):
    return sum(len(vessel.points) - 1 for vessel in made.tree)


@pytest.mark.parametrize("name", SMALL)
def test_small_phantoms_hold_their_tree_and_fill_their_lumen(name):
    made = getattr(phantom, name)()
    assert made.name == name
    assert made.volume.array.dtype == np.int16
    np.testing.assert_allclose(made.volume.spacing, 0.5)
    for vessel, reference in zip(made.tree, made.reference_radius, strict=True):
        assert made.volume.contains(vessel.points).all()
        np.testing.assert_allclose(sample(made.volume, vessel.points), LUMEN, atol=1)
        assert reference.shape == vessel.radius.shape == (len(vessel.points),)
        assert (vessel.radius <= reference).all()
    corners = made.volume.array[[0, 0, -1, -1], [0, -1, 0, -1], [0, -1, -1, 0]]
    assert (corners == FAT).all()


@pytest.mark.parametrize("name", ["straight_tube", "helix", "crossing", "trefoil"])
def test_measured_radius_is_the_true_one(name):
    made = getattr(phantom, name)()
    for vessel in made.tree:
        for i in range(5, len(vessel.points) - 5, 11):
            tangent = vessel.points[i + 1] - vessel.points[i - 1]
            radius = measured_radius(made.volume, vessel.points[i], tangent, (LUMEN + WALL) / 2)
            assert radius == pytest.approx(vessel.radius[i], abs=0.15)


def test_the_wall_lies_around_the_lumen():
    made = phantom.straight_tube()
    thickness = 0.5 + 0.08 * 4
    assert sample(made.volume, [[4 + thickness / 2, 0, 0]])[0] == pytest.approx(WALL, abs=60)
    outside = measured_radius(made.volume, np.zeros(3), np.array([0, 0, 1.0]), (WALL + FAT) / 2)
    assert outside == pytest.approx(4 + thickness, abs=0.15)


@pytest.mark.parametrize("percent", [0.0, 30.0, 70.0])
def test_stenosis_shows_the_stated_percentage(percent):
    made = phantom.stenosis(percent=percent)
    (stated,) = made.stenoses
    assert (stated.vessel, stated.arc_length, stated.percent) == (0, 30.0, percent)
    up = np.array([0, 0, 1.0])
    edge = (LUMEN + SOFT) / 2
    narrow = measured_radius(made.volume, np.zeros(3), up, edge)
    healthy = measured_radius(made.volume, 20 * up, up, edge)
    assert 100 * (1 - narrow / healthy) == pytest.approx(percent, abs=4)
    lumen = made.tree[0].radius
    assert 100 * (1 - lumen.min() / lumen.max()) == pytest.approx(percent)
    (ring,) = made.plaques
    assert ring.kind == "soft"
    if percent == 70.0:
        middle = 4 - ring.thickness / 2
        assert sample(made.volume, [[middle, 0, 0], [0, -middle, 0]]) == pytest.approx(SOFT, abs=1)


def test_calcification_lies_where_it_is_stated():
    made = phantom.calcified_wall()
    (plaque,) = made.plaques
    assert plaque.kind == "calcified"
    bright = np.argwhere(made.volume.array > 500)[:, ::-1] @ made.volume.world_from_index[:3, :3].T
    bright += made.volume.origin
    np.testing.assert_allclose(bright.mean(axis=0), plaque.position, atol=0.5)
    assert isinstance(plaque.position, tuple)
    assert plaque.position == pytest.approx((5.0, 0.0, 0.0))
    assert np.ptp(bright[:, 2]) == pytest.approx(plaque.length, abs=1.1)
    angles = np.arctan2(bright[:, 1], bright[:, 0])
    assert np.ptp(angles) == pytest.approx(plaque.angular_extent, abs=0.3)
    radius = measured_radius(made.volume, np.zeros(3), np.array([0, 0, 1.0]), 205)
    assert radius > 4.0  # The calcification lies outside the lumen.


def test_y_junction_shares_its_end_point_to_the_bit():
    trunk, right, left = phantom.y_junction().tree
    assert trunk.points[-1].tobytes() == right.points[0].tobytes() == left.points[0].tobytes()


def test_trefoil_closes_to_the_bit():
    (knot,) = phantom.trefoil().tree
    assert knot.points[0].tobytes() == knot.points[-1].tobytes()


def test_collinear_runs_have_no_extent_across_the_anterior_view():
    bend, end_on = phantom.collinear_run().tree
    assert (np.ptp(end_on.points[:, [0, 2]], axis=0) == 0).all()
    run = np.diff(bend.points, axis=0)
    along = (run[:, [0, 2]] == 0).all(axis=1)
    assert along.sum() == 30
    assert not along[0]
    assert not along[-1]


@pytest.mark.parametrize("name", WORKLOADS)
def test_workloads_are_as_large_as_in_the_paper(name):
    target, size = WORKLOADS[name]
    made = getattr(phantom, name)(scale=0.125)
    assert made.volume.array.dtype == np.int16
    assert made.volume.size == tuple(round(n / 8) for n in size)
    assert abs(segments(made) - target) <= 0.03 * target
    names = [vessel.name for vessel in made.tree]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("name", WORKLOADS)
def test_workload_vessels_lie_inside_and_shine(name):
    made = getattr(phantom, name)(scale=0.25)
    points = np.concatenate([vessel.points for vessel in made.tree])
    assert made.volume.contains(points).all()
    wide = np.concatenate([vessel.radius > 4 for vessel in made.tree])
    # The noise is 14 HU; voxels of 3 mm blur only vessels narrower than that.
    assert sample(made.volume, points[wide]) == pytest.approx(LUMEN, abs=90)


@pytest.mark.parametrize("name", WORKLOADS)
def test_workload_vessels_hang_together(name):
    made = getattr(phantom, name)(scale=0.05)
    ends = [(v.points[0].tobytes(), v.points[-1].tobytes()) for v in made.tree]
    parent = {end: end for pair in ends for end in pair}

    def root(end):
        while parent[end] != end:
            end = parent[end]
        return end

    for a, b in ends:
        parent[root(a)] = root(b)
    assert len({root(end) for end in parent}) == 1
    # Each cycle adds an edge to a tree: the bypass, and the ring of both vertebral arteries.
    cycles = len(ends) - (len(parent) - 1)
    assert cycles == {"aorta": 0, "runoff": 1, "cervical": 1}[name]


@pytest.mark.parametrize("name", WORKLOADS)
def test_workload_lesions_match_their_radii(name):
    made = getattr(phantom, name)(scale=0.05)
    assert made.stenoses
    assert any(plaque.kind == "calcified" for plaque in made.plaques)
    for stated in made.stenoses:
        vessel, reference = made.tree[stated.vessel], made.reference_radius[stated.vessel]
        steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
        arc = np.concatenate([[0.0], np.cumsum(steps)])
        near = abs(arc - stated.arc_length) < stated.length / 2
        narrowest = 100 * (1 - vessel.radius[near] / reference[near]).max()
        assert narrowest == pytest.approx(stated.percent, abs=0.5)
    for plaque in made.plaques:
        distance = np.linalg.norm(made.tree[plaque.vessel].points - plaque.position, axis=1).min()
        assert distance < made.reference_radius[plaque.vessel].max() + plaque.thickness + 2


def test_the_seed_decides_every_byte():
    first, again, other = (phantom.aorta(seed, scale=0.1) for seed in (1, 1, 2))
    assert first.volume.array.tobytes() == again.volume.array.tobytes()
    assert first.volume.array.tobytes() != other.volume.array.tobytes()
    assert first.tree[3].points.tobytes() == again.tree[3].points.tobytes()
    assert first.tree[3].points.tobytes() != other.tree[3].points.tobytes()


def test_the_number_of_threads_changes_no_byte():
    code = (
        "from hashlib import sha256; from lumencut import phantom;"
        "print(sha256(phantom.aorta(5, scale=0.1).volume.array.tobytes()).hexdigest())"
    )
    expected = sha256(phantom.aorta(5, scale=0.1).volume.array.tobytes()).hexdigest()
    for threads in ("1", "3"):
        environment = {**os.environ, "RAYON_NUM_THREADS": threads}
        run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
        assert run.stdout.strip() == expected, run.stderr


@pytest.mark.parametrize(
    ("call", "subject"),
    [
        (lambda: phantom.stenosis(percent=100.0), "percent"),
        (lambda: phantom.stenosis(percent=float("nan")), "percent"),
        (lambda: phantom.aorta(scale=0.0), "scale"),
        (lambda: phantom.runoff(scale=float("inf")), "scale"),
        (lambda: phantom.cervical(seed=-1), "seed"),
        (lambda: phantom.cervical(seed=0.5), "seed"),
    ],
)
def test_bad_arguments_are_named(call, subject):
    with pytest.raises(SettingsError, match=f"^{subject}: found"):
        call()
