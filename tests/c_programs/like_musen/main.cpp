/* main FILE VOLUME TENSION RADIUS1 RADIUS2 SEPARATION...: force on the left grain at each separation, and whether the bond
   is broken. */
#include <cstdio>
#include <cstdlib>

#include "pendular_musen.h"

int main(int count, char **words)
try {
    if (count < 7)
        return 2;
    PendularModel model(words[1]);
    SParticleStruct grains;
    SLiquidBondStruct bonds = {};
    bonds.volume = atof(words[2]);
    bonds.tension = atof(words[3]);
    grains.radii = { atof(words[4]), atof(words[5]) };
    model.particles = &grains;
    model.bonds = &bonds;
    for (int i = 6; i < count; ++i) {
        unsigned broken = 0;
        bonds.active = true;
        grains.places = { { 0, 0, 0 }, { 0, grains.radii[0] + grains.radii[1] + atof(words[i]), 0 } };
        grains.forces.assign(2, CVector3{ 0, 0, 0 });
        model.CalculateLB(1.0, 1e-7, 0, 1, 0, bonds, &broken);
        model.ConsolidatePart(1.0, 1e-7, 0, grains);
        if (grains.forces[0].y != -grains.forces[1].y || bonds.active == (broken == 1))
            return 3;
        std::printf("%.17g %u\n", grains.forces[0].y, broken);
    }
    return 0;
} catch (const std::runtime_error &error) {
    std::printf("%s\n", error.what());
    return 0;
}
