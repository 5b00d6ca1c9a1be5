"""A wheel that could not be installed or run everywhere is rejected before it is kept."""

import sys
import zipfile

import pytest

from script_modules import SCRIPTS, script

ROOT = SCRIPTS.parent


@pytest.fixture(scope="module")
def wheel():
    yield from script("wheel")


@pytest.fixture
def made(tmp_path, wheel):
    """A wheel with all parts that are checked."""

    def make(page=wheel.PAGE, **licences):
        path = tmp_path / "lumencut-0.1.0-cp311-abi3-manylinux_2_17_x86_64.whl"
        texts = {name: (ROOT / name).read_bytes() for name in wheel.LICENCES} | licences
        stated = "".join(f"License-File: {name}\n" for name, text in texts.items() if text)
        with zipfile.ZipFile(path, "w") as archive:
            for name in page:
                archive.writestr(name, "page")
            archive.writestr("lumencut-0.1.0.dist-info/METADATA", f"Name: lumencut\n{stated}")
            for name, text in texts.items():
                if text:
                    archive.writestr(f"lumencut-0.1.0.dist-info/licenses/{name}", text)
        return path

    return make


def test_a_whole_wheel_passes(wheel, made):
    wheel.check_wheel(made())


def test_a_wheel_without_a_licence_text_is_noticed(wheel, made):
    with pytest.raises(wheel.PackageError, match="found the licences"):
        wheel.check_wheel(made(**{"THIRD-PARTY-LICENSES": b""}))
    with pytest.raises(wheel.PackageError, match="THIRD-PARTY-LICENSES is not the repository's"):
        wheel.check_wheel(made(**{"THIRD-PARTY-LICENSES": b"an older list"}))


def test_a_wheel_without_the_page_of_the_viewer_is_noticed(wheel, made):
    with pytest.raises(wheel.PackageError, match=r"found no lumencut/viewer/page/index\.html"):
        wheel.check_wheel(made(page=wheel.PAGE[1:]))


def test_a_wheel_for_one_python_alone_is_noticed(wheel, made, tmp_path):
    path = tmp_path / "lumencut-0.1.0-cp312-cp312-manylinux_2_17_x86_64.whl"
    made().rename(path)
    with pytest.raises(wheel.PackageError, match="expected the stable ABI"):
        wheel.check_wheel(path)


def test_a_wheel_is_tried_without_rust_and_node(wheel, tmp_path):
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/python").symlink_to(sys.executable)
    seen = "import os, pathlib, shutil; pathlib.Path('seen').write_text(repr([*map(shutil.which, {!r})]))"
    wheel.run_apart(tmp_path, "python", "-c", seen.format(("cargo", "rustc", "node", "npm")))
    assert (tmp_path / "seen").read_text("utf-8") == "[None, None, None, None]"
