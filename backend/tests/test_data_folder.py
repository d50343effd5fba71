"""Each system keeps a user's data elsewhere."""

import sys
from pathlib import Path

import pytest

from servodeck.cli.options import data_folder


@pytest.mark.parametrize(
    ("platform", "variables", "folder"),
    [
        ("linux", {}, "home/.local/share/servodeck"),
        ("linux", {"XDG_DATA_HOME": "elsewhere"}, "elsewhere/servodeck"),
        ("darwin", {"XDG_DATA_HOME": "elsewhere"}, "home/Library/Application Support/Servodeck"),
        ("win32", {}, "home/AppData/Local/Servodeck"),
        ("win32", {"LOCALAPPDATA": "local"}, "local/Servodeck"),
    ],
)
def test_where_a_system_wants_it(
    monkeypatch: pytest.MonkeyPatch, platform: str, variables: dict[str, str], folder: str
) -> None:
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setattr(Path, "home", lambda: Path("home"))
    for name in ("XDG_DATA_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert data_folder() == Path(folder)
