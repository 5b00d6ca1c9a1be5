"""Defaults and names of methods are defined only once, below Python."""

import inspect

import pytest

import lumencut
from lumencut import VesselTree, _lumencut
from lumencut.cli.measure import measure as measure_command
from lumencut.measured_vessel import GROUPS
from lumencut.stenosis import METHODS


@pytest.mark.parametrize(
    ("function", "parameter", "name"),
    [
        (lumencut.measure, "step", "measuring_step"),
        (VesselTree.measured, "step", "measuring_step"),
        (lumencut.find_vessels, "smallest_radius", "smallest_radius"),
        (lumencut.trace_from, "smallest_radius", "smallest_radius"),
        (lumencut.trace_mask, "shortest_branch", "shortest_branch"),
    ],
)
def test_defaults_of_functions_are_those_of_the_core(function, parameter, name):
    assert inspect.signature(function).parameters[parameter].default == _lumencut.DEFAULTS[name]


def test_the_default_of_the_command_is_that_of_the_core():
    (step,) = [option for option in measure_command.params if option.name == "step"]
    assert step.default == _lumencut.DEFAULTS["measuring_step"]


def test_names_of_methods_are_those_of_the_core():
    assert list(METHODS) == [name for name, _ in _lumencut.STENOSIS_METHODS]
    assert list(GROUPS) == _lumencut.STENOSIS_TERRITORIES
