"""What is known of a family's graph without building it: edges, largest degree, symmetry.

Every one of them is strongly connected and balanced. Source: as `families`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Family:
    """A graph of a family with one weight on every edge.

    Attributes
    ----------
    name : str
        One of `FAMILIES` or `SHAPED_FAMILIES`.
    sizes : (agents,) or (rows, columns)
        What `sparse_family` was given.
    weight : Fraction
        The weight of every edge.
    """

    name: str
    sizes: tuple[int, ...]
    weight: Fraction = Fraction(1)

    @property
    def shape(self) -> tuple[int, int] | None:
        """Rows and columns of a grid or torus."""
        return (self.sizes[0], self.sizes[1]) if len(self.sizes) == 2 else None

    @property
    def agents(self) -> int:
        """N."""
        return self.sizes[0] * (1 if self.shape is None else self.sizes[1])

    @property
    def edges(self) -> int:
        """How many directed edges it has."""
        n = self.agents
        if self.shape is not None:
            rows, columns = self.shape
            return 4 * n if self.name == "torus" else 2 * (2 * n - rows - columns)
        counts = {
            "complete": n * (n - 1),
            "directed-cycle": n,
            "cycle": 2 * n if n > 2 else 2,
            "hypercube": n * (n.bit_length() - 1),
        }
        return counts.get(self.name, 2 * (n - 1))

    @property
    def degree_max(self) -> Fraction:
        """D = max_i (A 1)_i. Exact."""
        n = self.agents
        if self.shape is not None:
            neighbours = sum(_along(side) for side in self.shape)
        else:
            neighbours = {
                "star": n - 1,
                "complete": n - 1,
                "directed-cycle": 1,
                "hypercube": n.bit_length() - 1,
            }.get(self.name, _along(n))
        return neighbours * self.weight

    @property
    def is_directed_cycle(self) -> bool:
        """Whether agent i hears i-1 alone."""
        return self.name == "directed-cycle"

    @property
    def is_symmetric(self) -> bool:
        """A = A^T."""
        return not self.is_directed_cycle or self.agents == 2


def _along(side: int) -> int:
    """The most neighbours that an agent has along a side of so many agents, a closed one of at least 3."""
    return min(side - 1, 2)
