"""How long a bridge takes in the C library: ``python -m benchmarks.c_library``.

A program in C asks one bridge after another, as a particle code does, and counts the time of its own process.
"""

import subprocess
import tempfile
from pathlib import Path

import numpy as np

from pendular.codes.library.write import SHARED, STATIC, write

SEED = 19
PAIRS, REPEATS = 2000, 15
QUESTIONS = ("bridge", "bridge_near", "rupture")

_PROGRAM = """
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "pendular.h"

enum { pairs = %(pairs)d, repeats = %(repeats)d };

static pendular_pair pair[pairs];
static pendular_state state[pairs], end[pairs];
static double held[pairs], share[pairs];

int main(int count, char **words)
{
    const int control = atoi(words[1]);
    double least[3] = { 1.0, 1.0, 1.0 };
    int i, k, found = 0;
    (void)count;
    for (i = 0; i < pairs; ++i)
        if (scanf("%%lf %%lf %%lf %%lf %%lf %%lf %%lf", &pair[i].radius1, &pair[i].radius2, &pair[i].contact_angle1,
                &pair[i].contact_angle2, &pair[i].surface_tension, &held[i], &share[i]) != 7)
            return 1;
    for (k = 0; k < 3 * repeats; ++k) {
        clock_t start = clock();
        for (i = 0; i < pairs; ++i) {
            if (k %% 3 == 0)
                found += pendular_rupture(control, held[i], &pair[i], &end[i]) == PENDULAR_FOUND;
            else if (k %% 3 == 1)
                pendular_bridge(control, share[i] * end[i].separation, held[i], &pair[i], &state[i]);
            else
                pendular_bridge_near(control, (share[i] + 1e-3) * end[i].separation, held[i], &pair[i], &state[i]);
        }
        const double took = (double)(clock() - start) / CLOCKS_PER_SEC / pairs;
        least[k %% 3] = took < least[k %% 3] ? took : least[k %% 3];
    }
    printf("%%d %%.3f %%.3f %%.3f\\n", found / repeats, 1e6 * least[1], 1e6 * least[2], 1e6 * least[0]);
    return 0;
}
"""


def questions(control: str) -> str:
    """Random pairs of grains, of which the larger is at most three times the smaller, a line each."""
    random = np.random.default_rng(SEED)
    small, ratio = 10.0 ** random.uniform(-6, -3, PAIRS), random.uniform(1.0, 3.0, PAIRS)
    angle, tension = random.uniform(0.0, 1.0, PAIRS), np.full(PAIRS, 0.0728)
    mean = 2.0 * small * ratio / (1.0 + ratio)
    star = 10.0 ** random.uniform(-4.0, -1.0, PAIRS) if control == "volume" else 10.0 ** random.uniform(0.0, 3.0, PAIRS)
    held = star * mean**3 if control == "volume" else star * tension / mean
    columns = (small, small * ratio, angle, angle, tension, held, random.uniform(0.0, 0.95, PAIRS))
    return "\n".join(" ".join(map(repr, map(float, row))) for row in zip(*columns, strict=True))


def main() -> None:
    """Print the microseconds of a call under both controls."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        written = {path.name: path.stat().st_size for path in write(folder)}
        (folder / "main.c").write_text(_PROGRAM % {"pairs": PAIRS, "repeats": REPEATS}, encoding="utf-8")
        command = ["gcc", "-O2", "-o", "main", "main.c", STATIC, "-lm"]
        subprocess.run(command, cwd=folder, check=True)
        sizes = ", ".join(f"{file} {written[file] / 1e3:.0f} kB" for file in (STATIC, SHARED) if file in written)
        print(f"{PAIRS} random pairs, seed {SEED}, one thread; microseconds a call, the least of {REPEATS}; {sizes}")
        for code, control in enumerate(("suction", "volume")):
            program = [folder / "main", str(code)]
            told = subprocess.run(program, input=questions(control), check=True, capture_output=True, text=True)
            found, *times = told.stdout.split()
            each = "   ".join(f"{question} {time}" for question, time in zip(QUESTIONS, times, strict=True))
            print(f"{control:8s} {found} of {PAIRS} break   {each}")


if __name__ == "__main__":
    main()
