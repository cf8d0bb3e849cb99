"""Which files are designs.

A file given by name always is one. In a folder, and below it, these are: ``*.design.toml``, ``*.design.json``, and
.toml and .json files with top-level ``format = "fomas-design/1"``. One with both ``alpha`` and ``graph`` and no such
mark is refused with the way to mark it, so that no design is passed over in silence. A table [grid] makes it a grid,
which only `sweep` takes. A certificate is none, whatever
its name: `gate -o` writes ``x.design.json`` of x.design.toml. Links to folders and hidden folders are not entered.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Final

from fomas_verify.design import DesignError
from fomas_verify.design.document import MAX_BYTES, format_of, parse_document
from fomas_verify.exact.errors import source_name
from fomas_verify.gate.model import Result, Skipped, refusal

MARK: Final = "fomas-design"
HOW_TO_MARK: Final = (
    'alpha and graph make it a design: expected a name that ends in .design{} or format = "fomas-design/1" at its top'
)

_ENDINGS = (".toml", ".json")
_NAMES = tuple(f".design{ending}" for ending in _ENDINGS)
_CERTIFICATE = re.compile(rb"""(?:\xef\xbb\xbf)?\s*\{\s*"format"\s*:\s*"fomas-certificate/""")
_KEYS = re.compile(r"""^\s*["']?alpha["']?\s*[=:].*graph|graph.*^\s*["']?alpha["']?\s*[=:]""", re.DOTALL | re.MULTILINE)

Found = Path | Result | Skipped


def find_designs(paths: Iterable[Path]) -> Iterator[Found]:
    """Look through files and folders, in the order given, folders in the order of their names.

    Parameters
    ----------
    paths : iterable of Path
        Files, each taken for a design, and folders.

    Yields
    ------
    Path, Result or Skipped
        A design's file, each file once; the refusal of what cannot be looked at or is a design without a mark; or what
        is not a design, and why. No file is read that is not named .toml or .json.
    """
    seen: dict[str, str] = {}
    for path in paths:
        for found in _look_through(path) if _is_folder(path) else (path,):
            if isinstance(found, Path):
                real, source = os.path.realpath(found), source_name(found)
                if real in seen:
                    yield Skipped(source, f"the same file as {seen[real]}")
                    continue
                seen[real] = source
            yield found


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _look_through(folder: Path) -> Iterator[Found]:
    try:
        with os.scandir(folder) as listing:
            entries = sorted(listing, key=lambda entry: entry.name)
    except OSError as error:
        yield _refused(folder, f"expected a readable folder, got {_reason(error)}")
        return
    for entry in entries:
        path = Path(entry.path)
        if entry.is_symlink() and _is_folder(path):
            yield Skipped(source_name(path), "a link to a folder; links to folders are not followed")
        elif entry.is_dir(follow_symlinks=False):
            if entry.name.startswith("."):
                yield Skipped(source_name(path), "a hidden folder")
            else:
                yield from _look_through(path)
        elif entry.name.lower().endswith(_NAMES):
            yield Skipped(source_name(path), "a certificate") if _is_certificate(path) else path
        elif entry.name.lower().endswith(_ENDINGS):
            yield _judge(path)


def _is_certificate(path: Path) -> bool:
    """Whether a file begins as a certificate does: no design can, since its format would be another."""
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            return False
        with path.open("rb") as file:
            return _CERTIFICATE.match(file.read(256)) is not None
    except OSError:
        return False


def _judge(path: Path) -> Found:
    """Whether a file that no name marks is a design, by its content."""
    source = source_name(path)
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode) or status.st_size > MAX_BYTES:
            return Skipped(source, "no regular file" if status.st_size <= MAX_BYTES else "larger than a design can be")
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        return _refused(path, f"expected a readable file, got {_reason(error)}")
    except UnicodeDecodeError:
        return Skipped(source, "not in UTF-8")
    if MARK not in text and not ("alpha" in text and "graph" in text):
        return Skipped(source, "no alpha and no graph")
    try:
        top = parse_document(text, format_of(path, text), source)
    except DesignError:
        return path if MARK in text or _KEYS.search(text) else Skipped(source, "cannot be parsed, and has no mark")
    if str(top.get("format", "")).startswith(f"{MARK}/"):
        return path
    if "grid" in top:
        return Skipped(source, "a grid for sweep")
    if "alpha" in top and ("graph" in top or "graphs" in top):
        return _refused(path, HOW_TO_MARK.format(path.suffix.lower()))
    return Skipped(source, "no alpha and no graph at its top level")


def _refused(path: Path, message: str) -> Result:
    source = source_name(path)
    return refusal(source, str(path), message)


def _reason(error: OSError) -> str:
    return (error.strerror or "an error of the system").lower()
