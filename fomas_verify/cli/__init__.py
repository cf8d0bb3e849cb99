"""The command line: options in, exit status out."""

from fomas_verify.cli.app import main

__all__ = ["main"]
