"""What is said where a library is not installed."""

from fomas_verify.exact.errors import MissingExtraError

__all__ = ["MissingExtraError"]
