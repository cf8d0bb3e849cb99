"""The closed loop as its norms see it: a graph, an enclosure of mu, the memory; of one design, or of many at once.

Whatever is shown of a loop from these is true of every design that they enclose.
"""

from typing import Protocol

from fomas_verify.checker.graph import Graph
from fomas_verify.checker.powers import Enclosure
from fomas_verify.checker.resolvent import Memory


class Loop(Protocol):
    """A graph, mu and the memory.

    Attributes
    ----------
    graph : the digraph
    precisions : the bits at which a question is worth asking, in this order
    """

    @property
    def graph(self) -> Graph:
        """The digraph."""

    @property
    def precisions(self) -> tuple[int, ...]:
        """The bits at which a question is worth asking, in this order."""

    def mu(self, bits: int) -> Enclosure:
        """Bounds of mu."""

    def __hash__(self) -> int:
        """What is found of a loop is kept for all who ask again."""

    def kernel(self, scale: int) -> Memory:
        """The memory at a scale."""
