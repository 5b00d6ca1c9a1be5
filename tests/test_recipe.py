"""The text in a PNG that says how it was rendered: complete, without patient data, and robust."""

from __future__ import annotations

import dataclasses
import json
import struct
import zlib

import numpy as np
import pytest
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from lumencut import (
    Camera,
    FileError,
    Focus,
    FormatError,
    Opacity,
    Renderer,
    Settings,
    Slab,
    TransferFunction,
    Window,
    phantom,
    read_volume,
)
from lumencut.pictures.picture_text import KEYWORD
from lumencut.pictures.recipe import Recipe, png_options, read_recipe

RAMP = TransferFunction([(-100.5, (0, 10, 20), 0), (0.1 + 0.2, (255, 0, 1), 1 / 3)])
CHOSEN = [
    Settings(window=Window(0.1, 1 / 3), context_window=Window(1e-7, 1e7)),
    Settings.paper(opacity=Opacity(-50, 150.25), slab=Slab(4.2, "mean"), background=(1, 2, 3, 4)),
    Settings(context=None, samples=3, silhouettes=False, cost_weight=np.pi),
    Settings(context="mida", context_transfer=RAMP, context_shading=True, context_gamma=-0.3),
    Settings(context="dvr", context_transfer="bone", context_step=0.7, context_preview=True),
    Settings.focused(
        focus=Focus(-1.5, 1 / 3), context_from="whole", context_strength=0.65, context_halo=0.3, occlusion=0.2
    ),
]


def written(path, recipe, *, states_spacing=True):
    Image.new("RGBA", (4, 3)).save(path, **png_options(recipe, states_spacing=states_spacing))
    return path


def turned(seed):
    random = np.random.default_rng(seed)
    camera = Camera(
        random.normal(size=3) * 100, random.normal(size=3), random.normal(size=3), (640, 480), 1 / 3
    )
    return camera.rotated(random.normal()).rotated(random.normal(), "right").zoomed(1.3).panned(0.1, 7.7)


@pytest.mark.parametrize("settings", CHOSEN)
@pytest.mark.parametrize("seed", range(4))
def test_recipes_come_back_to_the_last_bit(tmp_path, settings, seed):
    recipe = Recipe(turned(seed), settings, annotate=seed % 2 == 0, vessel_names=seed > 2, vessels=seed)
    again = read_recipe(written(tmp_path / "view.png", recipe))
    assert again == recipe
    for name in ("center", "direction", "right_axis", "up"):
        assert getattr(again.camera, name).tobytes() == getattr(recipe.camera, name).tobytes()


@pytest.fixture(scope="module")
def frame():
    made = phantom.calcified_wall()
    return Renderer(made.volume, made.tree).render(Camera.anterior(made.tree, (220, 200)))


def test_saved_pictures_hold_what_was_used(frame, tmp_path):
    frame.save(tmp_path / "view.png", annotate=True)
    recipe = read_recipe(tmp_path / "view.png")
    assert recipe.camera == frame.camera
    assert (recipe.annotate, recipe.vessel_names, recipe.vessels) == (True, False, 1)
    made = phantom.calcified_wall()
    renderer = Renderer(made.volume, made.tree)
    assert recipe.settings == dataclasses.replace(
        Settings(), window=renderer.window, context_window=renderer.window
    )
    again = renderer.render(recipe.camera, recipe.settings)
    np.testing.assert_array_equal(again.image, frame.image)


@pytest.mark.parametrize("spacing", [0.25, 0.37, 1.0, 3.3])
def test_a_png_states_the_size_of_its_pixels(frame, tmp_path, spacing):
    camera = dataclasses.replace(frame.camera, pixel_spacing=spacing)
    dataclasses.replace(frame, camera=camera).save(tmp_path / "view.png")
    content = (tmp_path / "view.png").read_bytes()
    at = content.index(b"pHYs")
    across, down, unit = struct.unpack(">IIB", content[at + 4 : at + 13])
    assert across == down == round(1000 / spacing)
    assert unit == 1


@pytest.mark.parametrize("spacing", [1e-6, 900.0, 1e4])
def test_the_extremes_of_a_camera_can_be_written(frame, tmp_path, spacing):
    """PNG stores whole pixels per metre; the size of pixels above 1 m is only in the recipe."""
    camera = dataclasses.replace(frame.camera, pixel_spacing=spacing)
    dataclasses.replace(frame, camera=camera).save(tmp_path / "view.png", annotate=True)
    assert (b"pHYs" in (tmp_path / "view.png").read_bytes()) == (spacing < 2000)
    assert read_recipe(tmp_path / "view.png").camera.pixel_spacing == spacing


def test_no_size_is_stated_where_the_source_states_none(frame, tmp_path):
    source = dataclasses.replace(frame._source, states_spacing=False)
    dataclasses.replace(frame, _source=source).save(tmp_path / "view.png")
    assert b"pHYs" not in (tmp_path / "view.png").read_bytes()


def test_only_png_holds_a_recipe(frame, tmp_path):
    for ending in ("tif", "webp", "jpg", "bmp"):
        frame.save(tmp_path / f"view.{ending}")
        assert KEYWORD.encode() not in (tmp_path / f"view.{ending}").read_bytes()


def test_the_text_names_no_patient_no_file_and_no_vessel(tmp_path):
    import nibabel as nib

    from lumencut import Vessel, VesselTree

    folder = tmp_path / "DOE_JANE"
    folder.mkdir()
    image = nib.Nifti1Image(np.zeros((20, 20, 20), np.int16) + 77, np.diag([-1, -1, 1, 1]))
    image.header["descrip"], image.header["aux_file"] = b"PATIENT 4711", b"ROE.txt"
    nib.save(image, folder / "study_of_JANE.nii.gz")
    volume = read_volume(folder / "study_of_JANE.nii.gz")
    tree = VesselTree([Vessel([[5, 5, 5], [9, 9, 9]], 1.0, "LAD of JANE")])
    shown = Renderer(volume, tree).render(Camera.anterior(tree, (220, 200)))
    shown.save(folder / "JANE.png", annotate=True, vessel_names=True)
    with Image.open(folder / "JANE.png") as picture:
        assert set(picture.info) == {"Software", KEYWORD, "dpi"}
        text = json.dumps(picture.info)
    content = (folder / "JANE.png").read_bytes()
    for word in ("JANE", "DOE", "4711", "ROE", "LAD", str(tmp_path), ".nii"):
        assert word not in text
        assert word.encode() not in content
    chunks, at = [], 8
    while at < len(content):
        length, kind = struct.unpack(">I4s", content[at : at + 8])
        chunks.append(kind)
        at += 12 + length
    assert set(chunks) == {b"IHDR", b"tEXt", b"pHYs", b"IDAT", b"IEND"}


SOUND = Recipe(turned(0), CHOSEN[1], annotate=True, vessel_names=False, vessels=3)


def text_of(path):
    with Image.open(path) as picture:
        return json.loads(picture.info[KEYWORD])


def changed(**parts):
    """Changes to the content of a valid text: values by their path."""

    def change(content):
        for place, value in parts.items():
            *outer, name = place.split("__")
            part = content
            for step in outer:
                part = part[step]
            if value is KeyError:
                del part[name]
            else:
                part[name] = value
        return content

    return change


@pytest.mark.parametrize(
    "change",
    [
        lambda content: [],
        lambda content: None,
        lambda content: 5,
        lambda content: {},
        changed(format=2),
        changed(format=True),
        changed(format="1"),
        changed(format=[1]),
        changed(camera=KeyError),
        changed(camera=[]),
        changed(camera__center="SECRET"),
        changed(camera__center=[1, 2]),
        changed(camera__center=[float("nan"), 0, 0]),
        changed(camera__center=[float("inf"), 0, 0]),
        changed(camera__center=[1, 2, None]),
        changed(camera__center=[[1, 2, 3]]),
        changed(camera__center=["1", "2", "SECRET"]),
        changed(camera__direction=[0, 0, 0]),
        changed(camera__direction=[0, 0, 2]),
        changed(camera__up=[0, 1, 0]),
        changed(camera__right_axis=[1, 0, 0]),
        changed(camera__right_axis=[1, 0]),
        changed(camera__right_axis={}),
        changed(camera__size=[0, 5]),
        changed(camera__size=[10**9, 10**9]),
        changed(camera__size=["a", 5]),
        changed(camera__size=[5.5, 5]),
        changed(camera__pixel_spacing=0),
        changed(camera__pixel_spacing=-1),
        changed(camera__pixel_spacing="SECRET"),
        changed(camera__pixel_spacing=10**400),
        changed(camera__pixel_spacing=KeyError),
        changed(settings="SECRET"),
        changed(settings=None),
        changed(settings__levels=KeyError),
        changed(settings__SECRET=1),
        changed(settings__levels=99),
        changed(settings__levels="SECRET"),
        changed(settings__levels={"SECRET": 1}),
        changed(settings__window={"level": 1}),
        changed(settings__window={"level": 1, "width": 2, "SECRET": 3}),
        changed(settings__window={"level": "SECRET", "width": 2}),
        changed(settings__window={"level": 1, "width": -2}),
        changed(settings__window=[1, 2]),
        changed(settings__slab={"thickness": 4, "mode": "SECRET"}),
        changed(settings__context_transfer={"points": "SECRET"}),
        changed(settings__context_transfer={"points": [[1, [2, 3], 4]]}),
        changed(settings__context_transfer={"points": [[n, [0, 0, 0], 0] for n in range(65)]}),
        changed(settings__context_transfer=["grey"]),
        changed(settings__context="SECRET"),
        changed(settings__silhouettes="SECRET"),
        changed(settings__background=[1, 2, 3, 400]),
        changed(annotate="yes"),
        changed(annotate=1),
        changed(vessel_names=None),
        changed(annotate=KeyError),
        changed(vessels=KeyError),
        changed(vessels=-1),
        changed(vessels=True),
        changed(vessels="SECRET"),
        changed(vessels=[0, 1]),
    ],
)
def test_texts_that_cannot_be_rendered_are_refused_without_quoting_them(tmp_path, change):
    content = change(text_of(written(tmp_path / "sound.png", SOUND)))
    refuse(tmp_path, json.dumps(content))


@pytest.mark.parametrize(
    "text",
    [
        *("", "SECRET", "{", "[" * 90_000, '{"format": NaN}', '{"format": 1e999}', "1" * 5000, "\0", '"x"'),
        *("é" * 9, "x" * 100_001, " " * 100_001 + "1"),
    ],
    ids=lambda text: f"{text[:10]!r} of {len(text)}",
)
def test_texts_that_are_no_recipe(tmp_path, text):
    refuse(tmp_path, text)


def refuse(folder, text):
    info = PngInfo()
    info.add_text(KEYWORD, text)
    Image.new("RGBA", (4, 3)).save(folder / "other.png", pnginfo=info)
    with pytest.raises(FormatError) as caught:
        read_recipe(folder / "other.png")
    said = str(caught.value)
    assert said.startswith(f"{folder / 'other.png'}: found a text ")
    assert "SECRET" not in said
    assert len(said) < len(str(folder)) + 200
    assert caught.value.__cause__ is None
    assert caught.value.__suppress_context__ or caught.value.__context__ is None


def test_a_text_that_unpacks_to_more_than_memory_is_refused(tmp_path):
    packed = zlib.compress(b" " * 50_000_000)
    chunk = b"zTXt" + KEYWORD.encode() + b"\0\0" + packed
    content = written(tmp_path / "sound.png", SOUND).read_bytes()
    at = content.index(b"tEXt") - 4
    bomb = struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
    (tmp_path / "bomb.png").write_bytes(content[:at] + bomb + content[at:])
    with pytest.raises(FormatError, match="no PNG, or a damaged one"):
        read_recipe(tmp_path / "bomb.png")


def test_pictures_of_others_and_other_files(tmp_path):
    Image.new("RGB", (4, 3)).save(tmp_path / "bare.png")
    with pytest.raises(FormatError, match="without a description of its rendering; expected a PNG picture"):
        read_recipe(tmp_path / "bare.png")
    for ending in ("jpg", "tif", "webp"):
        Image.new("RGB", (4, 3)).save(tmp_path / f"view.{ending}")
        with pytest.raises(FormatError, match="no PNG, or a damaged one"):
            read_recipe(tmp_path / f"view.{ending}")
    (tmp_path / "empty.png").write_bytes(b"")
    with pytest.raises(FormatError, match="no PNG, or a damaged one"):
        read_recipe(tmp_path / "empty.png")
    for path in (tmp_path / "missing.png", tmp_path):
        with pytest.raises(FileError):
            read_recipe(path)


def test_every_beginning_of_a_picture_is_refused(tmp_path):
    content = written(tmp_path / "sound.png", SOUND).read_bytes()
    for end in range(content.index(b"IEND") + 4):
        (tmp_path / "part.png").write_bytes(content[:end])
        with pytest.raises(FormatError, match="no PNG, or a damaged one"):
            read_recipe(tmp_path / "part.png")


def test_flipped_bytes_give_an_error_of_ours_or_the_same_recipe(tmp_path):
    content = written(tmp_path / "sound.png", SOUND).read_bytes()
    random = np.random.default_rng(0)
    refused = 0
    for _ in range(400):
        damaged = bytearray(content)
        for place in random.integers(0, len(content), random.integers(1, 4)):
            damaged[place] ^= int(random.integers(1, 256))
        (tmp_path / "part.png").write_bytes(damaged)
        try:
            assert read_recipe(tmp_path / "part.png") == SOUND
        except FormatError:
            refused += 1
    assert refused > 300
