"""The working precisions tried in turn."""

from __future__ import annotations

PRECISIONS = (128, 256, 512, 1024, 2048, 4096)
"""In bits; what is not decided at the last one is ``undecided``, on every machine."""

SAMPLE_PRECISIONS = (192, 384, 768)
"""Those of the statements about every sample, which cost more."""
