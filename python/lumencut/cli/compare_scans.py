"""``lumencut compare-scans``: the lumen of the same vessels in two scans."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from lumencut.cli import options
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.parameters import PLACES
from lumencut.cli.report import bar, say, verbose_option, warn
from lumencut.cli.scene import read_files, scene_from
from lumencut.errors import MeasuringError

if TYPE_CHECKING:
    from lumencut.measuring.comparison import Comparison
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

_ENDINGS = (".csv", ".json", ".html", ".htm")


class _Side(NamedTuple):
    """One of both scans: what it is called, its voxels and its vessels."""

    name: str
    voxels: Volume
    tree: VesselTree


@click.command("compare-scans", short_help="Compare the lumen of vessels in two scans.")
@click.argument("earlier", type=options.FILE)
@click.argument("earlier_lines", type=options.FILE)
@click.argument("later", type=options.FILE)
@click.argument("later_lines", type=options.FILE)
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    multiple=True,
    required=True,
    help="The differences as a table (.csv) or JSON (.json) of one vessel, or a report of all (.html); "
    "may be repeated.",
)
@click.option("--vessel", metavar="NAME|ID", help="Compare only this vessel of EARLIER_LINES.")
@click.option(
    "--later-vessel", metavar="NAME|ID", help="The same vessel in LATER_LINES; default: by its name."
)
@click.option(
    "--pair",
    type=PLACES,
    multiple=True,
    metavar=PLACES.name,
    help="Places that belong together: arc lengths on both vessels, the earlier first (mm); may be repeated.",
)
@click.option("--other-patient", is_flag=True, help="Accept scans of two patients.")
@options.reading_options
@verbose_option
def compare_scans(output: tuple[Path, ...], other_patient: bool, **chosen: Any) -> None:
    """Compare vessels in two scans: the difference of their diameters, with the uncertainties of both.

    Vessels with the same name, given or suggested, are compared unless --vessel chooses one. Places that
    belong together follow from the shape of the vessels, from branches, or from --pair.

    \b
    lumencut compare-scans before.nii.gz before.vtp after.nii.gz after.vtp -o change.html --vessel Aorta
    """  # noqa: D301 - click needs the control character itself
    _check(output, chosen)
    sides = _Sides(*(_side(chosen, which) for which in ("earlier", "later")))
    pairs = _vessels(sides, chosen)
    from lumencut.measuring.comparison import save_all

    compared = _compared(sides, pairs, chosen, other_patient=other_patient)
    if not compared:
        raise MeasuringError(
            "vessels to compare", "none that can be compared", "one or more; see the warnings"
        )
    for path in output:
        if path.suffix.lower() in _ENDINGS[:2] and len(compared) > 1:
            found = f"{path}: found {len(compared)} vessels; expected one, or a report (.html)"
            raise click.UsageError(f"{found}; choose a vessel by --vessel")
        save_all(compared, path)
        say(str(path))


class _Sides(NamedTuple):
    earlier: _Side
    later: _Side


def _check(output: tuple[Path, ...], chosen: dict[str, Any]) -> None:
    for path in output:
        if path.suffix.lower() not in _ENDINGS:
            found = f"{path}: found the extension {path.suffix!r}"
            raise click.UsageError(f"{found}; expected {', '.join(_ENDINGS)}")
        options.check_folder(path)
    if chosen["vessel"] is None and (chosen["later_vessel"] is not None or chosen["pair"]):
        given = "--later-vessel" if chosen["later_vessel"] is not None else "--pair"
        raise click.UsageError(f"{given} needs --vessel: it belongs to one vessel")
    if any(len(pair) != 2 for pair in chosen["pair"]):
        raise click.UsageError("found a --pair of one place; expected two, such as 41,38")


def _side(chosen: dict[str, Any], which: str) -> _Side:
    volume = chosen[which]
    one = {**chosen, "volume": volume, "centerlines": (chosen[f"{which}_lines"],)}
    files = scene_from(one)
    check_files(files.volume, files.centerlines)
    check_reading(one, [volume], has_centerlines=True)
    voxels, tree = read_files(files, one)
    if voxels is None or tree is None:
        raise click.UsageError("lumencut compare-scans needs two scans with centerlines")
    from lumencut.scene.placement import check_meeting

    check_meeting(voxels, tree)
    return _Side(volume.name, voxels, tree)


def _vessels(sides: _Sides, chosen: dict[str, Any]) -> list[tuple[str, int, int]]:
    """Return the name and both ids of each vessel to compare."""
    from lumencut.cli.vessels import ids_of

    if chosen["vessel"] is not None:
        first = ids_of(sides.earlier.tree, (chosen["vessel"],))
        second = ids_of(sides.later.tree, (chosen["later_vessel"] or chosen["vessel"],))
        if len(first) > 1 or len(second) > 1:
            raise click.UsageError(f"several vessels are named {chosen['vessel']!r}; choose by ids")
        return [(chosen["vessel"], first[0], second[0])]
    first_names, second_names = (_names(side) for side in sides)
    common = [(name, n, second_names[name]) for name, n in first_names.items() if name in second_names]
    if not common:
        found = f"{_listed(first_names)} in the earlier scan, {_listed(second_names)} in the later one"
        mend = "choose the vessel by --vessel and --later-vessel"
        raise MeasuringError("vessels to compare", found, "a name that is in both", mend)
    return common


def _names(side: _Side) -> dict[str, int]:
    """Return the ids of vessels by their names, given or suggested; without names that several have."""
    from lumencut.tracing.suggested_names import suggest_names

    suggested = suggest_names(side.tree)
    names = [vessel.name or suggested[n].name for n, vessel in enumerate(side.tree)]
    return {name: n for n, name in enumerate(names) if name is not None and names.count(name) == 1}


def _listed(names: dict[str, int]) -> str:
    from lumencut.base.wording import listed

    return listed([repr(name) for name in names], 8) if names else "no named vessel"


def _compared(
    sides: _Sides, pairs: list[tuple[str, int, int]], chosen: dict[str, Any], *, other_patient: bool
) -> list[Comparison]:
    from lumencut.measuring import comparison
    from lumencut.measuring.sections import measure

    found = []
    with bar("measuring", "vessel") as progress:
        for number, (name, *ids) in enumerate(pairs, 1):
            try:
                first, second = (
                    measure(side.voxels, side.tree[n], tree=side.tree)
                    for side, n in zip(sides, ids, strict=True)
                )
                scans = (sides.earlier.name, sides.later.name)
                made = comparison.compare_scans(
                    first, second, chosen["pair"], vessel=name, scans=scans, other_patient=other_patient
                )
                found.append((name, made))
            except MeasuringError as error:
                if len(pairs) == 1 or error.subject == "scans to compare":
                    raise
                warn(f"{name} is not compared: {error}")
            progress(number, len(pairs))
    for name, one in found:
        say(f"{name}: {one!r}")
        for line in str(one).splitlines():
            say(f"  {line}")
    return [one for _, one in found]
