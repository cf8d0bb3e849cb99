"""``verify-design selftest``."""

from __future__ import annotations

import json

import click

from fomas_verify.checker import check
from fomas_verify.cli.options import json_option
from fomas_verify.design import parse_design
from fomas_verify.prover import prove
from fomas_verify.prover.selftest import PRIMITIVES

DISAGREEMENT = 4
TIE = 'alpha = "1/2"\nmu = 1\n[graph]\nfamily = "path"\nagents = 4\n'


def checker_accepts() -> bool:
    """A certificate of a design with a tie and six refutations passes the checker."""
    return check(_certificate()).exit_status == 0


def checker_refuses() -> bool:
    """The same certificate with one verdict turned round does not."""
    turned = _certificate().replace(
        b'"id": "gain-bound",\n      "verdict": "refuted"', b'"id": "gain-bound",\n      "verdict": "proved"'
    )
    return check(turned).exit_status == 1


def _certificate() -> bytes:
    return prove(parse_design(TIE, "toml", "selftest")).certificate().encode()


@click.command("selftest")
@json_option
def command(*, as_json: bool) -> int:
    """Prove known answers of every primitive that a verdict rests on, again, on this machine.

    \b
    Example:  verify-design selftest
    """
    failed, records = 0, []
    for test in (*PRIMITIVES, checker_accepts, checker_refuses):
        right = test()
        failed += not right
        name, doc = test.__name__.replace("_", " "), " ".join((test.__doc__ or "").replace("``", "").split())
        records.append({"name": name, "right": right, "statement": doc})
        if not as_json:
            click.echo(f"{'ok   ' if right else 'WRONG'}  {name}: {doc}")
    ending = f"{failed} known answers are wrong: trust no verdict." if failed else "Every known answer is proved again."
    click.echo(json.dumps({"wrong": failed, "tests": records}, indent=2) if as_json else ending)
    return DISAGREEMENT if failed else 0
