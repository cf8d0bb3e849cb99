"""Graph files that a stranger's design names: no way out of its folder, and nothing in them is run."""

import os
import pickle
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
import scipy.io

pytestmark = pytest.mark.slow

DESIGN = "alpha = 0.9\nmu = 0.1\n[graph]\nfile = {}\norientation = 'hears'\n"
SECRET = "0,1\n1,0\n"


def prove(folder: Path, name: str) -> subprocess.CompletedProcess[str]:
    (folder / "x.toml").write_text(DESIGN.format(f"'{name}'"))
    return subprocess.run(
        [sys.executable, "-m", "fomas_verify", "prove", "x.toml"],
        cwd=folder,
        env={**os.environ, "HOME": str(folder.parent)},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "secret.csv").write_text(SECRET)
    inside = tmp_path / "designs"
    (inside / "sub").mkdir(parents=True)
    (inside / "sub" / "up").symlink_to("../..")
    (inside / "link.csv").symlink_to(tmp_path / "secret.csv")
    (inside / "chain.csv").symlink_to("link.csv")
    return inside


@pytest.mark.parametrize(
    "name",
    [
        "../secret.csv",
        "sub/../../secret.csv",
        "sub/up/secret.csv",
        "./././../secret.csv",
        "link.csv",
        "chain.csv",
        "../designs-of-others/secret.csv",
        "/etc/passwd.csv",
        "/proc/self/cwd/../secret.csv",
        "//etc/x.csv",
    ],
)
def test_no_way_out_of_the_folder(folder: Path, name: str) -> None:
    """Whether or not the file exists: what lies outside is not even looked for."""
    done = prove(folder, name)
    assert done.returncode == 2
    assert "expected a file in the folder of the design" in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "name",
    ["~/secret.csv", "$HOME/secret.csv", "file:///etc/passwd.csv", "http://localhost:1/x.csv", "..\\\\secret.csv"],
)
def test_a_name_is_a_name(folder: Path, name: str) -> None:
    """Nothing is expanded, and no address is followed."""
    done = prove(folder, name)
    assert done.returncode == 2
    assert "no such file" in done.stderr


class Harm:
    """Runs a command where it is unpickled."""

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return os.system, ("touch ran",)


def test_nothing_in_a_graph_file_is_run(folder: Path) -> None:
    harm = np.array([[Harm(), Harm()], [Harm(), Harm()]], dtype=object)
    np.savez(folder / "a.npz", A=harm)
    np.savez(folder / "b.npz", format=harm, shape=harm, data=harm, indices=harm, indptr=harm)
    with zipfile.ZipFile(folder / "c.npz", "w") as archive:
        archive.writestr("A.npy", pickle.dumps(Harm()))
    scipy.io.savemat(folder / "d.mat", {"A": np.array([["x", "y"], ["z", "w"]], dtype=object)})
    (folder / "e.mat").write_bytes(pickle.dumps(Harm()))
    text = "__import__('os').system('touch ran')"
    (folder / "f.edgelist").write_text(f"1 2 {{'weight': {text}}}\n2 1 {{'weight': 1}}\n")
    (folder / "g.csv").write_text(f"0,{text}\n=cmd,0\n")
    for path in sorted(folder.glob("*.[cemn]*")):
        if path.suffix != ".toml" and not path.is_symlink():
            done = prove(folder, path.name)
            assert done.returncode == 2, path.name
            assert done.stderr.count("\n") == 1, done.stderr
    assert list(folder.parent.rglob("ran")) == []


def test_the_harm_would_be_done_by_a_pickle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The trap is live: loading it the wrong way runs it."""
    monkeypatch.chdir(tmp_path)
    pickle.loads(pickle.dumps(Harm()))
    assert (tmp_path / "ran").exists()
