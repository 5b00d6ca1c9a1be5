"""Properties of the repository: versions, licences, names, sizes, and the cost of an import."""

import ast
import inspect
import itertools
import json
import re
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import lumencut
from import_graph import circle, import_graph
from lumencut import errors
from lumencut.base import overlaps
from rust_graph import rust_graph

ROOT = Path(__file__).resolve().parents[1]
LONGEST_FILE = 400
#: Packages that only some calls need; they must not be imported before such a call.
HEAVY = {
    "PIL",
    "SimpleITK",
    "anywidget",
    "av",
    "click",
    "gdcm",
    "itk",
    "matplotlib",
    "nibabel",
    "nrrd",
    "openjpeg",
    "pydicom",
    "starlette",
    "tqdm",
    "uvicorn",
    "vtkmodules",
}


def text(path: str) -> str:
    return (ROOT / path).read_text("utf-8")


def toml(path: str) -> dict:
    return tomllib.loads(text(path))


def sources() -> list[Path]:
    return [
        path
        for folder, ending in (("crates", "rs"), ("python", "py"), ("scripts", "py"), ("tests", "py"))
        for path in sorted((ROOT / folder).rglob(f"*.{ending}"))
        if "target" not in path.parts
    ]


def test_no_source_file_is_long():
    sheets = list((ROOT / "web/src").rglob("*.css"))
    assert len(sheets) >= 5
    paths = (*sources(), *sheets)
    lengths = {path.relative_to(ROOT): len(path.read_text("utf-8").splitlines()) for path in paths}
    assert len(lengths) > 60
    assert {path: length for path, length in lengths.items() if length > LONGEST_FILE} == {}


def test_every_rust_file_of_tests_is_part_of_a_program():
    """A file that neither `main.rs` nor `Cargo.toml` names would never run."""
    programs = sorted((ROOT / "crates").glob("*/tests/main.rs"))
    assert len(programs) == 3
    for program in programs:
        named = re.findall(r"^mod (\w+);$", program.read_text("utf-8"), re.MULTILINE)
        crate = (program.parent.parent / "Cargo.toml").read_text("utf-8")
        named += re.findall(r'^\[\[test\]\]\nname = "(\w+)"$', crate, re.MULTILINE)
        assert {path.stem for path in program.parent.glob("*.rs")} <= set(named), program


def test_no_document_has_a_gap_left_to_fill():
    folders = ("docs", "python", "crates", "tests")
    documents = [*ROOT.glob("*.md"), *(path for folder in folders for path in (ROOT / folder).rglob("*.md"))]
    assert len(documents) > 5
    gaps = {str(path.relative_to(ROOT)): re.findall("@@.*?@@", path.read_text("utf-8")) for path in documents}
    assert {path: found for path, found in gaps.items() if found} == {}


def test_the_method_states_the_constant_of_the_silhouettes():
    stage = text("crates/lumencut-core/src/stages/silhouette.rs")
    section = text("docs/method/surroundings.md").partition("\n## silhouette\n")[2].partition("\n## ")[0]
    used = re.search(r"\bZONE_BORDER: f32 = ([\d.]+);", stage)[1]
    stated = re.search(r"\bb = ([\d.]+) where a neighbour", section)[1]
    assert float(stated) == float(used)


def test_versions_agree():
    version = toml("pyproject.toml")["project"]["version"]
    locked = {package["name"]: package["version"] for package in toml("Cargo.lock")["package"]}
    stated = {
        "Cargo.toml": toml("Cargo.toml")["workspace"]["package"]["version"],
        "CITATION.cff": re.search(r'^version: "?([\d.]+)"?$', text("CITATION.cff"), re.MULTILINE)[1],
        "CHANGELOG.md": re.search(r"^## \[(\d[\d.]*)\]", text("CHANGELOG.md"), re.MULTILINE)[1],
        "lumencut.__version__": lumencut.__version__,
        "installed": metadata.version("lumencut"),
        **{name: found for name, found in locked.items() if name.startswith("lumencut-")},
    }
    assert len(stated) >= 8
    assert set(stated.values()) == {version}, stated


def test_oldest_python_and_licence_are_stated_once():
    project, workspace = toml("pyproject.toml")["project"], toml("Cargo.toml")["workspace"]["package"]
    assert project["license"] == workspace["license"]
    cited = re.search(r"^license:\n((?:  - .*\n)+)", text("CITATION.cff"), re.MULTILINE)
    assert re.findall(r"- (.*)", cited[1]) == workspace["license"].split(" OR ")
    oldest = re.fullmatch(r">=(3\.(\d+))", project["requires-python"])
    assert toml("pyproject.toml")["tool"]["ruff"]["target-version"] == f"py3{oldest[2]}"
    assert f"abi3-py3{oldest[2]}" in text("crates/lumencut-python/Cargo.toml")


def pins(path: str) -> dict[str, set[str]]:
    """Return the versions that a lock file allows of each package; each must have hashes."""
    found: dict[str, set[str]] = {}
    for entry in re.split(r"\n(?=\S)", text(path).strip()):
        pin = re.match(r"([\w.-]+)==([^\s;]+)", entry)
        assert pin, f"{path}: {entry.splitlines()[0]!r} is not pinned"
        assert "--hash=sha256:" in entry, f"{path}: {pin[1]} carries no hash"
        found.setdefault(canonicalize_name(pin[1]), set()).add(pin[2])
    return found


def test_locks_hold_what_is_declared():
    project = toml("pyproject.toml")
    runtime, dev, docs, wheel = (
        pins(f"requirements/{name}.lock") for name in ("runtime", "dev", "docs", "wheel")
    )
    groups = project["dependency-groups"]
    for lock, declared in (
        (runtime, project["project"]["dependencies"] + groups["build"]),
        (dev, [line for line in groups["dev"] if isinstance(line, str)]),
        (docs, groups["docs"]),
        (wheel, [line for line in groups["wheel"] if isinstance(line, str)]),
    ):
        for requirement in map(Requirement, declared):
            versions = lock.get(canonicalize_name(requirement.name), set())
            assert versions, f"{requirement} is not locked: make lock"
            assert all(requirement.specifier.contains(version) for version in versions), requirement
    for lock in (dev, wheel):
        assert {name: versions for name, versions in lock.items() if name in runtime} == runtime
    both = docs.keys() & dev.keys()
    assert {name: docs[name] for name in both} == {name: dev[name] for name in both}
    assert project["build-system"]["requires"] == groups["build"]


@pytest.fixture(scope="module")
def crates() -> list[dict]:
    """The crates of the workspace and all their dependencies, on any platform."""
    command = ["cargo", "metadata", "--locked", "--format-version=1"]
    told = subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    packages = json.loads(told.stdout)["packages"]
    assert len(packages) > 20
    return packages


def test_crates_accept_the_oldest_rust(crates):
    def release(version: str) -> tuple[int, ...]:
        return tuple(map(int, version.split(".")))

    oldest = toml("Cargo.toml")["workspace"]["package"]["rust-version"]
    wanted = {crate["name"]: crate["rust_version"] for crate in crates if crate["rust_version"]}
    newer = {name: version for name, version in wanted.items() if release(version) > release(f"{oldest}.0")}
    assert newer == {}


def runtime_packages() -> dict[str, metadata.Distribution]:
    """The package and all its dependencies, as installed."""
    found: dict[str, metadata.Distribution] = {}
    wanted = ["lumencut"]
    while wanted:
        name = wanted.pop()
        if name in found:
            continue
        found[name] = metadata.distribution(name)
        needs = map(Requirement, found[name].requires or [])
        wanted += [n.name for n in needs if n.marker is None or n.marker.evaluate({"extra": ""})]
    return found


def test_licences_of_the_python_packages():
    packages = runtime_packages()
    assert len(packages) > 8
    for name, package in packages.items():
        stated = [package.metadata.get("License-Expression"), *(package.metadata.get_all("Classifier") or [])]
        stated.append((package.metadata.get("License") or "").partition("\n")[0])
        licence = " ".join(line for line in stated if line and ("License ::" in line or "::" not in line))
        assert licence, name
        assert not re.search(r"\b[AL]?GPL|General Public", licence), f"{name}: {licence}"


def test_public_names_have_one_home():
    homes = [name for names in lumencut._HOME.values() for name in names]
    assert len(homes) == len(set(homes))
    assert sorted(homes) == sorted(lumencut.__all__)
    tree = ast.parse(text("python/lumencut/__init__.py"))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    typed = {node.module: tuple(alias.name for alias in node.names) for node in block.body}
    assert {f"lumencut.{module}": set(names) for module, names in lumencut._HOME.items()} == {
        module: set(names) for module, names in typed.items()
    }


def public_members() -> dict[str, object]:
    """Public functions, classes and what the classes define themselves."""
    found = {name: getattr(lumencut, name) for name in lumencut.__all__}
    found = {name: value for name, value in found.items() if callable(value)}
    for owner, value in list(found.items()):
        if inspect.isclass(value):
            members = {name: member for name, member in vars(value).items() if not name.startswith("_")}
            documented = (property, classmethod, staticmethod)
            found |= {
                f"{owner}.{name}": member
                for name, member in members.items()
                if inspect.isfunction(member) or isinstance(member, documented)
            }
    return found


def test_public_names_are_documented():
    members = public_members()
    assert len(members) > 40
    undocumented = [
        name
        for name, member in members.items()
        # A data class without a docstring gets its signature as docstring.
        if not (member.__doc__ or "").strip() or member.__doc__.startswith(f"{name}(")
    ]
    assert undocumented == []


def test_every_rust_error_has_its_class():
    source = text("crates/lumencut-core/src/error.rs")
    kinds = re.search(r"pub enum ErrorKind \{(.*?)^\}", source, re.DOTALL | re.MULTILINE)
    kinds = set(re.findall(r"^    (\w+),", kinds[1], re.MULTILINE)) - {"Interrupted"}
    assert len(kinds) >= 4
    raised = {
        name
        for path in (ROOT / "crates/lumencut-python/src").glob("*.rs")
        for name in re.findall(r'"(\w+Error)"', path.read_text("utf-8"))
    }
    assert {f"{kind}Error" for kind in kinds} <= raised
    for name in raised:
        place = overlaps if name == "OverlapError" else errors
        assert issubclass(getattr(place, name), lumencut.LumencutError), name


def test_every_error_is_a_builtin_one_too():
    classes = [value for value in vars(errors).values() if inspect.isclass(value)]
    own = [value for value in classes if issubclass(value, lumencut.LumencutError)]
    assert len(own) > 6
    for value in own:
        assert value.__name__ in lumencut.__all__
        assert value is lumencut.LumencutError or issubclass(value, (ValueError, OSError, RuntimeError))


def imported_by(code: str) -> set[str]:
    """Return the top-level modules that are loaded after `code` ran in a separate interpreter."""
    listing = f"import sys\n{code}\nprint(*sorted({{name.partition('.')[0] for name in sys.modules}}))"
    told = subprocess.run([sys.executable, "-c", listing], check=True, capture_output=True, text=True)
    return set(told.stdout.split())


def test_importing_is_light():
    assert imported_by("import lumencut") & {"numpy", *HEAVY} == set()
    every_name = "import lumencut\nfor name in lumencut.__all__: getattr(lumencut, name)"
    modules = imported_by(every_name)
    assert "numpy" in modules
    assert modules & HEAVY == set()


@pytest.mark.parametrize("crate", ["lumencut-io", "lumencut-volumes"])
def test_each_fuzz_target_has_seeds(crate):
    """`make fuzz` runs the targets that have a folder of seeds."""
    folder = f"crates/{crate}/fuzz"
    targets = {target["name"] for target in toml(f"{folder}/Cargo.toml")["bin"]}
    seeds = {path.name for path in (ROOT / folder / "seeds").iterdir() if any(path.iterdir())}
    assert targets == seeds


def test_no_modules_import_each_other_in_a_circle():
    graph = import_graph(ROOT / "python/lumencut")
    assert len(graph) > 40
    assert {"lumencut.base.paths", "lumencut.scene.vessel_tree"} <= graph["lumencut.files.centerline_file"]
    assert " imports ".join(circle(graph)) == ""


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("import house.second", "import os, house.first"),
        ("from house import second", "from house.first import door"),
        ("from .second import window", "def late():\n    from . import first"),
        ("import house.second", "if TYPE_CHECKING:\n    from house.first import Door"),
        ("from house.second import window", "from house import door"),
    ],
)
def test_circles_of_imports_are_found(tmp_path, first, second):
    house = tmp_path / "house"
    house.mkdir()
    (house / "__init__.py").write_text("from house.first import door")
    (house / "first.py").write_text(first)
    (house / "second.py").write_text("import os")
    assert circle(import_graph(house)) == []
    (house / "second.py").write_text(second)
    graph = import_graph(house)
    found = circle(graph)
    assert {"house.first", "house.second"} <= set(found)
    assert found[0] == found[-1]
    assert all(target in graph[module] for module, target in itertools.pairwise(found))


@pytest.mark.parametrize(
    "crate", sorted(path.parent.parent.name for path in ROOT.glob("crates/*/src/lib.rs"))
)
def test_no_files_of_a_crate_need_each_other_in_a_circle(crate):
    graph = rust_graph(ROOT / "crates" / crate / "src")
    assert any(graph.values()) or len(graph) == 1
    assert " needs ".join(circle(graph)) == ""


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("use crate::room::second::Door;", "use crate::room::first::{Key, Lock};"),
        ("use super::second::{self, Door};", "pub use super::{first::Key};"),
        ("use crate::{a::B, room::second::Door};", "pub(crate) use super::super::room::first::Key;"),
    ],
)
def test_circles_of_files_are_found(tmp_path, first, second):
    (tmp_path / "room").mkdir()
    (tmp_path / "room.rs").write_text("mod first;\nmod second;\n")
    (tmp_path / "room/first.rs").write_text(first)
    (tmp_path / "room/second.rs").write_text("use std::fmt;\n// use super::first::Key;\n")
    assert circle(rust_graph(tmp_path)) == []
    (tmp_path / "room/second.rs").write_text(second)
    assert set(circle(rust_graph(tmp_path))) == {"room::first", "room::second"}
