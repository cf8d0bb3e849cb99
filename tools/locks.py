"""The lock files read: which packages are pinned, who asks for them, and which of them a user of the package gets."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LOCKS = ("dev.txt", "bench.txt", "base.txt", "peers.txt")
DEVELOPMENT = "dev"
_ENTRY = re.compile(r"^([\w.-]+)==([\w.]+)(?: ; ([^\\]+?))? \\$", re.MULTILINE)
_VIA = re.compile(r"^    # +(?:via )?([\w.-]+)(?: \(.*\))?$", re.MULTILINE)


@dataclass(frozen=True)
class Pin:
    """One version of a package, the marker of the Pythons and platforms that get it, and the names that ask for it."""

    name: str
    version: str
    marker: str
    asked_by: frozenset[str]


def pins(text: str) -> Iterator[Pin]:
    """The entries of a lock file, in its order."""
    entries = list(_ENTRY.finditer(text))
    for entry, following in zip(entries, [*entries[1:], None], strict=True):
        rest = text[entry.end() : following.start() if following else len(text)]
        yield Pin(entry[1], entry[2], (entry[3] or "").strip(), frozenset(_VIA.findall(rest)) - {"via"})


def locked() -> dict[str, list[Pin]]:
    """Every locked package by its name; several versions where Pythons or platforms differ."""
    found: dict[str, list[Pin]] = {}
    for lock in LOCKS:
        for pin in pins((ROOT / "requirements" / lock).read_text("utf-8")):
            known = found.setdefault(pin.name, [])
            if all((pin.version, pin.marker) != (x.version, x.marker) for x in known):
                known.append(pin)
    return found


def project() -> dict[str, object]:
    """The table [project] of pyproject.toml."""
    table: dict[str, object] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return table


def asked_for() -> dict[str, list[str]]:
    """The names that the package asks for: under "base", and under each extra that a user may choose."""
    table = project()
    groups: dict[str, list[str]] = {"base": table["dependencies"], **table["optional-dependencies"]}  # type: ignore[dict-item]
    return {
        group: [re.split(r"[^\w.-]", requirement, maxsplit=1)[0] for requirement in requirements]
        for group, requirements in groups.items()
        if group != DEVELOPMENT
    }


def closure(names: Iterable[str], packages: Mapping[str, list[Pin]]) -> set[str]:
    """These packages, what they ask for, and so on."""
    found: set[str] = set()
    waiting = [name for name in names if name in packages]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += needs(name, packages)
    return found


def needs(name: str, packages: Mapping[str, list[Pin]]) -> list[str]:
    """What a package asks for itself."""
    return [other for other, versions in packages.items() if any(name in pin.asked_by for pin in versions)]
