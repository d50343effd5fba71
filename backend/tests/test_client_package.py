"""servodeck-client, the package for TypeScript and JavaScript, as a person who installed it uses it: each
program in its README and in docs/scripts.md runs with Node on a simulated board, and passes the type checker.
"""

import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, Run, ServoTarget
from tests.served_robot import Served, served
from tests.test_with_simulator import ROOT, Board, board, pytestmark

pytestmark = [
    *pytestmark,
    pytest.mark.exhaustive,
    pytest.mark.skipif(shutil.which("npm") is None, reason="npm is not installed"),
]
fixtures = (board,)
PIECE = re.compile(r"^```js\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SOURCES = ("shared/src/client/README.md", "docs/scripts.md")
PLACE = "http://127.0.0.1:8300"
TSC = ROOT / "node_modules" / "typescript" / "bin" / "tsc"
DOC = FAMILIES["doc"]


def run(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with nothing but the package."""
    folder = tmp_path_factory.mktemp("program")
    run("node", "scripts/client_package.mjs", folder, cwd=ROOT)
    (package,) = folder.glob("servodeck-client-*.tgz")
    (folder / "package.json").write_text('{"private": true}')
    run("npm", "install", "--offline", "--no-audit", "--no-fund", f"./{package.name}", cwd=folder)
    return folder


@pytest.fixture
def here(board: Board, tmp_path: Path) -> Iterator[Served]:
    with served(tmp_path, device=str(board.link)) as made:
        yield made


def programs() -> list[str]:
    return [piece for source in SOURCES for piece in PIECE.findall((ROOT / source).read_text("utf-8"))]


def test_the_package_is_what_it_says_and_needs_no_other(installed: Path) -> None:
    package = installed / "node_modules" / "servodeck-client"
    about = json.loads((package / "package.json").read_text("utf-8"))
    project = json.loads((ROOT / "package.json").read_text("utf-8"))
    assert [about[key] for key in ("version", "license")] == [project["version"], project["license"]]
    assert "dependencies" not in about
    assert {path.name for path in package.iterdir()} == {
        *("package.json", "README.md", "LICENSE", "servodeck.js", "types")
    }
    assert [path.name for path in package.parent.iterdir() if not path.name.startswith(".")] == [package.name]


def test_its_programs_run_as_they_stand(installed: Path, here: Served, board: Board) -> None:
    for number, program in enumerate(programs()):
        file = installed / f"program{number}.mjs"
        file.write_text(program.replace(PLACE, here.url))
        run("node", file, cwd=installed)
    got = bytes(byte for _, byte in board.taken())
    assert encode(Move(1500, (ServoTarget(1, 1800),)), DOC) in got
    assert encode(Run(7, 2), DOC) in got


def test_its_programs_pass_the_strict_type_checker_and_wrong_units_do_not(installed: Path) -> None:
    files = [installed / f"typed{number}.mts" for number, _ in enumerate(programs())]
    for file, program in zip(files, programs(), strict=True):
        file.write_text(program)
    strict = ("--strict", "--noEmit", "--target", "es2022", "--module", "nodenext")
    run("node", TSC, *strict, *files, cwd=installed)
    files[0].write_text(programs()[0].replace("'deg'", "'degrees'"))
    with pytest.raises(AssertionError, match="'\"degrees\"' is not assignable to type 'Units'"):
        run("node", TSC, *strict, files[0], cwd=installed)
