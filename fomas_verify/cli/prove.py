"""``verify-design prove``."""

from __future__ import annotations

from pathlib import Path

import click

from fomas_verify.cli.options import design_argument, digits_option
from fomas_verify.design import Design, DesignError, UncertainDesign, read_any
from fomas_verify.prover import Proof, UncertainProof, prove, prove_uncertain


@click.command("prove")
@design_argument
@click.option("-o", "--output", type=click.Path(path_type=Path), metavar="CERT.json", help="write the certificate")
@click.option("--horizon", type=click.IntRange(0, 10**9), metavar="K", help="also check (14) term by term, k = 0..K")
@click.option("--coq", type=click.Path(path_type=Path), metavar="DIR", help="write the proof as a Coq file into DIR")
@digits_option
@click.option("--json", "as_json", is_flag=True, help="print the certificate in place of the table")
def command(
    design: Path, output: Path | None, horizon: int | None, coq: Path | None, digits: int, *, as_json: bool
) -> int:
    """Decide every claim about DESIGN, print the verdicts and write the certificate.

    \b
    Example:  verify-design prove examples/paper.toml -o certificate.json --horizon 1000
    """
    proof = _prove(read_any(design), horizon, digits, coq)
    if output is not None:
        from fomas_verify.report.files import write_whole

        write_whole(output, proof.certificate().encode())
    if as_json:
        click.echo(proof.certificate(), nl=False)
    else:
        from fomas_verify.report.text import proof_text, uncertain_text

        click.echo(proof_text(proof) if isinstance(proof, Proof) else uncertain_text(proof))
    return proof.exit_status


def _prove(
    design: Design | UncertainDesign, horizon: int | None, digits: int, coq: Path | None
) -> Proof | UncertainProof:
    if isinstance(design, Design):
        proof = prove(design, horizon=horizon, digits=digits)
        if coq is not None:
            _write_coq(proof, coq)
        return proof
    for option, value in {"--horizon": horizon, "--coq": coq}.items():
        if value is not None:
            raise DesignError(f"{design.least.source}: {option} is not supported yet with an interval")
    return prove_uncertain(design)


def _write_coq(proof: Proof, folder: Path) -> None:
    from fomas_verify.certificate.coq import coq_file
    from fomas_verify.report.files import make_folder, write_whole

    file = coq_file(proof.loop, proof.decisions)
    make_folder(folder)
    write_whole(folder / f"{file.module}.v", file.text.encode())
    for line in file.remarks():
        click.echo(f"{file.module}.v: {line}", err=True)
