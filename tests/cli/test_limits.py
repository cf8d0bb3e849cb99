"""``--time-limit`` and ``--memory``: they end a run with status 3 and nothing written, and change nothing otherwise."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from subprocess import CompletedProcess

import click
import pytest

from fomas_verify.cli.limits import Limits, _bytes

Verify = Callable[..., CompletedProcess[str]]
PAPER = "examples/paper.toml"
ENDLESS = ("prove", PAPER, "--horizon", 10**7)
SLOW = 'name = "{}"\nalpha = 0.9\nmu = 0.1\nhorizon = 10000000\n[graph]\nfamily = "cycle"\nagents = 4\n'
QUICK = 'name = "{}"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 4\n'
TIME = "verify-design: kept within --time-limit {}: this run needs longer; it is ended, and nothing is written\n"
MEMORY = "verify-design: kept within --memory {}: this run needs more; it is ended, and nothing is written\n"

INTERRUPTIBLE = """import signal
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job starts with it ignored
from fomas_verify._entry import main
main()
"""


def designs(folder: Path, **texts: str) -> Path:
    folder.mkdir()
    for name, text in texts.items():
        (folder / f"{name}.design.toml").write_text(text.format(name))
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    return {str(x.relative_to(folder)): x.read_bytes() if x.is_file() else b"" for x in folder.rglob("*")}


def test_the_time_limit_ends_a_run_and_nothing_is_written(verify: Verify, tmp_path: Path) -> None:
    (tmp_path / "certificate.json").write_text("former")
    (tmp_path / "tmp").mkdir()
    before = contents(tmp_path)
    run = verify(*ENDLESS, "--time-limit", 1, "-o", tmp_path / "certificate.json", TMPDIR=str(tmp_path / "tmp"))
    assert (run.returncode, run.stdout, run.stderr) == (3, "", TIME.format(1))
    assert contents(tmp_path) == before


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_gate_is_ended_with_all_its_processes_and_reports(verify: Verify, tmp_path: Path, jobs: int) -> None:
    """The first design passes long before: its certificate, its line and a report of it must not be there."""
    folder = designs(tmp_path / "designs", a=QUICK, b=SLOW, c=SLOW)
    (tmp_path / "former.xml").write_text("former")
    before = contents(tmp_path)
    files = [x for name in ("junit", "sarif", "markdown") for x in (f"--{name}", tmp_path / f"new.{name}")]
    files += ["--junit", tmp_path / "former.xml", "-o", tmp_path / "deep" / "out", "--cache", tmp_path / "cache"]
    run = verify("gate", folder, "--jobs", jobs, "--time-limit", 3, *files)
    assert (run.returncode, run.stdout, run.stderr) == (3, "", TIME.format(3))
    assert contents(tmp_path) == before


def test_the_gate_within_its_limits_writes_what_it_writes_without(verify: Verify, tmp_path: Path) -> None:
    folder = designs(tmp_path / "designs", a=QUICK, b=QUICK)
    runs = {}
    for name, options in {"free": (), "limited": ("--time-limit", 300, "--memory", "4G")}.items():
        out = tmp_path / name
        call = ("gate", folder, "--jobs", 2, "-o", out / "certificates", "--junit", tmp_path / f"{name}.xml")
        run = verify(*call, *options)
        assert sorted(contents(out)) == ["certificates", "certificates/a.json", "certificates/b.json"]
        assert "<testsuite" in (tmp_path / f"{name}.xml").read_text()
        runs[name] = (run.returncode, run.stdout, run.stderr, contents(out))
    assert runs["free"] == runs["limited"]
    assert runs["free"][0] == 0


def test_more_files_than_may_be_open_by_default(checkout: Path, tmp_path: Path) -> None:
    folder = designs(tmp_path / "designs", **{f"d{i}": QUICK for i in range(60)})
    few = INTERRUPTIBLE.replace("main()", "import resource as r; limit = r.RLIMIT_NOFILE\n") + (
        "r.setrlimit(limit, (50, r.getrlimit(limit)[1]))\nmain()\n"
    )
    call = ["gate", str(folder), "--jobs", "1", "--quiet", "-o", str(tmp_path / "out"), "--time-limit", "900"]
    run = subprocess.run(
        [sys.executable, "-c", few, *call], cwd=checkout, capture_output=True, text=True, check=False
    )  # fmt: skip
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    assert len(contents(tmp_path / "out")) == 60


CALLS = {
    "a refutation": ("prove", PAPER, "--json"),
    "not proved": ("prove", "{tmp}/ring.toml"),
    "wrong input": ("prove", "{tmp}/none.toml"),
    "a wrong call": ("prove", PAPER, "--horizon", "-1"),
    "region": ("region", PAPER, "--json"),
    "kernel": ("kernel", PAPER, "--terms", "5"),
    "written to standard output": ("prove", PAPER, "-o", "/dev/stdout"),
}


@pytest.mark.parametrize("name", CALLS)
def test_within_the_limits_nothing_is_different(verify: Verify, tmp_path: Path, name: str) -> None:
    (tmp_path / "ring.toml").write_text(QUICK.replace("0.2", "2").format("ring"))
    call = [part.format(tmp=tmp_path) for part in CALLS[name]]
    free, limited = verify(*call), verify(*call, "--time-limit", 300, "--memory", "4G")
    assert (limited.returncode, limited.stdout, limited.stderr) == (free.returncode, free.stdout, free.stderr)


def test_files_within_the_limits(verify: Verify, tmp_path: Path) -> None:
    certificate, loop = tmp_path / "certificate.json", tmp_path / "loop.csv"
    assert verify("prove", PAPER, "-o", certificate, "--time-limit", 300).returncode == 0
    check = verify("check", certificate, "--design", PAPER, "--require", "design", "--time-limit", 99, "--memory", "1G")
    assert check.returncode == 0
    assert verify("simulate", PAPER, "--samples", 3, "--csv", loop, "--memory", "3G").returncode == 0
    assert len(loop.read_text().splitlines()) == 1 + 2 * 4
    assert sorted(contents(tmp_path)) == ["certificate.json", "loop.csv"]


STARVED = {
    "Python": ("prove", PAPER, "40M"),
    "flint, which aborts": ("kernel", PAPER, "--terms", 8_000, "--digits", 2_000, "100M"),
    "numpy": ("simulate", PAPER, "--samples", 10**6, "--csv", "{tmp}/loop.csv", "600M"),
    "a library that cannot be loaded": ("simulate", PAPER, "--csv", "{tmp}/loop.csv", "100M"),
    "a solver": ("region", PAPER, "--solver", "lmi", "-o", "{tmp}/region.json", "300M"),
    "the gate in one process": ("gate", "examples", "--jobs", 1, "--junit", "{tmp}/x.xml", "-o", "{tmp}/out", "60M"),
    "the gate in others": ("gate", "examples", "--jobs", 2, "--junit", "{tmp}/x.xml", "-o", "{tmp}/out", "150M"),
}


@pytest.mark.parametrize("name", STARVED)
def test_memory_ends_a_run_and_nothing_is_written(verify: Verify, tmp_path: Path, name: str) -> None:
    *call, size = STARVED[name]
    run = verify(*(str(part).format(tmp=tmp_path) for part in call), "--memory", size)
    assert (run.returncode, run.stdout, run.stderr) == (3, "", MEMORY.format(size))
    assert contents(tmp_path) == {}


def test_an_extra_that_does_not_fit_is_not_said_to_be_missing(verify: Verify, tmp_path: Path) -> None:
    run = verify("simulate", PAPER, "--memory", "100M", FOMAS_VERIFY_TRACEBACK="1")
    assert "pip install" not in run.stderr


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("--time-limit", x) for x in ("0", "-1", "0.0", "abc", "nan", "inf", "", "1e3", "1/2", "1 s", "٣")
    ] + [
        ("--memory", x)
        for x in ("0", "-1", "0G", "abc", "nan", "inf", "", "1e9", "4X", "G", "1/2", "4 G", "9999999T", "0.1B")
    ],
)  # fmt: skip
def test_what_is_no_limit(verify: Verify, tmp_path: Path, option: str, value: str) -> None:
    run = verify("prove", PAPER, "-o", tmp_path / "c.json", f"{option}={value}")
    assert (run.returncode, run.stdout) == (2, "")
    assert f"'{option}': expected " in run.stderr
    assert len(run.stderr.splitlines()) == 1
    assert contents(tmp_path) == {}


@pytest.mark.parametrize(
    ("text", "size", "shown"),
    [
        ("4G", 4 << 30, "4G"), ("1.5k", 1536, "1536"), ("7", 7, "7"), ("2GiB", 2 << 30, "2G"),
        ("512mb", 512 << 20, "512M"), ("1024M", 1 << 30, "1G"), ("3T", 3 << 40, "3T"), ("12B", 12, "12"),
    ],
)  # fmt: skip
def test_sizes(text: str, size: int, shown: str) -> None:
    context = click.Context(click.Command("x"))
    assert _bytes(context, click.Option(["--memory"]), text) == size
    assert Limits(None, size).memory_option == f"--memory {shown}"


@pytest.fixture
def started(checkout: Path, tmp_path: Path) -> Iterator[tuple[subprocess.Popen[str], int]]:
    """A run under a limit that has far to go, and the process that does its work."""
    call = [sys.executable, "-c", INTERRUPTIBLE, *map(str, ENDLESS), "--time-limit", "600"]
    with subprocess.Popen(
        call, cwd=checkout, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**os.environ, "TMPDIR": str(tmp_path)},
    ) as run:  # fmt: skip
        try:
            children = Path(f"/proc/{run.pid}/task/{run.pid}/children")
            while not (found := children.read_text().split()):
                time.sleep(0.01)
            child = int(found[0])
            while os.getpgid(child) != child:
                time.sleep(0.01)
            yield run, child
        finally:
            run.kill()


def wait_until_gone(process: int) -> None:
    while Path(f"/proc/{process}/stat").exists():
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
        if state == "Z":  # ended; whoever takes on orphans has not looked yet
            return
        time.sleep(0.05)


# The processes that a run leaves behind have other parents; only /proc lists them all.
needs_proc = pytest.mark.skipif(
    not Path("/proc/self/task").exists(), reason="what is left of a run is looked for in /proc, which macOS has not"
)


@needs_proc
@pytest.mark.parametrize(("sent", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interruption_ends_all(
    started: tuple[subprocess.Popen[str], int], tmp_path: Path, sent: signal.Signals, status: int
) -> None:
    run, child = started
    run.send_signal(sent)
    out, err = run.communicate()
    assert (run.returncode, out, err.strip()) == (status, "", "")
    wait_until_gone(child)
    assert contents(tmp_path) == {}


@needs_proc
def test_the_run_ends_with_the_process_that_watches_over_it(started: tuple[subprocess.Popen[str], int]) -> None:
    run, child = started
    run.kill()
    run.wait()
    wait_until_gone(child)


@needs_proc
@pytest.mark.parametrize("sent", [signal.SIGABRT, signal.SIGKILL, signal.SIGSEGV])
def test_an_end_from_outside_without_a_limit_of_memory_is_no_answer(
    started: tuple[subprocess.Popen[str], int], sent: signal.Signals
) -> None:
    run, child = started
    os.kill(child, sent)
    out, err = run.communicate()
    assert (run.returncode, out) == (4, "")
    assert "internal error: the process of this run was ended from outside" in err.splitlines()[-1]


def test_without_limits_no_process_watches(checkout: Path) -> None:
    code = (
        "import sys; from fomas_verify.cli import main; "
        f"main(['kernel', {PAPER!r}]); sys.exit('fomas_verify.cli.supervision' in sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=checkout, stdout=subprocess.DEVNULL, check=False)
    assert run.returncode == 0


@pytest.mark.parametrize("fresh", [False, True])
def test_processes_share_the_memory(checkout: Path, fresh: bool) -> None:
    """Two processes and the one that started them have a third each."""
    code = (
        "import resource\n"
        "from fomas_verify.exact.memory import allow_memory\n"
        "from fomas_verify.prover.processes import processes\n"
        "if __name__ == '__main__':\n"
        "    allow_memory(6 << 30)\n"
        f"    with processes(2, fresh={fresh}) as pool:\n"
        "        print(pool.submit(resource.getrlimit, resource.RLIMIT_AS).result()[0])\n"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=checkout, capture_output=True, text=True, check=True)
    assert int(run.stdout) == 2 << 30


def test_a_sweep_keeps_its_rows_and_goes_on(verify: Verify, checkout: Path, tmp_path: Path) -> None:
    """Half a second a design, so that no machine ends the 25 of them within the limit."""
    grid, text = tmp_path / "grid.toml", (checkout / "examples/sweeps/grid.toml").read_text()
    grid.write_text("horizon = 500000\n" + text.replace("steps = 11", "steps = 5").replace("steps = 9", "steps = 5"))
    call = ("sweep", grid, "-o", tmp_path / "rows", "--jobs", 1, "--part-rows", 4, "--time-limit")
    first = verify(*call, 2)
    assert (first.returncode, first.stdout) == (3, "")
    assert "what is written stays, and the same call goes on" in first.stderr.splitlines()[-1]
    there = contents(tmp_path / "rows")
    assert not [name for name in there if name.endswith(".tmp")]
    second = verify(*call, 300)
    assert (second.returncode, second.stderr) == (0, "")
    assert second.stdout.startswith("25 designs over gamma, h\n")
    assert {name: data for name, data in contents(tmp_path / "rows").items() if name in there} == there
