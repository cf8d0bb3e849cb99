"""A library that is not installed: the command that needs it names the extra; the others do the same as ever."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from .commands import NEW, found, lay
from .processes import told

pytestmark = pytest.mark.slow
WITHOUT = (
    "import sys; sys.modules.update(dict.fromkeys(sys.argv.pop(1).split(',')));"
    "from fomas_verify._entry import main; sys.argv[0] = 'verify-design'; main()"
)
EXTRAS = {
    "report": ("jinja2", "latex2mathml", "sympy"),
    "region": ("cvxpy", "clarabel", "numpy", "scipy"),
    "simulate": ("numpy", "scipy"),
    "plot": ("matplotlib",),
    "graphs": ("defusedxml", "networkx", "numpy", "scipy"),
    "sweep": ("dask", "distributed", "pyarrow", "rich"),
    "scale": ("numpy", "scipy", "qdldl"),
    "control": ("control",),
}
ALL = ",".join(sorted({module for modules in EXTRAS.values() for module in modules}))
GRAPH = 'alpha = 0.9\nmu = 0.1\n[graph]\nfile = "network.{}"\norientation = "hears"\n'
FILES = {
    **NEW,
    "ml.toml": GRAPH.format("graphml").encode(),
    "mtx.toml": GRAPH.format("mtx").encode(),
    "mat.toml": GRAPH.format("mat").encode(),
    "network.graphml": b"<graphml/>",
    "network.mtx": b"%%MatrixMarket matrix coordinate real general\n2 2 2\n1 2 1\n2 1 1\n",
    "network.mat": b"MATLAB",
    "former/report.tex": b"former",
    "former.csv": b"former",
    "former.svg": b"former",
}
MISSING = [
    ("jinja2", "report plant.toml -o former", "report"),
    ("sympy", "report plant.toml -o former", "report"),
    ("latex2mathml", "report plant.toml -o former --format html", "report"),
    *((name, "region plant.toml --solver lmi", "region") for name in EXTRAS["region"]),
    ("cvxpy", "synthesize plant.toml --weights", "region"),
    ("numpy", "simulate plant.toml --csv former.csv", "simulate"),
    ("scipy", "simulate plant.toml --csv former.csv", "simulate"),
    ("matplotlib", "region plant.toml --plot former.svg", "plot"),
    ("matplotlib", "simulate plant.toml --plot former", "plot"),
    ("matplotlib", "sweep grid.toml -o rows --plot former.svg --x alpha --y alpha --claim gain-bound", "plot"),
    ("pyarrow", "sweep grid.toml -o rows", "sweep"),
    ("distributed", "sweep grid.toml -o rows --scheduler tcp://127.0.0.1:1", "sweep"),
    ("pyarrow", "simulate plant.toml --parquet former.csv", "sweep"),
    ("numpy", "prove mtx.toml", "graphs"),
    ("scipy", "prove mtx.toml", "graphs"),
    ("scipy", "prove mat.toml", "graphs"),
    ("defusedxml", "prove ml.toml", "graphs"),
    ("networkx", "prove ml.toml", "graphs"),
]
ALONE = [
    "prove plant.toml -o out.json",
    "check out.json --design plant.toml",
    "prove plant.toml --coq coq",
    "gate designs -j 1 --junit gate.xml --sarif gate.sarif -o kept",
    "kernel plant.toml --csv kernel.csv",
    "region plant.toml -o region.json",
    "synthesize plant.toml --objective gentlest --direct -o best",
    "init made",
    "schema design",
    "completion zsh",
    "selftest",
]


def without(modules: str, words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return told([sys.executable, "-c", WITHOUT, modules, *words.split()], folder)


@pytest.mark.parametrize(("module", "words", "extra"), MISSING, ids=lambda value: value.split(" -")[0])
def test_a_missing_extra_is_named(module: str, words: str, extra: str, room: Path) -> None:
    lay(FILES, room)
    run = without(module, words, room)
    assert (run.returncode, run.stderr.count("\n")) == (2, 1), run.stderr
    assert f"which the extra `{extra}` brings: pip install 'fomas_verify[{extra}]'" in run.stderr
    left = found(room)
    assert {name: left[name] for name in FILES} == FILES
    assert set(left) - set(FILES) <= {"rows/_lock", "rows/_sweep.json"}


def test_all_else_needs_no_extra(room: Path) -> None:
    """The same output and the same files as where all of them are installed."""
    seen = []
    for modules, name in ((ALL, "alone"), ("antigravity", "full")):
        folder = room / name
        lay(NEW, folder)
        runs = [without(modules, words, folder) for words in ALONE]
        assert [(run.args[-1], run.returncode, run.stderr) for run in runs if run.returncode or run.stderr] == []
        seen.append(([run.stdout for run in runs], found(folder)))
    assert seen[0] == seen[1]


@pytest.mark.parametrize("module", ["flint", "mpmath"])
def test_a_broken_installation_is_no_verdict(module: str, room: Path) -> None:
    lay(NEW, room)
    run = without(module, "selftest" if module == "mpmath" else "prove plant.toml -o out.json", room)
    assert (run.returncode, run.stderr.count("\n")) == (4, 1)
    assert module in run.stderr
    assert found(room) == NEW
