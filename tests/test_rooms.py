"""The groups of modules of tracing and measuring, and which group may use which."""

from pathlib import Path

from rust_graph import rust_graph

ROOT = Path(__file__).resolve().parents[1]

ROOMS: dict[str, tuple[str, ...]] = {
    "voxels": (),
    "trace::lines": (),
    "trace::lumen": ("voxels", "trace::lines"),
    "trace::ways": ("voxels", "trace::lines", "trace::lumen"),
    "trace::skeleton": ("trace::lines",),
    "trace::clicks": ("voxels", "trace::lines", "trace::lumen", "trace::ways"),
    "trace::mask": ("voxels", "trace::lines", "trace::lumen", "trace::skeleton"),
    "trace::find": ("voxels", "trace::lines", "trace::lumen"),
    "measure::section": ("voxels",),
    "measure::beside": ("measure::section",),
    "measure::estimation": (),
    "measure::model": ("measure::section", "measure::estimation"),
    "measure::uncertainty": ("measure::section",),
    "measure::fit": (
        "measure::section",
        "measure::beside",
        "measure::estimation",
        "measure::model",
        "measure::uncertainty",
    ),
    "measure::wall": (
        "voxels",
        "measure::section",
        "measure::beside",
        "measure::estimation",
        "measure::model",
        "measure::fit",
    ),
    "measure::along": (
        "measure::section",
        "measure::estimation",
        "measure::model",
        "measure::uncertainty",
        "measure::fit",
    ),
    "measure::outer": ("voxels", "measure::section"),
    "measure::flap": ("voxels", "measure::section", "measure::estimation", "measure::outer"),
    "measure::profile": (
        "voxels",
        "measure::section",
        "measure::beside",
        "measure::estimation",
        "measure::model",
        "measure::uncertainty",
        "measure::fit",
        "measure::wall",
        "measure::along",
        "measure::outer",
        "measure::flap",
    ),
    "measure::stenosis": ("measure::section", "measure::uncertainty", "measure::profile"),
    "measure::comparison": ("measure::section", "measure::profile", "measure::stenosis"),
}


def stray_arrows(graph, order):
    """Return the modules that use a group that `order` does not allow for their own group."""

    def room(module):
        return next((name for name in order if (module + "::").startswith(name + "::")), None)

    return [
        (module, other)
        for module, others in sorted(graph.items())
        for other in sorted(others)
        if room(module) and room(other) and room(other) not in {room(module), *order[room(module)]}
    ]


def test_rooms_of_vessels_need_only_those_below_them():
    source = ROOT / "crates/lumencut-vessels/src"
    graph = rust_graph(source)
    folders = {
        f"{part}::{path.name}"
        for part in ("trace", "measure")
        for path in (source / part).iterdir()
        if path.is_dir()
    }
    assert folders == {name for name in ROOMS if "::" in name}
    assert any(graph["trace::find"])
    assert {module.split("::")[1] for module in graph if module.startswith("measure::")} == {
        name.split("::")[1] for name in ROOMS if name.startswith("measure::")
    }
    assert stray_arrows(graph, ROOMS) == []
    order = list(ROOMS)
    assert all(order.index(other) < order.index(name) for name, others in ROOMS.items() for other in others)


def test_an_arrow_upwards_is_found(tmp_path):
    (tmp_path / "low").mkdir()
    (tmp_path / "low/first.rs").write_text("use crate::high::Roof;")
    (tmp_path / "high.rs").write_text("use crate::low::first::Floor;")
    graph = rust_graph(tmp_path)
    assert stray_arrows(graph, {"low": (), "high": ("low",)}) == [("low::first", "high")]
    assert stray_arrows(graph, {"low": ("high",), "high": ("low",)}) == []
