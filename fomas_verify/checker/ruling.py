"""How a test that does not end in acceptance says so: refused (not shown) or undecided (not known).

A test of the checker returns when what it was asked to see is true, and raises one of these when it is not seen.
"""


class Refused(Exception):
    """What the certificate says is false, or its witness does not show it (exit status 1)."""


class Undecided(Exception):
    """The truth was not found within the work allowed (exit status 3)."""


def need(sign: int | None, allowed: tuple[int, ...], statement: str) -> None:
    """Return if `sign`, the sign of a difference, is one of `allowed`.

    Parameters
    ----------
    sign : -1, 0, 1, or None where it is not known
    allowed : the signs with which `statement` is true
    statement : what is being tested, for the reason given

    Raises
    ------
    Undecided
        If the sign is not known.
    Refused
        If it is known, and not one of `allowed`.
    """
    if sign is None:
        raise Undecided(f"not decided within the work allowed: {statement}")
    if sign not in allowed:
        raise Refused(f"not true: {statement}")


def need_that(truth: bool, statement: str) -> None:
    """Return if `truth`, raise `Refused` if not."""
    need(int(truth), (1,), statement)
