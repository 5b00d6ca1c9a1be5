"""The folders of the package: each imports only folders listed before it, and each names its subject."""

import ast
from pathlib import Path

import pytest

import lumencut
from import_graph import Graph, import_graph

PACKAGE = Path(lumencut.__file__).parent

#: Errors and `base` know each other (an error states its remedy), so they are one step.
ORDER = (
    ("_lumencut", "base", "errors"),
    ("scene", "phantom"),
    ("dicom",),
    ("files",),
    ("demo", "pictures"),
    ("measuring",),
    ("tracing",),
    ("reformations",),
    ("evaluation",),
    ("reports",),
    ("cohort",),
    ("notebook",),
    ("viewer",),
    ("cli",),
    ("__main__",),
)

#: The one import against the order: datasets of pydicom in memory are one of the kinds of images.
EXCEPTIONS = {("scene.images", "dicom.reading.datasets")}


def arrows_against(graph: Graph, order: tuple[tuple[str, ...], ...]) -> set[tuple[str, str]]:
    """Return the imports of a folder that the order lists later, as pairs of modules."""
    step = {name: number for number, names in enumerate(order) for name in names}

    def place(module: str) -> int:
        return step[module.split(".")[0]]

    inner = {module.partition(".")[2]: others for module, others in graph.items() if "." in module}
    return {
        (module, other.partition(".")[2])
        for module, others in inner.items()
        for other in others
        if "." in other and place(module) < place(other.partition(".")[2])
    }


def test_folders_import_only_the_folders_before_them():
    listed = {name for names in ORDER for name in names}
    entries = {path.stem.split(".")[0] for path in PACKAGE.iterdir() if path.suffix in {"", ".py", ".pyi"}}
    assert entries - {"__pycache__", "__init__", "py"} == listed
    found = arrows_against(import_graph(PACKAGE), ORDER)
    # The packages around an imported module count as imported too.
    assert {(a, b) for a, b in found if not any(e.startswith(b) for _, e in EXCEPTIONS)} == set()
    assert found >= EXCEPTIONS


def test_an_import_against_the_order_is_found(tmp_path):
    house = tmp_path / "house"
    for name, source in {"low": "from house.high import roof", "high": "import os"}.items():
        (house / name).mkdir(parents=True)
        (house / name / "__init__.py").write_text("")
        (house / name / "roof.py").write_text(source)
    (house / "__init__.py").write_text("")
    assert ("low.roof", "high.roof") in arrows_against(import_graph(house), (("low",), ("high",)))
    assert arrows_against(import_graph(house), (("high",), ("low",))) == set()


def test_every_folder_states_its_subject_and_stays_small():
    folders = [path.parent for path in PACKAGE.rglob("__init__.py")]
    assert len(folders) > 15
    for folder in folders:
        text = ast.get_docstring(ast.parse((folder / "__init__.py").read_text("utf-8")))
        assert text, folder
    largest = max(len(list(folder.glob("*.py"))) for folder in folders)
    assert largest <= 50


@pytest.mark.parametrize("group", ["measuring", "reformations", "tracing"])
def test_groups_offer_the_public_names_of_their_modules(group):
    module = getattr(__import__(f"lumencut.{group}"), group)
    homes = {name for name, home in lumencut._MODULE.items() if home.startswith(f"{group}.")}
    assert set(module.__all__) == homes
    for name in homes:
        assert getattr(module, name) is getattr(lumencut, name)
    with pytest.raises(AttributeError, match="has no attribute 'gone'"):
        module.gone  # noqa: B018 - the access raises
