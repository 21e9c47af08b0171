"""The four lines of the page on LAMMPS, in an empty folder and an environment with nothing in it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tools.code_blocks import code_blocks

import pendular as pl

ROOT = Path(__file__).parents[1]


@pytest.mark.long
@pytest.mark.skipif(shutil.which("g++") is None, reason="no g++ to build the plug-in: apt-get install g++")
def test_four_lines_put_exact_bridges_into_lammps_on_two_ranks(tmp_path):
    blocks = list(code_blocks((ROOT / "docs" / "lammps.md").read_text(encoding="utf-8")))
    install, *lines = next(block.code for block in blocks if block.language == "sh").splitlines()
    (text,) = [block.code for block in blocks if block.code.startswith("units si\natom_style sphere\nlattice")]
    (tmp_path / "in.wet").write_text(text)
    subprocess.run([sys.executable, "-m", "venv", tmp_path / "fresh"], check=True)
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "VIRTUAL_ENV"))}
    environment = clean | {"PATH": f"{tmp_path / 'fresh' / 'bin'}{os.pathsep}{os.environ['PATH']}"}

    def run(line):
        return subprocess.run(
            line, shell=True, cwd=tmp_path, env=environment, check=False, capture_output=True, text=True, timeout=1200
        )

    assert "'.[lammps]'" in install
    done = run(install.replace(".[lammps]", f"{ROOT}[lammps]"))
    if done.returncode != 0:
        pytest.skip(f"nothing can be installed here: {done.stderr.strip().splitlines()[-1]}")
    for line in [*lines, "mpiexec -n 2 lmp -in in.wet"]:
        done = run(line)
        assert done.returncode == 0, f"{line}\n{done.stdout}{done.stderr}"
    assert "on 2 procs" in done.stdout
    rows = [line.split() for line in (tmp_path / "bridges.txt").read_text().splitlines()]
    forces = np.array([row[3] for row in rows[-648:]], float)
    exact = pl.bridge(pl.Pair(50.05e-6, np.deg2rad(20)), 0.0, suction=10e3, liquid=pl.Liquid(surface_tension=0.0728))
    np.testing.assert_allclose(forces, float(exact.force), rtol=5e-6)  # six digits are written
