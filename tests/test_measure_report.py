"""Reports of measured vessels: complete pages that load nothing else."""

import re

import numpy as np
import pytest

import lumencut
from lumencut import Renderer, VesselTree, measure, phantom
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
from lumencut.reports.measure_report import report
from report_reading import Page


@pytest.fixture(scope="module")
def page() -> Page:
    """Two pages: a marked stenosis, and the same vessel under an odd name with only suggestions."""
    scene = phantom.stenosis(60)
    vessel = scene.tree[0]
    profile = measure(scene.volume, vessel)
    measured = [
        MeasuredVessel.of("0", vessel, profile, Marked(30.0, (10.0, 50.0), group="carotid")),
        MeasuredVessel.of("1", vessel.named("<script>LAD & 'co'"), profile, Marked()),
    ]
    renderer = Renderer(scene.volume, VesselTree([vessel]), "cpu")
    told = []
    asked = dict.fromkeys(("fwhm", "at", "reference", "method", "original", "comparison", "group"))
    text = report(renderer, scene.volume, measured, asked | {"step": 0.5}, lambda *step: told.append(step))
    assert told == [(1, 2), (2, 2)]
    return Page(text)


def test_nothing_is_fetched_and_nothing_runs(page):
    assert page.links
    assert all(link.startswith("data:image/png;base64,") for link in page.links)
    assert set(page.tags) & {"script", "link", "iframe", "object", "base", "form"} == set()
    assert not re.search(r"https?:|//|@import|url\(", re.sub('base64,[^"]*', "", page.source))


def test_pictures_are_whole_and_show_something(page):
    # Each page has the plot with the CPR, and sections at the marked place and two references.
    pictures = page.pictures()
    assert len(pictures) == 2 * 4
    for picture in pictures:
        assert np.asarray(picture.convert("L")).std() > 10


def test_each_page_says_what_it_is_of_and_what_it_is_not(page):
    assert page.count("section") == 2
    assert page.text.count("Lumencut is not a medical device.") == 2
    assert page.text.count(f"Measured by Lumencut {lumencut.__version__}") == 2
    assert page.text.count("thrombus and plaque are not lumen") == 2
    assert page.text.count("Settings: step 0.5 mm; window W ") == 2
    assert page.text.count("FWHM of the point spread ") == 2
    assert "<script>LAD & 'co', 60.0 mm" in page.text


def test_no_percentage_without_method_references_and_mm(page):
    lines = [line for line in page.words if "%" in line]
    graded = (
        r"\d+ ± \d+ % of the diameter \(NASCET\): [\d.]+ ± [\d.]+ mm at 30\.0 mm, reference [\d.]+ mm at .*"
    )
    group = r"Severity group: 50 to 69 % \(groups of NASCET, .*\)"
    assert len(lines) == 2
    assert re.fullmatch(graded, lines[0])
    assert re.fullmatch(group, lines[1])


def test_every_number_of_the_table_has_its_unit(page):
    heads = ["arc length (mm)", "diameter ± 1 SD (mm)", "shortest (mm)", "longest (mm)", "area (mm²)"]
    # Marked places and the longest diameter of one vessel, and suggestions for the other.
    assert page.count("table") == 3
    for head in heads:
        assert page.source.count(f"<th>{head}</th>") == 3
    assert page.text.count("narrowest place (suggestion)") == 2
    assert page.text.count("marked place") == 2
