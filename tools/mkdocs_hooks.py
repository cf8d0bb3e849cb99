"""Hooks of mkdocs: pages that stand outside docs/, and links as a forge reads them.

Every page is plain Markdown whose relative links are right in the repository. The site holds docs/ at its root; what
lies elsewhere comes with it: Markdown as pages, Coq sources as pages with numbered lines, examples as files.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name

ROOT = Path(__file__).resolve().parent.parent
PAGES = ("CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "proofs/README.md")
LINK = re.compile(r"(?<!!)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")
FENCE = re.compile(r"^(```+).*?^\1$", re.MULTILINE | re.DOTALL)
LISTING = HtmlFormatter(linenos="inline", lineanchors="L", anchorlinenos=True, wrapcode=True)
COQ = """---
search:
  exclude: true
---
# {name}

{listing}
"""


def on_files(files: Files, config: Any) -> Files:
    """Add what lies outside docs/."""
    for name in PAGES:
        files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    for path in sorted((ROOT / "examples").rglob("*.toml")):
        files.append(File.generated(config, path.relative_to(ROOT).as_posix(), abs_src_path=str(path)))
    for path in sorted((ROOT / "proofs").rglob("*.v")):
        name = path.relative_to(ROOT).as_posix()
        page = COQ.format(name=name, listing=highlight(path.read_text("utf-8"), get_lexer_by_name("coq"), LISTING))
        files.append(File.generated(config, f"{name}.md", content=page))
    return files


def on_page_markdown(markdown: str, page: Any, files: Files, **_: Any) -> str:
    """Turn links of the repository into links of the site; what the site does not hold keeps its words only."""
    source = page.file.src_uri
    folder = posixpath.dirname(source if source in PAGES else f"docs/{source}")
    known = {file.src_uri for file in files}

    def follow(match: re.Match[str]) -> str:
        words, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        path, _, anchor = target.partition("#")
        found = site_path(posixpath.normpath(posixpath.join(folder, path)), known)
        if found is None:
            return words
        if found.endswith(".v.md"):
            anchor = anchor.replace("L", "L-")
        here = posixpath.relpath(found, posixpath.dirname(source) or ".")
        return f"[{words}]({here}{'#' * bool(anchor)}{anchor})"

    parts, end = [], 0
    for fence in FENCE.finditer(markdown):
        parts += [LINK.sub(follow, markdown[end : fence.start()]), fence[0]]
        end = fence.end()
    return "".join([*parts, LINK.sub(follow, markdown[end:])])


def site_path(path: str, known: set[str]) -> str | None:
    """Where the site holds this file of the repository, if it does."""
    if path == "README.md":
        return "index.md"
    for name in (path.removeprefix("docs/") if path.startswith("docs/") else path, f"{path}.md"):
        if name in known:
            return name
    return None
