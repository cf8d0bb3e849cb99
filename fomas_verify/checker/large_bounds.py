"""What is known of a large design: enclosures of mu, 2^alpha, lambda2, lambda_max, beta and the square of sigma.

Each is true of the exact design; where little is known it is wide. Source: docs/certificate-format.md, section 11;
docs/theory.md, section 14.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import cast

from fomas_verify.checker.designs import Design, State
from fomas_verify.checker.edge_list import network_of
from fomas_verify.checker.facts import Facts
from fomas_verify.checker.families import Family
from fomas_verify.checker.gain import Gain
from fomas_verify.checker.graph import Graph
from fomas_verify.checker.large_form import LargeDesign
from fomas_verify.checker.network import Network, Quotients
from fomas_verify.checker.powers import Enclosure, first_threshold, second_threshold
from fomas_verify.checker.ruling import Undecided

MAX_STATE_BITS = 2**30

_ZERO = Fraction(0)


@dataclass(frozen=True, eq=False)
class LargeGraph:
    """The digraph of a design: a family, of which the edges are built only where they are asked for, or a network."""

    family: Family | None
    listed: Network | None

    @cached_property
    def network(self) -> Network:
        """The edges; raises `Undecided` where there are too many."""
        return network_of(cast(Family, self.family)) if self.listed is None else self.listed

    @property
    def _known(self) -> Family | Network:
        return cast(Family | Network, self.family or self.listed)

    @property
    def degree_max(self) -> Fraction:
        """D."""
        return self._known.degree_max

    @property
    def is_symmetric(self) -> bool:
        """A = A^T."""
        return self._known.is_symmetric

    @property
    def is_directed_cycle(self) -> bool:
        """Whether it is given as a directed cycle."""
        return self.family is not None and self.family.is_directed_cycle

    @property
    def satisfies_assumption(self) -> bool:
        """Assumption 1."""
        return self.listed is None or self.listed.satisfies_assumption

    @property
    def has_root(self) -> bool:
        """Whether some agent reaches every other."""
        return self.listed is None or self.listed.has_root


@dataclass(frozen=True, eq=False)
class Known:
    """A design, its graph, and the bounds that were seen to be true.

    Attributes
    ----------
    quotients : of each vector that sums to 0 and is not 0
    by_factor : bounds of the format's keys that were redone
    """

    design: LargeDesign
    graph: LargeGraph
    quotients: tuple[Quotients, ...] = ()
    by_factor: tuple[tuple[str, Fraction], ...] = ()

    def _by_factor(self, key: str, otherwise: Fraction) -> Fraction:
        return dict(self.by_factor).get(key, otherwise)

    def mu(self, bits: int) -> Enclosure:
        """The integrated gain."""
        gamma, mu, h = (None if x is None else (x, x) for x in (self.design.gamma, self.design.mu, self.design.h))
        return Gain(gamma, mu, h).at(self.design.alpha, bits)

    def threshold(self, bits: int) -> Enclosure:
        """2^alpha - 1."""
        return first_threshold(self.design.alpha, bits)

    def second_threshold(self, bits: int) -> Enclosure:
        """-sqrt(3^alpha - 2^alpha)."""
        root = second_threshold(self.design.alpha, bits)
        return Enclosure(-root.upper, -root.lower)

    def lambda2(self, bits: int) -> Enclosure:
        """lambda2, under Assumption 1."""
        if self.graph.family is not None:
            return self.graph.family.lambda2(bits)
        upper = min([2 * self.graph.degree_max, *(q for q, _ in self.quotients)])
        return Enclosure(max(_ZERO, self._by_factor("lambda2_lower", _ZERO)), upper)

    def lambda_max(self, bits: int) -> Enclosure:
        """The largest eigenvalue of L_s, under Assumption 1."""
        if self.graph.family is not None:
            return self.graph.family.lambda_max(bits)
        degree = self.graph.degree_max
        lower = max([degree, *(q for q, _ in self.quotients)])
        return Enclosure(lower, min(2 * degree, self._by_factor("lambda_max_upper", 2 * degree)))

    def beta(self, bits: int) -> Enclosure:
        """1 - mu lambda2."""
        x = _product(self.mu(bits), self.lambda2(bits))
        return Enclosure(1 - x.upper, 1 - x.lower)

    def sigma_square(self, bits: int) -> Enclosure:
        """sigma^2: what no bound excludes."""
        lower, upper = [square_of(self.beta(bits)).lower], [self._crude(bits)]
        mu = self.mu(bits)
        for q, s in self.quotients:
            lower.append(1 - 2 * mu.upper * q + mu.lower**2 * s)
        if self.graph.is_symmetric:
            ends = [square_of(_one_less(_product(mu, x(bits)))) for x in (self.lambda2, self.lambda_max)]
            lower.append(max(end.lower for end in ends))
            upper.append(max(end.upper for end in ends))
        if self.graph.is_directed_cycle:
            square = self._of_directed_cycle(bits)
            lower.append(square.lower)
            upper.append(square.upper)
        if mu.upper * self.graph.degree_max <= 1:
            gap = self.lambda2(bits).lower
            upper.append(1 - 2 * mu.lower * gap * (1 - mu.upper * self.graph.degree_max))
        return Enclosure(max(lower), min(upper))

    def _crude(self, bits: int) -> Fraction:
        """(1 + 2 mu D)^2, or the bound by factor."""
        crude = 1 + 2 * self.mu(bits).upper * self.graph.degree_max
        return min(crude, max(self._by_factor("sigma_upper", crude), _ZERO)) ** 2

    def _of_directed_cycle(self, bits: int) -> Enclosure:
        """The larger of 1 - 2 mu (1 - mu) x at x = lambda2 and at x = lambda_max: it is linear in x."""
        mu = self.mu(bits)
        ends = []
        for x in (self.lambda2(bits), self.lambda_max(bits)):
            # t (1 - t) is concave: between the ends it is at least the smaller of the two.
            least = min(t * (1 - t) for t in (mu.lower, mu.upper))
            most = max(t * (1 - mu.lower) for t in (mu.lower, mu.upper))
            products = [2 * gain * y for gain in (least, most) for y in (x.lower, x.upper)]
            ends.append(Enclosure(1 - max(products), 1 - min(products)))
        return Enclosure(max(end.lower for end in ends), max(end.upper for end in ends))

    def sample_square(self, quotients: Quotients, bits: int) -> Enclosure:
        """norm(Phi_1 e)^2 / norm(e)^2 for e with these quotients, Phi_1 = P + f I, f = 2 - 2^alpha."""
        q, s = quotients
        mu, threshold = self.mu(bits), self.threshold(bits)
        low, high = 2 - threshold.upper, 2 - threshold.lower
        return Enclosure(
            low**2 - 2 * mu.upper * high * q + mu.lower**2 * s,
            high**2 - 2 * mu.lower * low * q + mu.upper**2 * s,
        )

    @cached_property
    def facts(self) -> Facts:
        """What matrices show of the design."""
        network, given = self.graph.network, self.design
        ends = zip(network.sources, network.targets, network.weights, strict=True)
        edges = tuple((i + 1, j + 1, Fraction(weight, network.denominator)) for i, j, weight in ends)
        numbers = given.alpha, given.gamma, given.mu, given.h
        design = Design(given.agents, edges, given.x0, False, given.require, *numbers)
        return Facts(design, Graph(design))

    @cached_property
    def error_quotients(self) -> Quotients | None:
        """Those of L x_0, None where it is 0; raises `Undecided` where x_0 is too long."""
        x0 = cast(State, self.design.x0)
        entries = [entry for row in x0 for entry in row]
        common, longest = 1, max(entry.numerator.bit_length() for entry in entries)
        for denominator in {entry.denominator for entry in entries}:
            common = lcm(common, denominator)
            if (common.bit_length() + longest) * len(entries) > MAX_STATE_BITS:
                raise Undecided("an initial state with so large a common denominator is beyond the work allowed")
        columns = [self.graph.network.image([int(x * common) for x in column]) for column in zip(*x0, strict=True)]
        return self.graph.network.quotients(columns) if any(map(any, columns)) else None


def _product(x: Enclosure, y: Enclosure) -> Enclosure:
    """x y of numbers >= 0."""
    return Enclosure(x.lower * y.lower, x.upper * y.upper)


def _one_less(x: Enclosure) -> Enclosure:
    """1 - x."""
    return Enclosure(1 - x.upper, 1 - x.lower)


def square_of(x: Enclosure) -> Enclosure:
    """x^2."""
    least = max(x.lower, -x.upper, _ZERO)
    return Enclosure(least**2, max(x.lower**2, x.upper**2))
