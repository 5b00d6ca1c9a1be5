"""Suggested names of the vessels found in large phantoms."""

import pytest

from lumencut import phantom
from test_suggested_names import check_names


@pytest.mark.parametrize("make", [phantom.runoff, phantom.cervical])
def test_found_vessels_of_large_phantoms_get_no_wrong_name(make):
    check_names(make)
