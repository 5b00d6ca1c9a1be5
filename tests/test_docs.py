"""The documentation site: pages, links, scripts, and the checks of the built site."""

import re
import runpy
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import lumencut
from lumencut import demo
from lumencut.cli import main
from lumencut.evaluation import figures as evaluation_figures
from lumencut.evaluation.figures.figure import Figure, Panel
from lumencut.evaluation.figures.page import html_page

from script_modules import SCRIPTS  # isort: skip - the next ones are found by it
import docs
import site_checks
import types_for_users
from stent_scene import stent_stand_in

ROOT = SCRIPTS.parent

EXAMPLES = [script.path for script in docs.scripts_of(docs.EXAMPLES)]
GALLERY = [script.path for script in docs.scripts_of(docs.GALLERY)]


def test_every_page_is_in_the_navigation_and_the_other_way_round():
    named = re.findall(r"^      - (\S+\.md)$", (ROOT / "mkdocs.yml").read_text("utf-8"), re.MULTILINE)
    assert len(named) > 30
    assert sorted(named) == sorted([*docs.page_sources(), docs.FIGURES_PAGE])


def test_every_public_name_is_on_one_page():
    told = docs.names_on_pages()
    assert len(told) == len(set(told))
    assert {*told, "__version__"} == set(lumencut.__all__)


def test_roles_of_docstrings_become_links_but_where_types_are_code():
    text = "volume : Volume, or what :func:`lumencut.render` takes\n    :meth:`Camera.rotated`, :attr:`gone`."
    assert docs.linked(text) == (
        "volume : Volume, or what render takes\n    [`Camera.rotated`][lumencut.Camera], `gone`."
    )


def headings(text: str) -> set[str]:
    """The anchors of a page, as GitHub and the site make them."""
    plain = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    lines = re.findall(r"^#+ (.*)$", plain, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", line.lower()).replace(" ", "-") for line in lines}


@pytest.mark.parametrize("name", [*docs.page_sources(), "README.md", "examples/README.md"])
def test_every_link_of_a_page_leads_somewhere(name):
    source = docs.page_sources().get(name, ROOT / name)
    docs.site_page(source)
    for link in re.findall(r"\]\(([^)\s]+)\)", source.read_text("utf-8")):
        target, _, anchor = link.partition("#")
        path = (source.parent / target).resolve() if target else source
        if anchor and path.suffix == ".md" and not re.match("[a-z]+:", link):
            assert anchor in headings(path.read_text("utf-8")), link


@pytest.mark.parametrize("name", docs.page_sources())
def test_a_part_of_a_list_is_indented_by_four(name):
    """GitHub accepts a smaller indentation, MkDocs does not."""
    text = re.sub(r"^```.*?^```$", "", docs.page_sources()[name].read_text("utf-8"), flags=re.S | re.M)
    assert re.findall(r"^\n {1,3}(?! ).*", text, re.MULTILINE) == []


def test_links_are_those_of_the_site(tmp_path):
    text, files = docs.site_page(ROOT / "docs/pictures.md")
    assert "](method/cut-surface.md)" in text
    assert "](results/accuracy.md)" in text
    assert files["images/csr.webp"] == ROOT / "docs/images/csr.webp"
    assert "](command-line.md)" in docs.site_page(ROOT / "docs/gallery.md")[0]
    assert "](docs/" not in docs.site_page(ROOT / "ARCHITECTURE.md")[0]


def test_links_of_pages_in_subfolders_are_relative(monkeypatch, tmp_path):
    monkeypatch.setattr(docs, "ROOT", tmp_path)
    for name in (
        "README.md",
        "docs/measuring.md",
        "docs/method/measuring.md",
        "docs/images/one.png",
        "docs/results/speed.md",
        "scripts/one.py",
        *(f"{one}.md" for one in docs.OF_ROOT),
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    page = tmp_path / "docs/method/measuring.md"
    page.write_text(
        "[a](../measuring.md#x) [b](../results/speed.md) [c](measuring.md) [d](../../CHANGELOG.md) "
        "[e](../../README.md) ![f](../images/one.png) [g](../../scripts/one.py)",
        "utf-8",
    )
    text, files = docs.site_page(page)
    assert text == (
        "[a](../measuring.md#x) [b](../results/speed.md) [c](measuring.md) [d](../CHANGELOG.md) "
        "[e](../index.md) ![f](../images/one.png) [g](../scripts/one.py)"
    )
    assert set(files) == {"images/one.png", "scripts/one.py"}
    (tmp_path / "CHANGELOG.md").write_text("[a](docs/method/measuring.md) [b](SECURITY.md)", "utf-8")
    assert docs.site_page(tmp_path / "CHANGELOG.md")[0] == "[a](method/measuring.md) [b](SECURITY.md)"


def tracked_sources() -> dict[str, str]:
    """The text of every source file by its path."""
    patterns = ("*.rs", "*.py", "*.pyi", "*.ts", "*.tsx", "*.wgsl", "*.toml", "*.json", "Makefile")
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *patterns]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    paths = [name for name in done.stdout.splitlines() if (ROOT / name).is_file()]
    return {name: (ROOT / name).read_text("utf-8") for name in paths}


@pytest.mark.parametrize("page", ["ARCHITECTURE.md", "CONTRIBUTING.md"])
def test_files_and_names_of_the_code_that_a_page_names_exist(page):
    text = re.sub(r"^```.*?^```$", "", (ROOT / page).read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    spans = {span for span in re.findall(r"`([^`\n]+)`", text) if "NAME" not in span}
    sources = tracked_sources()
    known = set(re.findall(r"\w+", "\n".join(sources.values())))
    files = {one for span in spans for one in re.findall(r"[\w./-]+\.(?:rs|py|wgsl|tsx?|json|toml)\b", span)}
    files -= {"x.rs", "x.wgsl", "stages/x.rs", "stages/x.wgsl", "before.json", "after.json"}
    missing = [one for one in files if not any(f"/{name}".endswith(f"/{one}") for name in sources)]
    assert missing == []
    words = {word for span in spans - files for word in re.findall(r"[A-Za-z_]\w{3,}", span)}
    shown = {"trefoil", "parameters", "DecompressionStream", "open_x", "reference_"}
    assert sorted(words - known - shown) == []


def test_a_link_that_leads_nowhere_is_refused(monkeypatch, tmp_path):
    monkeypatch.setattr(docs, "ROOT", tmp_path)
    page = tmp_path / "docs" / "page.md"
    page.parent.mkdir()
    page.write_text("See [this](nowhere.md).", "utf-8")
    with pytest.raises(docs.PageError, match=r"docs/page.md: found the link nowhere.md"):
        docs.site_page(page)
    page.write_text("```\n[code](nowhere.md)\n```\n[there](page.md#a) [else](https://example.org)", "utf-8")
    assert docs.site_page(page)[1] == {}


PAGES = {**docs.page_sources(), "README.md": ROOT / "README.md"}


def blocks(language: str) -> list[tuple[str, str]]:
    """The blocks of code of all pages, with the names of the pages."""
    fence = re.compile(rf"^```{language}\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    return [(name, block) for name, path in PAGES.items() for block in fence.findall(path.read_text("utf-8"))]


def test_every_option_that_a_page_shows_is_one_of_its_command():
    lines = [(page, line) for page, block in blocks("sh") for line in block.splitlines()]
    shown = [(page, line.partition(" # ")[0].split()) for page, line in lines if line.startswith("lumencut ")]
    assert len(shown) > 60
    wrong = []
    for page, (_, *words) in shown:
        command = main.commands.get(words[0]) if words else main
        known = (
            {name for one in command.params for name in (*one.opts, *one.secondary_opts)} if command else {}
        )
        wrong += [(page, word) for word in words if word.startswith("--") and word.split("=")[0] not in known]
        wrong += [] if command else [(page, words[0])]
    assert wrong == []


def test_every_name_that_a_page_shows_is_public():
    shown = {
        (page, name)
        for page, block in blocks("python")
        for name in re.findall(r"\blumencut\.([A-Za-z]\w*)\(", block)
    }
    assert len(shown) > 30
    assert [(page, name) for page, name in sorted(shown) if name not in lumencut.__all__] == []


@pytest.mark.parametrize("path", [*EXAMPLES, *GALLERY], ids=lambda path: path.stem)
def test_every_script_is_a_card_of_one_page(path):
    page = "gallery.md" if path in GALLERY else "python.md"
    assert (ROOT / "docs" / page).read_text("utf-8").count(f"(../{path.relative_to(ROOT)})") == 1
    text, _ = docs.site_page(ROOT / "docs" / page)
    script = docs.script_of(path)
    assert f"### {script.title}\n" in text
    assert "    import lumencut\n" in script.card()
    assert (f"](gallery/{path.stem}.webp)" in text) == (path in GALLERY)


def test_a_script_without_words_is_refused(tmp_path):
    path = tmp_path / "silent.py"
    path.write_text('"""No more than a title."""\nimport lumencut\n', "utf-8")
    with pytest.raises(docs.PageError, match=r"silent.py: found no title and text"):
        docs.script_of(path)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_and_says_something(path, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(path), run_name="__main__")
    assert len(capsys.readouterr().out.split()) > 3
    written = re.findall(r'(?:save|write_centerlines)\((?:tree, )?"([^"]+)"', path.read_text("utf-8"))
    assert [name for name in written if not (tmp_path / name).stat().st_size] == []


@pytest.fixture(scope="module")
def stent():
    return stent_stand_in()


@pytest.mark.parametrize("path", GALLERY, ids=lambda path: path.stem)
def test_a_script_of_the_gallery_makes_its_picture(path, stent, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(demo, "stent_scene", lambda: stent)
    runpy.run_path(str(path), run_name="__main__")
    with Image.open(tmp_path / docs.script_of(path).picture) as picture:
        low, high = picture.convert("L").getextrema()
    assert high - low > 100


PAGE = '<html><head>{head}</head><body><h1 id="top">T</h1>{body}</body></html>'


@pytest.fixture
def built(tmp_path):
    """A site of two pages and a sheet."""

    def write(head="", body="", css=""):
        (tmp_path / "index.html").write_text(PAGE.format(head=head, body=body), "utf-8")
        (tmp_path / "other.html").write_text(PAGE.format(head="", body=""), "utf-8")
        (tmp_path / "site.css").write_text(css, "utf-8")
        return tmp_path

    return write


def test_a_good_site_passes(built):
    body = '<a href="other.html#top">a</a><a href="#top">b</a><a href="https://example.org">c</a>'
    site_checks.check_site(built('<link rel="stylesheet" href="site.css">', f'{body}<img src="data:,">'))


@pytest.mark.parametrize(
    ("parts", "fault"),
    [
        ({"head": '<script src="https://example.org/a.js"></script>'}, "requests https://example.org/a.js"),
        ({"head": '<link rel="stylesheet" href="//example.org/a.css">'}, "requests //example.org/a.css"),
        ({"head": '<link rel="preconnect" href="https://example.org">'}, "requests https://example.org"),
        ({"css": "a { background: url('https://example.org/a.png') }"}, "requests https://example.org/a.png"),
        ({"css": "@import 'https://example.org/a.css';"}, "requests https://example.org/a.css"),
        ({"body": '<img src="absent.webp">'}, "fetches absent.webp, which does not exist"),
        ({"body": '<a href="absent.html">a</a>'}, "links to absent.html, which does not exist"),
        ({"body": '<a href="other.html#absent">a</a>'}, "which has no such heading"),
    ],
)
def test_requests_to_other_hosts_and_broken_links_are_rejected(built, parts, fault):
    with pytest.raises(site_checks.SiteError, match=re.escape(fault)):
        site_checks.check_site(built(**parts))


def test_an_empty_site_is_refused(tmp_path):
    with pytest.raises(site_checks.SiteError, match="found no page"):
        site_checks.check_site(tmp_path)


def test_the_page_of_the_figures_shows_every_picture(tmp_path, monkeypatch):
    def made(folder):
        table = Figure("Table 1", "Words.", [], [["a", "b"], ["1", "2"]])
        panel = Panel("a", "A knot.", {"paper": np.zeros((4, 4, 3), np.uint8)})
        (folder / "index.html").write_text(html_page([Figure("Figure 2", "Knots.", [panel]), table], "1"))
        return ["figure-2a-paper.png", "index.html"]

    monkeypatch.setattr(evaluation_figures, "make_figures", made)
    page, pictures = docs.figures(tmp_path)
    assert pictures == {"figures/figure-2a-paper.png": tmp_path / "figure-2a-paper.png"}
    assert page.startswith("---\nhide: [toc]\n---\n\n# Figures of Curved Surface Reformation\n\n")
    assert 'src="figures/figure-2a-paper.png"' in page
    assert "<td>2</td>" in page
    assert "<html" not in page


def test_without_the_ct_of_the_demo_no_picture_is_made(tmp_path, monkeypatch):
    def unreachable():
        raise demo.UnreachableError("imageio", "no network", "a wheel from the package index")

    monkeypatch.setattr(demo, "stent_scene", unreachable)
    with pytest.raises(docs.PageError, match="the CT of the gallery: imageio: found no network"):
        docs.drawn(tmp_path / "gallery")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("code", "said"),
    [("raise ValueError('no such vessel')", "no such vessel"), ("pass", "found no broken.webp after it ran")],
)
def test_a_picture_that_cannot_be_made_ends_the_build(tmp_path, monkeypatch, code, said):
    path = tmp_path / "broken.py"
    path.write_text(f'"""A title.\n\nA text.\n"""\n{code}\n', "utf-8")
    monkeypatch.setattr(docs, "GALLERY", Path(tmp_path))
    with pytest.raises(docs.PageError, match=said):
        docs.draw(docs.script_of(path), tmp_path)


def symbol(name, *, known=True, ambiguous=False):
    return {"name": f"lumencut.{name}", "isTypeKnown": known, "isTypeAmbiguous": ambiguous}


def test_public_names_without_a_known_type_are_named():
    symbols = [symbol("Frame"), symbol("render", known=False), symbol("Vessel", ambiguous=True)]
    report = {"typeCompleteness": {"symbols": [*symbols, symbol("cli.main", known=False)]}}
    names = {"Frame", "render", "Vessel"}
    assert list(types_for_users.unknown(report, names)) == ["lumencut.render", "lumencut.Vessel"]
    with pytest.raises(ValueError, match="found not every public name"):
        list(types_for_users.unknown(report, {*names, "Camera"}))
