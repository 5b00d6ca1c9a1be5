"""Which studies of a cohort succeeded, which failed, and which remain."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from lumencut.base.paths import write_text
from lumencut.cohort.layout import Layout
from lumencut.cohort.lock import Shard
from lumencut.cohort.manifest import Manifest, Study
from lumencut.cohort.recipe import CohortRecipe
from lumencut.cohort.record import FORMAT, Origin, Record, origin_of, read_record
from lumencut.errors import FormatError

Retry = Literal["failed", "all"]


@dataclass(frozen=True)
class Planned:
    """A study, the present state of its inputs, and its record if it was made from the same inputs."""

    study: Study
    origin: Origin
    record: Record | None


def known_record(layout: Layout, study: Study, origin: Origin) -> Record | None:
    """Return the record of a study if its files and recipe are still the same.

    Raises
    ------
    FormatError
        For a record of a newer version of Lumencut.
    """
    for path in (layout.record(study), layout.failure(study)):
        record = read_record(path)
        if record is not None and record.id == study.id and record.origin == origin:
            return record
    return None


def planned(layout: Layout, manifest: Manifest, recipe: CohortRecipe) -> list[Planned]:
    """Look up the record of each study in the order of the manifest. Studies that are left out have none."""
    found = []
    for study in manifest.studies:
        if study.left_out:
            found.append(Planned(study, Origin("", recipe.digest), None))
            continue
        origin = origin_of(study, recipe.digest)
        found.append(Planned(study, origin, known_record(layout, study, origin)))
    return found


def to_do(plans: Sequence[Planned], shard: Shard, retry: Retry | None) -> list[Planned]:
    """Return the studies of a shard that must be processed now."""
    return [
        one
        for place, one in enumerate(plans)
        if shard.has(place)
        and not one.study.left_out
        and (one.record is None or retry == "all" or (retry == "failed" and one.record.state == "failed"))
    ]


def settle_recipe(layout: Layout, recipe: CohortRecipe, retry: Retry | None) -> None:
    """Reject a folder whose results were made with another recipe or version.

    Raises
    ------
    FormatError
        If such results exist, unless all studies are processed again.
    """
    now = {"format": FORMAT, "recipe": recipe.digest, "version": Origin("", "").version}
    path = layout.batch_file
    try:
        found = json.loads(path.read_text("utf-8"))
        before = {name: found[name] for name in now}
    except FileNotFoundError:
        before = now
    except (ValueError, KeyError, TypeError):
        before = dict.fromkeys(now, "unknown")
    if before != now and retry != "all":
        other = "recipe" if before["version"] == now["version"] else "version of Lumencut"
        found = f"results of another {other} ({before[other.partition(' ')[0]]})"
        mend = "name another folder, or process all again with --retry all"
        raise FormatError(str(layout.out), found, f"those of {now[other.partition(' ')[0]]}", mend)
    write_text(path, json.dumps(now, indent=1) + "\n")
