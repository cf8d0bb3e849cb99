"""The norm of a matrix known up to an error: compared with a number, and bounded from above.

norm M < s is shown by t^2 I - X^T X > 0 with t = s - error, norm M > s by a negative eigenvalue with t = s + error.
A guess proposes an upper bound; only the test decides.
"""

from dataclasses import replace
from fractions import Fraction
from math import ceil, floor, isqrt

from fomas_verify.checker.ball import Ball
from fomas_verify.checker.definite import quick_sign
from fomas_verify.checker.graph import Rows

_COARSE_BITS = 96
_SLACKS = (30, 12, 6, 2)


def compare_norm(ball: Ball, lower: int, upper: int, bits: int) -> int | None:
    """1 if norm M < s, -1 if norm M > s, None if neither is seen, for lower <= s / 2^exponent <= upper. Rigorous."""
    if ball.coarse is not ball:
        shift = ball.coarse.exponent - ball.exponent
        sign = compare_norm(ball.coarse, lower >> shift, -(-upper >> shift), _COARSE_BITS)
        if sign is not None:
            return sign
    if ball.frobenius < lower:
        return 1
    above = upper + ball.error
    if above < 0 or max(row[-1] for row in ball.gram) > above**2:
        return -1
    if isqrt(ball.stretch) > above:
        return -1
    below = lower - ball.error
    for width in sorted({min(_COARSE_BITS, bits), bits}):
        if below > 0 and quick_sign(_shifted(ball.gram, below**2), width, (1,)) == 1:
            return 1
        if quick_sign(_shifted(ball.gram, above**2), width, (-1,)) == -1:
            return -1
    return None


def compare_norm_with(ball: Ball, s: Fraction, bits: int) -> int | None:
    """The same for a rational s > 0, whatever the size of the exponent."""
    size = s.numerator.bit_length() - s.denominator.bit_length() - ball.exponent
    if size > ball.frobenius.bit_length() + 1:
        return 1
    if size < -1:
        # s is below one unit.
        return compare_norm(ball, 0, 1, bits)
    scaled = s / Fraction(2) ** ball.exponent
    return compare_norm(ball, floor(scaled), ceil(scaled), bits)


def norm_upper(ball: Ball, precise: bool = True) -> int:
    """An upper bound of norm M / 2^exponent: to 2^-30 of it or to its error, less so where not `precise`. Rigorous."""
    whole, ball = ball, ball.coarse
    guess = isqrt(ball.stretch) + 1
    below = above = guess
    for slack in _SLACKS[not precise :]:
        below, above = above, guess + (guess >> slack) + 1
        if _is_above(ball, above):
            break
    else:
        above = ball.frobenius
    while precise and (above - below) >> max(above.bit_length() - _SLACKS[0], 0) > 1:
        middle = (below + above) // 2
        below, above = (below, middle) if _is_above(ball, middle) else (middle, above)
    return min(above + ball.error << ball.exponent - whole.exponent, whole.frobenius)


def norm_lower(ball: Ball) -> int:
    """A lower bound of norm M / 2^exponent that costs little. Rigorous."""
    coarse = ball.coarse
    return isqrt(coarse.stretch) - coarse.error << coarse.exponent - ball.exponent


def measured(ball: Ball, precise: bool = True) -> Ball:
    """The same matrix, for many products: errors are then stretched by its norm only."""
    return replace(ball, known=norm_upper(ball, precise))


def _is_above(ball: Ball, bound: int) -> bool:
    """Whether bound > norm X is seen at few bits."""
    return quick_sign(_shifted(ball.gram, bound**2), _COARSE_BITS, (1,)) == 1


def _shifted(gram: Rows, square: int) -> Rows:
    """square I - X^T X, a lower triangle."""
    return [[-entry for entry in row[:-1]] + [square - row[-1]] for row in gram]
