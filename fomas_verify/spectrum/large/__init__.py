"""Bounds of lambda2, lambda_max and sigma of a network too large for exact matrices, and the vectors that go with them.

numpy and scipy (the extra `scale`) are imported when something is asked. Source: docs/theory.md, section 14.
"""

from fomas_verify.spectrum.large.bounds import LargeBounds, large_bounds

__all__ = ["LargeBounds", "large_bounds"]
