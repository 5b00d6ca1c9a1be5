"""The checks of scripts/words.py find the faults they are made for, and none in plain text."""

import subprocess

import pytest

from script_modules import SCRIPTS, script

ROOT = SCRIPTS.parent
LONG = (
    "The fit moves each of the ten points " + "and the next one " * 6 + "until nothing moves any more at all."
)


@pytest.fixture(scope="module")
def words():
    yield from script("words")


def said(found) -> str:
    return "\n".join(map(str, found))


def test_a_page_without_budget_and_one_over_it_are_named(words):
    found = said(words.over_budget({"docs/new.md": "One word.", "examples/README.md": "word " * 51}))
    assert "docs/new.md: found no budget" in found
    assert "examples/README.md: found 51 words; expected at most 50" in found
    assert said(words.over_budget({"examples/README.md": "word " * 50})) == ""


def test_all_pages_together_have_a_budget(words, monkeypatch):
    monkeypatch.setattr(words, "MOST_WORDS", 3)
    assert "all pages: found 4 words; expected at most 3" in said(words.over_budget({"README.md": "a b c d"}))


def test_every_page_that_has_a_budget_exists(words):
    assert sum(words.BUDGETS.values()) <= words.MOST_WORDS
    assert [name for name in words.BUDGETS if not (ROOT / name).is_file()] == []


def test_long_sentences_are_found_in_text_and_lists(words):
    for text in (LONG, f"* {LONG}", f"Short one. {LONG} Another.", LONG.replace(" and", "\nand", 3)):
        assert "at most 30" in said(words.long_sentences({"a.md": text})), text


@pytest.mark.parametrize(
    "text",
    [
        f"```\n{LONG}\n```",
        f"| a |\n|---|\n| {LONG} |",
        f"a | b\n---|---\nc | {LONG}\nd | {LONG}",
        f"# {LONG}",
        f"A formula:\n\n    {LONG}\n    {LONG}\n",
        "It took " + "12 × 34 5.6 " * 20 + "ms.",
        "* one item of a list\n" * 20,
        LONG.replace(" and", ". And"),
        f"See `{LONG.rstrip('.')}` there.",
        "Unless you state otherwise, any contribution intentionally submitted " + LONG,
    ],
)
def test_code_tables_headings_and_legal_texts_may_be_long(words, text):
    assert said(words.long_sentences({"a.md": text})) == ""


def test_leftovers_of_a_merge_are_found(words):
    sentence = "The renderer shows each of the vessels in its own colour."
    assert "also appears in a.md" in said(words.repeated({"a.md": f"{sentence} More.", "b.md": sentence}))
    assert "also appears in a.md" in said(words.repeated({"a.md": f"{sentence}\n\n* {sentence}"}))
    row = "| lines | the lines of each vessel with all their radii |\n"
    assert "also appears in a.md" in said(words.repeated({"a.md": row + row}))
    row = "lines | the lines of each vessel with all their radii\n"
    assert "also appears in a.md" in said(words.repeated({"a.md": f"a | b\n---|---\n{row}{row}"}))
    start = "(BSD-3-Clause) and SimpleITK (Apache-2.0) as oracles, the fuzz targets"
    texts = {"a.md": f"Tests use vtk\n{start} one of both\nand others\n{start} none of both\n"}
    assert "2 lines start with: (BSD-3-Clause) and SimpleITK" in said(words.repeated(texts))
    assert said(words.repeated({"a.md": sentence, "README.md": sentence})) == ""
    assert said(words.repeated({"a.md": "Lumencut is not a medical device.\n\n" * 2})) == ""


def test_dialect_is_counted_outside_code_only(words):
    text = "It tells whoever asks. What is told stands beside it. `told` is a name."
    counts = words.dialect_counts(words.prose(text))
    assert counts["tell, tells, told"] == 2
    assert counts["whoever, whatever"] == counts["beside"] == 1
    limits = dict.fromkeys(words.DIALECT, 1)
    assert "found 'tell, tells, told' 2 times; expected at most 1" in said(
        words.dialect([words.prose(text)], "x", limits)
    )
    assert words.dialect_counts("Besides, an hotel retold it.") == dict.fromkeys(words.DIALECT, 0)


def test_messages_of_python_are_errors_warnings_and_help(words):
    source = '''
"""Not this one."""
@main.command()
@click.option("--at", help="The place of it.")
def measure(at):
    """Measure a vessel.

    \\b
    lumencut measure it
    """
    if at: raise MeasuringError("place", f"{at:g} mm along it", "one within")
    warnings.warn("a doubt about it", stacklevel=2)
'''
    found = set(words.python_messages(source))
    assert {"The place of it.", "value mm along it", "one within", "a doubt about it"} <= found
    assert any(text.strip() == "Measure a vessel." for text in found)


def test_messages_of_the_page_and_of_rust_are_strings_of_some_words(words):
    page = (
        "/** Not this one here. */\n"
        "const a = 'a vessel of it'; // nor 'this one here'\n"
        "b = `${n} vessels were found`;"
    )
    assert list(words.page_messages(page)) == ["a vessel of it", "value vessels were found"]
    rust = (
        '/// Not "this one here".\n'
        'let a = format!("{n} vessels\\\n  were found"); // c\n'
        '#[cfg(test)]\nmod tests { "not this one" }'
    )
    assert list(words.rust_messages(rust)) == ["value vessels were found"]


def test_long_sentences_of_messages_are_found(words):
    long = "word " * 26
    assert "26 words, at most 25" in said(words.long_messages({"a.py": [long]}))
    assert said(words.long_messages({"a.py": ["found " + "x " * 20 + "; expected " + "y " * 20]})) == ""


def test_comments_are_counted_as_grep_does(words):
    pattern = r"^\s*(//|#[^[!]|\*|/\*\*)"
    files = words.tracked(*words.COMMENTED)
    done = subprocess.run(
        ["grep", "-hE", pattern, *files],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
        errors="replace",
    )
    assert words.comment_lines() == len(done.stdout.splitlines())


def test_the_command_fails_with_a_line_per_fault(words, monkeypatch, capsys):
    monkeypatch.setattr(words, "pages", lambda _=(): {"docs/new.md": "One."})
    monkeypatch.setattr(words, "messages", dict)
    monkeypatch.setattr("sys.argv", ["words.py", "--check"])
    monkeypatch.setattr(words, "comment_lines", lambda: 0)
    assert words.main() == 1
    told = capsys.readouterr()
    assert told.out.startswith("docs/new.md: found no budget")
    assert "found 1 faults" in told.err
    monkeypatch.setattr(words, "pages", lambda _=(): {"README.md": "One."})
    assert words.main() == 0
