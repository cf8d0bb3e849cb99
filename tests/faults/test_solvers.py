"""A solver that answers nonsense, or not at all: what is proved and written stays true, and the checker accepts it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from .commands import NEW, found, lay, run
from .processes import told

pytestmark = pytest.mark.slow
SPOILT = """
import sys
import cvxpy
import numpy as np

kind, sys.argv = sys.argv[1], ["verify-design", *sys.argv[2:]]
honest, asked = cvxpy.Problem.solve, []
random = np.random.default_rng(1)


def spoil(value):
    if value is None:
        return None
    shape = np.shape(value)
    return {
        "NaN": np.full(shape, np.nan),
        "zero": np.zeros(shape),
        "huge": np.full(shape, 1e300),
        "a little off": np.asarray(value, float) * (1 + 1e-3 * random.normal(size=shape)),
    }[kind]


def solve(self, *arguments, **options):
    asked.append(kind)
    if kind == "nothing":
        return None
    if kind == "raises":
        raise RuntimeError("the solver\\nfell over")
    honest(self, *arguments, **options)
    for leaf in (*self.variables(), *(dual for c in self.constraints for dual in c.dual_variables)):
        leaf._value = spoil(leaf._value)
    self._status = "optimal"
    return None


cvxpy.Problem.solve = solve
from fomas_verify.cli import main
status = int(main())
assert asked, "the solver was never asked"
sys.exit(status)
"""
BOTH = b"""alpha = 0.9
mu = "13/20"
[[graphs]]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
[[graphs]]
family = "directed-cycle"
agents = 5
"""
KINDS = ["NaN", "zero", "huge", "a little off", "nothing", "raises"]


def spoilt(kind: str, words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return told([sys.executable, "-c", SPOILT, kind, *words.split()], folder)


def must_be_true(folder: Path) -> None:
    """The checker accepts each certificate, in a process where nothing is spoilt."""
    for name in found(folder):
        if name.endswith(".json"):
            checked = run(("check", name), folder)
            assert checked.returncode == 0, checked.stdout + checked.stderr


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("words", ["region plant.toml --solver lmi -o out.json", "synthesize plant.toml -o best"])
def test_a_second_opinion_changes_nothing(words: str, kind: str, room: Path) -> None:
    """Nonsense is set aside; an answer that is sound and another twice would be an internal error, status 4."""
    direct = words.replace("--solver lmi ", "").replace("plant.toml -o best", "plant.toml --direct -o best")
    lay(NEW, room)
    lay(NEW, room / "direct")
    assert run(tuple(direct.split()), room / "direct").returncode == 0
    ended = spoilt(kind, words, room)
    assert "Traceback" not in ended.stderr
    assert ended.returncode == 0, ended.stderr
    written = found(room / "direct")
    assert {name: data for name, data in found(room).items() if not name.startswith("direct/")} == written


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "words",
    ["synthesize plant.toml --weights --direct -o best", "prove both.toml -o out.json", "region both.toml -o out.json"],
)
def test_what_rests_on_a_solver_is_true_or_undecided(words: str, kind: str, room: Path) -> None:
    lay({**NEW, "both.toml": BOTH}, room)
    ended = spoilt(kind, words, room)
    assert "Traceback" not in ended.stderr
    assert ended.returncode in (0, 1, 3), ended.stderr
    must_be_true(room)
