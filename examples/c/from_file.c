/* A bridge between two grains that are pulled apart, from a table in a file.

   pendular export table --contact-angle 20 --out w.bridges --header pendular_table.h
   gcc -std=c99 -O2 -o from_file from_file.c -lm
   ./from_file w.bridges
*/
#include <stdio.h>

#include "pendular_table.h"

int main(int count, char **words)
{
    const double small = 50e-6, large = 100e-6, suction = 14e3, surface_tension = 0.0728; /* [m], [m], [Pa], [N/m] */
    pendular_table table;
    double rupture;
    int i, code;
    if (count != 2) {
        fprintf(stderr, "usage: from_file w.bridges\n");
        return 2;
    }
    code = pendular_table_open(words[1], &table);
    if (code != PENDULAR_TABLE_OK) {
        fprintf(stderr, "%s: %s\n", words[1], pendular_table_error(code));
        return 1;
    }
    printf("contact angles %.4g and %.4g rad, error of the force below %.1e of %s\n", table.contact_angle[0],
        table.contact_angle[1], table.channel[PENDULAR_TABLE_FORCE].bound,
        pendular_table_bound_of(&table, PENDULAR_TABLE_FORCE));
    rupture = pendular_table_rupture_distance(&table, suction, small, large, surface_tension);
    printf("breaks at %.6e m\n", rupture);
    printf("separation [m]  force [N]     stiffness [N/m]  energy [J]     volume [m3]\n");
    for (i = 0; i <= 5; ++i) {
        const double separation = 0.2 * i * rupture;
        printf("%.6e    %.6e  %+.6e    %+.6e  %.6e\n", separation,
            pendular_table_force(&table, separation, suction, small, large, surface_tension),
            pendular_table_stiffness(&table, separation, suction, small, large, surface_tension),
            pendular_table_energy(&table, separation, suction, small, large, surface_tension),
            pendular_table_liquid(&table, separation, suction, small, large, surface_tension));
    }
    pendular_table_close(&table);
    return 0;
}
