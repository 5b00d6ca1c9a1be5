"""The stated uncertainty of diameters is right in scenes of one kind; ``make test-long`` tries all kinds."""

import numpy as np
import pytest

from calibration import KINDS, calibrated

#: Expected shares of sections within one and two stated standard deviations (percent).
WITHIN = {1: (60, 76), 2: (90, 98)}


@pytest.fixture(scope="module")
def told():
    return calibrated(next(kind for kind in KINDS if kind.name == "fat"), 8)


def test_the_truth_lies_within_what_is_told_as_often_as_told(told):
    for deviations, (least, most) in WITHIN.items():
        _, low, high = told.within(deviations)
        assert low <= most
        assert high >= least


def test_diameters_have_no_bias_by_their_walls(told):
    assert np.concatenate(told.errors).mean() == pytest.approx(0, abs=0.05)
