"""`pendular_table.h` where it is hard to look: in WebAssembly, on a GPU, in threads, and with files that are damaged.

apt-get install -y --no-install-recommends clang lld wasi-libc libclang-rt-14-dev-wasm32 nodejs
"""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from benchmarks.c_header import WARNINGS, C, has_compiler

import pendular as pl
from table_reader import HEADERS, PLAIN, PROGRAMS, SEED, TABLES, WARNED, Reader, contacts_of, kernels_of

EXAMPLE = Path(__file__).parents[1] / "examples" / "wasm"
CLANG = ("clang", "-std=c99")
OWN_LIBRARIES = ("libclang_rt", "libasan", "-lasan", "-lubsan", "-ltsan", "libtsan", "'math.h' file not found")
WATCHED = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
ODD = np.array([np.nan, np.inf, -np.inf, 0.0, -1.0, 1e308, 5e-324])
needs_c = pytest.mark.skipif(not has_compiler(C), reason="gcc is not installed")
needs_node = pytest.mark.skipif(
    shutil.which("node") is None or shutil.which("wasm-ld") is None, reason="node, or wasm-ld of lld, is not installed"
)
needs_clang = pytest.mark.skipif(not has_compiler(CLANG), reason="clang is not installed")


@pytest.fixture(scope="module", params=TABLES)
def table(request):
    return pl.tabulate(**TABLES[request.param])


def built(command, *arguments):
    """Build a program; a compiler that lacks a library of its own skips the test, any other fault fails it."""
    done = subprocess.run([*command, *arguments], check=False, capture_output=True, text=True)
    if done.returncode != 0 and any(part in done.stderr for part in OWN_LIBRARIES):
        pytest.skip(f"{command[0]} lacks a library of its own: {done.stderr.strip().splitlines()[0]}")
    assert done.returncode == 0, done.stderr


# WebAssembly -------------------------------------------------------------------------------------------------------


@needs_clang
@needs_node
def test_webassembly_is_equal_to_the_kernels_to_the_last_bit(table, tmp_path):
    """A module that asks nothing of its host; of numbers that are none it says what a processor says."""
    exports = ",".join(f"--export={name}" for name in ("malloc", "size_of_table", "open_bytes", "ask"))
    command = (*CLANG, "--target=wasm32-wasi", "-mexec-model=reactor", f"-Wl,{exports}", "-O2", "-ffp-contract=off")
    module = ("-DPENDULAR_TABLE_NO_FILES", "-I", HEADERS, "-o", tmp_path / "a.wasm", PROGRAMS / "answers.c")
    built(command, *WARNED, *module)
    table.save(tmp_path / "w.bridges")
    whole = np.array(contacts_of(table, 1500))
    random = np.random.default_rng(SEED)
    contact = np.hstack([whole, np.where(random.random(whole.shape) < 0.2, random.choice(ODD, whole.shape), whole)])
    contact.tofile(tmp_path / "contacts")
    files = (tmp_path / name for name in ("a.wasm", "w.bridges", "contacts", "out"))
    subprocess.run(["node", PROGRAMS / "answers.mjs", *files, *map(str, PLAIN)], check=True)
    found = np.fromfile(tmp_path / "out").reshape(len(PLAIN), -1)
    reader = Reader(tmp_path, CLANG, ("-O2", "-ffp-contract=off"))
    opened = reader.open(tmp_path / "w.bridges")
    for answers, (asked, wanted) in zip(found, kernels_of(table, whole).items(), strict=True):
        assert np.array_equal(answers[:1500], wanted, equal_nan=True), asked
        assert np.array_equal(answers, reader.ask(opened, asked, contact), equal_nan=True), asked


@needs_clang
@needs_node
def test_the_example_in_webassembly_runs_as_it_says(tmp_path):
    table = pl.tabulate(**TABLES["two angles"])
    table.save(tmp_path / "w.bridges")
    command = (*CLANG, "--target=wasm32-wasi", "-mexec-model=reactor", "-O2", "-I", HEADERS)
    built(command, *WARNINGS, "-o", tmp_path / "bridge.wasm", EXAMPLE / "bridge.c")
    program = ["node", EXAMPLE / "bridge.mjs", tmp_path / "bridge.wasm"]
    done = subprocess.run([*program, tmp_path / "w.bridges"], check=True, capture_output=True, text=True)
    end, _, *rows = done.stdout.splitlines()
    contact = (14e3, 50e-6, 100e-6, 0.0728)
    assert float(end.split()[2]) == pytest.approx(table.rupture_distance(*contact), rel=1e-15)
    separation, force = np.array([row.split() for row in rows], float).T
    np.testing.assert_allclose(force, table.force(separation, *contact), rtol=1e-14)
    assert force[-1] == 0.0
    (tmp_path / "cut.bridges").write_bytes((tmp_path / "w.bridges").read_bytes()[:-1])
    refused = subprocess.run([*program, tmp_path / "cut.bridges"], check=False, capture_output=True, text=True)
    assert refused.returncode == 1
    assert "cut.bridges: it is shorter or longer than it says" in refused.stderr


# GPUs --------------------------------------------------------------------------------------------------------------

KERNEL = """#include "pendular_table.h"
__global__ void answers(pendular_table table, int asked, int count, const double *gap, double control, double *out)
{
    const int i = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count)
        out[i] = pendular_table_value(&table, asked, gap[i], control, 5e-5, 6e-5, 0.07);
}
pendular_table moved(const char *path, const void *device)
{
    pendular_table table;
    if (pendular_table_open(path, &table) != PENDULAR_TABLE_OK)
        return table;
    return pendular_table_moved(&table, device);
}
"""


@pytest.mark.skipif(shutil.which("nvcc") is None, reason="nvcc is not installed")
def test_cuda_compiles_the_evaluator_for_host_and_device(tmp_path):
    """Compiled, not run: no GPU is asked for."""
    (tmp_path / "main.cu").write_text(KERNEL)
    options = ("-Werror", "all-warnings", "-Wno-deprecated-gpu-targets", "-I", HEADERS)
    subprocess.run(["nvcc", *options, "-c", "main.cu"], cwd=tmp_path, check=True)
    subprocess.run(["nvcc", *options, "-fmad=false", "-ptx", "main.cu"], cwd=tmp_path, check=True)
    text = (tmp_path / "main.ptx").read_text()
    assert text.count(".entry") == 1
    assert ".extern .func" not in text, "calls what no GPU has"


# Threads -----------------------------------------------------------------------------------------------------------


@needs_c
@pytest.mark.parametrize("name", ["two angles", "volume"])
def test_threads_write_nothing_that_others_read(name, tmp_path):
    """With a compiler that watches all threads."""
    pl.tabulate(**TABLES[name]).save(tmp_path / "w.bridges")
    watched = ("-O1", "-g", "-fsanitize=thread", "-pthread", "-I", HEADERS)
    built(C, *watched, *WARNED, "-o", tmp_path / "threads", PROGRAMS / "threads.c", "-lm")
    done = subprocess.run([tmp_path / "threads", tmp_path / "w.bridges"], check=False, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert int(done.stdout.split()[0]) > 100


# Damaged files -----------------------------------------------------------------------------------------------------


@needs_c
@pytest.mark.parametrize(
    ("name", "mixes"),
    [
        ("two angles", 300),
        *(pytest.param(name, 20_000, marks=pytest.mark.long) for name in ("two angles", "volume", "dry")),
    ],
)
def test_damaged_files_are_never_read_beyond_their_end(name, mixes, tmp_path):
    """Each byte, each truncation, and wrong numbers under a right checksum, with a compiler that watches."""
    built(C, *WATCHED, *WARNED, "-I", HEADERS, "-o", tmp_path / "fuzz", PROGRAMS / "fuzz.c", "-lm")
    path = tmp_path / "w.bridges"
    pl.tabulate(**TABLES[name]).save(path)
    program = [tmp_path / "fuzz", path, str(SEED), str(mixes)]
    done = subprocess.run(program, check=False, capture_output=True, text=True)
    print(done.stdout)
    assert done.returncode == 0, done.stdout + done.stderr
    whole, cut, each_byte, sealed_bytes, mixed = done.stdout.splitlines()
    assert "no error" not in cut + each_byte
    assert all("no error" in line for line in (whole, sealed_bytes, mixed))


SMALL = {"contact_angle": 0.5, "reduced": (10.0, 10.1), "radius_ratio": (1.0, 1.01), "tolerance": 1e-2}


@needs_clang
@pytest.mark.parametrize("seconds", [4, pytest.param(60, marks=pytest.mark.long)])
def test_a_fuzzer_finds_no_bytes_that_do_harm(seconds, tmp_path):
    """With libFuzzer, which looks for bytes that reach new places of the reader, and a compiler that watches."""
    watched = ("-O1", "-g", "-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=all", "-I", HEADERS)
    built(CLANG, *watched, *WARNED, "-o", tmp_path / "fuzz", PROGRAMS / "fuzz_target.c", "-lm")
    (tmp_path / "seeds").mkdir()
    for name, angles in (("one", 0.5), ("two", (0.2, 0.6))):
        pl.tabulate(**SMALL | {"contact_angle": angles}).save(tmp_path / "seeds" / f"{name}.bridges")
    # no limit of memory: what the fuzzer takes for its own begins with that of the process that started it
    options = (
        "-rss_limit_mb=0",
        f"-max_total_time={seconds}",
        f"-seed={SEED}",
        "-print_final_stats=1",
        f"-artifact_prefix={tmp_path}/",
    )
    program = [tmp_path / "fuzz", *options, tmp_path / "seeds"]
    done = subprocess.run(program, check=False, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr[-3000:]
    (count,) = [int(line.split()[1]) for line in done.stderr.splitlines() if "number_of_executed_units" in line]
    print(f"seed {SEED}, {count} inputs")
    assert count > 100 * seconds


@needs_c
def test_without_files_it_needs_no_input_and_output(tmp_path):
    (tmp_path / "main.c").write_text(
        '#define PENDULAR_TABLE_NO_FILES\n#include "pendular_table.h"\n#ifdef EOF\n#error "stdio.h is there"\n#endif\n'
        "int answer(const void *bytes, size_t size, pendular_table *table);\n"
        "int answer(const void *bytes, size_t size, pendular_table *table)\n"
        "{\n    return pendular_table_view(bytes, size, table);\n}\n"
    )
    command = [*C, *WARNED, "-I", str(HEADERS), "-c", "-o", str(tmp_path / "main.o"), str(tmp_path / "main.c")]
    subprocess.run(command, check=True)
