"""The Python API: a design from the objects you have, what is decided about it, and its certificate.

The command line says the same: exact numbers, certificates that the independent checker tests, one line for each
error, raised here as an exception below `FomasError`. Progress and notes go to the logger ``fomas_verify``.
"""

import logging

from fomas_verify.api.checking import Checked, check
from fomas_verify.api.design import Design
from fomas_verify.api.regions import Region, Strip, region
from fomas_verify.api.simulations import Simulation, simulate
from fomas_verify.api.syntheses import Synthesis, synthesize
from fomas_verify.api.verdicts import Proof, prove
from fomas_verify.claims.verdict import Verdict
from fomas_verify.exact.errors import FomasError

logging.getLogger("fomas_verify").addHandler(logging.NullHandler())

__all__ = [
    "Checked",
    "Design",
    "FomasError",
    "Proof",
    "Region",
    "Simulation",
    "Strip",
    "Synthesis",
    "Verdict",
    "check",
    "prove",
    "region",
    "simulate",
    "synthesize",
]
