"""The geometric program agrees with the direct search; and an answer that is nonsense changes nothing but a line."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from fomas_verify.checker import check
from fomas_verify.cli.app import main
from fomas_verify.region import program
from fomas_verify.region.program import MOST_STEPS, NoAnswerError, opinion
from fomas_verify.region.task import Objective
from fomas_verify.region.tradeoff import Piece

# log m in [-2, -1], gamma in [e^-3, 1], h in [e^-1, e^2], alpha = 1/2
PIECE = Piece(3, 3, 0.5, -2.0, -1.0, (-3.0, 0.0), (-1.0, 2.0))
BEST = {  # corners of the polyhedron by hand
    Objective.SLOWEST: (-3.0, 2.0),  # any gamma of [-3, -2] has h = e^2
    Objective.GENTLEST: (-3.0, 2.0),
    Objective.FASTEST: (-1.0, -1.0),  # any gamma of [-3/2, -1/2]
    Objective.ROBUST: (-1.75, 0.5),  # any in the middle of the strip, 1/3 from the other sides
}


@pytest.mark.parametrize("objective", Objective)
def test_the_solver_agrees(objective: Objective) -> None:
    assert opinion(PIECE, objective).agrees


@pytest.mark.parametrize("objective", Objective)
def test_the_right_point_agrees_and_one_beside_it_does_not(objective: Objective) -> None:
    g, y = BEST[objective]
    assert opinion(PIECE, objective, lambda *_: (g, y)).agrees
    moved = (g, y + 1e-3) if objective in (Objective.FASTEST, Objective.ROBUST) else (g + 1e-3, y - 1e-3)
    assert not opinion(PIECE, objective, lambda *_: moved).agrees


def raises(*_: object) -> tuple[float, float]:
    raise NoAnswerError("the solver says user_limit")


NONSENSE: list[tuple[Callable[..., tuple[float, float]], str]] = [
    (lambda *_: (math.nan, 0.0), "it is not a number"),
    (lambda *_: (0.0, math.inf), "it is not a number"),
    (lambda *_: (5.0, 5.0), "it violates a constraint"),
    (lambda *_: (-2.0, -1.0 - 1e-4), "it violates a constraint"),
    (lambda *_: (-1.2, 0.0), "it is not the best point"),
    (raises, "the solver says user_limit"),
]


@pytest.mark.parametrize(("solver", "reason"), NONSENSE)
def test_nonsense_is_set_aside(solver: Callable[..., tuple[float, float]], reason: str) -> None:
    found = opinion(PIECE, Objective.FASTEST, solver)
    assert not found.agrees
    assert reason in found.reason


def test_a_solver_that_stalls_or_finds_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(program, "MOST_STEPS", 1)
    assert MOST_STEPS > 1
    assert "the solver" in opinion(PIECE, Objective.ROBUST).reason
    impossible = Piece(1, 1, 0.5, 3.0, 4.0, (-3.0, 0.0), (-1.0, 2.0))
    monkeypatch.undo()
    assert "infeasible" in opinion(impossible, Objective.SLOWEST).reason


DESIGN = """alpha = 0.9
[graph]
adjacency = [[0,0,0,1,1], [1,0,1,0,0], [1,1,0,0,0], [0,1,1,0,0], [0,0,0,1,0]]
[limits]
h = [0.85, 0.85]
"""


@pytest.mark.parametrize(("solver", "reason"), [*NONSENSE[::2], NONSENSE[-1]])
def test_nonsense_never_reaches_a_certificate(
    solver: Callable[..., tuple[float, float]],
    reason: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The files are those of the direct search, to the byte, and the checker accepts them."""
    design = tmp_path / "plant.toml"
    design.write_text(DESIGN)
    call = ["synthesize", str(design), "--objective", "gentlest", "-o"]
    assert main([*call, str(tmp_path / "direct.toml"), "--direct"]) == 0
    monkeypatch.setattr(program, "geometric_program", solver)
    assert main([*call, str(tmp_path / "asked.toml")]) == 0
    assert "was set aside (" in capsys.readouterr().out
    for ending in ("toml", "json"):
        assert (tmp_path / f"asked.{ending}").read_bytes() == (tmp_path / f"direct.{ending}").read_bytes()
    assert check((tmp_path / "asked.json").read_bytes()).exit_status == 0


def test_a_point_of_the_search_that_is_false_is_never_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where the search proposes what lies outside, no rounding of it is proved: undecided, and no file."""
    from fomas_verify.region import rounding

    design = tmp_path / "plant.toml"
    design.write_text(DESIGN)
    outside = rounding.Fraction(17, 100), rounding.Fraction(85, 100)
    monkeypatch.setattr(rounding, "_candidates", lambda *_: iter([outside]))
    assert main(["synthesize", str(design), "--direct", "-o", str(tmp_path / "found.toml")]) == 3
    assert "neither a design within the limits nor the proof that there is none" in capsys.readouterr().err
    assert [x.name for x in tmp_path.iterdir()] == ["plant.toml"]


def test_without_the_extra_the_direct_search_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    design = tmp_path / "plant.toml"
    design.write_text(DESIGN)
    monkeypatch.setattr(program, "find_spec", lambda name: None)
    assert main(["synthesize", str(design), "--objective", "gentlest"]) == 0
    printed = capsys.readouterr().out
    assert "gamma = 0.1746, h = 0.85" in printed
    assert "geometric program" not in printed


@pytest.mark.parametrize("far", [(800.0, 900.0), (-900.0, -800.0)])
def test_a_limit_beyond_doubles_has_no_answer(far: tuple[float, float]) -> None:
    found = opinion(Piece(3, 3, 0.5, -2.0, -1.0, (-math.inf, math.inf), far), Objective.GENTLEST)
    assert (found.agrees, found.reason) == (False, "a limit is beyond doubles")
