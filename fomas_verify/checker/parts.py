"""Whether a claim has one truth at every alpha of an interval: by halving until each part is decided.

Over a part, mu is enclosed and the thresholds, which increase with alpha, are taken at an end. What is asked up to
alpha = 1 is asked of alpha < 1 only, so that a tie at 1 is enough there.
Source: docs/certificate-format.md, section 3, `margins`.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.corners import first_sign, second_sign, sigma_is_below, sigma_sign
from fomas_verify.checker.definite import quick_sign
from fomas_verify.checker.facts import BITS, Facts
from fomas_verify.checker.gain import Gain
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.powers import Enclosure, first_threshold

MAX_PARTS = 2**12
MAX_HALVINGS = 64
MAX_SIGMA_WORK = 2**31
_BITS = BITS[0]
_TESTS_A_PART = 4

Shown = Callable[[Fraction, Fraction], bool]


def throughout(first: Fraction, last: Fraction, shown: Shown, denied: Shown, most: int = MAX_PARTS) -> int | None:
    """1 if all parts of [first, last] are shown, -1 if a point of it is denied, None beyond the work allowed."""
    parts = deque([(first, last, 0)])
    count = 1
    while parts:
        low, high, depth = parts.popleft()
        if shown(low, high):
            continue
        middle = (low + high) / 2
        if denied(middle, middle):
            return -1
        count += 1
        if count > most or depth == MAX_HALVINGS:
            return None
        parts += [(low, middle, depth + 1), (middle, high, depth + 1)]
    return 1


@dataclass(frozen=True)
class Curve:
    """The designs that differ from one in alpha only; each method says whether a claim is seen over a part of [0, 1].

    Where mu is given, a part's ends decide, ties included.
    """

    graph: Graph
    gain: Gain

    @property
    def exact(self) -> bool:
        """Whether mu is one rational number for every alpha."""
        return self.gain.mu is not None

    @property
    def most(self) -> int:
        """How many parts `contracts` and `expands` may be asked of."""
        return min(MAX_PARTS, MAX_SIGMA_WORK // (_TESTS_A_PART * self.graph.agents**3))

    def over(self, first: Fraction, last: Fraction) -> Enclosure:
        """mu over a part."""
        return self.gain.over(first, last, _BITS)

    def remembers(self, first: Fraction, last: Fraction) -> bool:
        """Whether -sqrt(3^alpha - 2^alpha) <= beta <= 2^alpha - 1."""
        mu = self.over(first, last)
        return first_sign(self.graph, first, mu.lower, self.exact) in (0, 1) and second_sign(
            self.graph, first, mu.upper, self.exact
        ) in (-1, 0)

    def forgets(self, first: Fraction, last: Fraction) -> bool:
        """Whether that fails at every alpha < 1."""
        mu = self.over(first, last)
        tie = (0,) if last == 1 else ()
        return first_sign(self.graph, last, mu.upper, self.exact) in (-1, *tie) or second_sign(
            self.graph, last, mu.lower, self.exact
        ) in (1, *tie)

    def contracts(self, first: Fraction, last: Fraction) -> bool:
        """Whether sigma <= 2^alpha - 1; sigma is convex in mu."""
        mu = self.over(first, last)
        if not self.exact:
            return all(sigma_is_below(self.graph, first, t) for t in {mu.lower, mu.upper})
        return all(sigma_sign(self.graph, first, t) in (0, 1) for t in {mu.lower, mu.upper})

    def expands(self, first: Fraction, last: Fraction) -> bool:
        """Whether sigma > 2^alpha - 1 at every alpha < 1; sigma changes by at most norm L times the change of mu."""
        mu = self.over(first, last)
        if mu.lower == mu.upper:
            return sigma_sign(self.graph, last, mu.lower, self.exact) in ((-1, 0) if last == 1 else (-1,))
        bound = first_threshold(last, _BITS).upper + self.graph.size * mu.radius
        facts = Facts(self.graph.design.at(last, mu.middle), self.graph)
        return quick_sign(facts.sigma_form(bound**2, mu.middle), _BITS, (-1,)) == -1
