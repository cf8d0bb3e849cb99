"""docs/licences.md names every locked package, says what its metadata says, and holds nothing that BSD-3 forbids."""

import re
from importlib.metadata import PackageNotFoundError, distribution

import pytest

from tools.licences import PAGE, is_compatible, licence
from tools.locks import ROOT, asked_for, closure, locked, pins

ROW = re.compile(r"^\| ([\w.-]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)
TABLE = {name: (terms, purpose) for name, terms, purpose in ROW.findall(PAGE.read_text("utf-8")) if name != "package"}
PEERS = {pin.name for pin in pins((ROOT / "requirements" / "peers.txt").read_text("utf-8"))}


def is_installed(name: str) -> bool:
    try:
        distribution(name)
    except PackageNotFoundError:
        return False
    return True


def test_every_locked_package_has_its_row() -> None:
    assert set(TABLE) == set(locked())
    assert len(TABLE) > 100


@pytest.mark.parametrize("name", [name for name in TABLE if is_installed(name)])
def test_a_row_says_what_the_metadata_says(name: str) -> None:
    """Of packages locked at several versions one is installed, and the other may word it otherwise."""
    terms, _ = TABLE[name]
    assert licence(name) == terms or (len(locked()[name]) > 1 and is_compatible(licence(name)))


def test_what_is_not_installed_is_for_other_platforms_or_a_peer() -> None:
    missing = [name for name in TABLE if not is_installed(name)]
    assert [name for name in missing if name not in PEERS and not all(pin.marker for pin in locked()[name])] == []


def test_the_purpose_is_what_the_locks_say() -> None:
    packages = locked()
    for group, names in asked_for().items():
        found = closure(names, packages)
        assert {name for name, (_, purpose) in TABLE.items() if group in purpose.split(", ")} == found
        assert set(names) <= found


def test_all_are_compatible_and_a_strong_copyleft_is_a_peer_only() -> None:
    refused = {name for name, (terms, _) in TABLE.items() if not is_compatible(terms)}
    assert refused == PEERS == {"fodeint"}
    assert {purpose for name, (_, purpose) in TABLE.items() if name in PEERS} == {"a peer in tests"}


@pytest.mark.parametrize(
    "expression", ["GPL-3.0-or-later", "MIT AND GPL-2.0-only", "AGPL-3.0-only", "Proprietary", "", "MIT AND Unknown"]
)
def test_an_incompatible_licence_is_seen(expression: str) -> None:
    assert not is_compatible(expression)


@pytest.mark.parametrize(
    "expression", ["MIT", "GPL-3.0-only OR MIT", "(MIT AND BSD-3-Clause) AND 0BSD", "Apache-2.0 WITH LLVM-exception"]
)
def test_a_compatible_licence_is_seen(expression: str) -> None:
    assert is_compatible(expression)


def test_a_weak_copyleft_is_no_permissive_licence() -> None:
    assert is_compatible("MIT AND LGPL-3.0-or-later")
    assert not is_compatible("MIT AND LGPL-3.0-or-later", weak=False)


def test_a_package_that_is_not_there_has_no_licence() -> None:
    with pytest.raises(LookupError, match="not installed"):
        licence("no-such-package-anywhere")


def test_the_lock_reader_reads_every_entry() -> None:
    """Held against a plain count of lines."""
    for lock in ("base", "dev", "bench", "peers"):
        text = (ROOT / "requirements" / f"{lock}.txt").read_text("utf-8")
        assert len(list(pins(text))) == len(re.findall(r"^\S+==", text, re.MULTILINE))
        assert all(pin.asked_by for pin in pins(text))
