"""The bound of the inverse, on which every enclosed trajectory rests: never too small, and refused where it fails."""

import math
from fractions import Fraction

import pytest

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import to_interval
from fomas_verify.enclosure.trajectory import Enclosure, LinearLoop, law_response, one, step_responses

COUNT = 6
MU = Fraction(1, 3)
EDGES = ((0, 1, Fraction(1)), (1, 2, Fraction(2)), (2, 0, Fraction(1)))
LAPLACIAN = ((1, -1, 0), (0, 2, -2), (-1, 0, 1))


def enclosure() -> Enclosure:
    x0 = ((Fraction(1),), (Fraction(0),), (Fraction(-2),))
    exactly = Interval.exactly
    loop = LinearLoop(EDGES, x0, exactly(MU), exactly(MU), exactly(1), one(COUNT), one(COUNT))
    return Enclosure(loop, 128)


def inverse() -> list[list[list[Fraction]]]:
    """``(I + mu z/(1 - z) L)^-1 = (1 - z) (I - z P)^-1`` exactly, ``[i][j]`` over the samples."""
    agents = range(3)
    identity = [[Fraction(int(i == j)) for j in agents] for i in agents]
    step = [[identity[i][j] - MU * LAPLACIAN[i][j] for j in agents] for i in agents]
    powers = [identity]
    for _ in range(COUNT - 1):
        powers.append([[sum(step[i][m] * powers[-1][m][j] for m in agents) for j in agents] for i in agents])
    return [
        [[powers[k][i][j] - (powers[k - 1][i][j] if k else 0) for k in range(COUNT)] for j in agents] for i in agents
    ]


def floats(share: Fraction) -> list[list[list[float]]]:
    return [[[float(x * share) for x in column] for column in row] for row in inverse()]


@pytest.mark.parametrize("share", [Fraction(1), Fraction(9, 10), Fraction(3, 2), Fraction(1, 100)])
def test_the_bound_is_never_too_small(share: Fraction) -> None:
    """An approximation that is wrong by a factor gives a larger bound, not a smaller one."""
    norm = max(sum(abs(x) for column in row for x in column) for row in inverse())
    tube = enclosure()
    assert tube.bound_inverse(floats(share))
    assert tube.radius is not None
    first_defect = 2
    assert tube.radius >= norm * first_defect * (1 - Fraction(1, 2**40))
    if share == 1:
        assert tube.radius <= norm * first_defect * (1 + Fraction(1, 2**40))


@pytest.mark.parametrize("share", [Fraction(0), Fraction(-1), Fraction(2), Fraction(3), Fraction(100)])
def test_an_approximation_too_far_off_is_refused(share: Fraction) -> None:
    """Its ``Delta = (1 - share) I`` has a norm of 1 or more."""
    tube = enclosure()
    assert not tube.bound_inverse(floats(share))
    assert tube.radius is None
    with pytest.raises(ValueError, match="not bounded"):
        tube.states()


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_an_approximation_that_is_no_number_is_refused(bad: float) -> None:
    wrong = floats(Fraction(1))
    wrong[1][2][3] = bad
    assert not enclosure().bound_inverse(wrong)


def test_the_first_tube_already_contains_the_trajectory() -> None:
    """Before any correction it is as wide as the bound says; ``x_k = P^k x_0`` lies inside."""
    tube = enclosure()
    assert tube.bound_inverse(floats(Fraction(1)))
    x = [Fraction(1), Fraction(0), Fraction(-2)]
    for k in range(COUNT):
        assert all(row[0][k].contains(x[i]) for i, row in enumerate(tube.states()))
        x = [x[i] - MU * sum(LAPLACIAN[i][j] * x[j] for j in range(3)) for i in range(3)]


def test_step_responses_and_the_law_that_inverts_them() -> None:
    """At alpha = 1/2, c_3 = 2 - sqrt 3; and ``sum_j c_(n-j) r_j = 1`` for every n."""
    c = step_responses(Fraction(1, 2), 30, 128)
    r = law_response(c, None, 128)
    third = to_interval(c[3])
    assert (2 - third.upper) ** 2 <= 3 <= (2 - third.lower) ** 2
    for n in range(30):
        total = to_interval(sum((c[n - j] * r[j] for j in range(1, n + 1)), c[n] * r[0]))
        assert total.contains(Fraction(1))
        assert total.width < Fraction(1, 10**12)
    assert [to_interval(x) for x in law_response(c, 0, 128)] == [Interval.exactly(int(n == 0)) for n in range(30)]


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_correction_that_is_no_number_leaves_no_bound(bad: float) -> None:
    tube = enclosure()
    assert tube.bound_inverse(floats(Fraction(1)))
    correction = [[[0.0] * COUNT] for _ in range(3)]
    correction[0][0][2] = bad
    tube.correct(correction)
    assert tube.radius is None
