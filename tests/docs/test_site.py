"""The documentation site: built with warnings as errors, complete, and nothing of it reaches the network."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

from fomas_verify.cli.app import COMMANDS

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
Run = subprocess.CompletedProcess[str]


def build(*arguments: object) -> Run:
    return subprocess.run(
        [Path(sys.executable).parent / "mkdocs", "build", "--strict", *map(str, arguments)],
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    done = build("--site-dir", folder)
    assert done.returncode == 0, done.stdout
    return folder


class Loads(HTMLParser):
    """What a browser loads with a page, without a click."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("src", "srcset", "poster", "data") or (name == "href" and tag == "link"):
                self.addresses.append(value or "")


def foreign(html: str) -> list[str]:
    """Addresses of other hosts that a page loads, and the class that makes the theme fetch a script."""
    loads = Loads()
    loads.feed(html)
    return [x for x in loads.addresses if re.match(r"[a-z]+:|//", x)] + re.findall(r'class="mermaid"', html)


def test_no_page_loads_anything_from_elsewhere(site: Path) -> None:
    pages = list(site.rglob("*.html"))
    assert len(pages) > 60
    assert {str(page): hits for page in pages if (hits := foreign(page.read_text("utf-8")))} == {}
    sheets = list(site.rglob("*.css"))
    assert sheets
    assert [
        page for page in sheets if re.search(r"(url\(|@import)\s*[\"']?(https?:)?//", page.read_text("utf-8"))
    ] == []


def test_every_listing_keeps_to_the_width_of_the_page(site: Path) -> None:
    """The theme lets `pre > code` wrap or scroll; a bare `pre` would make the whole page wider than a phone."""
    pages = {str(page): page.read_text("utf-8") for page in site.rglob("*.html")}
    assert sum(html.count("<pre") for html in pages.values()) > 100
    bare = re.compile(r"<pre[^>]*>(?!\s*(<span></span>)?<code)")
    assert [page for page, html in pages.items() if bare.search(html)] == []


@pytest.mark.parametrize(
    "html",
    [
        '<script src="https://example.invalid/x.js"></script>',
        '<link rel="stylesheet" href="//example.invalid/x.css">',
        '<pre class="mermaid">x</pre>',
    ],
)
def test_what_would_be_loaded_is_seen(html: str) -> None:
    assert len(foreign(html)) == 1


def test_a_broken_link_breaks_the_build(tmp_path: Path) -> None:
    docs = tmp_path / "docs"
    docs.mkdir()
    (docs / "index.md").write_text("# One\n\n[two](#two)\n")
    (tmp_path / "mkdocs.yml").write_text(f"INHERIT: {ROOT / 'mkdocs.yml'}\nhooks: []\nextra_css: []\nnav: [index.md]\n")
    done = build("--config-file", tmp_path / "mkdocs.yml", "--site-dir", tmp_path / "site")
    assert done.returncode != 0
    assert "#two" in done.stdout
    (docs / "index.md").write_text("# One\n\n[one](#one)\n")
    done = build("--config-file", tmp_path / "mkdocs.yml", "--site-dir", tmp_path / "site")
    assert done.returncode == 0, done.stdout


def test_references_are_complete(site: Path) -> None:
    """Each command with its options, each public name with its docstring."""
    import fomas_verify.api
    import fomas_verify.simulate

    commands = (site / "reference" / "cli.html").read_text("utf-8")
    for name in COMMANDS:
        assert f'id="verify-design-{name}"' in commands or f'id="{name}"' in commands, name
    assert "--baseline CERTDIR" in commands
    names = (site / "reference" / "api.html").read_text("utf-8")
    for module in (fomas_verify.api, fomas_verify.simulate):
        for name in module.__all__:
            assert name.isupper() or f'id="{module.__name__}.{name}"' in names, name
    assert 'id="fomas_verify.api.Proof.save"' in names


def test_links_to_proofs_lead_to_their_lines(site: Path) -> None:
    page = (site / "proofs" / "index.html").read_text("utf-8")
    assert 'href="Model/Loop.v.html#L-53"' in page
    assert 'id="L-53"' in (site / "proofs" / "Model" / "Loop.v.html").read_text("utf-8")
