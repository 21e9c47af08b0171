/* A bridge between two grains that are pulled apart.

   pendular export c --contact-angle 20 --out bridge.h
   gcc -std=c99 -O2 -o main main.c -lm
   ./main
*/
#include <stdio.h>

#include "bridge.h"

int main(void)
{
    const double small = 50e-6, large = 100e-6, suction = 5e3, surface_tension = 0.0728; /* [m], [m], [Pa], [N/m] */
    const double rupture = pendular_rupture_distance(suction, small, large, surface_tension);
    int i;
    printf("breaks at %.6e m\n", rupture);
    printf("separation [m]  force [N]     stiffness [N/m]  volume [m3]\n");
    for (i = 0; i <= 5; ++i) {
        const double separation = 0.2 * i * rupture;
        printf("%.6e    %.6e  %+.6e    %.6e\n", separation,
            pendular_force(separation, suction, small, large, surface_tension),
            pendular_stiffness(separation, suction, small, large, surface_tension),
            pendular_volume(separation, suction, small, large, surface_tension));
    }
    return 0;
}
