"""The udev rule: shown, installed, and why it cannot be."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from servodeck.cli import main
from servodeck.cli.main import app
from servodeck.port.hid import UDEV_RULE


@pytest.fixture
def rule_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    file = tmp_path / "70-servodeck.rules"
    monkeypatch.setattr(main, "RULE_FILE", file)
    monkeypatch.setattr(main, "UDEV_COMMANDS", (("true",),))
    return file


def run(*options: str) -> Result:
    return CliRunner().invoke(app, ["udev-rule", *options])


def test_the_rule_alone_is_shown_so_that_it_can_be_piped(rule_file: Path) -> None:
    assert run().stdout == f"{UDEV_RULE}\n"
    assert 'ATTRS{idVendor}=="0483", ATTRS{idProduct}=="5750"' in UDEV_RULE
    assert not rule_file.exists()


def test_it_is_installed_and_says_what_to_do_next(rule_file: Path) -> None:
    result = run("--install")
    assert "Plug the board's cable in again." in result.stdout
    assert rule_file.read_text() == f"{UDEV_RULE}\n"


def test_without_rights_it_names_sudo(rule_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(Path, "write_text", refuse)
    result = run("--install")
    assert result.exit_code == 1
    assert "with sudo" in result.stderr


@pytest.mark.parametrize("program", ["false", "no-such-program"])
def test_where_udev_does_not_take_it_that_is_said(
    rule_file: Path, monkeypatch: pytest.MonkeyPatch, program: str
) -> None:
    monkeypatch.setattr(main, "UDEV_COMMANDS", ((program,),))
    result = run("--install")
    assert result.exit_code == 1
    assert "udev does not take the rule" in result.stderr
