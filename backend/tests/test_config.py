"""Flags, variables, files and defaults as a person meets them: through the command line."""

import tomllib
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner, Result

from servodeck.cli import options
from servodeck.cli.main import app
from servodeck.cli.options import Setting, toml_line

NOWHERE = Path("/nowhere")


@pytest.fixture(autouse=True)
def no_files(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The account that runs the tests may have settings."""
    monkeypatch.setattr(options, "SYSTEM_FILE", tmp_path / "etc" / options.FILE)
    monkeypatch.setattr(options, "config_folder", lambda: tmp_path / "home")


def show(*arguments: str, **variables: str) -> Result:
    return CliRunner().invoke(app, ["config", *arguments], env=variables)


def line_of(result: Result, name: str) -> str:
    (line,) = [line for line in result.stdout.splitlines() if line.startswith(f"{name} =")]
    return line


def write(path: Path, text: str) -> str:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return str(path)


def test_a_flag_beats_a_variable_beats_a_file_beats_the_default(tmp_path: Path) -> None:
    file = write(tmp_path / "some.toml", 'listen = "127.0.0.1:3"')
    flag, variable = "--listen=127.0.0.1:1", {"SERVODECK_LISTEN": "127.0.0.1:2"}
    assert line_of(show(flag, "--config", file, **variable), "listen") == 'listen = "127.0.0.1:1"  # --listen'
    assert line_of(show("--config", file, **variable), "listen") == (
        'listen = "127.0.0.1:2"  # SERVODECK_LISTEN'
    )
    assert line_of(show("--config", file), "listen") == f'listen = "127.0.0.1:3"  # {file}'
    assert line_of(show(), "listen") == 'listen = ""  # default'


@pytest.mark.parametrize(
    ("arguments", "variables", "text"),
    [
        (("--open",), {}, ""),
        ((), {"SERVODECK_OPEN": "1"}, ""),
        ((), {}, "open = true"),
    ],
)
def test_switches_come_from_everywhere_too(
    arguments: Sequence[str], variables: dict[str, str], text: str, tmp_path: Path
) -> None:
    file = write(tmp_path / "some.toml", text)
    assert line_of(show(*arguments, "--config", file, **variables), "open").startswith("open = true")


def test_the_file_of_the_user_goes_before_that_of_the_system(tmp_path: Path) -> None:
    of_system = write(tmp_path / "etc" / options.FILE, 'board = "lsc-6"')
    assert line_of(show(), "board") == f'board = "lsc-6"  # {of_system}'
    of_user = write(tmp_path / "home" / options.FILE, 'board = "xarm"')
    assert line_of(show(), "board") == f'board = "xarm"  # {of_user}'


def test_a_variable_may_name_the_file(tmp_path: Path) -> None:
    file = write(tmp_path / "some.toml", 'serial = "/dev/ttyUSB3"')
    assert line_of(show(SERVODECK_CONFIG=file), "serial") == f'serial = "/dev/ttyUSB3"  # {file}'


@pytest.mark.parametrize("command", ["config", "serve"])
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("lisen = 'x'", "lisen is no option. Did you mean listen?"),
        ("config = 'x'", "config is no option."),
        ("open_page = true", "open_page is no option."),
        ("serial = ['a', 'b']", "serial takes one value"),
        ("camera = [1]", "camera takes a text, or a list of texts"),
        ("serial = ", "is no TOML file"),
        ("open = 'perhaps'", "'--open'"),
    ],
)
def test_what_a_file_cannot_say_is_an_error_that_names_it(
    command: str, text: str, message: str, tmp_path: Path
) -> None:
    file = write(tmp_path / "some.toml", text)
    result = CliRunner().invoke(app, [command, "--config", file])
    assert result.exit_code == 2
    assert message in result.stderr


def test_a_variable_that_is_no_option_is_an_error_that_names_it() -> None:
    result = show(SERVODECK_LISTN="127.0.0.1:1")
    assert result.exit_code == 2
    assert "SERVODECK_LISTN is no option. Did you mean SERVODECK_LISTEN?" in result.stderr


def test_a_file_that_is_named_has_to_be_there() -> None:
    result = show("--config", str(NOWHERE))
    assert result.exit_code == 2
    assert "cannot be read" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "text", "cameras"),
    [
        (("--camera", "A=http://a/", "--camera", "B=http://b/"), "", ["A=http://a/", "B=http://b/"]),
        ((), 'camera = "Front door=http://a/"', ["Front door=http://a/"]),
        ((), 'camera = ["A=http://a/", "B=http://b/"]', ["A=http://a/", "B=http://b/"]),
    ],
)
def test_an_option_that_is_repeated_is_a_list_in_a_file(
    arguments: Sequence[str], text: str, cameras: list[str], tmp_path: Path
) -> None:
    file = write(tmp_path / "some.toml", text)
    shown = show(*arguments, "--config", file).stdout
    assert tomllib.loads(shown)["camera"] == cameras


def test_the_output_can_be_saved_as_a_file(tmp_path: Path) -> None:
    shown = show("--serial", "/dev/ttyUSB1", "--open").stdout
    file = write(tmp_path / "stored.toml", shown)
    again = show("--config", file).stdout
    assert tomllib.loads(again) == tomllib.loads(shown)


@given(st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\x7f")))
def test_every_text_survives_as_a_line_of_a_file(value: str) -> None:
    assert tomllib.loads(toml_line(Setting("name", value, "default"))) == {"name": value}


@pytest.mark.parametrize(
    ("option", "address", "shown"),
    [
        ("camera", "Bench=http://user:word@camera.local:81/stream", "Bench=http://***@camera.local:81/***"),
        ("camera", "Bench=http://camera.local/s?pwd=word", "Bench=http://camera.local/***"),
        ("camera", "Bench=http://camera.local?pwd=word", "Bench=http://camera.local/***"),
        ("camera", "Bench=http://word@camera.local/", "Bench=http://***@camera.local/"),
        ("camera", "Bench=http://user:wo@rd/?#@camera.local", "Bench=http://***@camera.local"),
        ("notify", "https://hook.example/word", "https://hook.example/***"),
        ("notify", "https://hook.example?token=word", "https://hook.example/***"),
        ("notify", "ntfy://word@ntfy.sh/word", "ntfy://***@ntfy.sh/***"),
    ],
)
def test_of_an_address_only_its_host_is_printed(option: str, address: str, shown: str) -> None:
    printed = show(f"--{option}", address)
    assert printed.exit_code == 0, printed.output
    assert tomllib.loads(printed.stdout)[option] == [shown]


@pytest.mark.parametrize("option", ["mqtt", "fleet"])
def test_of_a_broker_the_user_s_name_is_printed_too(option: str) -> None:
    for user, shown in (("arm-1:word@", "arm-1:***@"), ("arm-1@", "arm-1@"), ("", "")):
        printed = show(f"--{option}", f"mqtts://{user}broker.local:8883", "--fleet-password", "word")
        assert tomllib.loads(printed.stdout)[option] == f"mqtts://{shown}broker.local:8883"
        assert "word" not in printed.stdout.replace("password", "")
