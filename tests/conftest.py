"""What tests of several files need."""

import pytest

from pendular.front.cli import main


@pytest.fixture
def run(capsys):
    """Run the command in this process; returns its exit status, output and errors."""

    def run_with(*arguments: object) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as end:
            main([*map(str, arguments)])
        return (end.value.code, *capsys.readouterr())

    return run_with


@pytest.fixture(scope="session")
def liggghts(tmp_path_factory):
    """LIGGGHTS with the cohesion model."""
    from in_liggghts import built

    return built(tmp_path_factory.mktemp("model"))
