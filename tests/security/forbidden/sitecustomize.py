"""Loaded by every Python process with this folder on its path: sockets and look-ups are refused and written down."""

import os
import sys

FORBIDDEN = (
    "socket.",
    "urllib.",
    "http.client.",
    "ftplib.",
    "smtplib.",
    "poplib.",
    "imaplib.",
    "nntplib.",
    "telnetlib.",
)


def refuse(event: str, arguments: tuple[object, ...]) -> None:
    """An audit hook: it cannot be taken off again."""
    if event.startswith(FORBIDDEN):
        with open(os.environ["ATTEMPTS"], "a") as file:  # noqa: PTH123
            file.write(f"{event} {arguments!r}\n")
        raise PermissionError(f"{event} is forbidden here")


sys.addaudithook(refuse)
