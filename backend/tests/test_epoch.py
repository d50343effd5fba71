"""The count of starts on disk, and what happens where it cannot be written."""

import os
from pathlib import Path

import pytest

from servodeck.robot.driving import GRANTS_PER_START, first_epoch


def test_each_start_counts_on_from_above_all_before_it(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    assert [first_epoch(folder) for _ in range(3)] == [start * GRANTS_PER_START for start in (1, 2, 3)]
    assert [file.name for file in folder.iterdir()] == ["epoch"]


@pytest.mark.parametrize("text", ["", "seven", "-3", "\x00"])
def test_a_damaged_count_begins_anew(tmp_path: Path, text: str) -> None:
    (tmp_path / "epoch").write_text(text)
    assert first_epoch(tmp_path) == GRANTS_PER_START


def test_an_unwritable_folder_is_no_error() -> None:
    assert first_epoch(Path(os.devnull) / "none") == GRANTS_PER_START
