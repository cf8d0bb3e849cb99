"""At a few bits roundings are as large as they get: what is then said of signs is true, or nothing is said.

Designs are drawn so that the number asked for is near the truth, on either side; the truth is mpmath's at 60 digits.
"""

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from fomas_verify.checker import contraction, facts, powers, resolvent, schur, sizes, stability, thresholds
from fomas_verify.checker.definite import quick_sign
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.powers import Enclosure, outward, quotient, square_root
from fomas_verify.checker.resolvent import Kernel
from fomas_verify.checker.ruling import Refused, Undecided
from fomas_verify.checker.witness import Vector
from tests.checker import sampled
from tests.checker.builder import PAPER_EDGES, Json, complete, cycle, design, directed_cycle, laplacian, path
from tests.checker.sampled import integrated_gain, norm, real, step_matrix
from tests.checker.test_definite import from_spectrum
from tests.checker.test_oracle import balanced
from tests.checker.test_samples import facts as facts_of


def sign(x: Any) -> int:
    return int(x > 0) - int(x < 0)


@pytest.fixture
def few_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Precisions from 3 bits on, without guard bits."""
    monkeypatch.setattr(powers, "_GUARD", 0)
    monkeypatch.setattr(facts, "BITS", (3, 5, 8, 13, 21))
    for cached in (powers.power, powers.gamma_one_plus, powers._log):
        cached.cache_clear()


@pytest.fixture(autouse=True)
def _caches_left_empty() -> Iterator[None]:
    yield
    for cached in (powers.power, powers.gamma_one_plus, powers._log):
        cached.cache_clear()


def drawn(seed: int) -> Json:
    """A small balanced digraph with gamma and h, or mu, of few digits."""
    choose = random.Random(seed)
    agents = choose.randint(2, 5)
    alpha = choose.choice(["1/2", "9/10", "1/10", "2/3", f"{choose.randint(1, 99)}/100"])
    gain = {"gamma": f"{choose.randint(1, 40)}/40", "h": f"{choose.randint(1, 30)}/10"}
    if choose.random() < 0.3:
        gain = {"mu": f"{choose.randint(1, 40)}/40"}
    return design(balanced(choose, agents), agents, alpha, **gain)


def near(exact: Any, choose: random.Random) -> Iterator[Fraction]:
    """Rationals on both sides of a number, nearer and nearer, and ever shorter."""
    for digits in (1, 2, 3, 5, 8, 30):
        scaled = exact * mpmath.mpf(10) ** digits
        for end in (mpmath.floor, mpmath.ceil):
            yield Fraction(int(end(scaled)), 10**digits)
    yield Fraction(choose.randint(-30, 30), 10)


def lambda2(about: Json) -> Any:
    gain = integrated_gain(about)
    part = step_matrix(about) + step_matrix(about).T
    n = about["agents"]
    values = mpmath.eigsy(part - 100 * mpmath.ones(n), eigvals_only=True)
    return (1 - max(values) / 2) / gain


def beta(about: Json) -> Any:
    return 1 - integrated_gain(about) * lambda2(about)


def first(about: Json) -> Any:
    return mpmath.mpf(2) ** real(about["alpha"]) - 1


def second(about: Json) -> Any:
    return -mpmath.sqrt(mpmath.mpf(3) ** real(about["alpha"]) - mpmath.mpf(2) ** real(about["alpha"]))


COMPARED: dict[str, tuple[Callable[[Facts, Fraction], int | None], Callable[[Json], Any]]] = {
    "mu": (lambda f, x: negated(f.compare_mu(x)), integrated_gain),
    "threshold": (lambda f, x: negated(facts.compare(f.threshold, x)), first),
    "beta": (thresholds.beta_below, beta),
    "sigma": (thresholds.sigma_below, lambda about: norm(step_matrix(about))),
    "lambda2": (lambda f, x: -f.compare_lambda2_with(x), lambda2),
}


def negated(found: int | None) -> int | None:
    return None if found is None else -found


@pytest.mark.parametrize("seed", range(25))
@pytest.mark.parametrize("name", COMPARED)
def test_what_is_said_of_a_number_is_true(name: str, seed: int, few_bits: None) -> None:
    compare, value = COMPARED[name]
    about = drawn(seed)
    with mpmath.workdps(60):
        exact = value(about)
        for x in near(exact, random.Random(seed)):
            off = real(str(x)) - exact
            if abs(off) > mpmath.mpf(10) ** -40:
                assert compare(facts_of(about), x) in (None, sign(off)), x


def with_gain_near(about: Json, exact: Any, choose: random.Random) -> Iterator[Json]:
    """The design with mu near a number, given as mu, and by gamma and h."""
    alpha = real(about["alpha"])
    h = Fraction(choose.randint(1, 40), 10)
    kept = {key: value for key, value in about.items() if key not in ("mu", "gamma", "h")}
    for x in near(exact, choose):
        if x > 0:
            yield {**kept, "mu": str(x)}
    for x in near(exact * mpmath.gamma(1 + alpha) / real(str(h)) ** alpha, choose):
        if x > 0:
            yield {**kept, "gamma": str(x), "h": str(h)}


@pytest.mark.parametrize("seed", range(12))
def test_what_is_said_of_the_memory_is_true(seed: int, few_bits: None) -> None:
    """mu near (1 - c_1) / lambda2 and (1 + sqrt c_2) / lambda2."""
    about = drawn(seed)
    with mpmath.workdps(60):
        least = lambda2(about)
        for ask, value in ((thresholds.beta_below_first, first), (thresholds.beta_below_second, second)):
            for changed in with_gain_near(about, (1 - value(about)) / least, random.Random(seed)):
                off = value(changed) - (1 - integrated_gain(changed) * least)
                if abs(off) > mpmath.mpf(10) ** -40:
                    assert ask(facts_of(changed)) in (None, sign(off)), changed


@pytest.mark.parametrize("seed", range(12))
def test_what_is_said_of_the_repaired_condition_is_true(seed: int, few_bits: None) -> None:
    choose = random.Random(seed)
    agents = choose.randint(2, 5)
    about = design(complete(agents), agents, f"{choose.randint(1, 99)}/100", mu="1")
    with mpmath.workdps(60):
        for end in (1 - first(about), 1 + first(about)):
            for changed in with_gain_near(about, end / agents, choose):
                off = first(changed) - abs(1 - integrated_gain(changed) * agents)
                if abs(off) > mpmath.mpf(10) ** -40:
                    assert thresholds.sigma_below_first(facts_of(changed)) in (None, sign(off)), changed


def shown(test: Callable[[Facts, Vector], None], about: Json, e: list[int]) -> bool | None:
    try:
        test(facts_of(about), Vector(tuple(map(Fraction, e))))
    except Refused:
        return False
    except Undecided:
        return None
    return True


@pytest.mark.parametrize("seed", range(40))
def test_what_vectors_show_is_true(seed: int, few_bits: None) -> None:
    """norm(P e) against beta norm(e) and (2^alpha - 1) norm(e), with mu near the tie where there is one."""
    choose = random.Random(seed)
    edges, agents = choose.choice(
        [(PAPER_EDGES, 5), (path(4), 4), (cycle(4), 4), (directed_cycle(3), 3), (complete(3), 3)]
    )
    e = [choose.randint(-4, 4) for _ in range(agents - 1)]
    if agents == 4 and seed % 2:
        e = [1, -1, 1]
    e.append(-sum(e))
    if not any(e):
        e[0], e[-1] = 1, -1
    about = design(edges, agents, f"{choose.randint(1, 99)}/100", mu="1")
    with mpmath.workdps(120):
        column = mpmath.matrix(e)
        least, image = lambda2(about), column - step_matrix(about) * column
        size = mpmath.norm(column)
        a, b = (column.T * image)[0] / size**2, (mpmath.norm(image) / size) ** 2
        ties = [2 * (a - least) / (b - least**2)] if abs(b - least**2) > mpmath.mpf(10) ** -20 else [1 / least]
        c = first(about)
        ties += [(a + s * mpmath.sqrt(a * a - b * (1 - c * c))) / b for s in (1, -1) if a * a > b * (1 - c * c)]
        for tie in [*ties, mpmath.mpf(choose.randint(1, 50)) / 50]:
            for changed in with_gain_near(about, tie, choose):
                mu = integrated_gain(changed)
                stretch = mpmath.sqrt(abs(1 - 2 * mu * a + mu**2 * b))
                offs = (stretch - (1 - mu * least), stretch - c)
                for ask, off in zip(
                    (contraction.require_beyond_beta, contraction.require_beyond_threshold), offs, strict=True
                ):
                    if abs(off) > mpmath.mpf(10) ** -40:
                        assert shown(ask, changed, e) in (None, off > 0), (changed, e)


@pytest.mark.parametrize("bits", range(1, 14))
def test_quick_signs_of_nearly_singular_matrices(bits: int) -> None:
    choose = random.Random(bits)
    for seed in range(150):
        least = choose.choice([-1, 0, 1])
        others = [choose.randint(0, 2 ** choose.randint(1, 16)) + (least > 0) for _ in range(choose.randint(0, 3))]
        assert quick_sign(from_spectrum([least, *others], seed), bits) in (None, least)
        rows = [[choose.randint(-9, 9) for _ in range(i)] + [choose.randint(1, 12)] for i in range(2)]
        determinant = rows[0][0] * rows[1][1] - rows[1][0] ** 2
        assert quick_sign(rows, bits) in (None, sign(determinant))


@pytest.mark.parametrize("bits", [2, 6, 20])
def test_enclosures_of_short_numbers(bits: int) -> None:
    choose = random.Random(bits)
    for _ in range(200):
        ends = sorted(Fraction(choose.randint(0, 99), choose.randint(1, 99)) for _ in range(2))
        root = square_root(Enclosure(*ends), bits)
        assert root.lower**2 <= ends[0] <= (root.lower + Fraction(1, 2**bits)) ** 2
        assert (root.upper - Fraction(1, 2**bits)) ** 2 <= ends[1] < root.upper**2 or root.upper == Fraction(1, 2**bits)
        if ends[0] > 0:
            box = outward(*ends, bits)
            assert box.lower <= ends[0] <= box.lower * (1 + Fraction(1, 2 ** (bits + 6)))
            assert box.upper * (1 - Fraction(1, 2 ** (bits + 6))) <= ends[1] <= box.upper
            assert quotient(Enclosure(*ends), box).lower <= 1 <= quotient(Enclosure(*ends), box).upper


@pytest.mark.parametrize("scale", [2, 5, 9])
@pytest.mark.parametrize("guard", [0, 3])
@pytest.mark.parametrize("alpha", ["9/10", "1/2", "1/50", "49/50"])
def test_the_kernel_is_inside(scale: int, guard: int, alpha: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resolvent, "_GUARD", guard)
    found = Kernel(Fraction(alpha), scale)
    exact = sampled.resolvent(alpha, 60)
    with mpmath.workdps(60):
        a = real(alpha)
        for n in range(50):
            low, high = found.resolvent(n)
            assert low <= exact[n] * 2**scale <= high
            low, high = found.step_response(n)
            assert low <= ((n + 1) ** a - n**a) * 2**scale <= high
            low, high = found._weight(n + 1)
            assert low <= (2 * (n + 1) ** a - (n + 2) ** a - n**a) * 2**scale <= high


def integer_power(rows: list[list[int]], n: int) -> list[list[int]]:
    result = rows
    for _ in range(n - 1):
        result = [
            [sum(a * b for a, b in zip(row, column, strict=True)) for column in zip(*rows, strict=True)]
            for row in result
        ]
    return result


@pytest.mark.parametrize("seed", range(60))
def test_powers_of_rounded_matrices_are_inside(seed: int) -> None:
    """Entries at the ends of what the error allows: the exact power stays within the error that is said."""
    choose = random.Random(seed)
    size, width, error = choose.randint(1, 3), choose.randint(2, 9), choose.randint(0, 2)
    rows = [[choose.randint(-(2**width), 2**width) for _ in range(size)] for _ in range(size)]
    ends = [[entry + choose.choice([-error, error]) for entry in row] for row in rows]
    for n in (1, 2, 3, 5, 6):
        found = stability._power(stability.Scaled(rows, 0, error), n, width)
        exact = integer_power(ends, n)
        if found is not None:
            unit = Fraction(2) ** found.exponent
            off = [abs(x / unit - y) for a, b in zip(exact, found.rows, strict=True) for x, y in zip(a, b, strict=True)]
            assert max(off) <= found.error
            assert (
                found.error == 0
                or error > 0
                or max(map(abs, (entry for row in integer_power(rows, n) for entry in row))) >= 2**width
            )


def test_exceeding_whatever_the_exponent() -> None:
    for x in range(-3, 40):
        for exponent in range(-6, 7):
            for bound in (1, 2, 3, 8):
                assert stability._exceeds(x, exponent, bound) == (x * Fraction(2) ** exponent > bound)
    assert stability._exceeds(1, 10**12, 5)
    assert not stability._exceeds(10**9, -(10**12), 1)
    assert not stability._exceeds(-1, 10**12, 1)
    assert not stability._exceeds(0, 10**12, 1)


@pytest.mark.parametrize("seed", range(40))
def test_what_is_said_of_traces_is_true(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """abs trace(Pc^n) > N - 1 in fixed point of 4 bits on, against exact powers; t near where it happens."""
    choose = random.Random(seed)
    about = drawn(seed)
    graph = facts_of(about).graph
    monkeypatch.setattr(stability, "MAX_EXACT_POWER_BITS", 0)
    monkeypatch.setattr(facts, "BITS", (4, 7, 11, 30))
    for _ in range(6):
        t, n = Fraction(choose.randint(1, 60), choose.choice([7, 16, 30])), choose.randint(1, 9)
        rows, f = stability.differences_step(graph, t)
        trace = Fraction(sum(row[i] for i, row in enumerate(integer_power(rows, n))), f**n)
        beyond = 1 if abs(trace) > len(rows) else -1
        assert stability.trace_beyond.__wrapped__(graph, t, n) in (None, beyond)


@pytest.mark.parametrize("seed", range(40))
def test_what_is_said_of_stability_is_true(seed: int) -> None:
    """By squaring at few bits, where the radius is near 1: mu near mu* = min 2 Re(lambda) / abs(lambda)^2."""
    choose = random.Random(seed)
    about = drawn(seed)
    matrix = laplacian(about["edges"], about["agents"])
    with mpmath.workdps(40):
        eigenvalues = np.linalg.eigvals(matrix[:-1, :-1] - matrix[-1, :-1])
        edge = mpmath.mpf(min(2 * z.real / abs(z) ** 2 for z in eigenvalues))
        for changed in with_gain_near(about, edge, choose):
            off = edge - integrated_gain(changed)
            if abs(off) > mpmath.mpf(10) ** -9:
                for bits in (4, 8, 16, 60):
                    assert schur._by_squaring(facts_of(changed), bits) in (None, sign(off)), changed


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("given", ["mu", "gamma"])
def test_what_is_said_of_the_reach_is_true(given: str, seed: int, few_bits: None) -> None:
    """K_n with mu near 1/n and alpha >= 1/2, where the peak is 1: the reach is gamma n norm(x_0 - mean)."""
    choose = random.Random(seed)
    n, alpha, h = choose.randint(2, 5), f"{choose.randint(5, 9)}/10", f"{choose.randint(1, 40)}/7"
    x0 = [str(choose.randint(-9, 9)) for _ in range(n - 1)] + ["10"]
    mean = sum(map(Fraction, x0), Fraction(0)) / n
    square = sum(((Fraction(x) - mean) ** 2 for x in x0), Fraction(0))
    with mpmath.workdps(60):
        gamma = mpmath.gamma(1 + real(alpha)) / real(h) ** real(alpha) / n
        gain = {"mu": f"1/{n}"} if given == "mu" else {"gamma": f"{int(1000 * gamma)}/1000"}
        found = facts_of(design(complete(n), n, alpha, h=h, x0=x0, **gain))
        exact = (gamma if given == "mu" else real(gain["gamma"])) * n * mpmath.sqrt(real(str(square)))
        for x in near(exact, choose):
            assert sizes.reach_below(found, x) in (None, sign(real(str(x)) - exact))


@pytest.mark.parametrize("bits", [3, 10, 60])
def test_roots_and_gains_of_reach(bits: int) -> None:
    choose = random.Random(bits)
    with mpmath.workdps(60):
        for _ in range(100):
            x = Fraction(choose.randint(1, 10 ** choose.randint(1, 20)), choose.randint(1, 10 ** choose.randint(1, 20)))
            box = sizes._root(x, bits)
            assert box.lower**2 <= x <= box.upper**2
            assert box.upper - box.lower <= box.upper * Fraction(4, 2**bits)
            assert sizes._root(x**2, bits) == Enclosure(x, x)
        for seed in range(20):
            about = {"h": "3/7", **drawn(seed)}
            found = sizes._gain(facts_of(about).design, bits)
            alpha = real(about["alpha"])
            exact = integrated_gain(about) * mpmath.gamma(1 + alpha) / real(about["h"]) ** alpha
            assert real(str(found.lower)) * (1 - mpmath.mpf(10) ** -50) <= exact
            assert exact <= real(str(found.upper)) * (1 + mpmath.mpf(10) ** -50)
