"""The view of vessels in a notebook, without a browser: traits, the effect of steps, and invalid input."""

import base64
import io
import threading
from dataclasses import replace

import numpy as np
import pytest
import traitlets
from PIL import Image

import lumencut
from lumencut import (
    Camera,
    CameraError,
    Settings,
    SettingsError,
    VesselTree,
    VesselTreeError,
    VolumeError,
    Window,
)
from notebook_page import Page, junction, noise


def pixels(content: bytes) -> np.ndarray:
    with Image.open(io.BytesIO(content)) as picture:
        return np.asarray(picture.convert("RGBA"))


@pytest.fixture
def scene():
    return junction()


@pytest.fixture
def page(scene):
    widget = lumencut.show(scene.volume, scene.tree, size=(240, 200), device="cpu")
    yield Page(widget)
    widget.close()


def test_the_first_picture_is_that_of_the_frame(page):
    widget = page.widget
    shown = widget.frame().annotated(vessel_names=True)
    np.testing.assert_array_equal(pixels(widget.picture), shown)
    assert shown[..., :3].std() > 10
    assert widget.camera.size == (240, 200)


def test_documents_without_a_kernel_show_the_picture(page):
    data, _ = page.widget._repr_mimebundle_()
    assert base64.b64decode(data["image/png"]) == page.widget.picture
    assert "application/vnd.jupyter.widget-view+json" in data


def test_a_drag_turns_the_camera_and_answers_with_a_quick_picture(page):
    before = page.widget.camera
    answer = page.ask(["rotate", 100, 0])
    assert list(answer) == ["vessels"]
    with Image.open(io.BytesIO(answer["vessels"])) as picture:
        assert picture.format == "JPEG"
        assert picture.size == (240, 200)
    # A drag over the full height is half a turn; the scene follows the pointer, the viewer moves oppositely.
    expected = before.rotated(-np.pi / 2)
    np.testing.assert_allclose(page.widget.camera.direction, expected.direction, atol=1e-12)
    rest = page.widget.picture
    assert page.ask(moving=False) == {}
    assert page.widget.picture != rest
    np.testing.assert_array_equal(
        pixels(page.widget.picture), page.widget.frame().annotated(vessel_names=True)
    )


def test_the_view_turns_about_what_is_picked(page):
    page.widget.picked = (3.0, 2.0, 5.0)
    before = page.widget.camera.project([3.0, 2.0, 5.0])
    page.ask(["rotate", 31, -17], ["spin", 20, 0])
    np.testing.assert_allclose(page.widget.camera.project([3.0, 2.0, 5.0]), before, atol=1e-9)


def test_panning_and_zooming_keep_the_place_at_the_pointer(page):
    [[column, row, _]] = page.widget.camera.project([4.0, 0.0, 6.0])
    page.ask(["pan", 12, -7])
    np.testing.assert_allclose(page.widget.camera.project([4.0, 0.0, 6.0])[0, :2], [column + 12, row - 7])
    spacing = page.widget.camera.pixel_spacing
    page.ask(["zoom", 2.0, column + 12, row - 7])
    assert page.widget.camera.pixel_spacing == pytest.approx(spacing / 2)
    np.testing.assert_allclose(page.widget.camera.project([4.0, 0.0, 6.0])[0, :2], [column + 12, row - 7])


def test_a_window_is_dragged_chosen_and_reset(page):
    first = page.widget.frame()._source.window
    page.ask(["window", 100, 50])
    window = page.widget.settings.window
    assert window.width == pytest.approx(first.width * np.exp(0.4))
    assert window.level == pytest.approx(first.level + 0.2 * first.width)
    page.ask(["preset", 3])
    assert page.widget.settings.window == Window.named("bone")
    page.ask(["rotate", 30, 5], ["reset"])
    assert page.widget.settings.window is None
    assert page.widget.camera == Camera.anterior(page.widget.tree, (240, 200))


def test_a_drag_that_is_taken_back_leaves_no_trace(page):
    camera, settings = page.widget.camera, page.widget.settings
    page.ask(["begin"], ["rotate", 30, 5])
    page.ask(["window", 30, 5], ["back"])
    assert (page.widget.camera, page.widget.settings) == (camera, settings)


def test_keys_choose_views_and_silhouettes(page):
    page.ask(["view", "left"], ["silhouettes"])
    assert page.widget.camera == Camera.left(page.widget.tree, (240, 200))
    assert page.widget.settings.silhouettes is False


def test_a_click_picks_what_the_frame_has_there(page):
    frame = page.widget.frame()
    row, column = np.argwhere(frame.distance < 1)[7]
    answer = page.ask(["click", "vessels", float(column) + 0.3, float(row) - 0.3])
    assert page.widget.picked == tuple(frame.position[row, column])
    assert page.widget.vessel == frame.vessel[row, column]
    assert sorted(answer) == ["section", "straightened"]
    shown = page.widget._shown
    np.testing.assert_allclose(shown["cross"], [[column, row]], atol=0.01)
    assert shown["words"].startswith(page.widget.tree[page.widget.vessel].name or "vessel")


def test_a_click_beside_all_vessels_picks_none(page):
    page.ask(["click", "vessels", 2.0, 2.0])
    assert page.widget.vessel is None
    assert page.widget.picked is not None


def test_a_focus_picks_the_brightest_place_around_the_vessels(scene):
    widget = lumencut.show(
        scene.volume, scene.tree, settings=Settings.focused(), size=(240, 200), device="cpu"
    )
    page = Page(widget)
    frame = widget.frame()
    row, column = np.unravel_index(frame.distance.argmax(), frame.distance.shape)
    try:
        expected = lumencut.brightest(scene.volume, widget.camera, (column, row))
    except lumencut.TracingError:
        assert "meets no voxel" in page.refused(["click", "vessels", column, row])[0]["words"]
    else:
        page.ask(["click", "vessels", column, row])
        assert widget.picked == tuple(expected)
    row, column = np.argwhere(frame.distance < 1)[7]
    page.ask(["click", "vessels", column, row])
    np.testing.assert_allclose(widget.picked, frame.position[row, column])


def test_the_wheel_moves_the_section_and_turns_the_straightened_vessel(page):
    page.widget.vessel = 0
    page.ask(["click", "straightened", 10.0, 30.0])
    at = page.widget._view.place.at
    straightened = page.ask(["scroll", "section", 4])["straightened"]
    assert page.widget._view.place.at == pytest.approx(at + 2.0)
    assert page.ask(["scroll", "straightened", 9])["straightened"] != straightened
    assert page.widget._view.place.at == pytest.approx(at + 2.0)
    page.ask(["scroll", "section", 100000])
    assert page.widget._view.place.at == pytest.approx(page.widget.tree[0].length)


def test_a_click_in_the_straightened_vessel_is_shown_where_it_was_made(page):
    page.widget.vessel = 0
    page.ask(["click", "straightened", 20.0, 33.0])
    np.testing.assert_allclose(page.widget._shown["marks"]["straightened"], [20, 33], atol=0.6)
    page.ask(["click", "section", 90.0, 70.0])
    np.testing.assert_allclose(page.widget._shown["marks"]["section"], [90, 70], atol=0.6)


def test_traits_are_shown_at_once_and_can_be_observed(page):
    widget, heard = page.widget, []
    widget.observe(lambda change: heard.append(change["name"]), ["camera", "picked", "vessel"])
    picture = widget.picture
    widget.camera = Camera.left(widget.tree, (240, 200))
    assert widget.picture != picture
    page.ask(["rotate", 10, 0], ["click", "vessels", 120.0, 100.0])
    assert {"camera", "picked"} <= set(heard)
    widget.settings = Settings(context=None)
    np.testing.assert_array_equal(pixels(widget.picture), widget.frame().annotated(vessel_names=True))


def test_a_vessel_is_picked_by_its_name(scene):
    tree = VesselTree(vessel.named(name) for vessel, name in zip(scene.tree, "abc", strict=False))
    widget = lumencut.show(scene.volume, tree, size=(100, 100), device="cpu")
    widget.vessel = "b"
    assert widget.vessel == 1
    assert widget.picked in [tuple(point) for point in tree[1].points]
    widget.vessel = None
    assert widget._straightened == b""


def test_what_cannot_be_shown_leaves_everything_as_it_was(page):
    widget = page.widget
    before = (widget.camera, widget.settings, widget.tree, widget.picked, widget.vessel, widget.picture)
    beyond = VesselTree([replace_points(widget.tree[0])])
    for name, value, error in (
        ("camera", replace(widget.camera, size=(9000, 10)), CameraError),
        ("camera", "front", traitlets.TraitError),
        ("settings", Settings(focus_vessels=["nobody"]), VesselTreeError),
        ("settings", 3, traitlets.TraitError),
        ("tree", beyond, VesselTreeError),
        ("picked", (1, 2), CameraError),
        ("picked", (1, 2, np.nan), CameraError),
        ("vessel", "nobody", VesselTreeError),
        ("vessel", 99, VesselTreeError),
    ):
        with pytest.raises(error):
            setattr(widget, name, value)
        now = (widget.camera, widget.settings, widget.tree, widget.picked, widget.vessel, widget.picture)
        assert now == before, name


def replace_points(vessel):
    return lumencut.Vessel(vessel.points + 1e4, vessel.radius)


def test_a_volume_is_replaced_with_its_vessels(page, scene):
    widget = page.widget
    camera, picture = widget.camera.rotated(0.3), widget.picture
    widget.camera = camera
    darker = lumencut.Volume(scene.volume.array // 2, world_from_index=scene.volume.world_from_index)
    widget.settings = Settings(window=Window(200, 900))
    picture = widget.picture
    widget.replace(darker, scene.tree)
    assert widget.camera == camera
    assert widget.picture != picture
    other = noise()
    widget.replace(other)
    assert widget.tree is None
    assert widget.camera == Camera.anterior(other, (240, 200))
    page.ask(["click", "vessels", 120.0, 100.0])
    assert widget.vessel is None
    with pytest.raises(VesselTreeError):
        widget.replace(other, VesselTree([replace_points(scene.tree[0])]))
    assert widget.tree is None


def test_voxels_that_were_changed_are_shown_after_replacing(scene):
    volume = lumencut.Volume(scene.volume.array.copy(), world_from_index=scene.volume.world_from_index)
    widget = lumencut.show(volume, scene.tree, size=(100, 100), window=Window(200, 900), device="cpu")
    picture = widget.picture
    volume.array[:] = 0
    widget.replace(volume, scene.tree)
    assert widget.picture != picture


def test_a_volume_alone_is_shown_and_picked_from():
    widget = lumencut.show(noise(), size=(120, 90), device="cpu")
    page = Page(widget)
    page.ask(["window", 40, 10])
    assert widget.settings.window is None
    assert isinstance(widget.settings.context_window, Window)
    page.ask(["click", "vessels", 60.0, 45.0])
    assert widget.picked == tuple(lumencut.brightest(noise(), widget.camera, (60, 45)))
    widget.tree = None
    with pytest.raises(VesselTreeError, match="a tree, which show was not given"):
        widget.vessel = 0


def test_unexpected_mistakes_are_told_to_the_page_too(page, capsys):
    answer, _ = page.refused(["somersault"])
    assert answer["words"] == "unexpected KeyError: 'somersault'"
    page.ask(["rotate", 10, 0])


def test_an_error_while_it_moves_keeps_the_picture(page, monkeypatch):
    def fail(*_, **__):
        raise lumencut.DeviceError("GPU", "none", "one")

    picture = page.widget.picture
    monkeypatch.setattr(lumencut.Renderer, "render", fail)
    for moving in (True, False):
        answer, pictures = page.refused(["rotate", 10, 0], moving=moving)
        assert answer["words"] == "GPU: found none; expected one"
        assert pictures == {}
    assert page.widget.picture == picture


def test_a_widget_that_is_closed_while_it_renders_gives_up(page, monkeypatch):
    rendering, go_on = threading.Event(), threading.Event()
    real = lumencut.Renderer.render

    def slow(self, *arguments, progress, **options):
        rendering.set()
        assert go_on.wait(20)
        return real(self, *arguments, progress=progress, **options)

    monkeypatch.setattr(lumencut.Renderer, "render", slow)
    threads = threading.active_count()
    asking = threading.Thread(
        target=page.widget._handle_custom_msg,
        args=({"kind": "steps", "id": "late", "steps": [["rotate", 10, 0]], "moving": True}, []),
    )
    asking.start()
    assert rendering.wait(20)
    page.widget.close()
    go_on.set()
    asking.join(20)
    assert not asking.is_alive()
    assert page.answers == []
    assert threading.active_count() == threads
    assert repr(page.widget) == "VesselWidget(closed; show makes another one)"


def test_two_widgets_have_views_of_their_own(page, scene):
    other = lumencut.show(scene.volume, scene.tree, size=(120, 100), device="cpu")
    page.ask(["rotate", 40, 0])
    assert other.camera == Camera.anterior(scene.tree, (120, 100))
    other.close()


def test_moving_pictures_have_fewer_pixels_where_they_are_slow(page, monkeypatch):
    clock = iter(range(0, 10**6, 1))
    monkeypatch.setattr("lumencut.notebook.widget.time.perf_counter", lambda: next(clock) * 0.1)
    sizes = [pixels(page.ask(["rotate", 3, 0])["vessels"]).shape[:2] for _ in range(14)]
    assert sizes[:4] == [(200, 240)] * 3 + [(150, 180)]
    assert sizes[-1] == (50, 60)
    monkeypatch.setattr("lumencut.notebook.widget.time.perf_counter", lambda: 0.0)
    sizes = [pixels(page.ask(["rotate", 3, 0])["vessels"]).shape[:2] for _ in range(14)]
    assert sizes[-1] == (200, 240)
    clock = iter(range(0, 10**6, 1))
    monkeypatch.setattr("lumencut.notebook.widget.time.perf_counter", lambda: float(next(clock)))
    sizes = [pixels(page.ask(["rotate", 3, 0])["vessels"]).shape[:2] for _ in range(2)]
    assert sizes == [(200, 240), (50, 60)]


@pytest.mark.parametrize(
    ("arguments", "options", "error", "words"),
    [
        ((None,), {}, VolumeError, "volume of the notebook"),
        (("ct.nii.gz",), {}, VolumeError, "str"),
        ((noise(), 3), {}, VesselTreeError, "int"),
        ((noise(),), {"size": (5000, 10)}, CameraError, "at most 4096"),
        ((noise(),), {"size": (0, 10)}, CameraError, "size"),
        ((noise(), None, "front"), {}, CameraError, "str"),
        ((noise(), None, None, "look"), {}, SettingsError, "str"),
        ((noise(),), {"contxt": "dvr"}, SettingsError, "'contxt'"),
        ((noise(),), {"samples": 0}, SettingsError, "samples"),
        ((noise(),), {"device": "tpu"}, SettingsError, "tpu"),
    ],
)
def test_bad_arguments_are_refused(arguments, options, error, words):
    with pytest.raises(error, match=words):
        lumencut.show(*arguments, **options)


def test_settings_are_given_by_name():
    widget = lumencut.show(noise(), size=(80, 60), context="dvr", context_shading=True, device="cpu")
    assert widget.settings == Settings(context="dvr", context_shading=True)


def test_without_anywidget_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "lumencut.notebook.widget", None)
    with pytest.raises(lumencut.MissingPackageError, match=r"pip install 'lumencut\[notebook\]'"):
        lumencut.show(noise())
