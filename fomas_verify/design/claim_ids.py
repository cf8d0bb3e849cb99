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
