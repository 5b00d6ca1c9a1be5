"""``lumencut doctor``: whether this installation works, for bug reports."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import click

from lumencut.cli.report import FAILED, busy, complain, say, verbose_option


@click.command(short_help="Examine this installation, for bug reports.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@verbose_option
def doctor(as_json: bool) -> None:
    """Show versions, GPUs, the device that computes, the installed extras, and the viewer's page.

    The page must be isolated from other pages to use all cores.

    The CPU renders a small picture, and so does a GPU if there is one. Nothing is sent anywhere, and none of
    your files is named: you can put all of the output into a bug report. The exit code is 1 if there is a
    problem, and each problem has a line.
    """
    from lumencut.cli.installation import examined

    with busy("examining"):
        found = examined()
    say(json.dumps(found, indent=2, allow_nan=False) if as_json else "\n".join(_lines(found)))
    for problem in found["problems"]:
        complain(problem)
    if found["problems"]:
        click.get_current_context().exit(FAILED)


def _lines(found: dict[str, Any]) -> Iterator[str]:
    facts = [
        *found["versions"].items(),
        *(("gpu", _gpu(one)) for one in found["gpus"]),
        *([] if found["gpus"] else [("gpu", "none")]),
        ("auto takes", found["auto"]),
        *((f"picture by {device}", _milliseconds(taken)) for device, taken in found["pictures"].items()),
        ("page", _page(found["page"])),
        (
            "packages",
            ", ".join(f"{name} {version or 'MISSING'}" for name, version in found["packages"].items()),
        ),
        *((f"extra {name}", _extra(one)) for name, one in sorted(found["extras"].items())),
        *found["environment"].items(),
    ]
    width = max(len(name) for name, _ in facts)
    for name, value in facts:
        yield f"{name:<{width}}  {value}"
    count = len(found["problems"])
    yield "all is well" if not count else f"{count} problem{'' if count == 1 else 's'}, listed below"


def _gpu(one: dict[str, Any]) -> str:
    kind = ", software: it computes only with --device gpu" if one["is_software"] else ""
    return f"{one['name']}, {one['backend']}, {one['driver']}{kind}"


def _milliseconds(taken: float | None) -> str:
    return "failed" if taken is None else f"works, {taken:.1f} ms"


def _page(page: dict[str, Any] | None) -> str:
    if page is None:
        return "cannot be served"
    isolated = "isolated from other pages" if page["isolated"] else "NOT isolated from other pages"
    return f"{page['files']} files, {page['bytes'] / 1e6:.1f} MB, served {isolated}"


def _extra(one: dict[str, Any]) -> str:
    if not one["missing"]:
        return "installed"
    return f"without {', '.join(one['missing'])}; {one['mend']}"
