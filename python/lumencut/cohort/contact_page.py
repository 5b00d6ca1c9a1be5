"""The contact sheet of a cohort: one HTML file with a tile for each study, to filter and to rate."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from html import escape

from lumencut.base.html_pages import beside, one_file_page
from lumencut.cohort.layout import Layout
from lumencut.cohort.manifest import Manifest, Study
from lumencut.cohort.record import Record

_FILTERS = ("all", "failed", "flagged", "doubtful", "unrated", "good", "redo", "exclude")
_ORDERS = {
    "row": "the manifest",
    "id": "id",
    "narrowest": "narrowest place",
    "flags": "flags",
    "doubtful": "doubtful vessels",
    "seconds": "time",
}
#: Number of tiles shown at first; the page's script uses the same number.
_AT_ONCE = 200
_HELP = (
    "Click a tile to select it, then rate it: g good, r redo, x exclude, u none. Arrows select the next; "
    "Enter or a double click opens the picture in a new tab. Ratings stay in this browser until they are "
    "saved. Narrowest places are suggestions to check. "
    "Lumencut is not a medical device."
)


def contact_page(layout: Layout, manifest: Manifest, records: Sequence[Record | None]) -> str:
    """Return the contact sheet of a cohort as HTML.

    It includes its pictures, style and script, contacts no server, and its content policy blocks all other
    scripts. It contains no patient data except the pictures and the ids of the manifest.

    Parameters
    ----------
    layout : Layout
        The folder of the results; links lead to pictures there.
    manifest : Manifest
        The studies.
    records : sequence of Record or None
        The record of each study, in the order of the manifest; None if it is not processed yet.
    """
    style, script = (beside(__file__, name) for name in ("contact_page.css", "contact_page.js"))
    pairs = zip(manifest.studies, records, strict=True)
    tiles = "\n".join(_tile(layout, row, study, record) for row, (study, record) in enumerate(pairs))
    ids = "\0".join(study.id for study in manifest.studies)
    cohort = hashlib.sha256(f"{layout.out}\0{ids}".encode()).hexdigest()[:16]
    filters = "".join(f"<option>{name}</option>" for name in _FILTERS)
    orders = "".join(f'<option value="{key}">{name}</option>' for key, name in _ORDERS.items())
    body = f"""<header>
<h1>Cohort of {len(manifest.studies)} studies</h1>
<label>Show <select id="filter">{filters}</select></label>
<label>Order by <select id="order">{orders}</select></label>
<label>Id <input id="search" type="search" size="12"></label>
<button id="save" type="button">Save ratings as CSV</button>
<span id="shown" role="status"></span>
<p>{_HELP}</p>
</header>
<ol data-cohort="{cohort}">
{tiles}
</ol>
<footer></footer>"""
    return one_file_page(f"Cohort of {len(manifest.studies)} studies", style, script, body)


def _tile(layout: Layout, row: int, study: Study, record: Record | None) -> str:
    """Return the tile of a study: its thumbnail, how it ended, and what to check."""
    state = "skipped" if record is None else record.state
    numbers = {} if record is None else record.numbers
    narrowest, flags, doubtful = (
        str(numbers.get(name, "")) for name in ("suggested_narrowest_mm", "flags", "doubtful_vessels")
    )
    data = {
        "id": study.id,
        "row": str(row),
        "state": state,
        "flags": flags,
        "doubtful": doubtful,
        "narrowest": narrowest,
        "seconds": "" if record is None else f"{record.seconds:.3f}",
    }
    attributes = " ".join(f'data-{name}="{escape(value)}"' for name, value in data.items())
    lines = [study.left_out] if study.left_out else _lines(record, narrowest, flags, doubtful)
    words = "".join(f'<p title="{escape(line)}">{escape(line)}</p>' for line in lines)
    picture = _picture(layout, study) if state == "done" else f"<a>{state}</a>"
    name = f'<b title="{escape(study.id)}">{escape(study.id)}</b>'
    hidden = "" if row < _AT_ONCE else ' class="hidden"'
    return f'<li tabindex="0"{hidden} {attributes}>{picture}{name}{words}<p class="rating"></p></li>'


def _lines(record: Record | None, narrowest: str, flags: str, doubtful: str) -> list[str]:
    """Return the lines of text of a tile."""
    if record is None:
        return ["not done yet"]
    if record.state == "failed":
        return [record.reason]
    found = record.numbers
    lines = [f"{found['vessels']} vessels, {float(found['length_mm']):.0f} mm"]
    if narrowest:
        lines.append(f"narrowest {float(narrowest):.2f} mm, vessel {found['suggested_narrowest_vessel']}")
    notes = {"flags": flags, "doubtful vessels": doubtful, "warnings": str(len(record.warnings))}
    counts = [f"{count} {name}" for name, count in notes.items() if count not in ("", "0")]
    return [*lines, ", ".join(counts)] if counts else lines


def _picture(layout: Layout, study: Study) -> str:
    """Return the thumbnail of a study, as a link to its first picture."""
    folder = layout.folder(study)
    thumbnail = folder / f"{study.label}_thumbnail.webp"
    pictures = sorted(folder.glob("*.png"))
    if not thumbnail.is_file() or not pictures:
        return f'<a href="{escape(study.folder.as_posix())}/">files</a>'
    encoded = base64.b64encode(thumbnail.read_bytes()).decode("ascii")
    # Prefer views to reformations; file names of views contain "view".
    first = next((one for one in pictures if "_view-" in one.name), pictures[0])
    address = escape((study.folder / first.name).as_posix())
    image = f'<img loading="lazy" alt="{escape(study.id)}" src="data:image/webp;base64,{encoded}">'
    return f'<a href="{address}" tabindex="-1">{image}</a>'
