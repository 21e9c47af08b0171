"""The public names: the package, a type checker and the reference see the same ones, and loading them costs nothing."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import pendular as pl

ROOT = Path(__file__).parents[1]


def test_each_is_there():
    for name in pl.__all__:
        assert getattr(pl, name) is not None
    assert set(pl.__all__) <= set(dir(pl))
    with pytest.raises(AttributeError):
        pl.no_such_name  # noqa: B018


def test_none_is_loaded_before_it_is_used():
    heavy = "{'numpy', 'numba', 'scipy', 'matplotlib'}"
    code = f"import sys, pendular; assert not {heavy} & set(sys.modules), sys.modules.keys()"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.long
@pytest.mark.needs("lint")
def test_a_type_checker_knows_each(tmp_path):
    from mypy import api

    path = tmp_path / "user.py"
    asked = [*(f"pl.{name}" for name in pl.__all__), 'pl.laws["zhao2020"]']
    path.write_text("import pendular as pl\n" + "".join(f"reveal_type({name})\n" for name in asked))
    out, err, _ = api.run(["--strict", "--config-file", str(ROOT / "pyproject.toml"), str(path)])
    told = re.findall(r':(\d+): note: Revealed type is "(.*)"', out)
    assert [int(line) - 2 for line, _ in told] == list(range(len(asked))), f"{out}{err}"
    types = dict(zip(asked, (told_type for _, told_type in told), strict=True))
    assert [name for name, told_type in types.items() if told_type in ("Any", "types.ModuleType")] == []
    assert ": error:" not in out
