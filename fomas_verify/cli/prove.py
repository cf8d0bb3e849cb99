"""``verify-design prove``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import Count, allow_outside_option, design_argument, digits_option, tell_notes
from fomas_verify.design import AnyDesign, Design, DesignError, LargeDesign, SwitchedDesign, UncertainDesign, read_named
from fomas_verify.prover import LargeProof, Proof, UncertainProof, prove, prove_large, prove_uncertain

if TYPE_CHECKING:
    from fomas_verify.region.switching import SwitchedProof

    Found = LargeProof | Proof | UncertainProof | SwitchedProof


@click.command("prove")
@design_argument
@click.option("-o", "--output", type=click.Path(path_type=Path), metavar="CERT.json", help="write the certificate")
@click.option(
    "--horizon", type=Count(0, 10**7), metavar="K", help="also check (14) term by term, k = 0..K (such as 10^7)"
)
@click.option("--coq", type=click.Path(path_type=Path), metavar="DIR", help="write the proof as a Coq file into DIR")
@digits_option
@allow_outside_option
@click.option("--json", "as_json", is_flag=True, help="print the certificate in place of the table")
@limited()
def command(
    design: Path,
    output: Path | None,
    horizon: int | None,
    coq: Path | None,
    digits: int,
    *,
    allow_outside: bool,
    as_json: bool,
) -> int:
    """Decide every claim about DESIGN, print the verdicts and write the certificate.

    \b
    Example:  verify-design prove examples/paper.toml -o certificate.json --horizon 1000
    """
    named = read_named(design, allow_outside=allow_outside)
    proof = _prove(named, horizon, digits, coq=coq is not None)
    for note in proof.notes if isinstance(proof, LargeProof) else ():
        click.echo(f"note: {note}", err=True)
    certificate = _certificate(proof, output, coq, printed=as_json)
    if as_json:
        tell_notes(named)
        click.echo(certificate, nl=False)
    else:
        click.echo(_text(proof))
    return proof.exit_status


def _certificate(proof: Found, output: Path | None, coq: Path | None, *, printed: bool) -> str:
    """The certificate, written where that is asked for, Coq file or a large graph's edge list before it; empty where
    it is not.
    """
    from fomas_verify.report.files import write_all

    restated = {} if coq is None or not isinstance(proof, Proof) else _coq(proof, coq)
    if output is not None:
        files = proof.files(output) if isinstance(proof, LargeProof) else {output: proof.certificate().encode()}
        write_all(restated, files)
        return files[output].decode()
    write_all(restated)
    if not printed:
        return ""
    if not isinstance(proof, LargeProof):
        return proof.certificate()
    if proof.edge_list is not None:
        click.echo("note: the certificate names an edge list beside it: -o CERT.json writes both", err=True)
    return proof.certificate("certificate.json")


def _text(proof: Found) -> str:
    from fomas_verify.report.text import proof_text, uncertain_text

    if isinstance(proof, LargeProof):
        from fomas_verify.report.large_text import large_proof_text

        return large_proof_text(proof)
    if isinstance(proof, Proof):
        return proof_text(proof)
    if isinstance(proof, UncertainProof):
        return uncertain_text(proof)
    from fomas_verify.report.switched_text import switched_proof_text

    return switched_proof_text(proof)


def _prove(design: AnyDesign, horizon: int | None, digits: int, *, coq: bool) -> Found:
    if isinstance(design, Design):
        return prove(design, horizon=horizon, digits=digits)
    if isinstance(design, LargeDesign):
        if coq:
            raise DesignError(f"{design.source}: --coq is not supported yet with {design.graph.agents} agents")
        return prove_large(design, horizon=horizon, digits=digits)
    if isinstance(design, SwitchedDesign):
        source, what = design.first.source, "[[graphs]]"
    else:
        source, what = design.least.source, "an interval"
    for option, asked in {"--horizon": horizon is not None, "--coq": coq}.items():
        if asked:
            raise DesignError(f"{source}: {option} is not supported yet with {what}")
    if isinstance(design, UncertainDesign):
        return prove_uncertain(design)
    from fomas_verify.region.switching import prove_switched

    return prove_switched(design)


def _coq(proof: Proof, folder: Path) -> dict[Path, bytes]:
    from fomas_verify.certificate.coq import coq_file
    from fomas_verify.report.files import make_folder

    file = coq_file(proof.loop, proof.decisions)
    make_folder(folder)
    for line in file.remarks():
        click.echo(f"{file.module}.v: {line}", err=True)
    return {folder / f"{file.module}.v": file.text.encode()}
