"""Phantoms as Python hands them on: names, types, one known radius, seeds and errors."""

from __future__ import annotations

import numpy as np
import pytest

from lumencut import phantom
from lumencut.errors import SettingsError

SMALL = [
    "straight_tube", "helix", "y_junction", "crossing", "trefoil", "collinear_run", "stenosis",
    "calcified_wall",
]  # fmt: skip


@pytest.mark.parametrize("name", SMALL)
def test_small_phantoms_have_volume_tree_and_truth(name):
    made = getattr(phantom, name)()
    assert made.name == name
    assert made.volume.array.dtype == np.int16
    np.testing.assert_allclose(made.volume.spacing, 0.5)
    for vessel, reference in zip(made.tree, made.reference_radius, strict=True):
        assert made.volume.contains(vessel.points).all()
        np.testing.assert_allclose(made.volume.sample(vessel.points), 350, atol=1)
        assert reference.shape == vessel.radius.shape == (len(vessel.points),)


def test_stenoses_and_plaques_are_stated():
    made = phantom.stenosis(percent=70.0)
    (stated,) = made.stenoses
    assert (stated.vessel, stated.arc_length, stated.percent) == (0, 30.0, 70.0)
    (ring,) = made.plaques
    assert ring.kind == "soft"
    assert made.tree[0].radius.min() / made.tree[0].radius.max() == pytest.approx(0.3)
    (plaque,) = phantom.calcified_wall().plaques
    assert plaque.kind == "calcified"
    assert isinstance(plaque.position, tuple)
    assert plaque.position == pytest.approx((5.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ("name", "size"),
    [("aorta", (512, 512, 256)), ("runoff", (512, 512, 1305)), ("cervical", (512, 512, 575))],
)
def test_workloads_have_the_sizes_of_the_paper_and_names(name, size):
    made = getattr(phantom, name)(scale=0.125)
    assert made.volume.size == tuple(round(n / 8) for n in size)
    assert len({vessel.name for vessel in made.tree}) == len(made.tree)


def test_the_seed_decides_every_byte():
    first, again, other = (phantom.aorta(seed, scale=0.1) for seed in (1, 1, 2))
    assert first.volume.array.tobytes() == again.volume.array.tobytes()
    assert first.volume.array.tobytes() != other.volume.array.tobytes()
    assert first.tree[3].points.tobytes() == again.tree[3].points.tobytes()
    assert first.tree[3].points.tobytes() != other.tree[3].points.tobytes()


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
