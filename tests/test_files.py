"""A file under its final name is whole, and a place that cannot be read or written is told in one line."""

import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

import pendular as pl
from pendular.codes.yade import read_points, read_table
from pendular.front.cli import main
from pendular.ground.files import alone, whole

GRAINS = ("--radius", "50um", "--contact-angle", "20", "--suction", "20kPa")
FULL = pytest.mark.skipif(not Path("/dev/full").exists(), reason="/dev/full is not there on this system")


def test_what_is_interrupted_leaves_what_was_there(tmp_path):
    path = tmp_path / "table.txt"
    path.write_text("before")

    def write():
        with whole(path) as draft:
            draft.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write()
    assert [(entry.name, entry.read_text()) for entry in tmp_path.iterdir()] == [("table.txt", "before")]


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "link.txt").symlink_to("table.txt")
    for text in ("first", "second"):
        with whole(tmp_path / "link.txt") as draft:
            assert draft.suffix == ".txt"
            draft.write_text(text)
        assert (tmp_path / "table.txt").read_text() == text
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["link.txt", "table.txt"]
    assert (tmp_path / "link.txt").is_symlink()


@FULL
def test_a_device_is_not_replaced():
    def write():
        with whole(Path("/dev/full")) as place:
            place.write_text("text")

    with pytest.raises(OSError, match="No space left on device"):
        write()
    assert Path("/dev/full").is_char_device()


# -- one process at a time ---------------------------------------------------------------------------------------------

HOLDER = """
import sys, time
from pathlib import Path
from pendular.ground.files import alone
with alone(Path(sys.argv[1]), sys.argv[2], 60.0):
    print("held", flush=True)
    time.sleep(float(sys.argv[3]))
    Path(sys.argv[1]).with_name("done").touch()
"""


@pytest.fixture
def holder(tmp_path):
    """Start a process that holds a task for so many seconds."""
    started = []

    def hold(task, seconds):
        command = [sys.executable, "-c", HOLDER, str(tmp_path / "locks"), task, str(seconds)]
        started.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        assert started[-1].stdout.readline() == "held\n"
        return started[-1]

    yield hold
    for process in started:
        process.kill()
        process.communicate()


def seconds_to_pass(tmp_path, task, patience=60.0):
    begin = time.monotonic()
    with alone(tmp_path / "locks", task, patience):
        return time.monotonic() - begin


def test_a_process_waits_for_another_at_the_same_task(holder, tmp_path):
    holder("one", 1.0)
    seconds_to_pass(tmp_path, "one")
    assert (tmp_path / "done").exists()


def test_it_does_not_wait_for_another_task(holder, tmp_path):
    holder("one", 100.0)
    assert seconds_to_pass(tmp_path, "another") < 30.0


def test_a_process_that_is_killed_holds_nothing(holder, tmp_path):
    process = holder("one", 100.0)
    process.kill()
    process.wait()
    assert seconds_to_pass(tmp_path, "one") < 30.0


def test_patience_ends(holder, tmp_path):
    process = holder("one", 100.0)
    assert seconds_to_pass(tmp_path, "one", patience=0.2) >= 0.2
    assert process.poll() is None


def test_where_nothing_can_be_locked_all_pass(tmp_path):
    (tmp_path / "file").touch()
    with alone(tmp_path / "file" / "locks", "one", 60.0):
        pass


# -- every command that writes a file --------------------------------------------------------------------------------

WRITERS = {
    "bridge": ("bridge", *GRAINS, "--separation", "1um", "--plot", "out.svg"),
    "compare": ("compare", *GRAINS, "--plot", "out.svg"),
    "pair-table": ("export", "pair-table", *GRAINS, "--out", "out.svg"),
    "c": (
        *("export", "c", "--contact-angle", "20", "--reduced-suction", "20", "30", "--radius-ratio", "1", "1"),
        *("--tolerance", "1e-5", "--out", "out.svg"),
    ),
}


def ended(arguments, capsys):
    """Exit status and what was said of the failure."""
    with pytest.raises(SystemExit) as end:
        main(list(arguments))
    return end.value.code, capsys.readouterr().err


@pytest.mark.parametrize("name", WRITERS)
def test_a_command_leaves_its_file_or_nothing(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert ended(WRITERS[name], capsys) == (0, "")
    assert [entry.name for entry in tmp_path.iterdir()] == ["out.svg"]
    (tmp_path / "out.svg").unlink()
    (tmp_path / "out.svg").mkdir()
    status, told = ended(WRITERS[name], capsys)
    assert status > 0
    assert re.fullmatch(r"pendular: (plot|out): 'out.svg' cannot be written: Is a directory\n", told)
    assert [entry.name for entry in tmp_path.iterdir()] == ["out.svg"]


@FULL
@pytest.mark.parametrize("name", WRITERS)
def test_a_command_tells_of_a_full_disk(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out.svg").symlink_to("/dev/full")
    status, told = ended(WRITERS[name], capsys)
    assert status > 0
    assert re.fullmatch(r"pendular: (plot|out): 'out.svg' cannot be written: No space left on device\n", told)


@pytest.mark.parametrize("command", [("export", "yade", "--contact-angle", "20"), ("paper",)])
def test_a_folder_that_cannot_be_made(command, tmp_path, capsys):
    (tmp_path / "file").touch()
    status, told = ended((*command, "--out", str(tmp_path / "file" / "out")), capsys)
    assert status > 0
    assert re.fullmatch(r"pendular: out: '.*' cannot be written to: Not a directory\n", told.splitlines(True)[-1])


# -- the output of a command -----------------------------------------------------------------------------------------


def run_into(output, *arguments):
    code = "import sys; from pendular.front.cli import main; main(sys.argv[1:])"
    return subprocess.run(
        [sys.executable, "-c", code, *arguments], stdout=output, stderr=subprocess.PIPE, text=True, check=False
    )


@FULL
@pytest.mark.parametrize(
    "arguments", [("--help",), ("laws", "willett2000"), ("rupture", *GRAINS), ("rupture", *GRAINS, "--csv")]
)
def test_output_to_a_full_disk(arguments):
    with open("/dev/full", "w") as full:
        done = run_into(full, *arguments)
    assert (done.returncode, done.stderr) == (1, "pendular: output: No space left on device\n")


def test_a_reader_that_has_enough():
    reader, writer = os.pipe()
    os.close(reader)
    done = run_into(writer, "laws", "willett2000")
    os.close(writer)
    assert (done.returncode, done.stderr) == (1, "")


# -- files that cannot be read ---------------------------------------------------------------------------------------


@pytest.fixture
def unreadable(tmp_path):
    """A file that is there, and whose first byte cannot be read by anyone."""
    path = tmp_path / "M(r=1)"
    path.symlink_to("/proc/self/mem")
    if not path.is_file():
        pytest.skip("/proc is not there on this system")
    return path


def test_an_unreadable_file_of_yade(unreadable, capsys):
    for read in (read_table, read_points):
        with pytest.raises(ValueError, match=r"^path: '.*' cannot be read: Input/output error$"):
            read(unreadable)
    status, told = ended(("export", "yade", "--check", str(unreadable.parent)), capsys)
    assert status > 0
    assert told == f"pendular: check: '{unreadable}' cannot be read: Input/output error\n"


def test_an_unreadable_table(unreadable):
    with pytest.raises(ValueError, match=r"^path: '.*' cannot be read: Input/output error$"):
        pl.load_table(unreadable)


def test_points_that_are_no_numbers(tmp_path):
    path = tmp_path / "capillaryfile.txt"
    path.write_text(" ".join(["0", *["x"] * 9]))
    with pytest.raises(ValueError, match=r"^capillaryfile.txt: could not convert string to float: 'x'$"):
        read_points(path)


def test_a_table_in_no_folder(tmp_path):
    table = pl.tabulate(0.3, reduced=(20.0, 30.0), radius_ratio=(1, 1), tolerance=1e-5)
    with pytest.raises(ValueError, match=r"^path: '.*' cannot be written: No such file or directory$"):
        table.save(tmp_path / "none" / "table")
