"""Whatever happens below the entry point becomes one line and an exit status, never 1 by accident."""

import os
import shutil
import signal
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

Run = subprocess.CompletedProcess[str]
PREFIX = "verify-design: internal error: "


def start(folder: Path, checkout: Path, command_line: str, **options: object) -> Run:
    """Run the real entry point above a `fomas_verify.cli` that consists of the given source."""
    package = folder / "fomas_verify"
    package.mkdir()
    for name in ("__init__.py", "__main__.py", "_entry.py"):
        shutil.copy(checkout / "fomas_verify" / name, package)
    (package / "cli.py").write_text(command_line)
    options = {"stdout": subprocess.PIPE, "env": {**os.environ, "PYTHONPATH": str(folder)}} | options
    return subprocess.run(
        [sys.executable, "-m", "fomas_verify"], cwd=folder, stderr=subprocess.PIPE, text=True, check=False, **options
    )


@pytest.mark.parametrize(
    ("command_line", "reason"),
    [
        ("import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
        ("from fomas_verify import no_such_name", "ImportError: cannot import name 'no_such_name'"),
        ("def main(:", "SyntaxError: invalid syntax"),
        ("1 / 0", "ZeroDivisionError: division by zero"),
        ("def main(): raise ValueError('two\\nlines')", "ValueError: two lines"),
        ("def main(): main()", "RecursionError: maximum recursion depth exceeded"),
        ("def main(): raise MemoryError", "MemoryError:"),
        ("def main(): return None", "TypeError: int() argument must be"),
        ("main = 3", "TypeError: 'int' object is not callable"),
    ],
)
def test_internal_error_is_one_line_and_status_4(
    tmp_path: Path, checkout: Path, command_line: str, reason: str
) -> None:
    run = start(tmp_path, checkout, command_line)
    assert run.returncode == 4
    assert run.stderr.startswith(PREFIX + reason)
    assert run.stderr.count("\n") == 1
    assert run.stdout == ""


@pytest.mark.parametrize("status", [0, 1, 2, 3, 4])
@pytest.mark.parametrize("source", ["def main(): return {}", "def main(): raise SystemExit({})"])
def test_status_of_the_command_line_is_passed_on(tmp_path: Path, checkout: Path, status: int, source: str) -> None:
    run = start(tmp_path, checkout, source.format(status))
    assert (run.returncode, run.stdout, run.stderr) == (status, "", "")


def test_traceback_only_on_demand(tmp_path: Path, checkout: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "FOMAS_VERIFY_TRACEBACK": "1"}
    run = start(tmp_path, checkout, "import no_such_module", env=environment)
    assert run.returncode == 4
    assert "Traceback (most recent call last)" in run.stderr
    assert run.stderr.splitlines()[-1].startswith(PREFIX)


INTERRUPTED = f"""
import signal

def main():
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job starts with it ignored
    signal.raise_signal({signal.SIGINT.value})
"""


def test_interruption_is_130_and_quiet(tmp_path: Path, checkout: Path) -> None:
    run = start(tmp_path, checkout, INTERRUPTED)
    assert (run.returncode, run.stderr) == (130, "")


def test_a_reader_that_went_away_is_quiet(tmp_path: Path, checkout: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    run = start(tmp_path, checkout, "def main():\n    print('x')\n    return 0", stdout=writer)
    os.close(writer)
    assert (run.returncode, run.stderr) == (141, "")


# macOS has no such device, and a disk that is really full needs root.
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full, as on macOS")
def test_a_full_disk_is_no_success(tmp_path: Path, checkout: Path) -> None:
    with Path("/dev/full").open("w") as full:
        run = start(tmp_path, checkout, "def main():\n    print('x')\n    return 0", stdout=full)
    assert run.returncode == 2
    assert run.stderr == "verify-design: standard output: cannot write: No space left on device\n"


def test_package_costs_no_import_and_knows_its_version(checkout: Path) -> None:
    script = (
        "import sys; before = set(sys.modules); import fomas_verify; print(sorted(set(sys.modules) - before));"
        "print(fomas_verify.__version__)"
    )
    run = subprocess.run([sys.executable, "-I", "-c", script], capture_output=True, text=True, check=True)
    loaded, version = run.stdout.splitlines()
    assert loaded == "['fomas_verify']"
    assert version == tomllib.loads((checkout / "pyproject.toml").read_text())["project"]["version"]


def test_package_has_no_invented_attributes() -> None:
    import fomas_verify

    with pytest.raises(AttributeError, match="no attribute 'no_such_name'"):
        _ = fomas_verify.no_such_name
