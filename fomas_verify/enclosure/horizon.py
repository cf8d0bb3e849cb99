"""The running sum of inequality (14) in ball arithmetic, one pass, constant memory.

Every term is enclosed and added. Where the terms come in blocks, and the bounds at the two ends of a block show that no
sample inside can fail or have the least slack, its samples are not looked at one by one: for abs beta < 1 the power is
largest at the first, and the sum at the last. At the end of a block the sum must meet ``1 - c_n``, to which it
telescopes.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from flint import arb, fmpq

from fomas_verify.enclosure.interval import Interval
from fomas_verify.enclosure.real import to_ball, to_fmpq, to_interval, working_precision
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.enclosure.second_differences import BLOCK, Block, block

SHOWN_TIES = 16


def scan_horizon(
    alpha: Fraction, beta: Interval, last: int, digits: int
) -> tuple[int | None, tuple[int, ...], Interval, int]:
    """``beta^(k+1) + sum_{l=1}^{k+1} abs f(l)`` against 1 for k = 0 .. last.

    Returns the first certain failure, the samples not decided, the smallest relative slack and its sample. Rigorous:
    every term ``f(l) = (l+1)^alpha - 2 l^alpha + (l-1)^alpha`` is enclosed and added.

    Raises
    ------
    DisagreementError
        The sum is not what it telescopes to.
    """
    bits = int(digits * 3.33) + 3 * last.bit_length() + 32
    with working_precision(bits):
        scan = _Scan(to_fmpq(alpha), to_ball(beta))
        scan.look(1)
        shrinking = bool(abs(scan.factor) < 1)
        while scan.done <= last:
            terms = block(alpha, scan.done + 1, bits) if shrinking and scan.done + BLOCK <= last + 1 else None
            if terms is None or not scan.pass_over(terms):
                scan.look(min(BLOCK, last + 1 - scan.done))
        return scan.failure, tuple(scan.open_samples), to_interval(scan.smallest), scan.smallest_at


@dataclass
class _Scan:
    """What was seen at the samples before ``done``: ``total = sum_{l<=done} abs f(l)`` and ``power = beta^done``."""

    exponent: fmpq
    factor: arb
    done: int = 0
    total: arb = field(default_factory=lambda: arb(0))
    power: arb = field(default_factory=lambda: arb(1))
    failure: int | None = None
    open_samples: list[int] = field(default_factory=list)
    smallest: arb = field(default_factory=lambda: arb("inf"))
    smallest_at: int = 0

    def look(self, count: int) -> None:
        """At each of the next samples."""
        exponent, factor, one = self.exponent, self.factor, arb(1)
        behind, here = arb(self.done) ** exponent, arb(self.done + 1) ** exponent
        total, power = self.total, self.power
        for k in range(self.done, self.done + count):
            ahead = arb(k + 2) ** exponent
            step = ahead - here
            total -= step - (here - behind)
            power *= factor
            behind, here = here, ahead
            left = power + total
            if not left <= one:
                if left > one:
                    self.failure = k if self.failure is None else self.failure
                elif len(self.open_samples) < SHOWN_TIES:
                    self.open_samples.append(k)
            slack = one - power / step
            if slack < self.smallest:
                self.smallest, self.smallest_at = slack, k
        self.total, self.power, self.done = total, power, self.done + count

    def pass_over(self, terms: Block) -> bool:
        """Add a block of terms where its ends decide all samples; False where they do not. Needs abs beta < 1."""
        if not terms.negative:
            return False
        total = self.total + arb(-sum(terms.values), terms.error * BLOCK) / arb(2) ** terms.shift
        largest, left = abs(self.power * self.factor), 1 - total
        if not (largest < left and 1 - largest / left > self.smallest):
            return False
        self.done += BLOCK
        self.total, self.power = total, self.power * self.factor**BLOCK
        step = arb(self.done + 1) ** self.exponent - arb(self.done) ** self.exponent
        if not left.overlaps(step):
            raise DisagreementError(f"memory-inequality: the sum of {self.done} terms is not 1 - c_n")
        return True
