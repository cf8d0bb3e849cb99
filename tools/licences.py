"""``python -m tools.licences``: writes docs/licences.md from the lock files and the metadata of what is installed.

The package is BSD-3-Clause and contains none of its dependencies; what it imports must be permissive, or a weak
copyleft that ends at a package's own files. A strong copyleft may only stand in requirements/peers.txt: compared with
in tests, imported by nothing.
"""

from __future__ import annotations

import re
import sys
from importlib.metadata import Distribution, PackageNotFoundError, distribution

from tools.locks import ROOT, asked_for, closure, locked, pins

PAGE = ROOT / "docs" / "licences.md"
PERMISSIVE = {
    *("0BSD", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "CC0-1.0", "CNRI-Python", "HPND", "ISC", "MIT", "MIT-0"),
    *("MIT-CMU", "PSF-2.0", "Python-2.0", "Unlicense", "Zlib"),
}
WEAK = {"LGPL-2.1-or-later", "LGPL-3.0-or-later", "MPL-2.0"}
_WORDS = {
    r"mit( license)?|osi approved :: mit license": "MIT",
    r"apache( software)?( license)?[ -]?(2(\.0)?)?( license)?|osi approved :: apache software license": "Apache-2.0",
    r"mpl-2\.0|osi approved :: mozilla public license 2\.0 \(mpl 2\.0\)": "MPL-2.0",
    r"psf(l|-2\.0)?|osi approved :: python software foundation license": "PSF-2.0",
    r"gplv3\+": "GPL-3.0-or-later",
    r"lgpl-3\.0\+": "LGPL-3.0-or-later",
}
_HEAD = """# Licences

fomas_verify is under BSD-3-Clause and contains no other package. Its wheel asks for those below; each stays under its
own licence. *Weak copyleft* (LGPL, MPL) ends at that package's files and asks nothing of what imports it. GPL stands in
the last row only: a program that tests compare results with, and that nothing imports otherwise. Wheels of compiled
packages may bundle libraries of their own (OpenBLAS, GMP, FLINT); their files say which. atheris (Apache-2.0) guides
the fuzzer where it is asked for, and is installed for nothing else.

Written by `python -m tools.licences` from the lock files and the metadata of what is installed; a test compares it with
both.

| package | licence | for |
|---|---|---|
"""


def licence(name: str) -> str:
    """The SPDX expression of an installed package, by its metadata or, where that says only BSD, by its licence's text.

    Raises
    ------
    LookupError
        It is not installed, or its licence cannot be told.
    """
    try:
        package = distribution(name)
    except PackageNotFoundError as error:
        raise LookupError(f"{name}: not installed") from error
    data = package.metadata
    if expression := data.get("License-Expression"):
        return str(expression)
    classifiers = [x.removeprefix("License :: ") for x in data.get_all("Classifier") or [] if x.startswith("License")]
    stated = [(data.get("License") or "").strip(), *classifiers]
    for text in stated:
        if text in PERMISSIVE | WEAK:
            return text
        for pattern, found in _WORDS.items():
            if re.fullmatch(pattern, text.lower()):
                return found
    if any(re.match(r"bsd|osi approved :: bsd", text.lower()) for text in stated):
        return _which_bsd(package, stated[0])
    raise LookupError(f"{name}: cannot tell the licence from {stated}")


def _which_bsd(package: Distribution, stated: str) -> str:
    """Three clauses where the text forbids the use of names for endorsement, otherwise two."""
    files = [file for file in package.files or [] if re.match(r"(licen[cs]e|copying)", file.name, re.IGNORECASE)]
    text = " ".join([stated, *(file.read_text("utf-8") for file in files)])
    if "Redistributions" not in text:
        raise LookupError(f"{package.name}: its licence says BSD only, and its text is not at hand")
    return "BSD-3-Clause" if re.search(r"endorse\s+or\s+promote", text) else "BSD-2-Clause"


def is_compatible(expression: str, *, weak: bool = True) -> bool:
    """Whether every part joined by AND, in some branch of each OR, may be used beside BSD-3-Clause."""
    allowed = PERMISSIVE | (WEAK if weak else set())
    parts = re.split(r"\s+AND\s+", re.sub(r"[()]", "", expression))
    return all(any(x.split(" WITH ")[0] in allowed for x in re.split(r"\s+OR\s+", part)) for part in parts)


def rows() -> dict[str, tuple[str, str]]:
    """Name -> licence and what it is for, for every locked package."""
    packages = locked()
    users = {group: closure(names, packages) for group, names in asked_for().items()}
    peers = {pin.name for pin in pins((ROOT / "requirements" / "peers.txt").read_text("utf-8"))}
    table = {}
    for name in sorted(packages):
        groups = [group for group, found in users.items() if name in found]
        purpose = ", ".join(groups) or ("a peer in tests" if name in peers else "development")
        table[name] = licence(name), purpose
    return table


def page() -> str:
    """docs/licences.md: what a user gets first, then development, then peers."""
    order = {"development": 1, "a peer in tests": 2}
    table = sorted(rows().items(), key=lambda row: (order.get(row[1][1], 0), row[0]))
    return _HEAD + "".join(f"| {name} | {terms} | {purpose} |\n" for name, (terms, purpose) in table)


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8")
    sys.stdout.write(f"wrote {PAGE.relative_to(ROOT)}\n")
