"""The focus from Python and the command line: its formula on a phantom, its look, and errors."""

import dataclasses

import numpy as np
import pytest

from lumencut import (
    Camera,
    Focus,
    Renderer,
    Settings,
    SettingsError,
    Slab,
    Vessel,
    VesselTree,
    Volume,
    Window,
    _lumencut,
    phantom,
    render,
)


@pytest.fixture(scope="module")
def scene() -> phantom.Phantom:
    return phantom.y_junction()


@pytest.fixture(scope="module")
def renderer(scene: phantom.Phantom) -> Renderer:
    return Renderer(scene.volume, scene.tree, device="cpu")


@pytest.fixture(scope="module")
def camera(scene: phantom.Phantom) -> Camera:
    return Camera.anterior(scene.tree, size=(120, 100)).rotated(degrees=20)


def test_between_two_tubes_the_share_is_that_of_the_nearer_wall() -> None:
    """White tubes in a white volume on black, no context: the brightness is the share of the cut surface."""
    volume = Volume(np.full((40, 40, 60), 1000, np.int16), origin=(-30, -20, -20))
    tree = VesselTree(
        Vessel([[x, 0, -15], [x, depth, 15]], radius) for x, depth, radius in ((-12, 0, 2), (9, 4, 5))
    )
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), size=(50, 20), pixel_spacing=1)
    frame = render(
        volume,
        tree,
        camera,
        Settings(focus=Focus(1, 5), context=None, silhouettes=False, window=Window(500, 100)),
    )
    x = np.arange(50) - 24.5
    beyond = np.minimum(np.abs(x + 12) - 2, np.abs(x - 9) - 5).clip(0)
    away = ((beyond - 1) / 5).clip(0, 1)
    share = 1 - away**2 * (3 - 2 * away)
    assert np.abs(frame.image[10, :, 0] - 255 * share).max() <= 1


def test_the_look_is_a_focus_in_a_shaded_body() -> None:
    look = Settings.focused(samples=2)
    around = {"context_shading": True, "context_halo": 0.6, "context_body": True}
    assert look == Settings(focus=Focus(2, 6), context="mida", samples=2, **around)
    assert Settings().focus is None
    assert Settings.focused(focus=Focus(0, 3)).focus == Focus(0, 3)


NOTHING = Focus(-1e6, 0)
LOOKS = {
    "lumen": Settings(),
    "focus": Settings.focused(),
    "body": Settings(focus=NOTHING, context="mida", context_shading=True, context_from="whole"),
    "mip": Settings(focus=NOTHING, context="mip"),
    "slab": Settings(slab=Slab(10, "max")),
}


@pytest.mark.parametrize("name", LOOKS)
def test_a_look_is_several_settings_under_one_name(name: str) -> None:
    assert Settings.look(name) == LOOKS[name]
    assert Settings.look(name, samples=2) == dataclasses.replace(LOOKS[name], samples=2)
    assert set(LOOKS) == set(_lumencut.LOOKS) == set(_lumencut.LOOK_SENTENCES)


def test_an_unknown_look_is_refused() -> None:
    with pytest.raises(SettingsError, match=r"name of the look: found 'lumem'; expected one of 'lumen'"):
        Settings.look("lumem")


def test_nothing_is_cut_by_the_looks_of_the_body(scene: phantom.Phantom, camera: Camera) -> None:
    for name, context in (("body", "mida"), ("mip", "mip")):
        look = Settings.look(name, context_window=Window(300, 900))
        alone = Settings(
            context=context, context_shading=look.context_shading, context_window=Window(300, 900)
        )
        with_tree = render(scene.volume, scene.tree, camera, settings=look)
        without = render(scene.volume, None, camera, settings=alone)
        np.testing.assert_array_equal(with_tree.image, without.image)


@pytest.mark.parametrize(
    ("margin", "fade", "message"),
    [
        (float("nan"), 6, "focus margin: found NaN"),
        (float("inf"), 6, "focus margin: found inf"),
        (2, -1, "focus fade: found -1"),
        (2, float("nan"), "focus fade: found NaN"),
        ("2", 6, "focus margin"),
    ],
)
def test_other_lengths_are_refused(margin: float, fade: float, message: str) -> None:
    with pytest.raises(SettingsError, match=message):
        Focus(margin, fade)


def test_a_focus_needs_vessels(scene: phantom.Phantom) -> None:
    with pytest.raises(
        SettingsError, match=r"focus: found a focus for a scene without centerlines; .*leave the"
    ):
        render(scene.volume, None, settings=Settings.focused())


def test_a_pair_of_numbers_is_no_focus() -> None:
    with pytest.raises(SettingsError, match=r"focus: found \(2, 6\); expected a Focus or None"):
        Settings(focus=(2, 6))  # type: ignore[arg-type]


def test_the_strength_of_the_context_is_that_of_its_colours(renderer: Renderer, camera: Camera) -> None:
    shown = [
        renderer.render(
            camera,
            Settings(focus=Focus(-1e6, 6), context="mip", context_strength=strength, silhouettes=False),
        ).image[..., :3]
        for strength in (1.0, 0.5)
    ]
    assert np.abs(shown[0] * 0.5 - shown[1]).max() <= 1
    with pytest.raises(SettingsError, match="context_strength"):
        Settings(context_strength=1.1)
