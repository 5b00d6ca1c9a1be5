"""Building and packing of the viewer's page: only when out of date, and with all licence texts."""

import json
import os
import sys
from types import SimpleNamespace

import pytest

from script_modules import SCRIPTS, script

BUILT = '<head><script src="./assets/a.js"></script></head>'
"""The page that the build writes."""


@pytest.fixture
def room(tmp_path, monkeypatch):
    """The script in a repository of its own, with an npm that only records its arguments."""
    loaded = script("page")
    module = next(loaded)
    asked = []
    for name in ("Cargo.lock", "Cargo.toml", "web/src/main.ts", "web/index.html", "crates/core/src/lib.rs"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("x")
    for name in module._LICENCES:
        (tmp_path / name).write_text("licence")
    (tmp_path / "web/package-lock.json").write_text(json.dumps({"packages": {}}))
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "WEB", tmp_path / "web")
    monkeypatch.setattr(module, "PAGE", tmp_path / "python/page")
    monkeypatch.setattr(module, "missing_of_node", lambda: "")
    monkeypatch.setattr(module, "missing_of_wasm", lambda: "")
    monkeypatch.setattr(module.notices, "write", lambda: asked.append("notices"))

    def npm(*words):
        asked.append(" ".join(words[:2]))
        if words == ("run", "build"):
            (tmp_path / "web/dist/assets").mkdir(parents=True, exist_ok=True)
            (tmp_path / "web/dist/index.html").write_text(BUILT)

    monkeypatch.setattr(module, "npm", npm)
    (tmp_path / "python").mkdir()
    module.asked = asked
    yield module
    next(loaded, None)


def older(path):
    os.utime(path, (1, 1))


def newer(path):
    os.utime(path, (4e9, 4e9))


def test_the_page_is_built_with_its_notices_and_put_into_the_package(room):
    assert not room.is_current()
    assert room.build_if_possible()
    assert room.asked == ["ci --no-audit", "notices", "run build"]
    assert (room.PAGE / "index.html").read_text("utf-8") == BUILT
    assert not list(room.PAGE.parent.glob("*.new"))


def test_it_is_built_again_only_where_a_source_is_newer(room):
    room.build_if_possible()
    del room.asked[:]
    assert room.build_if_possible()
    assert room.asked == []
    (room.WEB / "node_modules/some").mkdir(parents=True)
    for name in ("node_modules/some/index.js", "dist/index.html"):
        (room.WEB / name).write_text("x")
        newer(room.WEB / name)
    assert room.is_current()
    for name in ("web/src/main.ts", "crates/core/src/lib.rs", "Cargo.lock"):
        newer(room.ROOT / name)
        assert not room.is_current()
        older(room.ROOT / name)


def test_what_the_page_no_longer_has_does_not_stay(room):
    room.build_if_possible()
    (room.PAGE / "old.js").write_text("old")
    newer(room.WEB / "src/main.ts")
    room.build_if_possible()
    assert {path.name for path in room.PAGE.iterdir()} == {
        path.name for path in (room.WEB / "dist").iterdir()
    }


@pytest.mark.parametrize(
    ("tool", "said"), [("missing_of_node", "no node"), ("missing_of_wasm", "no wasm"), (None, "no sources")]
)
def test_what_is_missing_is_told_and_is_no_error_where_asked(room, monkeypatch, capsys, tool, said):
    if tool:
        monkeypatch.setattr(room, tool, lambda: said)
    else:
        (room.WEB / "package-lock.json").unlink()
    assert not room.build_if_possible()
    assert room.asked == []
    assert said in capsys.readouterr().err
    monkeypatch.setattr(room.sys, "argv", ["page"])
    with pytest.raises(SystemExit, match=f"page: {said}"):
        room.main()


def test_a_build_that_fails_leaves_the_page_of_before(room, monkeypatch, capsys):
    room.build_if_possible()
    newer(room.WEB / "src/main.ts")

    def fails(*words):
        raise OSError("the network is unreachable")

    monkeypatch.setattr(room, "npm", fails)
    assert not room.build_if_possible()
    assert "the network is unreachable" in capsys.readouterr().err
    assert (room.PAGE / "index.html").read_text("utf-8") == BUILT


def test_the_site_is_the_page_with_the_licences(room, tmp_path):
    room.build_if_possible()
    room.write_site(tmp_path / "site")
    assert sorted(path.name for path in (tmp_path / "site").iterdir()) == [
        *("LICENSE-APACHE", "LICENSE-MIT", "assets", "index.html")
    ]


@pytest.mark.parametrize("address", ["/assets/a.js", "https://elsewhere.example/a.js"])
def test_a_site_that_needs_another_place_is_refused(room, tmp_path, address):
    room.build_if_possible()
    (room.PAGE / "index.html").write_text(f'<head><script src="{address}"></script></head>')
    with pytest.raises(room.PageError, match="expected addresses relative to the page"):
        room.write_site(tmp_path / "site")


@pytest.fixture
def notices():
    yield from script("notices")


def test_only_packages_of_the_page_are_listed(notices):
    locked = {
        "": {"name": "web"},
        "node_modules/a": {"version": "1.0.0"},
        "node_modules/a/node_modules/@scope/b": {"version": "2.0.0"},
        "node_modules/tool": {"version": "3.0.0", "dev": True},
        "node_modules/own": {"link": True},
    }
    assert [place.rpartition("node_modules/")[2] for place, _ in notices.needed(locked)] == ["a", "@scope/b"]


def test_the_text_of_a_package_is_the_one_that_it_ships(notices, tmp_path):
    folder = tmp_path / "node_modules/@scope/some"
    folder.mkdir(parents=True)
    told = {"version": "1.2.3", "license": "MIT"}
    with pytest.raises(notices.LicenceError, match=r"@scope/some 1\.2\.3: found no licence text"):
        notices.package_of(folder, told)
    (folder / "LICENSE.md").write_text("the text", "utf-8")
    package = notices.package_of(folder, told)
    assert (package.name, package.licence, package.texts) == ("@scope/some", "MIT", ("the text",))


def test_a_named_package_gets_the_standard_text(notices, tmp_path, monkeypatch):
    monkeypatch.setattr(notices, "WITHOUT_TEXT", frozenset({"bare"}))
    package = notices.package_of(tmp_path / "node_modules/bare", {"version": "1.0.0", "license": "MIT"})
    assert "the authors of bare" in package.texts[0]
    assert "bare 1.0.0: MIT (ships no licence text)" in notices.listing([package], notices.HEADING)


def test_the_packed_sources_have_what_their_build_needs():
    """The backend imports the scripts of the page only if `web/` exists; packed sources have none."""
    project = (SCRIPTS.parent / "pyproject.toml").read_text("utf-8")
    assert '{ path = "scripts/build_backend.py", format = "sdist" }' in project
    backend = (SCRIPTS / "build_backend.py").read_text("utf-8")
    assert "\nfrom page" not in backend
    assert "\nimport page" not in backend


@pytest.fixture
def toolchain():
    yield from script("toolchain")


@pytest.mark.skipif(os.name != "posix", reason="the stand-ins are scripts of a shell")
@pytest.mark.parametrize(
    ("said", "missing"), [("v20.1.0", ""), ("v24.0.0", ""), ("v18.19.1", "20 or newer"), ("what", "'what'")]
)
def test_an_old_node_is_as_good_as_none(toolchain, tmp_path, monkeypatch, said, missing):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert "no node or no npm" in toolchain.missing_of_node()
    for name in ("node", "npm"):
        (tmp_path / name).write_text(f"#!/bin/sh\necho {said}\n")
        (tmp_path / name).chmod(0o755)
    found = toolchain.missing_of_node()
    assert missing in found
    assert bool(missing) == bool(found)


@pytest.mark.skipif(os.name != "posix", reason="the stand-ins are scripts of a shell")
def test_rust_without_webassembly_is_told(toolchain, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert toolchain.missing_of_wasm() == "no rustc on the PATH"
    (tmp_path / "rustc").write_text(f"#!/bin/sh\necho {tmp_path}\n")
    (tmp_path / "rustc").chmod(0o755)
    assert "rustup target add wasm32-unknown-unknown" in toolchain.missing_of_wasm()
    libraries = tmp_path / "lib/rustlib"
    (libraries / "wasm32-unknown-unknown/lib").mkdir(parents=True)
    assert "rustup component add rust-src" in toolchain.missing_of_wasm()
    source = libraries / "src/rust/library/std"
    source.mkdir(parents=True)
    (source / "Cargo.toml").touch()
    assert toolchain.missing_of_wasm() == ""


@pytest.fixture
def backend(monkeypatch):
    maturin = pytest.importorskip("maturin")
    monkeypatch.setattr(maturin, "build_wheel", lambda *given: f"wheel in {given[0]}")
    monkeypatch.setattr(maturin, "build_sdist", lambda *given: f"sources in {given[0]}")
    yield from script("build_backend")


@pytest.mark.parametrize("has_sources", [True, False], ids=["checkout", "packed sources"])
def test_the_backend_builds_the_page_where_its_sources_are(backend, tmp_path, monkeypatch, has_sources):
    built = []
    monkeypatch.setitem(sys.modules, "page", SimpleNamespace(build_if_possible=lambda: built.append(1)))
    monkeypatch.setattr(backend, "_WEB", tmp_path if has_sources else tmp_path / "none")
    assert backend.build_wheel("there") == "wheel in there"
    assert backend.build_sdist("there") == "sources in there"
    assert len(built) == (2 if has_sources else 0)
