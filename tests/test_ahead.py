"""Machine code made ahead of time, by the command and in the background."""

import subprocess
import sys

import numpy as np
import pytest

from pendular.exact import branch
from pendular.exact.equations import SUCTION
from pendular.front import ahead
from pendular.front.cli import main
from pendular.ground import background, native, rows


@pytest.mark.needs("numba")
@pytest.mark.long  # compiles all that is not in the cache
def test_all_entries_are_made_ahead():
    names = set()
    assert list(ahead.compile_ahead(lambda made: names.add(made.name))) == list(ahead.QUESTIONS)
    entries = {f"{function.__module__.removeprefix('pendular.')}.{function.__name__}" for function in rows.ENTRIES}
    ours = {
        name for name in entries if name.partition(".")[0] in ("ask", "dataset", "exact", "laws", "packing", "table")
    }
    assert ours <= names
    assert rows._always == []


def test_rows_that_are_not_foretold_are_left_to_the_whole_solver():
    rupture, values, is_open = np.empty(1), np.empty((1, 2, 2)), np.zeros(1, bool)
    q, room = np.array([0.1, 0.5]), np.empty((2, 4))
    branch.foretold_range(SUCTION, False, ahead._NOT_FORETOLD, q, rupture, values, is_open, room, 0, 1)
    assert is_open[0]


@pytest.mark.needs("numba")
def test_the_command_tells_what_it_makes_and_where(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(ahead, "QUESTIONS", {"one": lambda: rows._always[-1](branch.foretold_range, 2.5)})
    monkeypatch.setenv("PENDULAR_CACHE_DIR", str(tmp_path))  # restored afterwards
    native.folder.cache_clear()
    with pytest.raises(SystemExit) as left:
        main(["compile", "--folder", str(tmp_path / "code")])
    native.folder.cache_clear()
    assert left.value.code == 0
    first, last = capsys.readouterr().out.splitlines()
    assert first.split() == ["exact.branch.foretold_range", "2.5", "s"]
    assert last.startswith(f"0 files, 0.0 MB, in {tmp_path / 'code'}, after")


@pytest.mark.needs("numba")
def test_a_folder_that_cannot_be_made_is_refused(tmp_path, capsys):
    (tmp_path / "file").touch()
    with pytest.raises(SystemExit) as left:
        main(["compile", "--folder", str(tmp_path / "file" / "code")])
    assert left.value.code == 2
    assert capsys.readouterr().err.startswith("pendular: folder: ")


# -- in the background ---------------------------------------------------------------------------------------------


@pytest.fixture
def started(tmp_path, monkeypatch):
    """Processes that would be started, by a person at a terminal."""
    commands = []
    monkeypatch.setattr(subprocess, "Popen", lambda command, **_: commands.append(command))
    monkeypatch.setattr(background, "_is_watched", lambda: True)
    monkeypatch.setattr(native, "folder", lambda: tmp_path / "kept")
    monkeypatch.delenv("PENDULAR_BACKGROUND", raising=False)
    background.compile_all.cache_clear()
    yield commands
    background.compile_all.cache_clear()


def test_one_process_is_started_once(started, tmp_path):
    background.compile_all()
    background.compile_all()
    background.compile_all.cache_clear()  # another process
    background.compile_all()
    assert len(started) == 1
    assert (tmp_path / "kept" / background.LOCK).exists()


def test_a_lock_of_a_process_that_was_killed_does_not_hold_for_ever(started, monkeypatch):
    background.compile_all()
    monkeypatch.setattr(background, "_LONGEST", -1.0)
    background.compile_all.cache_clear()
    background.compile_all()
    assert len(started) == 2


def test_a_variable_switches_it_off(started, monkeypatch):
    monkeypatch.setenv("PENDULAR_BACKGROUND", "0")
    background.compile_all()
    assert not started


def test_only_who_watches_starts_it(monkeypatch):
    monkeypatch.delattr(sys, "ps1", raising=False)
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.setattr(sys, "stderr", None)
    assert not background._is_watched()
    monkeypatch.setattr(sys, "ps1", ">>> ", raising=False)
    assert background._is_watched()
    monkeypatch.setenv("CI", "true")
    assert not background._is_watched()


def test_the_process_in_the_background_frees_the_lock(tmp_path):
    """Its command, with a stand-in for what it makes."""
    lock = tmp_path / background.LOCK
    lock.touch()
    made = "import pendular.front.ahead as ahead; ahead.QUESTIONS.clear()\n"
    subprocess.run([sys.executable, "-c", made + background._COMMAND, str(lock)], check=True)
    assert not lock.exists()
