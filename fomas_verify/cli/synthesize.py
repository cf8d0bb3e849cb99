"""``verify-design synthesize``."""

from __future__ import annotations

import json
from pathlib import Path

import click

from fomas_verify.api.synthesizing import Synthesized, find
from fomas_verify.cli.limits import limited
from fomas_verify.cli.options import allow_outside_option, design_argument, json_option, tell_notes
from fomas_verify.design import DesignError, read_design
from fomas_verify.region.model import Condition
from fomas_verify.region.task import MEANINGS, Objective
from fomas_verify.region.weighted_design import weights_text
from fomas_verify.report.files import make_folder, write_all


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
@limited()
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
    found = find(
        named, Objective(objective), Condition(condition), weights=weights, symmetric=symmetric, second=not direct
    )
    if found.chosen is not None and not as_json:
        click.echo(f"{weights_text(named, found.chosen)}\n")
    _write(output, found)
    if as_json:
        click.echo(json.dumps(found.record(), indent=2))
    else:
        click.echo(found.text())
    return found.exit_status


def _write(output: Path | None, found: Synthesized) -> None:
    """Both files, or the certificate alone; none where one cannot be written."""
    if output is None:
        return
    task = found.answer.task
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
    contents = {path: data for path, data in zip(paths, (found.design_file, found.certificate), strict=True) if data}
    write_all({path: data for path, data in contents.items() if not (path.is_file() and path.read_bytes() == data)})
