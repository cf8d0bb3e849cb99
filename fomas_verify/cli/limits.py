"""``--time-limit`` and ``--memory``: they only end a run, with status 3 and nothing written."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import wraps
from typing import Any

import click

_SECONDS = re.compile(r"\d{1,9}(\.\d{1,9})?", re.ASCII)
_BYTES = re.compile(r"(\d{1,15}(?:\.\d{1,9})?)(?:([KMGT])(?:i?B)?|B)?", re.ASCII | re.IGNORECASE)
_LARGEST = 1 << 62


@dataclass(frozen=True)
class Limits:
    """What the user allows: ``seconds``, and ``memory`` in bytes."""

    seconds: Fraction | None
    memory: int | None

    @property
    def time_option(self) -> str:
        """As the user would write it."""
        return f"--time-limit {float(self.seconds or 0):g}"

    @property
    def memory_option(self) -> str:
        """As the user would write it."""
        size = self.memory or 0
        power = next((x for x in (4, 3, 2, 1) if size % 1024**x == 0), 0)
        return f"--memory {size // 1024**power}{' KMGT'[power].strip()}"


def _seconds(_: click.Context, __: click.Parameter, value: str | None) -> Fraction | None:
    if value is None:
        return None
    found = Fraction(value) if _SECONDS.fullmatch(value) else Fraction(0)
    if found <= 0:
        raise click.BadParameter(f"expected a number of seconds above 0, such as 60 or 0.5, got {value[:40]!r}")
    return found


def _bytes(_: click.Context, __: click.Parameter, value: str | None) -> int | None:
    if value is None:
        return None
    match = _BYTES.fullmatch(value)
    found = int(Fraction(match[1]) * 1024 ** " KMGT".index((match[2] or " ").upper())) if match else 0
    if not 0 < found <= _LARGEST:
        raise click.BadParameter(f"expected bytes above 0, such as 4G, 512M or 1073741824, got {value[:40]!r}")
    return found


_time_option = click.option(
    "--time-limit", callback=_seconds, metavar="SECONDS", help="end the run then: status 3, nothing written"
)
_memory_option = click.option(
    "--memory", callback=_bytes, metavar="BYTES", help="such as 4G; end the run beyond it: status 3, nothing written"
)


def limited(*, keeps: bool = False) -> Callable[[Callable[..., int]], Callable[..., int]]:
    """Give a command both options. Without them it runs as it is; with one it runs in a process that can be ended.

    ``keeps``: what it has written whole stays when it is ended, because the same call goes on from there.
    """

    def decorate(command: Callable[..., int]) -> Callable[..., int]:
        @wraps(command)
        def run(*arguments: Any, time_limit: Fraction | None, memory: int | None, **options: Any) -> int:
            if time_limit is None and memory is None:
                return command(*arguments, **options)
            from fomas_verify.cli.supervision import supervised

            limits = Limits(time_limit, memory)
            return supervised(lambda: command(*arguments, **options), limits, keeps=keeps)

        wrapped: Callable[..., int] = _time_option(_memory_option(run))
        return wrapped

    return decorate
