"""Names of vessels on pictures: their positions, and which are left out."""

from __future__ import annotations

import numpy as np
import pytest

from label_reading import heights, read
from lumencut import VIEWS, Camera, Renderer, Settings, Vessel, VesselTree, Volume, Window
from lumencut.pictures.lettering import writable

SIZE, MIDDLE = (400, 300), (199.5, 149.5)
VOLUME = Volume(np.zeros((8, 8, 8), np.int16), world_from_index=np.diag([60.0, 60.0, 60.0, 1.0]))
HIGH = heights(SIZE)[0]


def pictures(named: dict[str, tuple[float, float]], volume: Volume = VOLUME):
    """The picture with and without the names of vessels that end at these pixels (column, row)."""
    camera = Camera((200, 200, 200), *VIEWS["anterior"], SIZE, 1.0)
    vessels = []
    for name, (column, row) in named.items():
        end = np.array([200 + column - MIDDLE[0], 200, 200 - row + MIDDLE[1]])
        vessels.append(Vessel([end + np.array([0, 50, 0]), end], 1.0, name or None))
    settings = Settings(context=None, silhouettes=False, window=Window(1000, 10))
    frame = Renderer(volume, VesselTree(vessels)).render(camera, settings)
    assert not frame.image[..., :3].any()
    return frame.annotated()[..., 0], frame.annotated(vessel_names=True)[..., 0]


def test_a_name_stands_to_the_right_of_its_dot():
    bare, named = pictures({"LAD": (120, 90)})
    assert not bare[80:101, 110:200].any()
    assert named[90, 120] == 255
    assert read(named[75:105, 125:200], ["LAD", "RCA"], HIGH) == "LAD"
    changed = np.argwhere(named != bare)
    assert changed.min(axis=0)[1] >= 115
    assert abs(changed.mean(axis=0)[0] - 90) < 2


@pytest.mark.parametrize(
    ("place", "part"),
    [
        # No room on the right side: the name is to the left of the dot.
        ((392, 60), (slice(45, 75), slice(330, 388))),
        # The letter R is on the left, and the picture ends on the right: the name is above the dot.
        ((100, 60), (slice(45, 75), slice(105, 190))),
    ],
)
def test_a_name_stands_where_there_is_room(place, part):
    _, named = pictures({"LAD": place})
    assert read(named[part], ["LAD", "RCA"], HIGH) == "LAD"


def test_names_that_would_overlap_move_or_are_left_out():
    _, named = pictures({"first": (120, 80), "second": (124, 80), "third": (122, 80), "far": (250, 200)})
    # Other dots are to the right of the first; their names would cover its dot, so only it has a name.
    assert read(named[60:100, 60:116], ["first"], HIGH) == "first"
    assert not named[60:100, 128:].any()
    assert not named[100:140, 60:].any()
    assert read(named[185:215, 255:330], ["far"], HIGH) == "far"


def test_names_beyond_the_picture_are_left_out():
    for place in ((-3, 100), (403, 100), (200, -3), (200, 303), (-20, 5)):
        bare, named = pictures({"LAD": place})
        np.testing.assert_array_equal(named, bare)


def test_names_write_over_no_letter_and_no_bar():
    random = np.random.default_rng(4)
    places = random.uniform((0, 0), SIZE, (150, 2))
    bare, named = pictures({f"vessel {number}": tuple(place) for number, place in enumerate(places)})
    np.testing.assert_array_equal(named[bare > 0], bare[bare > 0])
    assert (named != bare).sum() > 3000


def test_vessels_without_a_name_get_none():
    bare, named = pictures({"": (120, 90)})
    np.testing.assert_array_equal(named, bare)


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("LAD", "LAD"),
        ("  A. carotis  ", "A. carotis"),
        ("Käßmann é", "Ka?mann e"),
        ("大動脈", "???"),
        ("a\nb\x1b[31m", "a?b?[31m"),
        ("x" * 32, "x" * 32),
        ("x" * 33, "x" * 31 + "…"),
        ("\ud800", "?"),
    ],
)
def test_names_in_letters_that_the_font_has(name, written):
    assert writable(name) == written


@pytest.mark.parametrize("name", ["", "   ", "x" * 100_000, "大" * 50, "a\nb\tc"])
def test_odd_names_break_nothing(name):
    bare, named = pictures({name: (120, 90)})
    assert named.shape == bare.shape
