"""The stated uncertainty of diameters is right in all scenes of ``tests/calibration.py``.

This takes minutes, so ``make test-long`` runs it and ``make test`` does not.
"""

import pytest

from calibration import KINDS, calibrated
from test_calibration import WITHIN

#: These scenes have no walls although walls are expected: the uncertainty is too large, which is harmless.
CAUTIOUS = "even tissue, white noise"


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_the_truth_lies_within_what_is_told_as_often_as_told(kind):
    told = calibrated(kind, 24)
    assert len(told.errors) > 12
    for deviations, (least, most) in WITHIN.items():
        _, low, high = told.within(deviations)
        assert low <= most or kind.name == CAUTIOUS
        assert high >= least
