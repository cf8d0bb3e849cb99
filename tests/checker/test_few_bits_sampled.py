"""At a few bits P^k, Phi_k and trajectories stay inside their errors, and what is said of norms is true.

The truth is mpmath's at 60 digits.
"""

import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import decay, operators, samples, trajectory
from fomas_verify.checker import resolvent as resolvents
from fomas_verify.checker.ball import Ball, deviation
from fomas_verify.checker.box import Box
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.ruling import Undecided
from tests.checker.builder import PAPER_EDGES, Json, complete, cycle, design, directed_cycle, path
from tests.checker.sampled import (
    norm,
    peak_by_floats,
    power_norm,
    power_norms_by_floats,
    real,
    resolvent,
    sample_norm,
    step_matrix,
)
from tests.checker.test_few_bits import drawn, near, sign
from tests.checker.test_samples import facts

pytestmark = pytest.mark.slow

DESIGNS: list[Json] = [
    design(PAPER_EDGES, 5, gamma="3/20", h="17/20"),
    design(PAPER_EDGES, 5, "1/10", mu="2/5"),
    design(directed_cycle(4, "5/3"), 4, gamma="1/4", h="2"),
    design(path(3), 3, "1/3", mu="1/2"),
    design(complete(4), 4, "1/2", mu="1/4"),
    design(complete(3), 3, "1/2", gamma="2/7", h="6/5"),
    design(directed_cycle(3), 3, "4/5", gamma="3/5", h="1"),
    design([[1, 2, "1"], [2, 3, "1"], [3, 4, "2"], [4, 1, "2"], [1, 3, "1"]], 4, "1/2", mu="3/5"),
    design(cycle(5) + [[i, (i + 1) % 5 + 1, "1/7"] for i in range(1, 6)], 5, "3/4", mu="1/10"),
]


@pytest.fixture(params=[0, 5])
def guard(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """So many guard bits instead of 64."""
    for module in (samples, operators, trajectory):
        monkeypatch.setattr(module, "GUARD", request.param)
    caches = (samples._step, operators.operators, trajectory.trajectory)
    for cached in caches:
        cached.cache_clear()
    yield request.param
    for cached in caches:
        cached.cache_clear()


def matrices(about: Json, start: Any, count: int) -> Iterator[tuple[Any, Any]]:
    """P^k E and Phi_k E for k = 0, 1, ..., from their definitions."""
    step, r = step_matrix(about), resolvent(about["alpha"], count)
    powers = [start]
    for _ in range(count):
        powers.append(step * powers[-1])
    for k in range(count + 1):
        yield powers[k], sum((r[k - j] * powers[j] for j in range(1, k + 1)), r[k] * powers[0])


def is_inside(ball: Ball, matrix: Any) -> bool:
    """Whether the norm of what is off is at most the error."""
    size = len(ball.columns)
    scaled = matrix / mpmath.mpf(2) ** ball.exponent
    off = mpmath.matrix([[scaled[i, j] - ball.columns[j][i] for j in range(size)] for i in range(size)])
    return bool(norm(off) <= ball.error * (1 + mpmath.mpf(10) ** -25))


@pytest.mark.parametrize("about", DESIGNS)
@pytest.mark.parametrize("bits", [2, 5, 11])
def test_samples_stay_inside_their_error(about: Json, bits: int, guard: int) -> None:
    n = about["agents"]
    start = operators._centring(n, bits)
    found = samples.Samples(facts(about), bits, start)
    with mpmath.workdps(60):
        for k, (power, sample) in enumerate(matrices(about, mpmath.eye(n) - mpmath.ones(n) / n, 14)):
            assert is_inside(found.power(k), power), k
            assert is_inside(found.sample(k), sample), k
            assert found.power(k).exponent == found.sample(k).exponent == -bits - guard
        assert found.power(3) == found.power(3)


@pytest.mark.parametrize("about", [about for about in DESIGNS if "mu" in about])
@pytest.mark.parametrize("bits", [3, 9])
@pytest.mark.parametrize("room", [Fraction(1, 10), Fraction(1, 1000)])
def test_samples_of_a_box_stay_inside_their_error(about: Json, bits: int, room: Fraction, guard: int) -> None:
    n, alpha, middle = about["agents"], Fraction(about["alpha"]), Fraction(about["mu"])
    ends = (middle * (1 - room), middle * (1 + room))
    box = Box(facts(about).graph, (alpha, alpha), ends)
    found = samples.Samples(box, bits, operators._centring(n, bits))
    assert found.step.stretch >= 1 << found.scale
    with mpmath.workdps(60):
        for mu in (ends[0], middle, ends[1]):
            assert found.step.stretch >= power_norm({**about, "mu": str(mu)}, 1) * 2**found.scale
            start = mpmath.eye(n) - mpmath.ones(n) / n
            for k, (power, sample) in enumerate(matrices({**about, "mu": str(mu)}, start, 8)):
                assert is_inside(found.power(k), power), (mu, k)
                assert is_inside(found.sample(k), sample), (mu, k)


def test_a_fall_is_seen_at_the_ends_that_are_worst() -> None:
    """p_m c_(K+1) < c_(K+1+m) for p_m <= 1/2, c_(K+1) in [20, 100] and c_(K+1+m) in [51, 90], of 1024."""
    found = operators.Operators(facts(design(complete(3), 3, mu="1/6")), 10)
    found.scale = 10
    found.power_upper = lambda _: 512
    for last, seen in ((51, False), (52, True)):
        found.kernel = Responses({3: (20, 100), 7: (last, 90)})
        assert found._falls(2, 4) == seen


def test_the_peak_asks_of_the_powers_what_the_lower_bound_of_the_memory_allows() -> None:
    """u = 2 and c_1 in [20, 100] of 1024: norm P < 40."""
    found = operators.Operators(facts(design(complete(3), 3, mu="1/6")), 10)
    found.scale, found.one = 10, 1024
    found.kernel = Responses({1: (20, 100)})
    asked: list[int] = []
    found.sample_sign = lambda *_: 1
    found.power_sign = lambda n, lower, upper: asked.append(lower) or 1
    found._stays_below = lambda *_: True
    assert found.peak_sign(Enclosure(Fraction(2), Fraction(2))) == 1
    assert asked == [40]


class Responses:
    """Bounds of c_n for some n."""

    def __init__(self, bounds: dict[int, tuple[int, int]]) -> None:
        self.step_response = bounds.__getitem__


@pytest.mark.parametrize("scale", [2, 6, 11])
@pytest.mark.parametrize("alpha", [f"{k}/41" for k in range(1, 41, 3)])
def test_powers_of_every_number_are_inside(scale: int, alpha: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resolvents, "_GUARD", 0)
    found = resolvents.Kernel(Fraction(alpha), scale)
    with mpmath.workdps(40):
        for n in range(80):
            low, high = found._power(n)
            assert low <= mpmath.mpf(n) ** real(alpha) * 2**scale <= high


@pytest.mark.parametrize("about", DESIGNS)
@pytest.mark.parametrize("bits", [3, 6, 12])
def test_what_is_said_of_norms_at_the_samples_is_true(about: Json, bits: int, guard: int) -> None:
    found = operators.Operators(facts(about), bits)
    with mpmath.workdps(60):
        a, r = real(about["alpha"]), resolvent(about["alpha"], 40)
        c = [(n + 1) ** a - mpmath.mpf(n) ** a for n in range(40)]
        sigma = power_norm(about, 1)
        for k in (9, 1, 2, 5):
            power, sample = power_norm(about, k), sample_norm(about, k)
            assert found.power_upper(k) >= power * found.one
            assert found.sample_sign_of_one(k) in (None, sign(1 - sample))
            assert found.power_sign_of_memory(k) in (None, sign(c[k] - power))
            for ask, size in ((found.sample_sign, sample), (found.power_sign, power)):
                floor = int(mpmath.floor(size * found.one))
                for lower in range(floor - 40, floor + 40, 1 if bits < 12 else 3):
                    for upper in (lower, lower + 1, lower + 9):
                        said = ask(k, lower, upper)
                        assert said != 1 or size * found.one < lower
                        assert said != -1 or size * found.one > upper
            for u in (floor - 3, floor, floor + 1, floor + 40):
                scaled = mpmath.mpf(max(u, 1)) / found.one
                assert not found._stays_below(max(u, 1), k) or sigma * scaled + r[k + 1] <= scaled
            for m in (1, 2, 4, 8):
                if found.kernel.step_response(k + 1)[0] <= 0:
                    continue
                off = c[k + 1 + m] / c[k + 1] - power_norm(about, m)
                assert found.decays(k, m) in (None, sign(off))
                assert not found._falls(k, m) or off > 0


@pytest.mark.parametrize("about", DESIGNS)
@pytest.mark.parametrize("bits", [4, 8, 20])
def test_what_is_said_of_the_peak_is_true(about: Json, bits: int, guard: int) -> None:
    peak, _ = peak_by_floats(about, 400)
    found = operators.Operators(facts(about), bits)
    for part in (-400, -30, -5, -1, 1, 3, 20, 100, 999):
        u = Fraction(peak) * (1 + Fraction(part, 1000))
        for box in (Enclosure(u, u), Enclosure(u, u + Fraction(1, 100)), Enclosure(u - Fraction(1, 50), u)):
            try:
                said = found.peak_sign(box)
            except Undecided:
                continue
            assert said not in (0, 1) or box.lower > Fraction(peak) * (1 - Fraction(1, 10**12))
            assert said not in (0, -1) or box.upper < Fraction(peak) * (1 + Fraction(1, 10**12))


@pytest.mark.parametrize("about", DESIGNS)
@pytest.mark.parametrize("bits", [2, 4, 9])
def test_what_is_said_of_trajectories_is_true(about: Json, bits: int, guard: int) -> None:
    choose = random.Random(bits)
    found_facts = facts(about)
    n = about["agents"]
    for width in (1, 1, 2, 3):
        x0 = tuple(tuple(Fraction(choose.randint(-9, 9), choose.randint(1, 4)) for _ in range(width)) for _ in range(n))
        if len(set(x0)) == 1:
            continue
        found = trajectory.Trajectory(found_facts, x0, bits)
        columns, q = trajectory.error_columns(found_facts.graph, x0)
        with mpmath.workdps(60):
            e = mpmath.matrix([[real(str(Fraction(column[i], q))) for column in columns] for i in range(n)])
            size = mpmath.mnorm(e, "f")
            a = real(about["alpha"])
            assert found.sample_sign(0) is None
            for k, (power, sample) in enumerate(matrices(about, e, 12)):
                if k:
                    c = (k + 1) ** a - mpmath.mpf(k) ** a
                    assert found.sample_sign(k) in (None, sign(size - mpmath.mnorm(sample, "f")))
                    assert found.power_sign(k) in (None, sign(c * size - mpmath.mnorm(power, "f")))


@pytest.mark.parametrize("about", DESIGNS)
def test_what_is_said_of_powers_is_true(about: Json, monkeypatch: pytest.MonkeyPatch) -> None:
    """norm P^n against numbers near it, from 6 bits on."""
    monkeypatch.setattr(decay, "BITS", (6, 9, 14))
    choose = random.Random(1)
    found = facts(about)
    with mpmath.workdps(60):
        for n in (1, 2, 3, 7):
            size = power_norm(about, n)
            for s in near(size, choose):
                off = real(str(s)) - size
                if s > 0 and abs(off) > mpmath.mpf(10) ** -28:
                    assert decay.norm_sign.__wrapped__(found, n, s) in (None, sign(off))


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("base", [2, 3, 32])
def test_what_is_said_of_rates_is_true(seed: int, base: int) -> None:
    """kappa near the largest norm P^k / rho^k, and rho near the largest with which some kappa will do."""
    choose = random.Random(seed)
    about = drawn(seed)
    found = facts(about)
    rho = Fraction(choose.randint(2, 19), 20)
    with mpmath.workdps(30):
        step = step_matrix(about) / real(str(rho))
        power, sizes = step, []
        for _ in range(60):
            sizes.append(norm(power))
            power = step * power
        largest = max([mpmath.mpf(1), *sizes])
        for kappa in (*near(largest, choose), Fraction(3), Fraction(1000)):
            if kappa <= 1:
                continue
            for bits in (6, 12, 40):
                said = decay._by_levels(found, bits, base, kappa, rho, decay.Budget(about["agents"]))
                assert said != 1 or largest <= real(str(kappa)) * (1 + mpmath.mpf(10) ** -25)
                assert said != -1 or sizes[-1] > 1 or largest > real(str(kappa)) * (1 - mpmath.mpf(10) ** -25)
            grows = decay._exceeded(found, kappa, rho, decay.Budget(about["agents"]))
            assert not grows or largest > real(str(kappa)) * (1 - mpmath.mpf(10) ** -25) or sizes[-1] > sizes[-2]


@pytest.mark.parametrize("base", [2, 3, 4, 5, 32])
def test_a_norm_that_rises_first_is_not_hidden_by_the_levels(base: int) -> None:
    """norm P^k / rho^k is 1.385, 1.551, 1.871, 1.966, 1.570, 0.889, then less: by numpy's norms."""
    edges = [[4, 3, 1], [3, 1, 2], [1, 2, 2], [2, 4, 2], [2, 3, 1], [4, 1, 1], [1, 3, 1], [3, 2, 1]]
    about = design([[i, j, str(weight)] for i, j, weight in edges], 4, mu="2/5")
    found, rho = facts(about), Fraction(729, 1000)
    sizes = power_norms_by_floats(about, 0.729, 40)
    assert (sizes.index(max(sizes)), sizes[5] < 1, 1.96 < max(sizes) < 1.97) == (3, True, True)
    for kappa in ("11/10", "7/5", "8/5", "19/10", "196/100"):
        for bits in (20, 60):
            assert decay._by_levels(found, bits, base, Fraction(kappa), rho, decay.Budget(4)) != 1
    assert decay._by_levels(found, 60, 32, Fraction(197, 100), rho, decay.Budget(4)) == 1


class Place(int):
    """n, in place of the ball of P^n / rho^n."""

    exponent = 0


@pytest.mark.parametrize(("kappa", "said"), [("29/10", -1), ("13/2", None), ("89/10", None), ("91/10", 1)])
def test_levels_multiply(kappa: str, said: int | None, monkeypatch: pytest.MonkeyPatch) -> None:
    """q_1 .. q_3 = 3, 2, 3/2 and q_4 = 3, q_8 = 1/2: what is below 8 is at most 3 times 3."""
    q = {1: Fraction(3), 2: Fraction(2), 3: Fraction(3, 2), 4: Fraction(3), 8: Fraction(1, 2)}
    monkeypatch.setattr(decay, "deviation", lambda *_: Place(1))
    monkeypatch.setattr(decay, "measured", lambda ball, *_: ball)
    monkeypatch.setattr(decay, "product", lambda ball, unit, bits: Place(ball + unit))
    monkeypatch.setattr(decay, "_ends", lambda ball: (q[ball], q[ball] + 1))
    monkeypatch.setattr(decay, "norm_upper", lambda ball, *_: q[ball])
    monkeypatch.setattr(decay, "compare_norm_with", lambda ball, s, bits: sign(s - q[ball]) or None)
    found = facts(design(complete(3), 3, mu="1/6"))
    assert decay._by_levels(found, 128, 4, Fraction(kappa), Fraction(1, 2), decay.Budget(3)) == said


@pytest.mark.parametrize(
    ("one", "two", "four", "bounds"), [(2, 4, 5, [2, 4, 8, 5, 10, 20, 40]), (4, 2, 5, [4, 2, 8, 5, 20, 10, 40])]
)
def test_a_power_is_bounded_by_what_its_exponents_add_up_to(
    one: int, two: int, four: int, bounds: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """p_3 <= p_1 p_2, p_5 <= p_1 p_4, p_6 <= p_2 p_4, p_7 <= p_3 p_4."""
    found = operators.Operators(facts(design(complete(3), 3, mu="1/6")), 10)
    norms = {1: one * found.one, 2: two * found.one, 4: four * found.one}
    monkeypatch.setattr(operators, "norm_upper", lambda n: norms[n])
    found.samples.power = lambda n: n
    assert [found.power_upper(n) // found.one for n in range(1, 8)] == bounds


def test_going_back_in_the_samples_begins_again() -> None:
    """The resolvent's bounds widen as more of it is known: Phi_n is the same to its error."""
    found = samples.Samples(facts(DESIGNS[0]), 64, operators._centring(5, 64))
    powers, forward = [found.power(n) for n in range(6)], [found.sample(n) for n in range(6)]
    for n in (5, 2, 3, 0, 4):
        assert found.power(n) == powers[n]
        again = found.sample(n)
        off = [x - y for a, b in zip(again.columns, forward[n].columns, strict=True) for x, y in zip(a, b, strict=True)]
        assert max(map(abs, off)) <= again.error + forward[n].error
    assert len({repr(ball.columns) for ball in powers + forward}) == 11


def test_the_ends_of_a_norm_and_the_largest_of_a_level() -> None:
    """3000, 4000 and 5000 times the identity of two, give or take 100, in halves."""
    balls = [Ball([[k, 0], [0, k]], -1, 100) for k in (3000, 5000, 4000)]
    for k, ball in zip((3000, 5000, 4000), balls, strict=True):
        lower, upper = decay._ends(ball)
        assert lower == Fraction(k - 100, 2)
        assert Fraction(k + 100, 2) <= upper <= k + 100
    digits = decay._Digits()
    assert digits.largest(precise=True) == 1
    for ball in balls:
        digits.add(*decay._ends(ball), ball)
    assert 2550 <= digits.largest(precise=True) <= 2551
    assert [rival for _, rival in digits.rivals] == balls[1:]
    small = decay._Digits()
    small.add(Fraction(1, 3), Fraction(1, 2), Ball([[1]], -2, 0))
    assert (small.largest(precise=True), small.rivals) == (1, [])


def test_the_deviation_divided_by_a_rate() -> None:
    """K_3 at mu = 1/6: P - J = (I - J) / 2; divided by 1/4 its norm is 2."""
    lower, upper = decay._ends(deviation(facts(design(complete(3), 3, mu="1/6")), 40, Fraction(4)))
    assert 2 - Fraction(1, 2**30) <= lower <= 2 <= upper
