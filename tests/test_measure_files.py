"""Files of profiles: tables, JSON, plots and pictures of sections."""

import csv
import io
import json
import sys
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from PIL import Image

import lumencut
from lumencut import Flag, FormatError, MissingPackageError, Profile, Window, _lumencut, measure, phantom
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel, vessels_csv, vessels_json
from lumencut.measuring.profile_files import csv_text
from lumencut.measuring.profile_plot import figure_of, write
from lumencut.measuring.profile_sections import counts, flag_words, marks, nearest
from lumencut.pictures.contact_sheet import contact_sheet
from lumencut.reports.section_pictures import SectionView, sections_sheet

CYAN, ORANGE = (64, 220, 255), (255, 150, 40)


@pytest.fixture(scope="module")
def narrow():
    return phantom.stenosis(60)


@pytest.fixture(scope="module")
def profile(narrow) -> Profile:
    return measure(narrow.volume, narrow.tree[0], 1.0, tree=narrow.tree)


@pytest.fixture(scope="module")
def branched() -> Profile:
    """A profile with sections that do not count."""
    scene = phantom.y_junction()
    found = measure(scene.volume, scene.tree[0], 2.0, tree=scene.tree)
    assert 0 < counts(found).sum() < len(found)
    return found


@pytest.fixture(scope="module")
def marked(narrow, profile) -> MeasuredVessel:
    return MeasuredVessel.of("0", narrow.tree[0], profile, Marked(30.0, (10.0, 50.0), group="carotid"))


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_tables_give_back_the_numbers_to_seven_digits(branched, tmp_path):
    branched.save(tmp_path / "profile.csv")
    rows = rows_of((tmp_path / "profile.csv").read_text("utf-8"))
    assert len(rows) == len(branched)
    for name in ("arc_length", "diameter_equivalent", "diameter_min", "diameter_max", "diameter_mean"):
        read = [float(row[f"{name}_mm"] or "nan") for row in rows]
        np.testing.assert_allclose(read, getattr(branched, name), rtol=1e-6, atol=1e-6)
    area = [float(row["area_mm2"] or "nan") for row in rows]
    np.testing.assert_allclose(area, branched.area, rtol=1e-6)
    center = [[float(row[f"center_{axis}_lps_mm"]) for axis in "xyz"] for row in rows]
    np.testing.assert_allclose(center, branched.center, rtol=1e-6, atol=1e-6)
    assert {row["fwhm_source"] for row in rows} == {branched.fwhm_source}
    assert [row["counts"] == "yes" for row in rows] == counts(branched).tolist()


def test_every_column_of_a_length_states_its_unit(profile):
    (head,) = csv.reader([csv_text(profile).partition("\n")[0]])
    without = {"counts", "flags", "fwhm_source", "wall_source", "lumen_level", "background_level"}
    without |= {"outer_wall", "flap"}
    without |= {f"normal_{axis}_lps" for axis in "xyz"}
    without |= {"series_number", "series_description", "phase", "kernel"}
    assert {name for name in head if not name.endswith(("_mm", "_mm2"))} == without


def test_a_table_of_several_vessels_says_whose_a_line_is(narrow, marked):
    twice = vessels_csv([marked, marked])
    rows = rows_of(twice)
    assert len(rows) == 2 * len(marked.profile)
    assert {(row["vessel"], row["name"]) for row in rows} == {("0", narrow.tree[0].name)}


def test_flags_are_words_of_all_that_is_set(branched):
    assert flag_words(int(Flag.NO_EDGE | Flag.BRANCH)) == ["branch", "no clear wall"]
    assert flag_words(0) == []
    rows = rows_of(csv_text(branched))
    for row, bits in zip(rows, branched.flags, strict=True):
        words = row["flags"].split("; ") if row["flags"] else []
        assert sum(int(Flag[word.upper().replace(" ", "_")]) for word in words) == bits


def test_sections_that_count_are_those_of_the_core(branched, profile):
    for one in (branched, profile):
        kept = counts(one)
        widest = one.widest()
        assert widest.diameter == one.diameter_max[kept].max()
        assert one.arc_length[kept][one.diameter_max[kept].argmax()] == widest.arc_length


def refused(name):
    raise AssertionError(f"{name} is not JSON")


def test_json_gives_back_every_digit_and_null_for_nothing(branched):
    read = json.loads(branched.to_json(), parse_constant=refused)
    assert read["software"] == f"lumencut {lumencut.__version__}"
    assert read["notice"] == "Lumencut is not a medical device."
    for name in ("diameter_equivalent", "uncertainty", "inscribed_radius"):
        values = [np.nan if x is None else x for x in read["sections"][f"{name}_mm"]]
        np.testing.assert_array_equal(values, getattr(branched, name))
    assert read["fwhm_mm"] == branched.fwhm
    assert read["length_mm"] == branched.arc_length[-1]


def test_json_of_a_stenosis_has_method_references_and_mm(marked):
    options = {"step": 0.5, "at": 30.0, "reference": (10.0, 50.0), "group": "carotid"}
    options |= dict.fromkeys(("fwhm", "method", "original", "comparison"))
    read = json.loads(vessels_json(options, [marked]), parse_constant=refused)
    assert read["settings"]["reference_mm"] == [10.0, 50.0]
    assert read["settings"]["fwhm_mm"] is None
    (vessel,) = read["vessels"]
    graded = vessel["stenosis"]
    assert graded["method"] == "nascet"
    assert graded["percent"] == marked.stenosis.percent
    assert graded["percent"] == pytest.approx(100 * (1 - graded["diameter_mm"] / graded["reference_mm"]))
    assert [spot["arc_length_mm"] for spot in graded["references"]] == [10.0, 50.0]
    assert "NASCET" in graded["group"]
    suggested = vessel["suggestions"]["narrowest"]
    assert abs(suggested["arc_length_mm"] - 30) < 4


def test_only_two_endings_are_profiles(profile, tmp_path):
    with pytest.raises(FormatError, match=r"'\.xlsx'; expected \.csv, \.json, \.dcm"):
        profile.save(tmp_path / "profile.xlsx")
    assert list(tmp_path.iterdir()) == []


def test_places_that_nobody_named_are_suggestions(profile):
    suggested = marks(profile)
    assert [mark.name for mark in suggested] == ["narrowest place", "reference", "reference"]
    assert all(mark.is_suggestion and "(suggestion)" in str(mark) for mark in suggested)
    named = marks(profile, 30.0, (50.0,))
    place, offered, reference = named
    assert [(mark.name, mark.arc_length) for mark in (place, reference)] == [
        ("marked place", 30.0),
        ("reference", 50.0),
    ]
    # Only the reference before the place is unmarked, so one is suggested there.
    assert [mark.is_suggestion for mark in named] == [False, True, False]
    before, _ = profile.suggested_references(30.0)
    assert before is not None
    assert (offered.name, offered.arc_length) == ("reference", before.arc_length)
    assert len(marks(profile, 30.0, (10.0, 50.0))) == 3
    assert named[0].diameter == profile.diameter_at(30.0)[0]


def test_a_plot_draws_what_was_measured(branched):
    from matplotlib.figure import Figure

    axes = Figure().add_subplot()
    assert branched.plot(axes) is axes
    drawn = {line.get_label(): np.asarray(line.get_ydata(), float) for line in axes.lines}
    kept = counts(branched)
    np.testing.assert_array_equal(
        drawn["diameter of a circle of the same area"],
        np.where(kept, branched.diameter_equivalent, np.nan),
    )
    assert axes.get_xlabel() == "arc length (mm)"
    assert axes.get_ylabel() == "lumen diameter (mm)"
    assert axes.get_xlim() == (0, branched.arc_length[-1])
    assert {text.get_text() for text in axes.texts} == {
        word for bits in branched.flags for word in flag_words(int(bits))
    }


def test_a_plot_is_a_picture_of_the_line_and_the_places(marked, tmp_path):
    for name in ("one.png", "two.png"):
        write(figure_of([("$vessel 0", marked.profile, marked.marks)]), tmp_path / name)
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()
    with Image.open(tmp_path / "one.png") as image:
        pixels = np.asarray(image.convert("RGB")).astype(int)
        assert "http" not in str(image.info)
    for color, least in (((0x1F, 0x4E, 0x9C), 500), ((0xC8, 0x10, 0x2E), 500)):
        assert (np.abs(pixels - color).max(axis=-1) < 8).sum() > least


def test_an_svg_is_the_same_each_time(marked, tmp_path):
    for name in ("one.svg", "two.svg"):
        write(figure_of([("", marked.profile, marked.marks)]), tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
    assert ET.parse(tmp_path / "one.svg").getroot().tag.endswith("svg")


def test_without_matplotlib_the_extra_is_named(profile, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingPackageError, match=r'pip install "lumencut\[plot\]"'):
        profile.plot()


def near(picture, color):
    """Return columns and rows of the pixels that are close to a colour."""
    apart = np.abs(picture[..., :3].astype(int) - color).max(axis=-1)
    return np.argwhere(apart < 40)[:, ::-1]


@pytest.mark.parametrize("at", [10.0, 30.0])
def test_the_contour_of_a_section_lies_on_the_wall(narrow, marked, at):
    view = SectionView(narrow.volume, Window(level=200, width=800))
    number = nearest(marked.profile, at)
    picture = view.picture(marked, number)
    ring = near(picture, CYAN) - (view.side - 1) / 2
    radius = np.hypot(*ring.T) * _lumencut.section_spacing(marked.profile._core, view.side)
    assert len(ring) > 50
    profile = marked.profile
    wall = np.linalg.norm(profile.contour[number] - profile.center[number], axis=1).mean()
    assert radius.mean() == pytest.approx(wall, abs=0.03)
    plain = view.picture(marked, number, has_contour=False)
    assert len(near(plain, CYAN)) == 0
    middle, corner = plain[view.side // 2, view.side // 2, 0], plain[5, 5, 0]
    assert int(middle) - int(corner) > 80


def test_sections_that_do_not_count_have_another_colour(branched):
    scene = phantom.y_junction()
    one = MeasuredVessel.of("0", scene.tree[0], branched, Marked())
    view = SectionView(scene.volume, Window(level=200, width=800))
    out = int(np.flatnonzero(~counts(branched) & np.isfinite(branched.area))[0])
    picture = view.picture(one, out)
    assert len(near(picture, ORANGE)) > len(near(picture, CYAN))


def test_a_sheet_begins_lines_where_it_is_told():
    pictures = [np.full((40, 60, 4), (10 * n, 200, 0, 255), np.uint8) for n in range(1, 11)]
    titles = [f"picture {n}" for n in range(1, 11)]
    for starts, is_first in (((), False), ((0, 5), True)):
        sheet = contact_sheet(pictures, titles, starts)
        first, sixth = (
            np.argwhere((sheet == (10 * n, 200, 0, 255)).all(axis=-1)).min(axis=0) for n in (1, 6)
        )
        assert (first[1] == sixth[1]) == is_first
        assert sixth[0] > first[0]


def test_the_sheet_shows_marked_places_and_tells_its_progress(narrow, marked):
    view = SectionView(narrow.volume, Window(level=200, width=800))
    told = []
    bare = MeasuredVessel("0", marked.vessel, marked.profile, (), None)
    few = sections_sheet(view, [bare, bare], 3, lambda *step: told.append(step))
    more = sections_sheet(view, [marked, marked], 3)
    assert told == [(1, 2), (2, 2)]
    # Sections at 10 and 50 mm are added to the first, middle and last; each shows its contour.
    assert len(near(more, CYAN)) > 1.3 * len(near(few, CYAN))
