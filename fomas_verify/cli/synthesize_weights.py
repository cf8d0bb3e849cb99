"""The weights' part of ``verify-design synthesize``: ``--weights`` and ``--symmetric``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fomas_verify.cli.options import design_argument, json_option
from fomas_verify.design import read_design
from fomas_verify.report.files import write_all

if TYPE_CHECKING:
    from fomas_verify.region.weights import BestWeights

symmetric_option = click.option("--symmetric", is_flag=True, help="with --weights: the same weight both ways")


@click.command("weights")
@design_argument
@click.option("-o", "--output", type=click.Path(path_type=Path), metavar="DESIGN", help="write the design found")
@click.option("--certificate", type=click.Path(path_type=Path), metavar="CERT.json", help="write its certificate")
@symmetric_option
@json_option
def command(design: Path, output: Path | None, certificate: Path | None, *, symmetric: bool, as_json: bool) -> int:
    """Choose edge weights for DESIGN's edges that contract the disagreement most in one step.

    \b
    Example:  verify-design synthesize examples/paper.toml --weights -o weighted.toml
    """
    return synthesize_weights(design, output, certificate, symmetric=symmetric, as_json=as_json)


def synthesize_weights(
    path: Path, output: Path | None, certificate: Path | None, *, symmetric: bool, as_json: bool
) -> int:
    """Choose the weights, print them, and write the design and its certificate; 0, or an error's status."""
    from fomas_verify.prover import prove
    from fomas_verify.region.lmi import need_solver
    from fomas_verify.region.weighted_design import weighted_design, weighted_file, weights_text
    from fomas_verify.region.weights import best_weights

    design = read_design(path)
    need_solver()
    found = best_weights(design, symmetric=symmetric)
    weighted = weighted_design(design, found)
    contents: dict[Path, bytes] = {}
    if output is not None:
        contents[output] = weighted_file(weighted).encode()
    if certificate is not None:
        contents[certificate] = prove(weighted).certificate().encode()
    write_all(contents)
    click.echo(json.dumps(_record(found), indent=2) if as_json else weights_text(design, found, weighted))
    return 0


def _record(found: BestWeights) -> dict[str, Any]:
    def ends(x: Any) -> dict[str, str]:
        return {"lower": str(x.lower), "upper": str(x.upper)}

    return {
        "edges": [[i, j, str(w)] for i, j, w in found.graph.edges],
        "left_out": [list(pair) for pair in found.dropped],
        "sigma": ends(found.sigma),
        "sigma_as_given": None if found.before is None else ends(found.before),
        "least_sigma": str(found.least),
    }
