"""Graphs by name: degree, eigenvalues in closed form, and, where they are asked for, edges.

Source: docs/certificate-format.md, section 11; docs/theory.md, section 14.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from fomas_verify.checker.cosines import versine
from fomas_verify.checker.powers import Enclosure, point

PLAIN = ("cycle", "path", "star", "complete", "hypercube", "directed-cycle")
SHAPED = ("torus", "grid")


@dataclass(frozen=True)
class Family:
    """A family's graph on N agents, every weight 1; `shape` of a torus or grid.

    Under every name the graph is strongly connected and balanced.
    """

    name: str
    agents: int
    shape: tuple[int, int] | None

    @property
    def is_directed_cycle(self) -> bool:
        """Whether L^T L = 2 L_s: the directed cycle, whose P is normal."""
        return self.name == "directed-cycle"

    @property
    def is_symmetric(self) -> bool:
        """A = A^T."""
        return not self.is_directed_cycle or self.agents == 2

    @property
    def degree_max(self) -> Fraction:
        """D."""
        n = self.agents
        if self.shape is not None:
            return Fraction(sum(min(side - 1, 2) for side in self.shape))
        degrees = {"star": n - 1, "complete": n - 1, "hypercube": n.bit_length() - 1, "directed-cycle": 1}
        return Fraction(degrees.get(self.name, min(n - 1, 2)))

    @property
    def edge_count(self) -> int:
        """The number of directed edges."""
        n = self.agents
        if self.shape is not None:
            r, c = self.shape
            return 4 * n if self.name == "torus" else 2 * (r * (c - 1) + c * (r - 1))
        counts = {
            "cycle": 2 * n if n > 2 else 2,
            "complete": n * (n - 1),
            "hypercube": n * (n.bit_length() - 1),
            "directed-cycle": n,
        }
        return counts.get(self.name, 2 * (n - 1))

    def lambda2(self, bits: int) -> Enclosure:
        """The smallest eigenvalue of L_s on 1perp. Rigorous."""
        n = self.agents
        if self.shape is not None:
            # The larger side has the smaller eigenvalue.
            return self._side(max(self.shape), bits)[0]
        if self.name in ("cycle", "path"):
            return self._side(n, bits)[0]
        if self.name == "directed-cycle":
            return versine(Fraction(2, n), bits)
        return point(Fraction({"complete": n, "hypercube": 2}.get(self.name, 2 if n == 2 else 1)))

    def lambda_max(self, bits: int) -> Enclosure:
        """The largest eigenvalue of L_s. Rigorous."""
        n = self.agents
        if self.shape is not None:
            ends = [self._side(side, bits)[1] for side in self.shape if side > 1]
            return Enclosure(sum((x.lower for x in ends), Fraction(0)), sum((x.upper for x in ends), Fraction(0)))
        if self.name in ("cycle", "path"):
            return self._side(n, bits)[1]
        if self.name == "directed-cycle":
            return point(Fraction(2)) if n % 2 == 0 else _less(2, 1, versine(Fraction(1, n), bits))
        return point(Fraction(2 * (n.bit_length() - 1) if self.name == "hypercube" else n))

    def _side(self, n: int, bits: int) -> tuple[Enclosure, Enclosure]:
        """The smallest eigenvalue but 0, and the largest, of a cycle (on at least 3) or path on n >= 2 agents."""
        gap = versine(Fraction(1, n), bits)
        if self.name in ("path", "grid") or n == 2:
            return _doubled(gap), _less(4, 2, gap)
        return _doubled(versine(Fraction(2, n), bits)), point(Fraction(4)) if n % 2 == 0 else _less(4, 2, gap)

    def pairs(self) -> Iterator[tuple[int, int]]:
        """The edges (from, to), agents from 0, in any order; one may come twice."""
        joined = self._joined()
        for one, two in joined:
            yield one, two
            if not self.is_directed_cycle:
                yield two, one

    def _joined(self) -> Iterator[tuple[int, int]]:
        n = self.agents
        if self.shape is not None:
            return self._lattice(*self.shape)
        if self.name in ("cycle", "directed-cycle"):
            return ((i, (i + 1) % n) for i in range(n))
        if self.name == "path":
            return ((i, i + 1) for i in range(n - 1))
        if self.name == "star":
            return ((0, i) for i in range(1, n))
        if self.name == "complete":
            return ((i, j) for i in range(n) for j in range(i))
        return ((i, i ^ (1 << d)) for i in range(n) for d in range(n.bit_length() - 1))

    def _lattice(self, rows: int, columns: int) -> Iterator[tuple[int, int]]:
        wrap = self.name == "torus"
        for i in range(rows):
            for j in range(columns):
                if wrap or j + 1 < columns:
                    yield i * columns + j, i * columns + (j + 1) % columns
                if wrap or i + 1 < rows:
                    yield i * columns + j, (i + 1) % rows * columns + j


def _doubled(x: Enclosure) -> Enclosure:
    return Enclosure(2 * x.lower, 2 * x.upper)


def _less(whole: int, times: int, x: Enclosure) -> Enclosure:
    """whole - times x."""
    return Enclosure(whole - times * x.upper, whole - times * x.lower)
