"""The communication network: digraph, Laplacian, degrees, connectivity, balance, families.

Orientation, throughout: `a_ij > 0` means that agent i hears agent j; an edge `(from, to, weight)` says that `to` hears
`from`, so it contributes `a_(to, from) = weight`. Agents count from 1.
"""

from fomas_verify.network.balance import Imbalance, imbalances
from fomas_verify.network.connectivity import (
    Component,
    describe_unreachable,
    end_components,
    is_strongly_connected,
    strong_components,
    unreachable_pair,
)
from fomas_verify.network.digraph import Digraph, Edge, GraphError, digraph
from fomas_verify.network.families import FAMILIES, SHAPED_FAMILIES, family
from fomas_verify.network.matrices import (
    adjacency,
    degree_max,
    in_degrees,
    is_symmetric,
    laplacian,
    out_degrees,
)

__all__ = [
    "FAMILIES",
    "SHAPED_FAMILIES",
    "Component",
    "Digraph",
    "Edge",
    "GraphError",
    "Imbalance",
    "adjacency",
    "degree_max",
    "describe_unreachable",
    "digraph",
    "end_components",
    "family",
    "imbalances",
    "in_degrees",
    "is_strongly_connected",
    "is_symmetric",
    "laplacian",
    "out_degrees",
    "strong_components",
    "unreachable_pair",
]
