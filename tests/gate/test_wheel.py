"""A wheel built from the tree, in an empty environment with the base dependencies and nothing else."""

import importlib.metadata
import shutil
import subprocess
import sys
import venv
from pathlib import Path

import pytest

BASE = ("click", "mpmath", "python-flint")


def run(*command: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        list(map(str, command)), cwd=cwd, capture_output=True, text=True, check=False, env={"PATH": "/usr/bin:/bin"}
    )


@pytest.fixture(scope="module")
def environment(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment into which pip installed the wheel; the dependencies are this environment's, file by file."""
    folder = tmp_path_factory.mktemp("wheel")
    built = run(Path(sys.executable).parent / "hatchling", "build", "-t", "wheel", "-d", folder, cwd=checkout)
    assert built.returncode == 0, built.stderr
    (wheel,) = folder.glob("*.whl")
    venv.create(folder / "v", with_pip=False)
    (site,) = (folder / "v" / "lib").glob("python3*/site-packages")
    for name in BASE:
        distribution = importlib.metadata.distribution(name)
        for file in distribution.files or []:
            if ".." not in file.parts and "__pycache__" not in file.parts:
                (site / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(Path(str(distribution.locate_file(file))), site / file)
    options = ("--no-index", "--no-deps", "--quiet", "--disable-pip-version-check")
    done = run(
        sys.executable, "-m", "pip", "--python", folder / "v" / "bin" / "python", "install", *options, wheel, cwd=folder
    )
    assert done.returncode == 0, done.stderr
    return folder / "v" / "bin"


def test_the_gate_passes_on_the_examples(environment: Path, checkout: Path, tmp_path: Path) -> None:
    shutil.copytree(checkout / "examples", tmp_path / "examples")
    files = [x for kind in ("junit", "sarif", "markdown") for x in (f"--{kind}", kind)]
    done = run(environment / "verify-design", "gate", "examples", "--jobs", 2, *files, cwd=tmp_path)
    count = len(list((tmp_path / "examples").glob("*.toml")))
    assert (done.returncode, done.stderr) == (0, "")
    assert f"{count} designs: {count} pass" in done.stdout.splitlines()
    assert all((tmp_path / kind).stat().st_size for kind in files[1::2])


def test_init_and_schema_work_from_the_wheel(environment: Path, tmp_path: Path) -> None:
    for arguments in (["init", "."], ["schema", "design"], ["schema", "certificate"], ["gate", "."]):
        done = run(environment / "verify-design", *arguments, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (0, "")


def test_nothing_of_the_checkout_is_used(environment: Path, tmp_path: Path) -> None:
    script = "import fomas_verify as f, importlib.util as u; print(f.__file__); print(u.find_spec('jinja2'))"
    done = run(environment / "python", "-c", script, cwd=tmp_path)
    path, extra = done.stdout.splitlines()
    assert Path(path).is_relative_to(environment.parent)
    assert extra == "None"
