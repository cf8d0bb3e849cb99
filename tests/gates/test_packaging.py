"""The lock files cover the project and pin everything by hash; the wheel holds the whole package."""

import re
import tomllib
import zipfile
from pathlib import Path

import pytest

LOCKS = ["base.txt", "dev.txt", "bench.txt"]
PEERS = "peers.txt"


def pins(lock: str) -> dict[str, list[str]]:
    """Name -> the logical lines that pin it (several where versions differ between Pythons)."""
    found: dict[str, list[str]] = {}
    for entry in lock.replace("\\\n", " ").splitlines():
        if entry.strip() and not entry.lstrip().startswith("#"):
            found.setdefault(re.split(r"[^\w.-]", entry, maxsplit=1)[0], []).append(entry)
    return found


def unpinned(lock: str) -> list[str]:
    """Entries without an exact version or without a hash, options and addresses included."""
    return [
        entry
        for entries in pins(lock).values()
        for entry in entries
        if not re.match(r"[\w.-]+==[\w.]+ .*--hash=sha256:[0-9a-f]{64}", entry) or "://" in entry
    ]


def project(checkout: Path) -> dict:
    return tomllib.loads((checkout / "pyproject.toml").read_text())


@pytest.mark.parametrize("name", [*LOCKS, PEERS, "guided.txt"])
def test_every_entry_is_pinned_by_hash(checkout: Path, name: str) -> None:
    assert unpinned((checkout / "requirements" / name).read_text()) == []


@pytest.mark.parametrize(
    "entry",
    ["click==8.5.1", "click>=8 --hash=sha256:" + "0" * 64, "--index" + "-url x", "click @ https://example.invalid"],
)
def test_unpinned_entries_are_seen(entry: str) -> None:
    assert len(unpinned(entry + "\n")) == 1


@pytest.mark.parametrize(
    ("name", "extras"), [("base.txt", ["report"]), ("dev.txt", ["report", "dev"]), ("bench.txt", ["dev", "region"])]
)
def test_locks_cover_what_the_project_asks_for(checkout: Path, name: str, extras: list[str]) -> None:
    meta = project(checkout)
    asked = [*meta["project"]["dependencies"], *meta["build-system"]["requires"], *meta["dependency-groups"]["build"]]
    for extra in extras:
        asked += meta["project"]["optional-dependencies"][extra]
    names = {re.split(r"[^\w-]", requirement, maxsplit=1)[0] for requirement in asked} - {"fomas_verify"}
    assert names - set(pins((checkout / "requirements" / name).read_text())) == set()


def test_peers_are_locked_and_no_dependency_of_the_package(checkout: Path) -> None:
    """They are installed for tests, apart from what a user installs."""
    meta = project(checkout)
    names = {re.split(r"[^\w-]", x, maxsplit=1)[0] for x in meta["dependency-groups"]["peers"]}
    assert set(pins((checkout / "requirements" / PEERS).read_text())) == names
    assert not any(names & set(pins((checkout / "requirements" / lock).read_text())) for lock in LOCKS)
    assert not any(name in str(meta["project"]) for name in names)


def test_locks_agree_on_versions(checkout: Path) -> None:
    base, dev, bench = (pins((checkout / "requirements" / name).read_text()) for name in LOCKS)
    for smaller, larger in ((base, dev), (dev, bench)):
        assert {name: larger.get(name) for name in smaller} == smaller


def test_wheel_holds_the_whole_package(tmp_path: Path, checkout: Path, gate) -> None:
    run = gate(checkout, "hatchling", "build", "-t", "wheel", "-d", str(tmp_path))
    assert run.returncode == 0, run.stdout
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    package = checkout / "fomas_verify"
    files = {path.relative_to(checkout).as_posix() for path in package.rglob("*") if path.is_file()}
    files = {name for name in files if "__pycache__" not in name}
    assert files - names == set()
    assert {name.split("/")[0] for name in names} == {"fomas_verify", wheel.name.rsplit("-", 3)[0] + ".dist-info"}
    assert "fomas_verify/py.typed" in names
