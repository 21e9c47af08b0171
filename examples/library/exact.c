/* The exact bridge between two grains that are pulled apart.

   pendular export library --out lib
   gcc -std=c99 -O2 -I lib -o exact exact.c lib/libpendular.a -lm
   ./exact
*/
#include <stdio.h>

#include "pendular.h"

int main(void)
{
    const double suction = 14e3;                                       /* [Pa] */
    const pendular_pair grains = { 50e-6, 100e-6, 0.35, 0.35, 0.0728 }; /* [m], [m], [rad], [rad], [N/m] */
    pendular_state end, state;
    int i, status = pendular_rupture(PENDULAR_SUCTION, suction, &grains, &end);
    if (status != PENDULAR_FOUND) {
        fprintf(stderr, "no end of the bridge: status %d\n", status);
        return 1;
    }
    printf("breaks at %.17g m\n", end.separation);
    printf("separation [m], status, force [N], stiffness [N/m], volume [m3]\n");
    for (i = 0; i < 6; ++i) {
        const double separation = 0.22 * i * end.separation;
        status = pendular_bridge(PENDULAR_SUCTION, separation, suction, &grains, &state);
        printf("%.17g %d %.17g %.17g %.17g\n", separation, status, state.force, state.stiffness, state.volume);
    }
    return 0;
}
