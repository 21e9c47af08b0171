/* main FILE HELD TENSION RADIUS1 RADIUS2 SEPARATION...: how far bridges reach, then the force at each separation. A second
   radius of 0 is a wall. */
#include <cstdio>
#include <cstdlib>

#include "pendular_mercury.h"

int main(int count, char **words)
{
    pendular_table table;
    if (count < 7 || pendular_table_open(words[1], &table) != PENDULAR_TABLE_OK)
        return 2;
    PendularSpecies species;
    BaseSpecies base;
    base.adhesive = &species;
    species.base = &base;
    BaseParticle first(atof(words[4])), second(atof(words[5]));
    BaseWall wall;
    const bool is_wall = second.radius == 0.0;
    species.setTable(&table, atof(words[2]), atof(words[3]));
    species.setRadii(is_wall ? first.radius : std::min(first.radius, second.radius), std::max(first.radius, second.radius));
    std::printf("%.17g\n", base.distance);
    PendularInteraction contact(&first, is_wall ? static_cast<BaseInteractable *>(&wall) : &second, 0);
    contact.species = &base;
    try {
        for (int i = 6; i < count; ++i) {
            contact.overlap = -atof(words[i]);
            contact.force = 0.0;
            contact.computeAdhesionForce();
            std::printf("%.17g\n", contact.force);
        }
    } catch (const std::runtime_error &error) {
        std::printf("%s\n", error.what());
    }
    pendular_table_close(&table);
    return 0;
}
