"""What is released: the same bytes from any folder, a bill of materials, and an sdist that installs and decides."""

import contextlib
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import venv
import zipfile
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import pytest

from tests.docs.console import follow
from tools.licences import is_compatible
from tools.locks import asked_for, closure, locked, pins
from tools.sbom import bill

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
NOT_SOURCES = shutil.ignore_patterns(
    ".git", ".venv", "__pycache__", ".*_cache", ".hypothesis", ".coverage*", "build", "dist", "site", "reports"
)
COMPILED = ("Facts/Sums.vo", "Facts/.Sums.aux", ".lia.cache", "Makefile.coq", "Assumptions1.v")
Run = subprocess.CompletedProcess[str]


def build(source: Path, out: Path, **environment: str) -> None:
    clean = {name: value for name, value in os.environ.items() if name not in ("SOURCE_DATE_EPOCH", "PYTHONPATH")}
    done = subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-d", str(out)],
        cwd=source,
        env={**clean, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def only(folder: Path, pattern: str) -> Path:
    (path,) = folder.glob(pattern)
    return path


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Wheel and sdist, built in a copy of the sources, with the usual umask."""
    folder = tmp_path_factory.mktemp("one")
    shutil.copytree(ROOT, folder / "source", ignore=NOT_SOURCES)
    build(folder / "source", folder / "dist", TZ="UTC", LC_ALL="C", PYTHONHASHSEED="0")
    return folder / "dist"


def test_the_same_bytes_from_another_folder(built: Path, tmp_path: Path) -> None:
    """Another path, file times, order of writing, permissions, umask, time zone, locale, hash seed; proofs compiled."""
    source = tmp_path / "a folder of another length"
    before = os.umask(0o077)
    try:
        shutil.copytree(ROOT, source, ignore=NOT_SOURCES)
        for name in COMPILED:
            (source / "proofs" / name).write_text("not a source")
        for number, path in enumerate(sorted(filter(Path.is_file, source.rglob("*")), reverse=True)):
            os.utime(path, (1e9 + number, 1e9 + number))
            path.chmod(path.stat().st_mode & 0o700)
        build(source, tmp_path / "dist", TZ="Asia/Kathmandu", LC_ALL="C.UTF-8", PYTHONHASHSEED="1")
    finally:
        os.umask(before)
    for pattern in ("*.whl", "*.tar.gz"):
        assert digest(only(tmp_path / "dist", pattern)) == digest(only(built, pattern)), pattern


def test_a_change_of_the_sources_changes_the_bytes(built: Path, tmp_path: Path) -> None:
    source = tmp_path / "source"
    shutil.copytree(ROOT, source, ignore=NOT_SOURCES)
    (source / "fomas_verify" / "more.py").write_text("")
    build(source, tmp_path / "dist")
    assert digest(only(tmp_path / "dist", "*.whl")) != digest(only(built, "*.whl"))


@pytest.fixture(scope="module")
def unpacked(built: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sdist")
    with tarfile.open(only(built, "*.tar.gz")) as archive:
        archive.extractall(folder, filter="data")
    return only(folder, "fomas_verify-*")


def test_the_wheel_of_the_sdist_is_the_wheel(built: Path, unpacked: Path, tmp_path: Path) -> None:
    build(unpacked, tmp_path)
    assert digest(only(tmp_path, "*.whl")) == digest(only(built, "*.whl"))


def put_installed(name: str, site: Path) -> None:
    """Put an installed package into another environment, file by file, so that nothing is fetched."""
    package = distribution(name)
    for file in package.files or []:
        if ".." not in file.parts and "__pycache__" not in file.parts:
            (site / file).parent.mkdir(parents=True, exist_ok=True)
            try:
                (site / file).hardlink_to(str(file.locate()))
            except OSError:  # another file system
                shutil.copyfile(str(file.locate()), site / file)


def environment(home: Path, names: set[str]) -> Path:
    """An environment with pip and these packages, as far as this Python has them, and nothing else; its programs."""
    venv.create(home, with_pip=True)
    for name in names:
        with contextlib.suppress(PackageNotFoundError):  # for other Pythons or platforms
            put_installed(name, only(home / "lib", "python3*") / "site-packages")
    return home / "bin"


def test_the_sdist_installs_into_an_empty_environment_and_decides(built: Path, unpacked: Path, tmp_path: Path) -> None:
    """With the locked build requirements and base dependencies only, by pip, without an index."""
    names = {pin.name for pin in pins((ROOT / "requirements" / "base.txt").read_text("utf-8"))}
    report, base = (closure(asked_for()[group], locked()) for group in ("report", "base"))
    programs = environment(tmp_path / "environment", names - (report - base))
    python = programs / "python"

    def run(*arguments: object) -> Run:
        return subprocess.run(list(map(str, arguments)), cwd=tmp_path, capture_output=True, text=True, check=False)

    options = ["--no-index", "--no-build-isolation", "--no-deps", "--disable-pip-version-check"]
    done = run(python, "-m", "pip", "install", *options, only(built, "*.tar.gz"))
    assert done.returncode == 0, done.stderr
    where = run(python, "-c", "import fomas_verify; print(fomas_verify.__file__)")
    assert Path(where.stdout.strip()).is_relative_to(tmp_path / "environment")
    certificate = tmp_path / "certificate.json"
    tool, design = programs / "verify-design", unpacked / "examples" / "paper.toml"
    done = run(tool, "prove", design, "-o", certificate)
    assert (done.returncode, "All 6 required claims are proved." in done.stdout) == (0, True), done.stderr
    assert run(tool, "check", certificate, "--require", "design").returncode == 0
    done = run(tool, "report", design)
    assert (done.returncode, "fomas_verify[report]" in done.stderr) == (2, True), "jinja2 should be missing here"


def test_the_tutorial_runs_line_by_line_from_the_wheel_with_all_extras(built: Path, tmp_path: Path) -> None:
    """pip resolves every extra to what the locks hold, without an index; then each line of the tutorial."""
    groups = asked_for()
    packages = set().union(*(closure(names, locked()) for names in groups.values()))
    programs = environment(tmp_path / "environment", packages)
    extras = ",".join(group for group in groups if group != "base")
    wheel = f"fomas_verify[{extras}] @ {only(built, '*.whl').as_uri()}"
    done = subprocess.run(
        [programs / "python", "-m", "pip", "install", "--no-index", "--disable-pip-version-check", wheel],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "empty"
    folder.mkdir()
    follow((ROOT / "docs" / "tutorial.md").read_text("utf-8"), folder, programs)


def test_the_bill_is_written_beside_the_wheel(built: Path, tmp_path: Path) -> None:
    wheel = Path(shutil.copy(only(built, "*.whl"), tmp_path))
    subprocess.run([sys.executable, "-m", "tools.sbom", str(wheel)], cwd=ROOT, check=True, capture_output=True)
    assert json.loads(only(tmp_path, "*.cdx.json").read_text("utf-8")) == bill(wheel)


def test_the_bill_of_materials(built: Path) -> None:
    """What CycloneDX 1.6 requires of a file, of components and of dependencies, and what the locks say."""
    wheel = only(built, "*.whl")
    found = bill(wheel)
    assert json.dumps(found) == json.dumps(bill(wheel))
    assert (found["bomFormat"], found["specVersion"], found["version"]) == ("CycloneDX", "1.6", 1)
    assert re.fullmatch(
        r"urn:uuid:[0-9a-f]{8}-[0-9a-f]{4}-5[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}", found["serialNumber"]
    )
    own = found["metadata"]["component"]
    assert own["hashes"] == [{"alg": "SHA-256", "content": digest(wheel)}]
    with zipfile.ZipFile(wheel) as archive:
        metadata = archive.read(next(x for x in archive.namelist() if x.endswith("/METADATA"))).decode()
    assert f"\nName: {own['name']}\nVersion: {own['version']}\n" in metadata
    assert all({"type", "name", "bom-ref"} <= set(x) and x["type"] == "library" for x in [own, *found["components"]])
    assert all(x["scope"] in ("required", "optional") for x in found["components"])
    assert {x["name"] for x in found["components"] if x["scope"] == "required"} == {"click", "mpmath", "python-flint"}
    assert all(is_compatible(x["licenses"][0]["expression"]) for x in found["components"])
    references = [own["bom-ref"], *(x["bom-ref"] for x in found["components"])]
    assert len(references) == len(set(references))
    assert sorted(x["ref"] for x in found["dependencies"]) == sorted(references)
    for entry in found["dependencies"]:
        assert set(entry["dependsOn"]) < set(references)
        assert len(entry["dependsOn"]) == len(set(entry["dependsOn"]))
    asked = re.findall(r"^Requires-Dist: ([\w.-]+)[^;\n]*(?:; extra == '(?!dev')[^\n]*)?$", metadata, re.MULTILINE)
    assert set(asked) <= {x["name"] for x in found["components"]}
    versions = {(pin.name, pin.version) for several in locked().values() for pin in several}
    assert {(x["name"], x["version"]) for x in found["components"]} <= versions
