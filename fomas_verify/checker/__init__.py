"""The independent checker: decides what a certificate proves, with Python's standard library alone."""

from fomas_verify.checker.edge_list import beside
from fomas_verify.checker.report import Report, check
from fomas_verify.checker.statements import STATEMENTS
from fomas_verify.checker.text import Malformed

__all__ = ["STATEMENTS", "Malformed", "Report", "beside", "check"]
