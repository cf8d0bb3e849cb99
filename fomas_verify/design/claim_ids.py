"""The claims by their ids, and those required where a design does not say.

Source: the table of claims in docs/certificate-format.md, section 4, and the two norm bounds of the README.
"""

from typing import Final

DEFAULT_REQUIRE: Final = (
    "graph-assumption",
    "gain-bound",
    "memory-inequality",
    "perron-eigenvalues",
    "control-bounded",
    "average-consensus",
)
CLAIM_IDS: Final = (
    "graph-assumption",
    "gain-bound",
    "memory-inequality",
    "perron-eigenvalues",
    "beta-contraction",
    "repaired-condition",
    "control-norm-bound",
    "trajectory-norm-bound",
    "control-bounded",
    "average-consensus",
)

SWITCHED_CLAIM_IDS: Final = ("graph-assumption", "gain-bound", "control-bounded", "average-consensus")
"""The claims about a set of digraphs to switch among."""

SWITCHED_REQUIRE: Final = ("graph-assumption", "control-bounded", "average-consensus")
"""Those required of it where the design does not say: they do not need (15)."""
