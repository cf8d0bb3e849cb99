"""``verify-design synthesize``."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fomas_verify.certificate.document import plain as in_json
from fomas_verify.certificate.synthesis_document import synthesis_certificate_text
from fomas_verify.checker import check
from fomas_verify.cli.options import allow_outside_option, design_argument, json_option, tell_notes
from fomas_verify.design import Design, DesignError, parse_design, read_design
from fomas_verify.enclosure.reference import DisagreementError
from fomas_verify.prover import Proof, prove
from fomas_verify.region import find_region
from fomas_verify.region.clash import clash
from fomas_verify.region.common_form import SOLVER
from fomas_verify.region.design_file import design_text
from fomas_verify.region.errors import UndecidedRegionError
from fomas_verify.region.model import Condition
from fomas_verify.region.program import Opinion, is_installed, opinion
from fomas_verify.region.synthesize import Answer, synthesize
from fomas_verify.region.task import DEFAULT_SETTLE_TO, MEANINGS, Objective, pose
from fomas_verify.region.task_entries import limits_entry, task_entry
from fomas_verify.region.weighted_design import weighted_design, weights_record, weights_text
from fomas_verify.report.files import make_folder, write_all

if TYPE_CHECKING:
    from fomas_verify.region.task import Task
    from fomas_verify.region.weights import BestWeights

NONE_EXISTS = 1


@click.command("synthesize")
@design_argument
@click.option(
    "--objective",
    type=click.Choice([x.value for x in Objective]),
    default=Objective.ROBUST.value,
    show_default=True,
    help="; ".join(f"{name}: {words}" for name, words in MEANINGS.items()),
)
@click.option(
    "--condition",
    type=click.Choice([x.value for x in Condition]),
    default=Condition.REPAIRED.value,
    show_default=True,
    help="the strip of `region` in which to search",
)
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), metavar="PATH",
    help="write design and certificate: into a folder, or to NAME.toml and NAME.json; of NAME.design.toml, to "
    "NAME.certificate.json",
)  # fmt: skip
@click.option("--direct", is_flag=True, help="do not ask cvxpy for a second opinion")
@click.option(
    "--weights", is_flag=True, help="choose the edge weights first, for the strongest contraction in one step"
)
@click.option("--symmetric", is_flag=True, help="with --weights: the same weight both ways")
@allow_outside_option
@json_option
def command(
    design: Path,
    objective: str,
    condition: str,
    output: Path | None,
    *,
    direct: bool,
    weights: bool,
    symmetric: bool,
    allow_outside: bool,
    as_json: bool,
) -> int:
    """Find the best gamma and h under the limits of DESIGN, as a new design with its certificate.

    DESIGN needs no gamma and no h; its table [limits] may hold h, gamma, u_max and settle_within. Exit status 1: it is
    proved that no gamma and h satisfy condition and limits. --weights chooses the weights of DESIGN's edges before,
    whatever they are.

    \b
    Example:  verify-design synthesize examples/paper.toml --objective most-robust -o best
    """
    if symmetric and not weights:
        raise click.UsageError("--symmetric: expected with --weights only")
    if output is not None and output.suffix not in ("", ".toml"):
        raise DesignError(f"{output}: expected a folder or a name that ends in .toml")
    named = read_design(design, allow_outside=allow_outside)
    tell_notes(named)
    chosen = _weights(named, symmetric=symmetric) if weights else None
    region = find_region(named if chosen is None else weighted_design(named, chosen))
    task = pose(region, Condition(condition), Objective(objective))
    answer = synthesize(task)
    if chosen is not None and not as_json:
        click.echo(f"{weights_text(named, chosen)}\n")
    if answer.point is None:
        return _none(answer, output, chosen, as_json=as_json)
    second = None
    if answer.piece is not None and not direct and is_installed():
        second = opinion(answer.piece.piece, task.objective)
    proof = _proved(answer)
    _write(output, task, _text(proof.design, task, chosen), _certificate(answer, proof, chosen))
    if as_json:
        click.echo(json.dumps(_record(answer, proof, second, None, chosen), indent=2))
    else:
        from fomas_verify.report.synthesis import found_lines

        click.echo("\n".join(found_lines(answer, proof, _former(task, proof), second)))
    return 0


def _weights(design: Design, *, symmetric: bool) -> BestWeights:
    """The weights, by a solver; raises `MissingExtraError` where it is not installed."""
    from fomas_verify.region.lmi import need_solver
    from fomas_verify.region.weights import best_weights

    need_solver()
    return best_weights(design, symmetric=symmetric)


def _none(answer: Answer, output: Path | None, chosen: BestWeights | None, *, as_json: bool) -> int:
    """Say why no design exists, and write the certificate of it."""
    from fomas_verify.report.synthesis import heading

    why = clash(answer.task)
    _write(output, answer.task, None, _certificate(answer, None, chosen))
    if as_json:
        click.echo(json.dumps(_record(answer, None, None, why, chosen), indent=2))
    else:
        click.echo(f"{heading(answer.task)}\n\nNo gamma and h satisfy condition and limits.\n  {why or 'proved'}")
    return NONE_EXISTS


def _proved(answer: Answer) -> Proof:
    """The design that was found, all that it requires proved; raises `UndecidedRegionError` where that is not so."""
    task, point = answer.task, answer.point
    if point is None:
        raise TypeError("no design was found")
    name = f"{task.design.name[:150]}, {task.objective}"
    settle_to = task.design.settle_to or DEFAULT_SETTLE_TO
    found = replace(task.design, name=name, gamma=point.gamma, mu=None, h=point.h, settle_to=settle_to)
    proof = prove(found)
    if proof.exit_status:
        failing = [x for x in found.require if proof.decisions[x].verdict.value != "proved"]
        raise UndecidedRegionError(
            f"{task.design.source}: the best point, gamma = {point.gamma} and h = {point.h}, does not satisfy "
            f"{', '.join(failing)}, which the design requires; whether another does is not decided"
        )
    return proof


def _former(task: Task, proof: Proof) -> Proof | None:
    """The user's own design, where it gives gamma and h or mu, measured as the new one is."""
    design = task.design
    if design.mu is None and (design.gamma is None or design.h is None):
        return None
    return prove(replace(design, settle_to=proof.design.settle_to))


def _certificate(answer: Answer, proof: Proof | None, chosen: BestWeights | None) -> bytes:
    """The certificate, accepted by the checker; raises `DisagreementError` where it is not."""
    from importlib.metadata import version

    design = replace(answer.task.design, gamma=None, mu=None, h=None) if proof is None else proof.design
    values, decisions = ({}, {}) if proof is None else (proof.value_entries(), proof.decisions)
    entry = task_entry(answer) | ({} if chosen is None else {"solver": SOLVER})
    text = synthesis_certificate_text(design, entry, values, decisions, version("fomas_verify")).encode()
    report = check(text)
    refused = [x for x in report.outcomes if x.status == "refused"]
    if refused:
        raise DisagreementError(f"the checker refuses {refused[0].id} of the synthesis: {refused[0].reason}")
    if report.exit_status:
        raise UndecidedRegionError(f"{answer.task.design.source}: the checker did not decide the certificate")
    return text


def _text(design: Design, task: Task, chosen: BestWeights | None) -> bytes:
    """The design file, which reads as the design that was proved."""
    weights = "" if chosen is None else f" --weights; {SOLVER} proposed the weights, on another machine perhaps others"
    text = design_text(design, f"found by: verify-design synthesize --objective {task.objective}{weights}")
    same = parse_design(text, "toml", design.source)
    if replace(same, notes=design.notes) != design:
        raise DisagreementError("the design file that was written reads as another design")
    return text.encode()


def _write(output: Path | None, task: Task, text: bytes | None, certificate: bytes) -> None:
    """Both files, or the certificate alone; none where one cannot be written."""
    if output is None:
        return
    if output.suffix == ".toml":
        # In a folder that the gate is given, *.design.json would be taken for a design.
        design = output.name.endswith(".design.toml")
        paths = (
            output,
            output.with_suffix("").with_suffix(".certificate.json") if design else output.with_suffix(".json"),
        )
    else:
        make_folder(output)
        stem = f"{Path(task.design.source).name.split('.')[0]}-{task.objective}"
        paths = output / f"{stem}.design.toml", output / f"{stem}.certificate.json"
    contents = {path: data for path, data in zip(paths, (text, certificate), strict=True) if data is not None}
    write_all({path: data for path, data in contents.items() if not (path.is_file() and path.read_bytes() == data)})


def _record(
    answer: Answer, proof: Proof | None, second: Opinion | None, why: str | None, chosen: BestWeights | None
) -> dict[str, object]:
    """What ``--json`` prints."""
    task, point = answer.task, answer.point
    found: dict[str, Fraction | int | None] | None = None
    if point is not None:
        found = {"gamma": point.gamma, "h": point.h, "samples": point.samples}
    record = {
        "objective": task.objective.value,
        "condition": task.condition.value,
        "limits": limits_entry(task),
        "found": found,
        "bound": answer.bound,
        "clash": why,
        "values": None if proof is None else proof.value_entries(),
        "geometric_program": None if second is None else {"agrees": second.agrees, "reason": second.reason},
    }
    plain: dict[str, object] = in_json(record)
    return plain | ({} if chosen is None else {"weights": weights_record(chosen)})
