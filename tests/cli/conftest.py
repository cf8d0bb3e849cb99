"""The command line as a user starts it: ``python -m fomas_verify`` in a process of its own."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Run = subprocess.CompletedProcess[str]


@pytest.fixture
def verify(checkout: Path) -> Callable[..., Run]:
    """Run it with these arguments in the checkout; ``flags`` go to Python itself."""

    def start(*arguments: object, flags: tuple[str, ...] = (), **environment: str) -> Run:
        return subprocess.run(
            [sys.executable, *flags, "-m", "fomas_verify", *map(str, arguments)],
            cwd=checkout,
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
            check=False,
        )

    return start
