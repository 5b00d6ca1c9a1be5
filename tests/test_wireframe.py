"""The vessel walls as a wireframe over pictures: only the picture changes."""

import numpy as np
import pytest

from lumencut import Camera, Focus, Renderer, Settings, Window, phantom
from lumencut.errors import SettingsError

WINDOW = Window(100, 600)


@pytest.fixture(scope="module")
def scene():
    """A renderer of a vessel with a stenosis, and a view of it."""
    made = phantom.stenosis()
    return Renderer(made.volume, made.tree, "cpu"), Camera.anterior(made.tree, (120, 160))


@pytest.mark.parametrize("samples", [1, 2])
def test_only_the_picture_has_wires(scene, samples):
    renderer, camera = scene
    plain = renderer.render(camera, Settings(window=WINDOW, context_window=WINDOW, samples=samples))
    wired = renderer.render(
        camera, Settings(window=WINDOW, context_window=WINDOW, samples=samples, tree="wireframe")
    )
    for name in ("depth", "vessel", "value", "distance"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(wired, name))
    changed = (plain.image != wired.image).any(axis=-1)
    # No farther from the wall than half a wire and a pixel of smoothing.
    assert changed.any()
    assert wired.distance[changed].max() <= renderer.tree[0].radius.max() + 1.0 * camera.pixel_spacing


def test_wires_alone_lie_on_the_background(scene):
    renderer, camera = scene
    settings = Settings(
        focus=Focus(-1000, 0), context=None, silhouettes=False, tree="wireframe", window=WINDOW
    )
    shown = renderer.render(camera, settings, images=["image"]).image
    colors = np.unique(shown[..., :3].reshape(-1, 3), axis=0)
    # Black, the full colour, and mixtures of both.
    assert (colors[0] == 0).all()
    assert (colors[:, 2] >= colors[:, 1]).all()
    assert shown[..., 2].max() > 200


def test_another_name_is_rejected():
    with pytest.raises(SettingsError, match="'hidden', 'wireframe'"):
        Settings(tree="tubes")
