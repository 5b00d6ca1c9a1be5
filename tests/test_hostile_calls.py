"""Every public call rejects arguments of the wrong kind by a Lumencut error, or returns a result."""

from __future__ import annotations

import itertools
import warnings

import pytest

import lumencut
from conftest import each_value
from hostile_calls import WRONG, cases


@pytest.fixture(scope="module")
def every_case(tmp_path_factory):
    return list(cases(tmp_path_factory.mktemp("hostile")))


#: The wrong values are tried in so many shares: in each, a parameter meets other values.
SHARES = 12


@each_value(most=1)
@pytest.mark.parametrize("share", range(SHARES))
@pytest.mark.filterwarnings("ignore")
def test_wrong_values_give_errors_of_lumencut_or_results(every_case, tmp_path, monkeypatch, share):
    # Some wrong values are file names; files are written here.
    monkeypatch.chdir(tmp_path)
    foreign = []
    first = itertools.count(share)
    for case in every_case:
        for parameter in case.given:
            for wrong in WRONG[next(first) % SHARES :: SHARES]:
                # Errors raised by a function that is called back pass through.
                if parameter == "progress" and callable(wrong):
                    continue
                try:
                    with warnings.catch_warnings(action="ignore"):
                        case.call(**{parameter: wrong})
                except lumencut.LumencutError:
                    continue
                except Exception as error:
                    foreign.append(f"{case.name}({parameter}={wrong!r:.40}): {type(error).__name__}: {error}")
    assert foreign == []


@pytest.mark.filterwarnings("ignore")
def test_the_cases_are_most_of_what_is_public(every_case):
    names = {case.name for case in every_case}
    assert {"render", "measure", "cpr", "read_volume", "Camera.fitted", "VesselTree.select"} <= names
    assert len(names) > 80
