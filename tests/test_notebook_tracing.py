"""Tracing by clicks in a notebook, without a browser."""

import numpy as np
import pytest

import lumencut
from lumencut import phantom
from notebook_page import Page


@pytest.fixture(scope="module")
def scene():
    return phantom.y_junction()


@pytest.fixture
def page(scene):
    widget = lumencut.show(scene.volume, trace=True, size=(240, 200), device="cpu")
    yield Page(widget)
    widget.close()


def click(page, point):
    """Click on the pixel that shows a point of the scene."""
    [[column, row, _]] = page.widget.camera.project(point)
    return page.refused(["click", "vessels", column, row])[0]["words"]


def inner(vessel, share):
    return vessel.points[int(share * (len(vessel) - 1))]


def test_clicks_trace_a_vessel_that_python_has(page, scene):
    vessel = scene.tree[0]
    assert click(page, inner(vessel, 0.1)) == ""
    assert page.widget.tree is None
    assert click(page, inner(vessel, 0.9)) == ""
    [traced] = page.widget.tree
    expected = lumencut.trace(scene.volume, page.widget._view.tracing.points)
    np.testing.assert_array_equal(traced.points, expected[0].points)
    away = np.linalg.norm(traced.points[:, None] - vessel.points[None], axis=2).min(axis=1)
    assert away.max() < 1
    shown = page.widget._shown
    assert len(shown["points"]) == 2
    assert len(shown["lines"]) == 1


def test_a_double_click_ends_a_vessel_and_backspace_takes_points_away(page, scene):
    for vessel in scene.tree[:2]:
        click(page, inner(vessel, 0.1))
        click(page, inner(vessel, 0.9))
        page.ask(["double click", "vessels", 1.0, 1.0])
    assert len(page.widget.tree) == 2
    page.ask(["undo"])
    assert len(page.widget.tree) == 1
    page.ask(["undo"], ["undo"])
    assert page.widget.tree is None
    page.ask(["undo"], ["undo"], ["end"])
    assert page.widget._shown["points"] == []


def test_a_click_that_leads_nowhere_is_told_and_changes_nothing(page, scene):
    click(page, inner(scene.tree[0], 0.1))
    before = page.widget._shown["points"]
    words = page.refused(["click", "vessels", 3.0, 3.0])[0]["words"]
    assert "found" in words
    assert page.widget._shown["points"] == before
    assert click(page, inner(scene.tree[0], 0.9)) == ""
    assert len(page.widget.tree) == 1


def test_vessels_that_were_there_stay_beside_those_that_are_traced(scene):
    first = scene.tree.select(1)
    widget = lumencut.show(scene.volume, first, trace=True, size=(240, 200), device="cpu")
    page = Page(widget)
    click(page, inner(scene.tree[0], 0.1))
    click(page, inner(scene.tree[0], 0.9))
    assert len(widget.tree) == 2
    np.testing.assert_array_equal(widget.tree[0].points, first[0].points)
    widget.tree = None
    assert widget._shown["lines"] == []


def test_a_vessel_of_one_point_is_given_up_at_its_end(page, scene):
    click(page, inner(scene.tree[0], 0.1))
    page.ask(["end"])
    assert page.widget._shown["points"] == []
