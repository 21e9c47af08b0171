"""Write ``docs/accuracy.md``, every bound and the test that holds it: ``python -m tools.truth_page``.

A bound is that of its test, which names it in figures; tests/test_truth_page.py sees that the test is there and that
both agree. Errors of the laws come from their stored measurements.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from pendular.comparison.measured import measured_errors
from pendular.comparison.words import percent
from pendular.exact.answers import LARGEST_MISS
from pendular.laws import laws

PAGE = Path(__file__).parents[1] / "docs" / "accuracy.md"


class Bound(NamedTuple):
    """What holds, within which bound, over what, and the test of it."""

    what: str
    within: str  # in figures as in the test; empty where there is nothing but equal and not equal
    over: str
    test: str  # file::function


SUBJECTS: dict[str, tuple[Bound, ...]] = {
    "One bridge": (
        Bound(
            "force, volume, wetted areas",
            "2e-12",
            "763 bridges solved independently with 30 digits, over the whole domain, to 0.999 of rupture",
            "test_oracle.py::test_every_field",
        ),
        Bound(
            "meniscus, radii, filling angles, capillary tensor",
            "1e-12",
            "the same bridges",
            "test_oracle.py::test_energy_and_tensor",
        ),
        Bound(
            "stiffness",
            "1e-9",
            "the same bridges; it has no bound at rupture itself",
            "test_oracle.py::test_every_field",
        ),
        Bound(
            "bridges that are hard to find, both ends of the stable branch",
            "1e-9",
            "103 cases by another method, in 36 digits: large drops, folds that meet, nearly no wetting",
            "test_hard_cases.py::test_the_bridge",
        ),
        Bound(
            "a bridge is found, and is the right one",
            "1e-6",
            "thousands of random menisci, integrated from one solid to where the second one is put; seeds are printed",
            "test_made_bridges.py::test_many_made_bridges_are_found",
        ),
        Bound(
            "the shape that is drawn holds the liquid that is told",
            "1e-6",
            "the same cases, summed up along the meridian",
            "test_hard_cases.py::test_what_is_returned_holds_what_was_asked",
        ),
        Bound(
            "unstable directions",
            "",
            "against the second variation of the energy, at a volume and under suction",
            "test_stability.py::test_at_a_volume",
        ),
        Bound(
            "by a half-filling angle",
            "1e-6",
            "made bridges, every one of several",
            "test_half_filling_angle.py::test_made_bridges_are_found",
        ),
        Bound(
            "drops without a force between two spheres, to 1e4 cubes of the radius",
            "1e-9",
            "spheres of liquid, whose geometry is closed",
            "test_large_bridges.py::test_a_drop_between_two_spheres_is_found",
        ),
        Bound(
            "two planes: a cylinder breaks at half a wave",
            "1e-11",
            "its closed solution",
            "test_two_planes.py::test_a_cylinder_breaks_where_it_is_half_a_wave_long",
        ),
        Bound(
            "rates of the force in angle, volume, radius, suction",
            "1e-10",
            "differences of 30-digit solutions",
            "test_sensitivities.py::test_rates_have_the_thirty_digits_behind_them",
        ),
    ),
    "Paths with contact lines that stick and slide": (
        Bound(
            "rings, angles, separation, volume and suction of every step",
            "1e-9",
            "66 random paths, integrated from ring to ring by the Young-Laplace equation",
            "test_path.py::test_every_bridge_obeys_the_equation_between_its_rings",
        ),
        Bound(
            "the path",
            "1e-8",
            "the same paths in 24 small steps each, but for lines that turn within one: nine of ten",
            "test_path.py::test_a_path_is_that_of_many_small_steps",
        ),
        Bound(
            "without hysteresis, force, volume and radii of the free bridge",
            "1e-10",
            "three pairs up to rupture, at a volume and under suction",
            "test_path.py::test_without_hysteresis_it_is_the_curve",
        ),
        Bound(
            "angles within the receding and the advancing one, [rad]",
            "1e-12",
            "thousands of random paths; seeds are printed",
            "test_path.py::test_thousands_of_paths_keep_the_rules",
        ),
    ),
    "What every bridge obeys": (
        Bound(
            "force is the slope of energy at a volume, and of the grand potential under suction",
            "",
            "bridges that Hypothesis draws, with their tolerance beside each",
            "test_identities.py::test_force_is_the_slope_of_the_surface_energy_at_constant_volume",
        ),
        Bound(
            "Maxwell's relation between force and volume",
            "",
            "the same",
            "test_identities.py::test_maxwell_relation_at_constant_suction",
        ),
        Bound(
            "force at the neck, at both contact circles, by the capillary tensor",
            "",
            "the same",
            "test_identities.py::test_force_is_the_same_at_the_neck_and_at_both_contacts",
        ),
        Bound(
            "suction and volume control find one bridge",
            "",
            "the same",
            "test_identities.py::test_suction_and_volume_control_find_the_same_bridge",
        ),
        Bound(
            "plain Python, machine code, any number of threads: one answer",
            "1e-12",
            "rows of random questions",
            "test_rows.py::test_plain_python_and_machine_code_agree",
        ),
    ),
    "Tables": (
        Bound(
            "the bound that a table states for itself",
            "",
            "random bridges that it was not made from, over its whole range",
            "test_table.py::test_bounds_hold_over_the_whole_range",
        ),
        Bound(
            "rupture distance of a table under suction",
            "1e-9",
            "exact rupture distances",
            "test_table.py::test_rupture_distance",
        ),
        Bound(
            "a table in C, C++ and from its file, beside machine code of Python, over the bound of the table",
            "1e-3",
            "rows of random contacts, compilers and options",
            "test_table_file.py::test_c_is_equal_to_the_compiled_table",
        ),
        Bound(
            "a table on a GPU",
            "1e-12",
            "rows of random contacts, in a simulator; compiled for a GPU as well",
            "test_cuda.py::test_answers_are_those_of_the_processor",
        ),
    ),
    "The solver elsewhere": (
        Bound(
            "C library: rows equal to Python to the last bit",
            "",
            "rows of random questions",
            "test_c_library.py::test_it_is_equal_to_python",
        ),
        Bound(
            "WebAssembly, in arrays",
            "1e-11",
            "bridges in a row",
            "test_wasm.py::test_bridges_in_a_row_are_the_same_one_by_one",
        ),
        Bound(
            "LAMMPS: every step of a packing is that of its contact list",
            "1e-9",
            "forces, energy, virial, with liquid conserved",
            "test_lammps.py::test_every_step_of_a_packing_is_that_of_its_contact_list",
        ),
        Bound(
            "LIGGGHTS: forces of the table up to rupture",
            "1e-9",
            "random pairs, one rank and two",
            "test_liggghts.py::test_pairs_have_the_force_of_the_table_up_to_rupture",
        ),
        Bound(
            "LIGGGHTS: one bridge with a flat mesh, wherever the grain lies",
            "1e-9",
            "on faces, edges, corners and seams, one rank and two",
            "test_liggghts_walls.py::test_a_grain_on_a_flat_mesh_has_one_bridge_wherever_it_lies",
        ),
        Bound(
            "LIGGGHTS: the sum of the liquid on grains and in bridges",
            "1e-12",
            "grains that fly about, one rank and two",
            "test_liggghts_film.py::test_liquid_goes_from_grains_to_bridges_and_back",
        ),
        Bound(
            "YADE with the engine",
            "2e-9",
            "forces in a running YADE",
            "test_yade_engine.py::test_forces_in_yade_are_those_of_the_table",
        ),
        Bound(
            "YADE: one bridge with facets and boxes in a direction",
            "1e-7",
            "forces of every step, of walls that move and turn",
            "test_yade_engine.py::test_grains_have_one_bridge_with_facets_and_boxes_in_a_direction",
        ),
        Bound(
            "YADE: the sum of the liquid on grains and in bridges",
            "1e-12",
            "grains that fly about, come and go",
            "test_yade_engine.py::test_liquid_goes_from_grains_to_bridges_and_back",
        ),
        Bound(
            "Kratos: two grains are moved by the exact bridge",
            "1e-6",
            "the speeds of every step, up to rupture and beyond",
            "test_kratos.py::test_two_grains_in_kratos_have_the_exact_bridge",
        ),
        Bound(
            "meshes for Surface Evolver: it finds the same bridge",
            "1e-6",
            "its volume, and its energy with the square of an edge",
            "test_mesh.py::test_surface_evolver_finds_the_same_bridge",
        ),
        Bound(
            "297 bridges for other programs to be tested with",
            "1e-12",
            "an independent solution",
            "test_conformance.py::test_library_meets_all_cases",
        ),
    ),
    "Heaps": (
        Bound(
            "saturation, stress, interface of lattices",
            "1e-9",
            "their closed values",
            "test_packing.py::test_a_lattice_meets_its_closed_values",
        ),
        Bound(
            "a heap is the sum of its pairs",
            "1e-9",
            "a loop over exact bridges",
            "test_packing.py::test_a_heap_is_the_sum_of_its_pairs",
        ),
        Bound(
            "the heap of the explorer page: water, stress and meetings",
            "1e-12",
            "Python, on random heaps",
            "test_explorer_heap.py::test_water_and_stress_are_those_of_python",
        ),
        Bound(
            "stress is the rate of the potential with the strain",
            "3e-6",
            "differences of strained heaps",
            "test_packing.py::test_the_stress_is_the_rate_of_the_potential_with_the_strain",
        ),
    ),
    "Fits, liquids, the data base": (
        Bound(
            "a fit finds the truth from a bad guess",
            "1e-5",
            "curves without noise",
            "test_fit.py::test_the_truth_is_found_from_a_bad_guess",
        ),
        Bound(
            "errors of a fit cover the truth as often as they say",
            "",
            "300 made curves of any size, noise and length",
            "test_fit.py::test_errors_cover_the_truth_as_often_as_they_say",
        ),
        Bound(
            "surface tension of water, in mN/m",
            "6e-5",
            "the table of IAPWS, to its last digit",
            "test_liquid.py::test_water_surface_tension_is_that_of_iapws",
        ),
        Bound(
            "bridges of the data base",
            "2e-12",
            "the same formulas in 40 digits",
            "test_dataset.py::test_points_against_forty_digits",
        ),
        Bound(
            "rupture by its interpolation",
            "5e-6",
            "exact rupture distances",
            "test_dataset.py::test_rupture_of_equal_spheres",
        ),
    ),
    "Laws": (
        Bound(
            "the code of a law is the law",
            "",
            "the same law from the article, in 40 digits",
            "test_laws.py::test_force_equals_oracle",
        ),
        Bound("its stored errors", "1e-9", "measured anew", "test_law_errors.py::test_the_file_is_what_is_measured"),
    ),
}

HEAD = f"""\
# How true it is

Every bound that is stated, what it is over, and the test that holds it. Bounds are relative, unless the row says
otherwise. This page is written by `uv run python -m tools.truth_page`; a test sees that each test is there and has the
bound of this page. `python -m benchmarks.accuracy` prints the errors themselves, which are smaller.

Each answer is put back into its equations before it is given: separation, volume or suction, both contact angles. One
that misses them by more than {LARGEST_MISS:g} is not given, and a status says so.

Domain: volumes of 1e-30 to 1e4 cubes of the Derjaguin radius, suctions up to 1e13 of the surface tension over that
radius, contact angles from 0° to below 180°, any size ratio. Outside a question is refused in one line.

"""

LAWS = """
A law is as true as its authors made it. The largest errors inside its stated range, over the sample on
[its page](laws.md):

"""

FOOT = """
## What no test can tell

The numbers solve the equation of Young and Laplace with a constant contact angle. Whether that is your bridge is
another question: no gravity, so lengths are well below the capillary length, 2.7 mm for water; no roughness and no
hysteresis of the contact angle; no viscous force; no molecules, so that below 4 nm of radius the
[Kelvin equation itself](howto/humidity.md) is in doubt, and a warning says so. What has been compared with
measurements, and what has not, stands with [heaps](howto/packings.md#beside-measurements).
"""


def page() -> str:
    """Text of the page."""
    return "".join([HEAD, *(part for subject in SUBJECTS for part in section(subject)), LAWS, *law_lines(), FOOT])


def section(subject: str) -> Iterator[str]:
    """Table of a subject."""
    yield f"## {subject}\n\n| what | within | over | `tests/` |\n| --- | --- | --- | --- |\n"
    for bound in SUBJECTS[subject]:
        file, _, function = bound.test.partition("::")
        named = function.removeprefix("test_").replace("_", " ")
        yield f"| {bound.what} | {bound.within or '–'} | {bound.over} | `{file}`: {named} |\n"
    yield "\n" if subject != "Laws" else ""


def law_lines() -> Iterator[str]:
    """Largest errors of each law."""
    yield "| law | force | rupture | work |\n| --- | ---: | ---: | ---: |\n"
    for law in laws.values():
        largest = measured_errors(law).of_equal_spheres.largest
        cells = (percent(float(error), signed=False) if not math.isnan(float(error)) else "–" for error in largest)
        yield f"| [`{law.name}`](laws/{law.name}.md) | {' | '.join(cells)} |\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
