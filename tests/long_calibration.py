"""What is told of the uncertainty of diameters holds in all scenes of ``make calibration``.

This takes minutes, so ``make test-long`` runs it and ``make test`` does not.
"""

import pytest

from calibration import KINDS, calibrated
from test_calibration import WITHIN

#: Here walls are allowed for that are not there: the uncertainty is told too large, which misleads nobody.
CAUTIOUS = "even tissue, white noise"


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_the_truth_lies_within_what_is_told_as_often_as_told(kind):
    told = calibrated(kind, 24)
    assert len(told.errors) > 12
    for deviations, (least, most) in WITHIN.items():
        _, low, high = told.within(deviations)
        assert low <= most or kind.name == CAUTIOUS
        assert high >= least
