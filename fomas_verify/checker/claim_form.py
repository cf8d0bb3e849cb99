"""The array `claims` of a certificate: ids, verdicts and statements, read with the path of every defect.

Source: docs/certificate-format.md, section 4.
"""

from collections.abc import Callable
from typing import TypeVar

from fomas_verify.checker.designs import read_claim_id
from fomas_verify.checker.statements import VERDICTS
from fomas_verify.checker.text import Malformed, array, expected, fields, string

W = TypeVar("W")


def read_claims(value: object, path: str, read: Callable[[str, str, object, str], W]) -> list[tuple[str, str, str, W]]:
    """(id, verdict, statement, witness) of each claim; `read` reads a witness, given id, verdict, value and path.

    Raises
    ------
    Malformed
        If an entry is no claim, an id stands twice, or there is no claim.
    """
    claims: list[tuple[str, str, str, W]] = []
    seen: list[str] = []
    for index, entry in enumerate(array(value, path, "an array of claims")):
        here = f"{path}[{index}]"
        given = fields(entry, here, ("id", "verdict", "statement", "witness"))
        name = read_claim_id(given["id"], f"{here}.id", seen)
        verdict = given["verdict"]
        if not isinstance(verdict, str) or verdict not in VERDICTS:
            raise expected(f"{here}.verdict", f"one of {', '.join(VERDICTS)}", verdict)
        statement = string(given["statement"], f"{here}.statement")
        claims.append((name, verdict, statement, read(name, verdict, given["witness"], f"{here}.witness")))
    if not claims:
        raise Malformed(path, "expected at least one claim")
    return claims
