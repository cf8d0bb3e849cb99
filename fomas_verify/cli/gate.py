"""``verify-design gate``."""

from __future__ import annotations

import json
import os
import re
import sys
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fomas_verify.cli.limits import limited
from fomas_verify.cli.machine import ended_by_sigterm, processors
from fomas_verify.cli.numeric import redo_if_installed
from fomas_verify.cli.options import allow_outside_option, json_option
from fomas_verify.cli.require import OWN, require_option
from fomas_verify.exact.inputs import remember
from fomas_verify.report.files import OutputError, make_folder, write_all

if TYPE_CHECKING:
    from fomas_verify.gate.discovery import Found
    from fomas_verify.gate.model import Answer, Result

FILE = click.Path(path_type=Path)
FOLDER = click.Path(path_type=Path, exists=True, file_okay=False)
_NAMED_FILE = re.compile(r"""["']?\bfile["']?\s*[=:]\s*["']([^"'\n]+)["']""")


def share(_: click.Context, __: click.Parameter, value: str) -> Fraction:
    """A number from 0 to 1, exact: ``0.1``, ``1/10`` or ``10%``."""
    match = re.fullmatch(r"(\d{1,9}(?:\.\d{1,9})?)(?:(%)|/([1-9]\d{0,8}))?", value, re.ASCII)
    found = Fraction(match[1]) / (100 if match[2] else int(match[3] or 1)) if match else Fraction(2)
    if found > 1:
        raise click.BadParameter(f"expected a share from 0 to 1, such as 0.1, 1/10 or 10%, got {value[:40]!r}")
    return found


class NamedPath(click.Path):
    """A path that is not empty: an unset variable of a script must not stand for the current folder."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path."""
        if value == "":
            self.fail("expected a file or folder, got an empty path; `.` is the current folder", param, ctx)
        return super().convert(value, param, ctx)


@click.command("gate")
@click.argument("paths", nargs=-1, required=True, type=NamedPath(path_type=Path), metavar="PATH...")
@require_option
@click.option("-j", "--jobs", type=click.IntRange(1, 512), metavar="N", help="processes  [default: a processor each]")
@click.option("--junit", type=FILE, metavar="FILE", help="write the answers as JUnit XML")
@click.option("--sarif", type=FILE, metavar="FILE", help="write what is found as SARIF 2.1.0")
@click.option("--markdown", type=FILE, metavar="FILE", help="write a job summary or pull-request comment")
@json_option
@click.option("-o", "--output", type=FILE, metavar="CERTDIR", help="write each certificate, a baseline for later")
@click.option("--baseline", type=FOLDER, metavar="CERTDIR", help="fail also where a margin shrank since these")
@click.option("--loss", default="10%", show_default=True, callback=share, metavar="SHARE", help="that it may lose")
@click.option("--new-ok", is_flag=True, help="with --baseline: designs may pass of which it holds no certificate")
@click.option("--cache", type=FILE, metavar="DIR", help="reuse certificates, each checked again")
@allow_outside_option
@click.option("-q", "--quiet", is_flag=True, help="print only what does not pass")
@limited()
def command(
    paths: tuple[Path, ...],
    require: tuple[str, ...],
    jobs: int | None,
    junit: Path | None,
    sarif: Path | None,
    markdown: Path | None,
    output: Path | None,
    baseline: Path | None,
    loss: Fraction,
    cache: Path | None,
    *,
    as_json: bool,
    new_ok: bool,
    allow_outside: bool,
    quiet: bool,
) -> int:
    """Decide every design among files and folders, check each certificate, and answer with one exit status.

    In a folder these are designs: *.design.toml, *.design.json, and .toml or .json files with top-level
    format = "fomas-design/1". The exit status is the first of 4, 1, 2, 3, 0 that occurred; no design at all is 2.

    \b
    Example:  verify-design gate designs --require average-consensus --junit gate.xml --sarif gate.sarif
    """
    from fomas_verify.gate.deciding import Options
    from fomas_verify.gate.discovery import find_designs
    from fomas_verify.gate.model import first_of
    from fomas_verify.gate.run import run_gate

    reports = {"junit": junit, "sarif": sarif, "markdown": markdown}
    found = list(find_designs(paths))
    _refuse_overlap(
        {name: path for name, path in reports.items() if path is not None}, found, certificates=output is not None
    )
    if output is not None and baseline is not None and os.path.realpath(output) == os.path.realpath(baseline):
        raise click.BadParameter(
            "expected another folder than --baseline, which a failing run would replace", param_hint="-o"
        )
    if new_ok and baseline is None:
        raise click.UsageError("--new-ok says what --baseline may lack: give --baseline CERTDIR too")
    for folder in (output, cache):
        if folder is not None:
            make_folder(folder)
    margins = baseline is not None or output is not None
    used = jobs or processors()
    options = Options(require or (OWN,), margins, cache, baseline, loss, new_ok, allow_outside, redo_if_installed(used))
    teller = _Teller(sum(isinstance(x, Path) for x in found), quiet=quiet, silent=as_json, output=output, cache=cache)
    with ended_by_sigterm():
        answer = run_gate(found, options, used, teller.tell)
    teller.end(answer, as_json=as_json)
    return first_of([answer.status, *teller.failures, *_write(answer, junit, sarif, markdown)])


def _refuse_overlap(reports: dict[str, Path], found: list[Found], *, certificates: bool) -> None:
    """No report may take the place of another, and nothing that of a design or of its graph file."""
    taken = {os.path.realpath(x): "a design" for x in found if isinstance(x, Path)}
    if reports or certificates:
        graphs = (path for x in found if isinstance(x, Path) for path in _graph_files(x))
        taken |= {os.path.realpath(path): "a graph file" for path in graphs}
        for read in taken:
            remember(Path(read))
    for name, path in reports.items():
        real = os.path.realpath(path)
        if real in taken and not (path.exists() and not path.is_file()):
            raise click.BadParameter(f"expected a file of its own, got {path}, {taken[real]}", param_hint=f"--{name}")
        taken[real] = f"that of --{name}"


def _graph_files(design: Path) -> list[Path]:
    """What a design names as a file: those are read by other processes than the one that writes reports."""
    try:
        text = design.read_text("utf-8")
    except (OSError, ValueError):
        return []
    return [design.parent / name for name in _NAMED_FILE.findall(text)]


def _write(answer: Answer, junit: Path | None, sarif: Path | None, markdown: Path | None) -> list[int]:
    """Write each report that was asked for; the status of each that could not be written."""
    from fomas_verify.gate.junit import junit_xml
    from fomas_verify.gate.markdown import markdown_text
    from fomas_verify.gate.sarif import sarif_json

    wanted = ((junit, junit_xml), (sarif, sarif_json), (markdown, markdown_text))
    return [status for path, render in wanted if path is not None for status in _attempt(path, render(answer))]


def _contents(path: Path, result: Result) -> dict[Path, bytes]:
    """A certificate, and before it the edge list that it names."""
    found = {path: result.certificate.encode()}
    if not result.edge_list:
        return found
    name = json.loads(result.certificate)["design"]["graph"]["file"]
    return {path.with_name(name): result.edge_list} | found


def _attempt(path: Path, data: bytes) -> list[int]:
    return _attempt_all({path: data})


def _attempt_all(contents: dict[Path, bytes]) -> list[int]:
    try:
        write_all(contents)
    except OutputError as error:
        click.echo(f"verify-design: {error}", err=True)
        return [error.exit_status]
    return []


@dataclass
class _Teller:
    """Tells each result as it comes, keeps its certificate, and shows on a terminal how far it is."""

    total: int
    quiet: bool
    silent: bool
    output: Path | None
    cache: Path | None
    done: int = 0
    failures: list[int] = field(default_factory=list)

    def tell(self, result: Result) -> None:
        from fomas_verify.gate.lines import result_line

        self._keep(result)
        self._progress("\r\x1b[K")
        if not self.silent and (result.status or not self.quiet):
            click.echo(result_line(result))
        self.done += 1
        self._progress(f"{self.done}/{self.total}" if self.done < self.total else "")

    def end(self, answer: Answer, *, as_json: bool) -> None:
        from fomas_verify.gate.lines import summary
        from fomas_verify.gate.record import annotation_lines, gate_json

        if as_json:
            click.echo(gate_json(answer), nl=False)
        elif not self.quiet or not answer.results:
            for line in summary(answer):
                click.echo(line)
        if os.environ.get("GITHUB_ACTIONS") == "true":
            for line in annotation_lines(answer):
                click.echo(line, err=as_json)

    def _keep(self, result: Result) -> None:
        from fomas_verify.gate.cache import cache_file, certificate_file

        if self.failures or not result.certificate:
            return
        if self.cache is not None and not result.cached:
            self.failures += _attempt(cache_file(self.cache, result.key), result.certificate.encode())
        if self.output is not None:
            self.failures += _attempt_all(_contents(certificate_file(self.output, result.name), result))

    def _progress(self, text: str) -> None:
        if not self.quiet and sys.stderr is not None and sys.stderr.isatty():
            sys.stderr.write(text)
            sys.stderr.flush()
