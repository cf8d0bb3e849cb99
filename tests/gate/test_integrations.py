"""The integrations, each run: the GitHub action and the GitLab template as shell scripts, the hook by pre-commit, the
plugin by pytest.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree.ElementTree import parse

import pytest
import yaml

Run = subprocess.CompletedProcess[str]
BIN = Path(sys.executable).parent
GOOD = 'name = "{}"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 4\n'
BAD = GOOD.replace("0.2", "0.4")


@pytest.fixture
def plant(tmp_path: Path) -> Path:
    """A repository with a design that passes and, in a folder of its own, one that does not."""
    folder = tmp_path / "plant"
    (folder / "bad one").mkdir(parents=True)
    (folder / "good.design.toml").write_text(GOOD.format("good"))
    (folder / "bad one" / "bad.design.toml").write_text(BAD.format("bad"))
    return folder


def run(command: list[object], folder: Path, **environment: object) -> Run:
    kept = {
        name: value for name, value in os.environ.items() if not name.startswith(("GITHUB", "GIT_", "PYTEST", "COV"))
    }
    path = f"{BIN}{os.pathsep}{kept['PATH']}"
    return subprocess.run(
        list(map(str, command)),
        cwd=folder,
        env={**kept, "PATH": path, **{name: str(value) for name, value in environment.items()}},
        capture_output=True,
        text=True,
        check=False,
    )


def action_step(checkout: Path, number: int, inputs: dict[str, str], folder: Path, **environment: object) -> Run:
    """A step of action.yml as a runner starts it: expressions replaced, in bash with -eo pipefail."""
    action = yaml.safe_load((checkout / "action.yml").read_text())
    step = action["runs"]["steps"][number]
    given = {name: entry["default"] for name, entry in action["inputs"].items()} | inputs

    def value(expression: re.Match[str]) -> str:
        name = expression[1]
        return str(checkout) if name == "github.action_path" else given[name.removeprefix("inputs.")]

    variables = {name: re.sub(r"\$\{\{ *([\w.]+) *\}\}", value, text) for name, text in step["env"].items()}
    assert step["shell"] == "bash"
    assert "${{" not in step["run"]
    script = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]]
    return run(script, folder, **variables, **environment)


@pytest.mark.parametrize(
    ("inputs", "status", "designs"),
    [
        ({"paths": "good.design.toml"}, 0, ["good"]),
        ({"paths": "\ngood.design.toml\nbad one\n"}, 1, ["good", "bad"]),
        ({"paths": ".", "require": "graph-assumption", "cache": "kept"}, 0, ["bad", "good"]),
        ({"paths": "missing"}, 2, []),
        ({"paths": "--help"}, 2, []),
        ({"paths": "$(touch forged)"}, 2, []),
    ],
)
def test_the_gate_step_of_the_action(
    checkout: Path, plant: Path, tmp_path: Path, inputs: dict[str, str], status: int, designs: list[str]
) -> None:
    summary, output = tmp_path / "summary", tmp_path / "output"
    (tmp_path / "verify-design").mkdir()
    (tmp_path / "verify-design" / "bin").symlink_to(BIN)
    environment = {"RUNNER_TEMP": tmp_path, "GITHUB_STEP_SUMMARY": summary, "GITHUB_OUTPUT": output}
    files = {"junit": "gate.xml", "sarif": "gate.sarif"}
    done = action_step(checkout, 1, files | inputs, plant, GITHUB_ACTIONS="true", **environment)
    assert (done.returncode, output.read_text()) == (status, f"status={status}\n")
    assert summary.read_text().startswith("### verify-design gate: ")
    assert ("::error file=" in done.stdout) == (status != 0)
    assert [suite.find("testcase").get("classname") for suite in parse(plant / "gate.xml").getroot()][
        : len(designs)
    ] == designs
    assert not (plant / "forged").exists()
    assert (plant / "kept").exists() == ("cache" in inputs)


def test_the_install_step_of_the_action(checkout: Path, tmp_path: Path) -> None:
    """With a Python that writes down how it is called, since nothing here reaches the network."""
    calls = tmp_path / "calls"
    stub = tmp_path / "python"
    stub.write_text(
        f'#!/bin/sh\necho "$*" >>{calls}\n[ "$2" != venv ] || {{ mkdir -p "$3/bin"; cp "$0" "$3/bin/python"; }}\n'
    )
    stub.chmod(0o755)
    done = action_step(checkout, 0, {"python": str(stub)}, tmp_path, RUNNER_TEMP=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    venv, dependencies, package = calls.read_text().splitlines()
    assert venv == f"-m venv {tmp_path}/verify-design"
    assert dependencies.endswith(f"--no-deps --require-hashes --requirement {checkout}/requirements/base.txt")
    assert package.endswith(f"--no-deps --no-build-isolation {checkout}")
    stub.write_text("#!/bin/sh\nexit 7\n")
    assert action_step(checkout, 0, {"python": str(stub)}, tmp_path, RUNNER_TEMP=tmp_path).returncode == 7


def test_the_output_of_the_action_is_that_of_its_step(checkout: Path) -> None:
    action = yaml.safe_load((checkout / "action.yml").read_text())
    assert action["runs"]["using"] == "composite"
    assert action["outputs"]["status"]["value"] == f"${{{{ steps.{action['runs']['steps'][1]['id']}.outputs.status }}}}"


@pytest.mark.parametrize(
    ("variables", "status"),
    [
        ({}, 1),
        ({"VERIFY_DESIGN_PATHS": "good.design.toml"}, 0),
        ({"VERIFY_DESIGN_OPTIONS": "--require graph-assumption"}, 0),
        ({"VERIFY_DESIGN_PATHS": "missing"}, 2),
    ],
)
def test_the_gitlab_template(checkout: Path, plant: Path, variables: dict[str, str], status: int) -> None:
    (job,) = yaml.safe_load((checkout / "templates" / "verify-design.gitlab-ci.yml").read_text()).values()
    done = run(["sh", "-e", "-c", "\n".join(job["script"])], plant, **(job["variables"] | variables))
    assert done.returncode == status
    assert all((plant / name).exists() for name in (*job["artifacts"]["paths"], job["artifacts"]["reports"]["junit"]))
    stub = plant / "python"
    stub.write_text('#!/bin/sh\nshift 4\necho "$*"\n')
    stub.chmod(0o755)
    install = run(
        ["sh", "-e", "-c", "\n".join(job["before_script"])],
        plant,
        PATH=f"{plant}:{os.environ['PATH']}",
        **job["variables"],
    )
    assert install.stdout.split()[-1] == "fomas_verify"


@pytest.fixture
def hooks(checkout: Path, tmp_path: Path) -> Path:
    """A git repository with what pre-commit needs of this one."""
    folder = tmp_path / "hooks"
    folder.mkdir()
    for name in (".pre-commit-hooks.yaml", "pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(checkout / name, folder)
    shutil.copytree(checkout / "fomas_verify", folder / "fomas_verify", ignore=shutil.ignore_patterns("__pycache__"))
    commit(folder)
    return folder


def commit(folder: Path) -> str:
    git = ["git", "-c", "user.name=t", "-c", "user.email=t@example.invalid", "-c", "commit.gpgsign=false"]
    for arguments in (["init", "-q"], ["add", "-A"], [*git[1:], "commit", "-q", "-m", "x"]):
        assert run(["git", *arguments], folder).returncode == 0
    return run(["git", "rev-parse", "HEAD"], folder).stdout.strip()


def test_the_hook_by_pre_commit(hooks: Path, plant: Path, tmp_path: Path) -> None:
    """In this environment in place of one that pre-commit would fill from a registry."""
    revision = run(["git", "rev-parse", "HEAD"], hooks).stdout.strip()
    config = {"repo": str(hooks), "rev": revision, "hooks": [{"id": "verify-design", "language": "system"}]}
    (plant / ".pre-commit-config.yaml").write_text(yaml.safe_dump({"repos": [config]}))
    (plant / "other.toml").write_text("alpha = 1\ngraph = 2\n")
    commit(plant)
    call = [BIN / "pre-commit", "run", "--color", "never", "--all-files"]
    both = run(call, plant, PRE_COMMIT_HOME=tmp_path / "home")
    assert both.returncode == 1, both.stderr
    assert "- exit code: 1" in both.stdout
    assert "fail       bad one/bad.design.toml: gain-bound refuted" in both.stdout
    assert "good" not in both.stdout.replace("bad one/", "")
    assert "other.toml" not in both.stdout
    shutil.rmtree(plant / "bad one")
    run(["git", "rm", "-rq", "--cached", "bad one"], plant)
    good = run(call, plant, PRE_COMMIT_HOME=tmp_path / "home")
    assert (good.returncode, "Passed" in good.stdout) == (0, True)


MARKED = """
import pytest

@pytest.mark.design("good.design.toml")
def test_good(): pass

@pytest.mark.design("good.design.toml", require=["graph-assumption"])
@pytest.mark.design("bad one/bad.design.toml", require=("graph-assumption", "perron-eigenvalues"))
def test_required(): pass

@pytest.mark.design("bad one/bad.design.toml")
@pytest.mark.design("missing.toml")
def test_bad(): raise SystemExit("the body must not run")

@pytest.mark.design("good.design.toml", require=["gain"])
def test_unknown_claim(): pass

@pytest.mark.design("good.design.toml", require="gain-bound")
def test_no_list(): pass

@pytest.mark.design()
def test_no_path(): pass

@pytest.mark.design("good.design.toml", required=["gain-bound"])
def test_misspelt(): pass

@pytest.mark.design("good.design.toml")
def test_own_failure(): assert 1 == 2
"""


def test_the_pytest_plugin(plant: Path) -> None:
    (plant / "test_plant.py").write_text(MARKED)
    call = [sys.executable, "-m", "pytest", "-q", "-rA", "--strict-markers", "-p", "no:cacheprovider", "-W", "error"]
    done = run([*call, "test_plant.py"], plant)
    assert done.returncode == 1, done.stderr
    outcomes = dict(
        reversed(line.split()[:2]) for line in done.stdout.splitlines() if re.match("(PASSED|FAILED|ERROR) ", line)
    )
    assert {name.split("::")[1]: outcome for name, outcome in outcomes.items()} == {
        "test_good": "PASSED",
        "test_required": "PASSED",
        "test_bad": "FAILED",
        "test_unknown_claim": "FAILED",
        "test_no_list": "FAILED",
        "test_no_path": "FAILED",
        "test_misspelt": "FAILED",
        "test_own_failure": "FAILED",
    }
    for words in (
        "bad.design.toml: gain-bound refuted: mu = ",
        "missing.toml: expected a file, got no such file",
        "require: expected claim ids, got 'gain'",
        "require: expected a list of claim ids, got 'gain-bound'",
        "expected one path and perhaps require=[...] and allow_outside=True",
        "assert 1 == 2",
    ):
        assert words in done.stdout
    assert "the body must not run" not in done.stdout


def test_the_plugin_is_an_entry_point_that_costs_nothing(checkout: Path) -> None:
    """pytest loads it in every run, so it imports nothing of the package."""
    assert (
        '[project.entry-points.pytest11]\nfomas_verify = "fomas_verify.pytest_plugin"\n'
        in (checkout / "pyproject.toml").read_text()
    )
    script = (
        "import pytest, sys; before = set(sys.modules); import fomas_verify.pytest_plugin;"
        "print(*sorted(set(sys.modules) - before))"
    )
    done = run([sys.executable, "-c", script], checkout)
    assert done.stdout.split() == ["fomas_verify", "fomas_verify.pytest_plugin"]
