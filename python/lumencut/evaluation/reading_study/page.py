"""The page that readers of a study open: one HTML file without a server."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from lumencut.base.html_pages import beside, one_file_page

if TYPE_CHECKING:
    from lumencut.evaluation.reading_study.questions import Picture, Question

_HELP = (
    "You see pictures of vessels and answer a question about them. The time of each answer is recorded. "
    "You can take a break between two questions. At the end, save your answers and return the file. "
    "Your answers leave this page only in that file. Lumencut is not a medical device."
)


def study_page(
    study: str, asked: dict[int, list[Question]], names: dict[Picture, str], pictures: dict[str, str]
) -> str:
    """Return the page as HTML; it names no method."""
    style, script = (beside(__file__, name) for name in ("page.css", "page.js"))
    content = {
        "study": study,
        "pictures": pictures,
        "readers": {
            reader: [
                {
                    "name": one.name,
                    "words": one.words,
                    "pictures": [names[picture] for picture in one.pictures],
                    "choices": one.choices,
                }
                for one in questions
            ]
            for reader, questions in asked.items()
        },
    }
    # The slash of an end tag would end the script early.
    data = json.dumps(content).replace("</", "<\\/")
    body = f"""<main>
<section id="start">
<h1>Reading study</h1>
<p>{_HELP}</p>
<form><label>Your number as a reader, 1 to {len(asked)}
<input id="reader" type="number" min="1" max="{len(asked)}" required></label>
<button>Begin</button></form>
</section>
<section id="question" hidden>
<p id="progress" role="status"></p>
<h1 id="words" tabindex="-1"></h1>
<div id="pictures"></div>
<div id="choices" role="group" aria-labelledby="words"></div>
</section>
<section id="pause" hidden>
<p id="answered" role="status"></p>
<button id="next" type="button">Next question</button>
</section>
<section id="end" hidden>
<h1>Thank you</h1>
<p>Save your answers, and return the file to the person who gave you this page.</p>
<button id="save" type="button">Save answers</button>
</section>
</main>
<script type="application/json" id="study">{data}</script>"""
    return one_file_page("Reading study", style, script, body)
