"""A digraph as arrays, for as many agents as an edge list can hold: degrees, Assumption 1, quotients of vectors.

Rows count from 0 here; all of it takes O(agents + edges), in integers. Source: docs/certificate-format.md, section 11.
"""

from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

MAX_AGENTS = 2**22
MAX_EDGES = 2**24

Quotients = tuple[Fraction, Fraction]


@dataclass(frozen=True, eq=False)
class Network:
    """A digraph with weights over one denominator.

    Attributes
    ----------
    agents : N
    sources, targets : the ends of each edge, from 0, strictly ascending by (source, target), no self-loop
    weights : positive integers; agent `target` hears agent `source` with weight / denominator
    """

    agents: int
    sources: "array[int]"
    targets: "array[int]"
    weights: Sequence[int]
    denominator: int

    @cached_property
    def _degrees(self) -> tuple[list[int], list[int]]:
        """What each agent hears, and with what it is heard, times the denominator."""
        heard, spoken = [0] * self.agents, [0] * self.agents
        for source, target, weight in zip(self.sources, self.targets, self.weights, strict=True):
            heard[target] += weight
            spoken[source] += weight
        return heard, spoken

    def heard(self, agent: int) -> Fraction:
        """sum_j a_ij for i = agent, counted from 1."""
        return Fraction(self._degrees[0][agent - 1], self.denominator)

    def spoken(self, agent: int) -> Fraction:
        """sum_j a_ji for i = agent, counted from 1."""
        return Fraction(self._degrees[1][agent - 1], self.denominator)

    @cached_property
    def degree_max(self) -> Fraction:
        """D."""
        return Fraction(max(self._degrees[0]), self.denominator)

    @cached_property
    def is_balanced(self) -> bool:
        """Whether each agent hears as much as it is heard."""
        return self._degrees[0] == self._degrees[1]

    @cached_property
    def satisfies_assumption(self) -> bool:
        """Assumption 1. On a balanced graph it is enough that one agent reaches all (see `graph.Graph`)."""
        return self.is_balanced and self.reached(1).count(1) == self.agents

    @cached_property
    def has_root(self) -> bool:
        """Whether some agent reaches every other.

        If one does, so does the last agent from which a search had to start anew: whoever reaches it was not met
        before, or it would have been met then.
        """
        met, last = bytearray(self.agents), 0
        for agent in range(self.agents):
            if not met[agent]:
                self._search(agent, met)
                last = agent
        return self.reached(last + 1).count(1) == self.agents

    def reached(self, agent: int) -> bytearray:
        """1 at each agent to which a directed path leads from `agent` (counted from 1), itself included; else 0."""
        met = bytearray(self.agents)
        self._search(agent - 1, met)
        return met

    def _search(self, start: int, met: bytearray) -> None:
        """Mark what a directed path from `start` leads to through agents not yet marked."""
        first, targets = self._first, self.targets
        met[start] = 1
        waiting = [start]
        while waiting:
            agent = waiting.pop()
            for target in targets[first[agent] : first[agent + 1]]:
                if not met[target]:
                    met[target] = 1
                    waiting.append(target)

    @cached_property
    def _first(self) -> list[int]:
        """The position of each agent's first edge, and the number of edges."""
        return _starts(self.sources, self.agents)

    @cached_property
    def is_symmetric(self) -> bool:
        """A = A^T: the edges, taken by (target, source), are the edges turned round."""
        place = _starts(self.targets, self.agents)
        turned = array("q", bytes(8 * len(self.targets)))
        for edge, target in enumerate(self.targets):
            turned[place[target]] = edge
            place[target] += 1
        sources, targets, weights = self.sources, self.targets, self.weights
        return all(
            targets[other] == sources[edge] and sources[other] == targets[edge] and weights[other] == weights[edge]
            for edge, other in enumerate(turned)
        )

    def image(self, x: Sequence[int]) -> list[int]:
        """L x, times the denominator."""
        result = [0] * self.agents
        for source, target, weight in zip(self.sources, self.targets, self.weights, strict=True):
            result[target] += weight * (x[target] - x[source])
        return result

    def quotients(self, columns: Sequence[Sequence[int]]) -> Quotients:
        """e^T L_s e / e^T e and norm(L e)^2 / e^T e, each summed over the columns e before they are divided.

        At least one entry of a column is not 0.
        """
        square = form = stretch = 0
        for e in columns:
            image = self.image(e)
            square += sum(x * x for x in e)
            form += sum(x * y for x, y in zip(e, image, strict=True))
            stretch += sum(y * y for y in image)
        return Fraction(form, square * self.denominator), Fraction(stretch, square * self.denominator**2)


def _starts(ends: Sequence[int], agents: int) -> list[int]:
    """For each agent the number of ends that are smaller, and the number of all."""
    starts = [0] * (agents + 1)
    for end in ends:
        starts[end + 1] += 1
    for agent in range(agents):
        starts[agent + 1] += starts[agent]
    return starts
