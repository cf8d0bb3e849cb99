"""Which matrix of a file that holds several is the graph."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from fomas_verify.exact.rational import excerpt
from fomas_verify.network.files.refusals import refused

_SHOWN = 5


def choose(candidates: Mapping[str, str], variable: str | None, name: str) -> str:
    """The variable named, or the only one that is a square matrix of numbers.

    Parameters
    ----------
    candidates : mapping of str to str
        The variables of the file, and what each is; empty for a square matrix of at least 2 rows.
    variable : str or None
        What the user names.

    Raises
    ------
    GraphFileError
        There is none, or more than one and none is named.
    """
    if variable is not None:
        if variable not in candidates:
            raise refused(name, f"a variable {excerpt(variable)}", _listed(list(candidates)))
        return variable
    square = [key for key, other in candidates.items() if not other]
    if len(square) == 1:
        return square[0]
    if not square:
        found = [f"{excerpt(key)} ({other})" for key, other in candidates.items()]
        raise refused(name, "a square matrix of numbers", _listed(found, quote=str))
    raise refused(name, 'one square matrix, or its name as variable = "..."', _listed(square))


def _listed(names: list[str], quote: Callable[[str], str] = excerpt) -> str:
    shown = ", ".join(map(quote, names[:_SHOWN])) + (", ..." if len(names) > _SHOWN else "")
    return shown or "no variable"
