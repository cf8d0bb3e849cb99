"""Resolvent, P^k, Phi_k and their norms against mpmath at 60 digits; fixed-point matrices against exact ones."""

import json
import random
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import check
from fomas_verify.checker import resolvent as resolvents
from fomas_verify.checker.ball import Ball, deviation, exact_deviation, fitted, power, product
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.norms import compare_norm, compare_norm_with, measured, norm_upper
from fomas_verify.checker.operators import compare_peak, operators
from fomas_verify.checker.powers import Enclosure, point
from fomas_verify.checker.resolvent import Kernel
from fomas_verify.checker.ruling import Undecided
from fomas_verify.checker.schur import characteristic
from tests.checker.builder import PAPER_EDGES, Json, certificate, complete, cycle, design, directed_cycle, path
from tests.checker.sampled import DIGITS, peak_by_floats, power_norm, resolvent, sample_norm

PAPER = design(PAPER_EDGES, 5, gamma="3/20", h="17/20")
DESIGNS: list[Json] = [
    PAPER,
    design(PAPER_EDGES, 5, "1/10", mu="2/5"),
    design(directed_cycle(7), 7, "1/10", mu="19/20"),
    design(directed_cycle(4, "5/3"), 4, gamma="1/4", h="2"),
    design(path(6), 6, "1/3", mu="1/2"),
    design(complete(4), 4, "1/2", mu="1/4"),
    design(cycle(5) + [[i, (i + 1) % 5 + 1, "1/7"] for i in range(1, 6)], 5, "3/4", mu="1/50"),
]


def facts(about: Json) -> Facts:
    found = check(json.dumps(certificate(about)).encode()).design
    return Facts(found, Graph(found))


@pytest.mark.parametrize("alpha", ["9/10", "1/10", "1/2", "1/18446744073709551615", "999/1000"])
@pytest.mark.parametrize("scale", [64, 192])
def test_kernel_encloses(alpha: str, scale: int) -> None:
    found = Kernel(Fraction(alpha), scale)
    exact = resolvent(alpha, 300)
    with mpmath.workdps(DIGITS):
        a = mpmath.mpf(found.alpha.numerator) / found.alpha.denominator
        for n in (0, 1, 2, 3, 17, 100, 300):
            low, high = found.resolvent(n)
            assert low <= exact[n] * 2**scale + mpmath.mpf(10) ** -20
            assert exact[n] * 2**scale - mpmath.mpf(10) ** -20 <= high
            assert high - low <= 4 * n * n + 1
            low, high = found.step_response(n)
            assert low <= ((n + 1) ** a - n**a) * 2**scale <= high
            assert high - low <= 2


def test_kernel_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resolvents, "MAX_SAMPLES", 50)
    assert Kernel(Fraction(1, 2), 64).step_response(51)[0] > 0
    with pytest.raises(Undecided, match="samples are beyond the work allowed"):
        Kernel(Fraction(1, 2), 64).step_response(52)


@pytest.mark.parametrize("about", DESIGNS)
def test_norms_at_the_samples(about: Json) -> None:
    """To the last digits: a bound 1e-30 either way of the exact norm is decided rightly."""
    found = operators(facts(about), 128)
    with mpmath.workdps(DIGITS):
        for k in (7, 1, 2, 20):
            for sign, size in ((found.sample_sign, sample_norm(about, k)), (found.power_sign, power_norm(about, k))):
                near = int(mpmath.floor(size * found.one))
                away = found.one // 10**30
                assert sign(k, near + away, near + away + 1) == 1
                if near > away:
                    assert sign(k, near - away, near - away + 1) == -1
                assert sign(k, near - away, near + away) is None


@pytest.mark.parametrize("about", DESIGNS)
def test_peak_by_brute_force(about: Json) -> None:
    best, _ = peak_by_floats(about, 2000)
    exact = Fraction(best)
    found = facts(about)
    assert compare_peak(found, lambda _: point(exact * (1 + Fraction(1, 10**11)))) == 1
    assert compare_peak(found, lambda _: point(exact * (1 - Fraction(1, 10**11)))) == -1
    assert compare_peak(found, lambda _: Enclosure(Fraction(1, 2), exact * 2)) is None


def test_the_peak_is_one_exactly() -> None:
    found = facts(design(complete(4), 4, mu="1/4"))
    assert compare_peak(found, lambda _: point(Fraction(1))) == 0
    assert compare_peak(found, lambda _: Enclosure(Fraction(1), Fraction(3, 2))) is None


@pytest.mark.parametrize("about", DESIGNS)
@pytest.mark.parametrize("bits", [24, 128])
def test_powers_stay_inside_their_error(about: Json, bits: int) -> None:
    """Against exact powers at both ends of mu's enclosure, where that is a point."""
    found = facts(about)
    box = found.mu(400)
    columns, q = exact_deviation(found, box.lower)
    size = len(columns)
    for n in (1, 2, 3, 13):
        ball = power(deviation(found, bits), n, bits)
        exact = power(Ball(columns, 0, 0), n, None).columns
        unit = Fraction(2) ** ball.exponent
        off = [Fraction(exact[j][i], q**n) / unit - ball.columns[j][i] for i in range(size) for j in range(size)]
        assert sum(x * x for x in off) <= (ball.error + 1) ** 2


def integer_ball(seed: int, size: int, error: int = 0) -> Ball:
    choose = random.Random(seed)
    return Ball([[choose.randint(-(10**9), 10**9) for _ in range(size)] for _ in range(size)], 0, error)


@pytest.mark.parametrize("seed", range(8))
def test_norms_of_random_matrices(seed: int) -> None:
    ball = fitted(integer_ball(seed, 1 + seed), 100)
    with mpmath.workdps(80):
        matrix = mpmath.matrix([list(column) for column in ball.columns])
        exact = mpmath.sqrt(max(mpmath.eigsy(matrix * matrix.T, eigvals_only=True)))
        near = int(mpmath.floor(exact))
        assert exact <= norm_upper(ball) <= exact * (1 + mpmath.mpf(2) ** -28)
        assert exact <= norm_upper(ball, precise=False) <= mpmath.mpf(ball.frobenius)
    assert compare_norm(ball, near + 2, near + 3, 256) == 1
    assert compare_norm(ball, near - 2, near - 1, 256) == -1
    assert compare_norm(ball, near, near + 1, 256) is None
    vague = Ball(ball.columns, 0, 1000)
    assert compare_norm(vague, near + 900, near + 901, 256) is None
    assert compare_norm(vague, near + 1100, near + 1101, 256) == 1
    assert compare_norm(vague, near - 1100, near - 1099, 256) == -1
    assert product(measured(ball), vague, None).error <= product(ball, vague, None).error


def test_a_norm_against_numbers_of_any_size() -> None:
    ball = Ball([[3, 0], [0, 4]], -(10**9), 0)
    assert compare_norm_with(ball, Fraction(1, 10**500), 256) == 1
    ball = Ball([[3, 0], [0, 4]], 10**9, 0)
    assert compare_norm_with(ball, Fraction(10**500), 256) == -1
    ball = fitted(Ball([[3, 0], [0, 4]], -1, 0), 100)
    assert compare_norm_with(ball, Fraction(2001, 1000), 256) == 1
    assert compare_norm_with(ball, Fraction(1999, 1000), 256) == -1
    assert compare_norm_with(ball, Fraction(2), 256) is None
    assert norm_upper(Ball([[0, 0], [0, 0]], 0, 5)) <= 7


def test_a_norm_that_power_iteration_does_not_find() -> None:
    """The first guess, (-39, -2), is orthogonal to the vector (2, -39) that is stretched most."""
    ball = Ball([[6 * 10**6, 78 * 10**6], [-117 * 10**6, 4 * 10**6]], 0, 0)
    square = 9 * 1525 * 10**12
    assert ball.stretch < square // 2
    assert square <= norm_upper(ball) ** 2 <= square + square // 10**7


def test_nothing_left_but_error_stays_small() -> None:
    """K_3 at mu = 1/3: P - J = 0, known to rounding only."""
    ball = power(deviation(facts(design(complete(3), 3, mu="1/3")), 64), 2**40, 64)
    assert ball.frobenius.bit_length() + ball.exponent < -(2**40)


def test_characteristic_polynomial() -> None:
    """det(z - F/3) for F = [[1, 2], [3, 4]]: z^2 - 5/3 z - 2/9."""
    found: Any = characteristic([[1, 2], [3, 4]], 3)
    assert found == (-2, -15, 9)


@pytest.mark.parametrize("alpha", [Fraction(1, 10), Fraction(9, 10)])
def test_the_resolvent_by_blocks_is_that_of_the_sums_one_by_one(alpha: Fraction) -> None:
    """1/(1 - sum abs f(j) z^j), to the last integer: the sums of whole products are rounded once each."""
    memory = Kernel(alpha, 128)
    found = [memory.resolvent(n) for n in range(1400)]
    weights = [memory._weight(j)[0] for j in range(1, 1400)]
    one_by_one = [1 << 128]
    for n in range(1, 1400):
        one_by_one.append(sum(weights[j - 1] * one_by_one[n - j] for j in range(1, n + 1)) >> 128)
    assert [lower for lower, _ in found] == one_by_one
    true = resolvent(str(alpha), 1399)
    with mpmath.workdps(DIGITS):
        assert all(low <= r * 2**128 <= high for (low, high), r in zip(found, true, strict=True))
    assert all(high - low <= 2**24 for low, high in found)
