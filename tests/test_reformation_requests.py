"""Requests of reformations have the parameters of the functions that make them."""

import inspect
from dataclasses import MISSING, fields

import pytest

import lumencut
from lumencut.cli.laid_out.reformation_table import MAP_MODES
from lumencut.reformations.endoscoping import EndoscopyRequest
from lumencut.reformations.feature_aggregation import CfaRequest
from lumencut.reformations.lumen_mapping import LumenMapRequest
from lumencut.reformations.planar_reformation import CprRequest
from lumencut.reformations.spiral_reformation import SpiralRequest
from lumencut.reformations.tangential import TangentialRequest
from lumencut.reformations.uncurling import UncurlRequest
from lumencut.reformations.unrolled_wall import MODES
from lumencut.reformations.untangling import UntangledRequest

MADE_BY = {
    "cpr": CprRequest,
    "cfa": CfaRequest,
    "endoscopy": EndoscopyRequest,
    "spiral": SpiralRequest,
    "lumen_map": LumenMapRequest,
    "uncurl": UncurlRequest,
    "untangled": UntangledRequest,
}


@pytest.mark.parametrize("name", MADE_BY)
def test_a_request_has_the_parameters_of_its_function(name):
    _scene, _vessels, *given = inspect.signature(getattr(lumencut, name)).parameters.values()
    apart = {"device", "degrees"} | ({"camera"} if name == "cpr" else set())
    own = [one for one in given if one.name not in apart]
    expected = [
        (one.name, MISSING if one.default is one.empty else one.default, one.annotation) for one in own
    ]
    found = [(field.name, field.default, field.type) for field in fields(MADE_BY[name])]
    kinds = {'Mode | Literal["tangential"]': "Mode", "Mode | Literal['tangential']": "Mode"}
    assert found == [(own, default, kinds.get(kind, kind)) for own, default, kind in expected]


def test_the_tangential_mode_has_parameters_of_cpr():
    given = inspect.signature(lumencut.cpr).parameters
    found = {field.name: (field.default, field.type) for field in fields(TangentialRequest)}
    assert found == {name: (given[name].default, given[name].annotation) for name in found}


def test_the_modes_of_the_map_are_those_of_the_library():
    assert MAP_MODES == MODES
