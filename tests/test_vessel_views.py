"""Views centred on a point of a vessel, views of one vessel, and the diameters that a turn shows."""

import math

import numpy as np
import pytest

from lumencut import Camera, CameraError, Renderer, Settings, Vessel, VesselTree, VesselTreeError, Volume
from lumencut.pictures.place_turns import cut_diameter, radius_at, turn_about

#: Half the axes of the elliptical lumen (mm), and the spacing of its voxels.
A, B, SPACING = 6.0, 3.0, 0.4


@pytest.fixture(scope="module")
def ellipse() -> tuple[Volume, Vessel]:
    """A tube along z whose lumen is an ellipse, wider to the left and right, with soft walls."""
    half = np.arange(-50, 51) * SPACING
    x, y = np.meshgrid(half, half)
    # The distance from the wall along the line through the middle, away from the middle itself.
    share = np.maximum(np.hypot(x / A, y / B), 1e-3)
    beyond = (share - 1) * np.maximum(np.hypot(x, y), 1e-3 * B) / share
    section = np.clip(0.5 - beyond / SPACING, 0, 1) * 300
    voxels = np.repeat(section[None], 101, axis=0).astype(np.float32)
    volume = Volume(voxels, spacing=(SPACING,) * 3, origin=(half[0],) * 3)
    return volume, Vessel([[0, 0, -18], [0, 0, 18]], math.sqrt(A * B), name="LAD")


def test_a_turn_about_a_place_shows_every_diameter_of_an_ellipse(ellipse: tuple[Volume, Vessel]) -> None:
    volume, vessel = ellipse
    for degrees in range(0, 180, 15):
        camera = Camera.about(vessel, 18.0, degrees=degrees, size=(257, 257))
        turn = math.radians(degrees)
        expected = 2 * A * B / math.hypot(B * math.cos(turn), A * math.sin(turn))
        assert abs(cut_diameter(volume, camera, radius_at(vessel, 18.0)) - expected) < 0.15, degrees
        assert np.allclose(camera.project([0, 0, 0])[0], [128, 128, 0])


def test_the_cut_itself_shows_that_diameter(ellipse: tuple[Volume, Vessel]) -> None:
    volume, vessel = ellipse
    renderer = Renderer(volume, VesselTree([vessel]), device="cpu")
    for degrees in (0, 40, 90):
        camera = Camera.about(vessel, 18.0, degrees=degrees, size=(257, 257))
        row = renderer.render(camera, Settings(context=None)).value[128]
        shown = np.count_nonzero(row > 150) * camera.pixel_spacing
        assert abs(shown - cut_diameter(volume, camera, 4.2)) < 0.5, degrees


def test_a_place_stays_where_it_is_while_the_view_turns(ellipse: tuple[Volume, Vessel]) -> None:
    _, vessel = ellipse
    first = Camera.about(vessel, 7.5)
    assert first == Camera.about(vessel, 7.5, 0.0) == Camera.about(vessel, 7.5, degrees=0)
    assert Camera.about(vessel, 7.5, 0.4) == first.rotated(0.4)
    assert np.allclose(first.center, [0, 0, -10.5])
    assert np.allclose((first.direction, first.up), ((0, 1, 0), (0, 0, 1)))
    assert first.pixel_spacing == pytest.approx(16 * math.sqrt(A * B) / 512)


def test_each_frame_of_a_turn_says_the_diameters(ellipse: tuple[Volume, Vessel]) -> None:
    volume, vessel = ellipse
    renderer = Renderer(volume, VesselTree([vessel]), device="cpu")
    camera = Camera.about(vessel, 18.0, size=(220, 220))
    plain = renderer.render(camera, Settings(context=None))
    first, *others = turn_about(renderer, camera, 4.2, Settings(context=None), frames=3, degrees=90)
    changed = (first.image != plain.image).any(axis=2)
    assert changed[110:, 110:].any()
    assert not changed[:110].any()
    assert len(others) == 2


@pytest.mark.parametrize("at", [-1, 36.5, float("nan")])
def test_a_place_off_the_vessel_is_refused(ellipse: tuple[Volume, Vessel], at: float) -> None:
    with pytest.raises(CameraError, match=r"place of the view: found .* mm on a vessel of 36 mm"):
        Camera.about(ellipse[1], at)


def test_other_arguments_are_refused(ellipse: tuple[Volume, Vessel]) -> None:
    with pytest.raises(CameraError, match="found an angle in radians and one in degrees"):
        Camera.about(ellipse[1], 5, 1.0, degrees=3)
    with pytest.raises(CameraError, match="vessel of the view: found str"):
        Camera.about("LAD", 5)  # type: ignore[arg-type]


def test_a_vessel_is_refocused_by_its_name() -> None:
    angles = np.linspace(0, math.pi, 30)
    arch = Vessel(np.stack([0 * angles, 40 * np.cos(angles), 40 * np.sin(angles)], axis=1), 3, name="arch")
    other = Vessel([[0, 0, 0], [30, 0, 0]], 3, name="LCX")
    tree = VesselTree([other, arch])
    found = Camera.refocused(tree, "arch", size=(200, 100))
    assert abs(found.direction[0]) > 0.97, "the plane of the arch is that of x = 0"
    assert found.size == (200, 100)
    assert found == Camera.refocused(tree, 1, (200, 100)) == Camera.refocused(tree, arch, (200, 100))
    behind = Camera.refocused(tree, "arch", start=Camera.right(tree))
    assert behind.direction[0] > 0.97, "from the side that is nearer to the view before"
    with pytest.raises(VesselTreeError, match="perhaps 'arch' is meant"):
        Camera.refocused(tree, "arhc")
