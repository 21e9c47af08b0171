"""How long a bridge takes in the C library: ``python -m benchmarks.c_library`` writes it into docs/speed.md.

A program in C asks one bridge after another, as a particle code does, then all of them in rows, and counts the time of
its own process. Its rival is Willett's law in C, the program's own.
"""

import subprocess
import tempfile
from pathlib import Path

import numpy as np
from tools.law_in_c import source

from benchmarks.sections import machine, put
from pendular.codes.library.write import STATIC, write
from pendular.laws import laws

SEED = 19
PAIRS, REPEATS = 2000, 15
QUESTIONS = ("rupture", "bridge", "bridge near", "ruptures, in rows", "bridges, in rows", "bridges near, in rows")
RIVALS = {"suction": "zhao2020", "volume": "willett2000"}

_PROGRAM = """
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "pendular.h"

enum { pairs = %(pairs)d, repeats = %(repeats)d, questions = %(questions)d };

static pendular_pair pair[pairs];
static pendular_state state[pairs], end[pairs];
static double held[pairs], share[pairs], gap[pairs], further[pairs];
static double given[pairs][5];
static int statuses[pairs];
static double sum;

static void ask(int question, int control)
{
    int i;
    if (question == 3)
        pendular_ruptures(control, pairs, held, pair, end, statuses);
    else if (question == 4)
        pendular_bridges(control, pairs, gap, held, pair, state, statuses);
    else if (question == 5)
        pendular_bridges_near(control, pairs, further, held, pair, state, statuses);
    else
        for (i = 0; i < pairs; ++i)
            if (question == 0)
                pendular_rupture(control, held[i], &pair[i], &end[i]);
            else if (question == 1)
                pendular_bridge(control, gap[i], held[i], &pair[i], &state[i]);
            else if (question == 2)
                pendular_bridge_near(control, further[i], held[i], &pair[i], &state[i]);
            else
                sum += %(rival)s(given[i][0], given[i][1], given[i][2], given[i][2], given[i][3], given[i][4]);
}

int main(int count, char **words)
{
    const int control = atoi(words[1]);
    double least[questions + 1];
    int i, k;
    (void)count;
    for (i = 0; i < pairs; ++i)
        if (scanf("%%lf %%lf %%lf %%lf %%lf %%lf %%lf", &pair[i].radius1, &pair[i].radius2, &pair[i].contact_angle1,
                &pair[i].contact_angle2, &pair[i].surface_tension, &held[i], &share[i]) != 7)
            return 1;
    ask(0, control);
    for (i = 0; i < pairs; ++i) {
        const pendular_pair p = pair[i];
        const double mean = 2.0 / (1.0 / p.radius1 + 1.0 / p.radius2);
        if (!(end[i].separation > 0.0))
            return 2;
        gap[i] = share[i] * end[i].separation;
        further[i] = (share[i] + 1e-3) * end[i].separation;
        given[i][0] = gap[i] / mean;
        given[i][1] = control ? held[i] / (mean * mean * mean) : held[i] * mean / p.surface_tension;
        given[i][2] = p.contact_angle1;
        given[i][3] = mean / p.radius1;
        given[i][4] = mean / p.radius2;
    }
    for (k = 0; k <= questions; ++k)
        least[k] = 1.0;
    for (k = 0; k < (questions + 1) * repeats; ++k) {
        const clock_t start = clock();
        const int question = k %% (questions + 1);
        double took;
        for (i = 0; i < (question == questions ? 100 : 1); ++i)
            ask(question, control);
        took = (double)(clock() - start) / CLOCKS_PER_SEC / pairs / i;
        least[question] = took < least[question] ? took : least[question];
    }
    for (k = 0; k <= questions; ++k)
        printf("%%.2f\\n", 1e9 * least[k]);
    return sum == sum ? 0 : 3;
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


def measured(control: int, name: str) -> list[float]:
    """Nanoseconds a call of each question, and of the rival of a control."""
    rival = laws[RIVALS[name]]
    program = {"pairs": PAIRS, "repeats": REPEATS, "questions": len(QUESTIONS), "rival": f"{rival.name}_force_star"}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        write(folder)
        (folder / "main.c").write_text(source(rival) + _PROGRAM % program, encoding="utf-8")
        subprocess.run(["gcc", "-O2", "-o", "main", "main.c", STATIC, "-lm"], cwd=folder, check=True)
        told = subprocess.run(
            [folder / "main", str(control)], input=questions(name), check=True, capture_output=True, text=True
        )
    return [float(line) for line in told.stdout.split()]


def measure() -> str:
    """The page's section."""
    suction, volume = (measured(control, name) for control, name in enumerate(RIVALS))
    told = [
        f"| {question} | {one:.0f} | {one / suction[-1]:.0f} | {other:.0f} | {other / volume[-1]:.0f} |"
        for question, one, other in zip(QUESTIONS, suction, volume, strict=False)
    ]
    return f"""## The C library

Written by `python -m benchmarks.c_library` on: {machine()}. {PAIRS} random
pairs of grains, up to three times as large as each other, on one thread: ns a call or a row, the least of {REPEATS}
rounds, seed {SEED}. The rivals are compiled in C in the same run: the paper's closed form under suction
({suction[-1]:.0f} ns), Willett's law at a volume ({volume[-1]:.0f} ns).

| | suction, ns | times the closed form | volume, ns | times the closed form |
|---|---:|---:|---:|---:|
{chr(10).join(told)}
"""


if __name__ == "__main__":
    put("benchmarks.c_library", measure())
