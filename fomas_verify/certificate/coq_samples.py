"""The steps of a design's Coq file on control-norm-bound where samples decide it: Phi_k and P^n in fixed point.

A cell is an integer vector and a bound of its error, in units of 1/SCALE. Coq checks each transition and each norm;
the numbers here are computed as it checks them. Source: proofs/Design/Samples.v and Tail.v.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor

from fomas_verify.certificate.coq_chapter import BALANCED, Chapter, Step, about_loops, mu_range, vector
from fomas_verify.certificate.coq_enclosures import table
from fomas_verify.certificate.coq_factor import Factor, Table, factor, identity, stein
from fomas_verify.claims.control_norm_bound import examine
from fomas_verify.claims.verdict import Verdict
from fomas_verify.enclosure.real import power
from fomas_verify.exact.matrix import apply

CLAIM = "control-norm-bound"
BITS = 96
SCALE = 1 << BITS
MOST_NUMBERS = 4000
"""Numbers in the cells of one file."""
Pair = tuple[int, int]


@dataclass(frozen=True)
class Cell:
    """``abs(SCALE y_i - centre_i) <= error`` for every i."""

    centre: list[int]
    error: int


class Run:
    """The kernel and the samples of one loop, in integers."""

    def __init__(self, chapter: Chapter, length: int) -> None:
        """Enclose 1, 2^alpha, ..., length^alpha."""
        self.figures, self.numbers = chapter.figures, chapter.numbers
        exact = [power(Fraction(n), chapter.loop.design.alpha, 2 * BITS) for n in range(1, length + 1)]
        self.powers = [(floor(x.lower * SCALE) - 1, ceil(x.upper * SCALE) + 1) for x in exact]

    def c(self, n: int) -> Pair:
        """c_n."""
        if n == 0:
            return SCALE, SCALE
        (low, high), (less, more) = self.powers[n], self.powers[n - 1]
        return low - more, high - less

    def resolvent(self, last: int) -> list[Pair]:
        """r_0 .. r_last."""
        r = [(SCALE, SCALE)]
        f = [(self.c(i)[0] - self.c(i + 1)[1], self.c(i)[1] - self.c(i + 1)[0]) for i in range(last)]
        for k in range(last):
            low = sum(f[i][0] * r[k - i][0] for i in range(k + 1))
            high = sum(f[i][1] * r[k - i][1] for i in range(k + 1))
            r.append((low // SCALE, -(-high // SCALE)))
        return r

    def cells(self, start: list[int], r: Sequence[Pair], last: int) -> list[Cell]:
        """``Phi_0 start, ...``, or the powers where r is empty."""
        found = [Cell([SCALE * x for x in start], 0)]
        for k in range(last):
            found.append(self._after(start, r[k + 1] if r else (0, 0), found[-1]))
        return found

    def _after(self, start: list[int], r: Pair, cell: Cell) -> Cell:
        low, high, unit, d = self.numbers.low, self.numbers.high, self.numbers.unit, self.figures.denominator
        whole, centre, error = unit * d, [], 0
        for i, row in enumerate(self.figures.laplacian):
            moved = sum(x * y for x, y in zip(row, cell.centre, strict=True))
            exact = whole * (cell.centre[i] + r[0] * start[i]) - low * moved
            near = (2 * exact + whole) // (2 * whole)
            rest = abs(exact - whole * near) + (high - low) * abs(moved)
            rest += (whole + high * sum(map(abs, row))) * cell.error + whole * (r[1] - r[0]) * abs(start[i])
            centre.append(near)
            error = max(error, -(-rest // whole))
        return Cell(centre, error)


@dataclass(frozen=True)
class Bound:
    """The norm of a matrix of cells on 1perp is at most ``most + N^2 error``."""

    error: int
    most: int
    shown: Factor

    @property
    def text(self) -> str:
        """The record of Tail.v."""
        return (
            f"{{| error := {self.error}; most := {self.most}; weight := {self.shown.weight};\n"
            f"  factor := {table(self.shown.rows)[:-2]};\n  times := {self.shown.scale}; eps := {self.shown.eps} |}}"
        )


def bounded(cells: Sequence[Cell], limit: int) -> Bound | None:
    """What shows that the matrix with these columns has at most the norm limit/SCALE on 1perp."""
    n = len(cells)
    error = max(cell.error for cell in cells)
    most = limit - n * n * error
    if most < 0:
        return None
    columns: Table = [list(row) for row in zip(*(cell.centre for cell in cells), strict=True)]
    shown = factor(stein(identity(n), columns, most * most, 1, 0))
    return None if shown is None else Bound(error, most, shown)


def norm_bound_by_samples(chapter: Chapter) -> list[Step]:
    """``norm Phi_k <= 1`` for k <= K, and the powers that carry it on."""
    if not chapter.decided(CLAIM, Verdict.PROVED) or "repaired" in chapter.known:
        return []
    n, tail = len(chapter.figures.laplacian), _tail(chapter)
    if tail is None or n * n * (2 * tail[0] + tail[1] + 2) > MOST_NUMBERS:
        return []
    last, powers = tail
    run = Run(chapter, last + powers + 2)
    starts, r = identity(n), run.resolvent(last)
    phi = [run.cells(start, r, last) for start in starts]
    p = [run.cells(start, [], last + powers) for start in starts]
    ratio = SCALE * run.c(last + 1 + powers)[0] // run.c(last + 1)[1]
    samples = [bounded([cells[k] for cells in phi], SCALE) for k in range(1, last + 1)]
    beyond = [bounded([cells[k] for cells in p], run.c(k)[0]) for k in range(last + 1, last + powers + 1)]
    carried = bounded([cells[powers] for cells in p], ratio)
    shown = [x for x in (*samples, *beyond) if x is not None]
    if carried is None or len(shown) < len(samples) + len(beyond):
        return []
    lists = "resolvent_numbers phi_cells power_cells"
    proof = (
        f"refine (tail_sound agents weights denominator {mu_range(chapter)} scale power_numbers {lists}\n"
        f"    {last} {powers} phi_bounds power_bounds last_bound {ratio} alpha mu positive {BALANCED} _ mu_bounds\n"
        "    powers_enclosed ltac:(check)). unfold alpha. lra."
    )
    statement = "forall k, bounded_on_1perp agents (Phi alpha agents (perron agents graph mu) k) 1"
    use = f"refine (norm_bound_from_phi agents graph alpha gamma h {BALANCED} range _)."
    loops = "control_norm_bound agents graph alpha gamma h"
    return [
        *kernel(chapter, run, r),
        definition("phi_cells : list (list cell)", listed(map(listed_cells, phi))),
        definition("power_cells : list (list cell)", listed(map(listed_cells, p))),
        definition("phi_bounds : list bound", listed(x.text for x in shown[:last])),
        definition("power_bounds : list bound", listed(x.text for x in shown[last:])),
        definition("last_bound : bound", f"({carried.text})%Z"),
        Step("samples_bounded", statement, proof),
        about_loops(chapter, "norm_bound", loops, use, "samples_bounded", CLAIM),
    ]


def _tail(chapter: Chapter) -> tuple[int, int] | None:
    witness = chapter.decisions[CLAIM].witness
    if "samples" in witness:
        return witness["samples"], witness["powers"]
    found = examine(chapter.loop, 128)
    return None if found.peak is None else (found.peak.tail.last, found.peak.tail.powers)


def norm_bound_exceeded(chapter: Chapter) -> list[Step]:
    """A vector on which some Phi_k exceeds 1, where neither k = 1 in closed form nor an eigenvalue shows it."""
    witness = chapter.decisions[CLAIM].witness
    if "graph_assumption" not in chapter.known or "x0" not in witness or "no_norm_bound" in chapter.known:
        return []
    k, n = witness["k"], len(chapter.figures.laplacian)
    if n * k > MOST_NUMBERS or k > n * MOST_NUMBERS**0.5:
        return []
    start = chapter.figures.direction(apply(chapter.loop.laplacian, witness["x0"])).e
    run = Run(chapter, k + 1)
    r = run.resolvent(k)
    cells = run.cells(start, r, k)
    reached = sum(max(0, abs(x) - cells[k].error) ** 2 for x in cells[k].centre)
    if reached <= SCALE**2 * sum(x * x for x in start):
        return []
    proof = (
        f"refine (sample_refutes agents weights denominator {mu_range(chapter)} scale alpha mu power_numbers\n"
        f"    resolvent_numbers {vector(start)} sample_cells {k} positive ltac:(check) mu_bounds _ powers_enclosed\n"
        "    ltac:(check) ltac:(check) ltac:(check)). unfold alpha. lra."
    )
    statement = f"~ bounded_on_1perp agents (Phi alpha agents (perron agents graph mu) {k}) 1"
    use = (
        f"refine (norm_bound_false_at agents graph alpha gamma h {k} ltac:(unfold agents; lia)\n"
        "    graph_assumption range _)."
    )
    loops = "~ control_norm_bound agents graph alpha gamma h"
    return [
        *kernel(chapter, run, r),
        definition("sample_cells : list cell", listed_cells(cells)),
        Step("exceeded", statement, proof),
        about_loops(chapter, "no_norm_bound", loops, use, "exceeded", CLAIM, "refuted"),
    ]


def kernel(chapter: Chapter, run: Run, r: Sequence[Pair], prefix: str = "") -> list[Step]:
    """The definitions of the kernel's numbers, and the lemma that encloses the powers."""
    proof = (
        f"unfold {prefix}power_numbers. cbn [powers_within].\n"
        f"  repeat (apply conj; [rewrite INR_IZR_INZ; cbn [Z.of_nat Pos.of_succ_nat Pos.succ];\n"
        f"    unfold alpha, {prefix}scale; split; {chapter.numbers.by_interval}|]). exact I."
    )
    return [
        definition(f"{prefix}scale : Z", str(SCALE)),
        definition(f"{prefix}power_numbers : list (Z * Z)", listed(map(str, run.powers))),
        definition(f"{prefix}resolvent_numbers : list (Z * Z)", listed(map(str, r))),
        Step(f"{prefix}powers_enclosed", f"powers_within {prefix}scale alpha 1 {prefix}power_numbers", proof),
    ]


def definition(typed: str, value: str) -> Step:
    """A definition among the steps."""
    return Step("", "", f"Definition {typed} := {value}.")


def listed(items: Iterable[str]) -> str:
    """A list of integers, or of what is made of them."""
    return "[" + ";\n  ".join(items).replace("%Z", "") + "]%Z"


def listed_cells(cells: Iterable[Cell]) -> str:
    """A list of cells."""
    return listed(f"([{'; '.join(map(str, cell.centre))}], {cell.error})" for cell in cells)
