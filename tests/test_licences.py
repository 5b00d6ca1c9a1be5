"""Licence texts of linked crates: none is missing, none is repeated, and an outdated file is noticed."""

import pytest

from script_modules import script


@pytest.fixture(scope="module")
def licences():
    yield from script("licences")


@pytest.fixture
def package(tmp_path):
    """A crate as `cargo metadata` describes it, in a folder of its own with the given files."""

    def make(name="some", licence="MIT OR Apache-2.0", **files):
        folder = tmp_path / name
        folder.mkdir()
        for file, text in files.items():
            (folder / file.replace("_", "-")).write_text(text, "utf-8")
        return {
            "name": name,
            "version": "1.2.3",
            "license": licence,
            "authors": ["Ada", "Grace"],
            "manifest_path": str(folder / "Cargo.toml"),
        }

    return make


def test_the_texts_are_those_that_the_crate_ships(licences, package):
    crate = licences.crate_of(package(LICENSE_MIT="mit", COPYING="both", README="no licence", licence_x="x"))
    assert sorted(crate.texts) == ["both", "mit", "x"]


def test_a_crate_without_a_text_is_refused_by_name(licences, package):
    with pytest.raises(licences.LicenceError, match=r"some 1\.2\.3: found no licence text"):
        licences.crate_of(package(README="no licence"))


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("Zlib OR Apache-2.0 OR MIT", "Apache License"),
        ("MIT/Apache-2.0", "Apache License"),
        ("MIT", "Copyright (c) Ada, Grace"),
    ],
)
def test_a_named_crate_gets_the_standard_text(licences, package, monkeypatch, expression, expected):
    monkeypatch.setattr(licences, "WITHOUT_TEXT", {"some"})
    (text,) = licences.crate_of(package(licence=expression)).texts
    assert expected in text
    assert "Lumencut" not in text


@pytest.mark.parametrize("expression", ["Zlib", "MIT AND Zlib", None])
def test_a_licence_without_a_standard_text_is_refused(licences, package, monkeypatch, expression):
    monkeypatch.setattr(licences, "WITHOUT_TEXT", {"some"})
    with pytest.raises(licences.LicenceError, match=r"expected a choice of Apache-2\.0 or MIT"):
        licences.crate_of(package(licence=expression))


def test_a_named_crate_that_ships_a_text_after_all_is_refused(licences, package, monkeypatch):
    monkeypatch.setattr(licences, "WITHOUT_TEXT", {"some"})
    with pytest.raises(licences.LicenceError, match="ships a licence text"):
        licences.crate_of(package(LICENSE="text"))


def test_a_shared_text_stands_once_with_all_its_crates(licences):
    crates = [
        licences.Crate("first", "1.0.0", "MIT", ("the  text\r\n  of many\n",)),
        licences.Crate("second", "2.0.0", "MIT", ("the text\nof many", "its own")),
        licences.Crate("second", "3.0.0", "MIT", ("its own",)),
    ]
    text = licences.listing(crates)
    assert text.count("of many") == 1
    assert text.count("its own") == 1
    assert "first, second\n===" in text
    assert "second 2.0.0: MIT\nsecond 3.0.0: MIT\n" in text
    assert "\r" not in text


def metadata(**edges) -> dict:
    """Return metadata as from cargo, with crates that need others; macro crates are called `macro…`."""
    names = {"root", *edges, *(name for needs in edges.values() for name, _ in needs)}
    return {
        "packages": [
            {
                "id": name,
                "name": name,
                "source": None if name.startswith(("root", "own")) else "registry",
                "targets": [{"kind": ["proc-macro" if name.startswith("macro") else "lib"]}],
            }
            for name in sorted(names)
        ],
        "resolve": {
            "nodes": [
                {
                    "id": name,
                    "deps": [
                        {"pkg": needed, "dep_kinds": [{"kind": kind} for kind in kinds]}
                        for needed, kinds in edges.get(name, [])
                    ],
                }
                for name in names
            ]
        },
    }


def test_only_what_is_linked_is_listed(licences):
    told = metadata(
        root=[("own", [None]), ("tests", ["dev"]), ("builds", ["build"]), ("macro", [None]), ("a", [None])],
        own=[("b", ["dev", None])],
        macro=[("of_the_macro", [None])],
        other=[("of_another", [None])],
    )
    assert sorted(package["name"] for package in licences.linked(told, "root")) == ["a", "b"]


@pytest.fixture
def run(licences, monkeypatch, tmp_path):
    """Return a function that runs the script with one crate, whose text is given, in a separate folder."""
    listing = tmp_path / "THIRD-PARTY-LICENSES"

    def main(text, *arguments):
        monkeypatch.setattr(licences, "LISTING", listing)
        crates = [licences.Crate("some", "1.0.0", "MIT", (text,))]
        monkeypatch.setattr(licences, "linked_crates", lambda targets: crates)
        monkeypatch.setattr(licences.sys, "argv", ["licences", *arguments])
        licences.main()
        return listing

    return main


def test_a_stale_file_is_noticed_and_left_alone(run):
    with pytest.raises(SystemExit, match="mend it: make generate"):
        run("one text", "--check")
    listing = run("one text")
    before = listing.read_text("utf-8")
    assert "one text" in before
    run("one text", "--check")
    with pytest.raises(SystemExit, match="mend it: make generate"):
        run("another text", "--check")
    assert listing.read_text("utf-8") == before
