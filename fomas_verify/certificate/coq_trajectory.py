"""The steps of a design's Coq file on trajectory-norm-bound: the samples of one vector, ``v = L x_0``.

Source: proofs/Design/Trajectory.v.
"""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from fomas_verify.certificate.coq_chapter import BALANCED, Chapter, Step, about_loops, mu_range, vector
from fomas_verify.certificate.coq_factor import identity
from fomas_verify.certificate.coq_samples import (
    MOST_NUMBERS,
    SCALE,
    Cell,
    Run,
    bounded,
    definition,
    kernel,
    listed,
    listed_cells,
)
from fomas_verify.claims.verdict import Verdict

CLAIM = "trajectory-norm-bound"
MOST_BITS = 4096
"""Of a number of x_0 over its common denominator."""

RUN = "x0_scale x0_power_numbers x0_resolvent_numbers"


def trajectory_norm(chapter: Chapter) -> list[Step]:
    """From the bound for every x_0 where that is proved; else by the samples of this one, up to where they exceed 1."""
    components = chapter.loop.design.components or ()
    if len(components) != 1 or "graph_assumption" not in chapter.known:
        return []
    (x0,) = components
    state, unit = _state(x0)
    if max(x.bit_length() for x in (*state, unit)) > MOST_BITS:
        return []
    if "norm_bound" in chapter.known and chapter.decided(CLAIM, Verdict.PROVED):
        return [_from_every_state(chapter, x0)]
    witness = chapter.decisions[CLAIM].witness
    if "samples" in witness:
        return _within(chapter, x0, witness["samples"], witness["powers"])
    return _exceeded(chapter, x0, witness["k"]) if "k" in witness else []


def _state(x0: tuple[Fraction, ...]) -> tuple[list[int], int]:
    unit = lcm(*(x.denominator for x in x0))
    return [int(x * unit) for x in x0], unit


def _statement(x0: tuple[Fraction, ...]) -> str:
    state, unit = _state(x0)
    return f"trajectory_norm_bound agents graph alpha gamma h {vector(state)} {unit}"


def _start(chapter: Chapter, x0: tuple[Fraction, ...]) -> list[int]:
    state, _ = _state(x0)
    return [sum(x * y for x, y in zip(row, state, strict=True)) for row in chapter.figures.laplacian]


def _from_every_state(chapter: Chapter, x0: tuple[Fraction, ...]) -> Step:
    statement, given, bound = _statement(x0), "", "norm_bound"
    if chapter.numbers.gamma is None:
        given, bound = "intros gamma h range given. ", "(norm_bound gamma h range given)"
        statement = f"forall gamma h, design alpha gamma h -> mu_of alpha gamma h = mu ->\n    {statement}"
    return Step(
        "trajectory", statement, f"{given}exact (norm_bound_trajectory _ _ _ _ _ _ _ {bound}).", CLAIM, "proved"
    )


def _within(chapter: Chapter, x0: tuple[Fraction, ...], last: int, powers: int) -> list[Step]:
    n, start = len(chapter.figures.laplacian), _start(chapter, x0)
    if n * (2 * last + powers + 2 + n * (powers + 1)) > MOST_NUMBERS:
        return []
    run = Run(chapter, last + powers + 2)
    r = run.resolvent(last)
    phi, along = run.cells(start, r, last), run.cells(start, [], last + powers)
    p = [run.cells(unit, [], powers) for unit in identity(n)]
    ratio = SCALE * run.c(last + 1 + powers)[0] // run.c(last + 1)[1]
    carried = bounded([cells[powers] for cells in p], ratio)
    size = sum(x * x for x in start)
    limits = [(phi[k], SCALE) for k in range(1, last + 1)]
    limits += [(along[k], run.c(k)[0]) for k in range(last + 1, last + powers + 1)]
    if carried is None or not all(_size(cell) <= limit**2 * size for cell, limit in limits):
        return []
    proof = (
        f"refine (trajectory_sound agents weights denominator positive {mu_range(chapter)} {RUN} {vector(start)}\n"
        f"    x0_phi_cells x0_along_cells x0_power_cells {last} {powers} x0_last_bound {ratio} alpha mu {BALANCED} _\n"
        "    mu_bounds x0_powers_enclosed ltac:(check)). unfold alpha. lra."
    )
    image = "Phi alpha agents (perron agents graph mu) k (vector x0_start)"
    return [
        *kernel(chapter, run, r, "x0_"),
        definition("x0_start : list Z", vector(start)),
        definition("x0_phi_cells : list cell", listed_cells(phi)),
        definition("x0_along_cells : list cell", listed_cells(along)),
        definition("x0_power_cells : list (list cell)", listed(map(listed_cells, p))),
        definition("x0_last_bound : bound", f"({carried.text})%Z"),
        Step("x0_bounded", f"forall k, norm agents ({image}) <= norm agents (vector x0_start)", proof),
        about_loops(chapter, "trajectory", _statement(x0), _use("from_phi", x0), "x0_bounded", CLAIM),
    ]


def _exceeded(chapter: Chapter, x0: tuple[Fraction, ...], k: int) -> list[Step]:
    start = _start(chapter, x0)
    if len(start) * k > MOST_NUMBERS or k * k > MOST_NUMBERS:
        return []
    run = Run(chapter, k + 1)
    r = run.resolvent(k)
    cells = run.cells(start, r, k)
    if sum(max(0, abs(x) - cells[k].error) ** 2 for x in cells[k].centre) <= SCALE**2 * sum(x * x for x in start):
        return []
    proof = (
        f"refine (sample_exceeds agents weights denominator {mu_range(chapter)} x0_scale alpha mu x0_power_numbers\n"
        f"    x0_resolvent_numbers x0_start x0_cells {k} positive ltac:(check) mu_bounds _ x0_powers_enclosed\n"
        "    ltac:(check) ltac:(check) ltac:(check)). unfold alpha. lra."
    )
    image = f"Phi alpha agents (perron agents graph mu) {k} (vector x0_start)"
    return [
        *kernel(chapter, run, r, "x0_"),
        definition("x0_start : list Z", vector(start)),
        definition("x0_cells : list cell", listed_cells(cells)),
        Step("x0_exceeds", f"norm agents (vector x0_start) < norm agents ({image})", proof),
        about_loops(
            chapter, "trajectory", f"~ {_statement(x0)}", _use("false", x0, f" {k}"), "x0_exceeds", CLAIM, "refuted"
        ),
    ]


def _size(cell: Cell) -> int:
    return sum((abs(x) + cell.error) ** 2 for x in cell.centre)


def _use(lemma: str, x0: tuple[Fraction, ...], last: str = "") -> str:
    state, unit = _state(x0)
    return (
        f"refine (trajectory_{lemma} agents weights denominator positive alpha gamma h\n"
        f"    {vector(state)} x0_start {unit}{last}\n"
        "    range ltac:(lia) ltac:(check) _)."
    )
