"""The commands that write files, over a folder that holds what a former run wrote.

`OLD` and `NEW` are the same files with other numbers, so that every output of the second run differs from the first's.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
START = [sys.executable, "-m", "fomas_verify"]
Files = dict[str, bytes]

PLANT = """name = "plant"
alpha = {alpha}
gamma = {gamma}
h = 0.85
x0 = [4.5, 5, 6, 1.5, -1]
settle_to = "1/100"
[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
[gate]
require = ["average-consensus"]
[limits]
h = [0.1, {longest}]
u_max = 3
settle_within = 60
"""
GRID = 'mu = {mu}\n[graph]\nfamily = "complete"\nagents = 3\n[grid]\nalpha = {{from = 0.5, to = 0.9, steps = 24}}\n'


def _inputs(alpha: str, gamma: str, longest: str, mu: str) -> Files:
    plant = PLANT.format(alpha=alpha, gamma=gamma, longest=longest)
    texts = {
        "plant.toml": plant,
        "designs/a.design.toml": plant,
        "designs/b.design.toml": f'alpha = 0.8\nmu = {mu}\n[graph]\nfamily = "complete"\nagents = 4\n',
        "grid.toml": GRID.format(mu=mu),
    }
    return {name: text.encode() for name, text in texts.items()}


OLD = _inputs("0.88", "0.16", "2.5", "0.25")
NEW = _inputs("0.9", "0.15", "2", "0.2")


@dataclass(frozen=True)
class Command:
    """A call that writes files; `weight`: how often it is chosen among the others."""

    arguments: tuple[str, ...]
    weight: int = 1
    over_old: bool = True

    @property
    def name(self) -> str:
        """Its words."""
        return " ".join(self.arguments)


def _command(words: str, weight: int, *, over_old: bool = True) -> Command:
    return Command(tuple(words.split()), weight, over_old)


COMMANDS = [
    _command("prove plant.toml -o plant.json", 8),
    _command("prove plant.toml --coq coq", 2),
    _command("kernel plant.toml --csv kernel.csv", 4),
    _command("gate designs --junit gate.xml --sarif gate.sarif --markdown gate.md --cache cache -o kept -j 1", 8),
    _command("region plant.toml -o region.json", 6),
    _command("region plant.toml --plot region.svg", 2),
    # A design that stands there is never replaced, nor the rows of another sweep: these two begin without outputs.
    _command("synthesize plant.toml --objective gentlest --direct -o best", 4, over_old=False),
    _command("simulate plant.toml --samples 2000 --csv samples.csv", 5),
    _command("simulate plant.toml --plot figures", 2),
    _command("sweep grid.toml -o rows --part-rows 4 -j 1", 2, over_old=False),
    _command("report plant.toml -o report", 1),
]


def environment(**changed: str) -> dict[str, str]:
    """Of this source tree, whatever is installed, with one thread a library."""
    kept = {**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return kept | changed


def call(arguments: tuple[str, ...]) -> list[str]:
    """The command line that runs them."""
    return [*START, *arguments]


def run(arguments: tuple[str, ...], folder: Path, **changed: str) -> subprocess.CompletedProcess[bytes]:
    """Run to the end in a folder."""
    return subprocess.run(
        call(arguments),
        cwd=folder,
        env=environment(**changed),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        check=False,
    )


def lay(files: Mapping[str, bytes], folder: Path) -> None:
    """Write files under a folder."""
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)


def found(folder: Path) -> Files:
    """Every file under a folder."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()
    }
