"""The stated uncertainty of diameters is right in some of the scenes of ``tests/calibration.py``."""

import numpy as np
import pytest

from calibration import KINDS, calibrated

#: Expected shares of sections within one and two stated standard deviations (percent).
WITHIN = {1: (60, 76), 2: (90, 98)}

FEW = [kind for kind in KINDS if kind.name in ("fat", "muscle", "sharp kernel", "stenoses")]


@pytest.mark.parametrize("kind", FEW, ids=lambda kind: kind.name)
def test_the_truth_lies_within_what_is_told_as_often_as_told(kind):
    told = calibrated(kind, 12)
    for deviations, (least, most) in WITHIN.items():
        _, low, high = told.within(deviations)
        assert low <= most
        assert high >= least


def test_diameters_have_no_bias_by_their_walls():
    told = calibrated(next(kind for kind in KINDS if kind.name == "fat"), 12)
    assert np.concatenate(told.errors).mean() == pytest.approx(0, abs=0.05)
