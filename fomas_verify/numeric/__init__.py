"""Bounds of eigenvalues redone for `check --numeric`: what takes a sparse factor, by floats whose errors are bounded.

It knows neither the checker nor the prover. numpy, scipy and qdldl (the extra `scale`) are imported when something is
asked. Source: docs/theory.md, section 14.
"""

from fomas_verify.numeric.redo import SCALE, Redo

__all__ = ["SCALE", "Redo"]
