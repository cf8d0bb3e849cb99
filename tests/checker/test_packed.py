"""Packed integers against plain sums; power iteration against numpy's eigenvalues."""

import random
from operator import mul

import numpy as np
import pytest

from fomas_verify.checker import packed
from fomas_verify.checker.ball import COARSE_BITS, Ball
from fomas_verify.checker.iteration import is_kept, iterated, squared
from fomas_verify.checker.norms import compare_norm, norm_lower, norm_upper
from fomas_verify.checker.packed import FEW, combination, combinations, largest, unpacked, width_of

Rows = list[list[int]]


def drawn(choose: random.Random, rows: int, columns: int, bits: int) -> Rows:
    """Entries of up to so many bits, the extreme ones among them."""
    ends = [2**bits - 1, 1 - 2**bits, 0, 1, -1]
    return [
        [
            choose.choice(ends) if choose.random() < 0.5 else choose.randint(1 - 2**bits, 2**bits - 1)
            for _ in range(columns)
        ]
        for _ in range(rows)
    ]


def plain(vectors: Rows, coefficients: Rows) -> Rows:
    return [
        [sum(x * vector[j] for x, vector in zip(line, vectors, strict=True)) for j in range(len(vectors[0]))]
        for line in coefficients
    ]


@pytest.mark.parametrize("count", [1, 2, FEW - 1, FEW, FEW + 1, 33])
@pytest.mark.parametrize("bits", [1, 7, 8, 9, 60, 200])
def test_combinations_are_the_plain_sums(count: int, bits: int) -> None:
    choose = random.Random(100 * count + bits)
    for length in (1, 3, 20):
        vectors, coefficients = drawn(choose, count, length, bits), drawn(choose, 4, count, 1 + bits // 2)
        assert combinations(vectors, coefficients) == plain(vectors, coefficients)


@pytest.mark.parametrize("bits", range(1, 40))
def test_the_largest_sums_just_fit(bits: int) -> None:
    """All entries and all coefficients at the same end: no sum is larger."""
    for count in (FEW, 2 ** (FEW.bit_length()) - 1, 2 ** FEW.bit_length()):
        for entry in (2**bits - 1, 1 - 2**bits):
            for x in (2**bits - 1, 1 - 2**bits):
                found = combination([[entry, -entry]] * count, bits)([x] * count)
                assert found == [count * x * entry, -count * x * entry]


@pytest.mark.parametrize("width", [8, 16, 24, 64])
def test_what_is_packed_is_unpacked(width: int) -> None:
    top = 2 ** (width - 1) - 1
    for vector in ([0], [top], [-top], [-top, top, -1, 0, 1, -top, -1], [top, -top] * 9):
        number = packed.packed(vector, width)
        assert number == sum(x << width * j for j, x in enumerate(vector))
        assert unpacked(number, len(vector), width) == vector
        assert unpacked(number - (5 << len(vector) * width), len(vector), width) == vector


def test_a_width_has_room_for_the_sign() -> None:
    for bits in range(1, 100):
        assert bits + 1 <= width_of(bits) <= bits + 8
        assert width_of(bits) % 8 == 0


def test_the_largest_entry() -> None:
    assert largest([[1, -7], [6, 0]]) == 7
    assert largest([[0]]) == 0


@pytest.mark.parametrize("size", [2, 5, FEW, 30])
def test_power_iteration_leads_to_the_largest_eigenvalue(size: int) -> None:
    choose = np.random.default_rng(size)
    root = choose.integers(-(2**20), 2**20, (size, size))
    full = [[int(x) for x in row] for row in root @ root.T]
    top = np.linalg.eigvalsh(np.array(full, dtype=float))[-1]
    start = list(range(1, size + 1))
    vector = iterated(squared(full, 6), start)
    assert largest([vector]).bit_length() <= 57
    image = [sum(x * y for x, y in zip(row, vector, strict=True)) for row in full]
    inner = sum(x * y for x, y in zip(vector, image, strict=True)) / sum(x * x for x in vector)
    assert abs(inner / top - 1) < 1e-9
    assert is_kept(full, vector)
    assert not is_kept(full, start)


def test_power_iteration_with_nothing() -> None:
    assert iterated([[0, 0], [0, 0]], [3, 4]) == [3, 4]
    assert squared([[0]], 2) == [[0]]
    assert is_kept([[0]], [1])


@pytest.mark.parametrize("columns", [2, FEW, 20])
def test_gram_coarse_and_lower_bound_of_a_ball(columns: int) -> None:
    """The rounded ball contains the matrix; numpy's norm lies between the bounds."""
    choose = random.Random(columns)
    ball = Ball(drawn(choose, columns, 7, 150), -140, 5)
    plain_gram = [[sum(map(mul, x, y)) for y in ball.columns[: i + 1]] for i, x in enumerate(ball.columns)]
    assert ball.gram == plain_gram
    coarse = ball.coarse
    assert coarse.longest <= COARSE_BITS + 1 < ball.longest
    unit = 2 ** (coarse.exponent - ball.exponent)
    off = [x - y * unit for a, b in zip(ball.columns, coarse.columns, strict=True) for x, y in zip(a, b, strict=True)]
    assert sum(x * x for x in off) <= (coarse.error * unit - ball.error) ** 2
    norm = np.linalg.norm(np.array(ball.columns, dtype=float), 2)
    assert norm_lower(ball) <= norm * (1 + 1e-9)
    assert norm * (1 - 1e-9) <= norm_upper(ball) <= norm * (1 + 2e-9)
    assert norm_lower(ball) >= norm * (1 - 1e-4)


def test_a_norm_that_few_bits_do_not_decide_is_decided_by_all() -> None:
    """norm of [[k, 0], [0, 1]] against k - 1, k and k + 1, k of 100 bits."""
    k = 2**100 + 7
    ball = Ball([[k, 0], [0, 1]], 0, 0)
    assert compare_norm(ball.coarse, k - 1 >> 41, k + 1 >> 41, 96) is None
    assert [compare_norm(ball, k + i, k + i, 256) for i in (-1, 0, 1)] == [-1, None, 1]
