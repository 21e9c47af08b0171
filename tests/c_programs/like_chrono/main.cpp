/* main FILE HELD TENSION RADIUS1 RADIUS2 SEPARATION...: force on the first of two spheres at each separation, one after
   another. */
#include <cstdio>
#include <cstdlib>

#include "pendular_chrono.h"

int main(int count, char **words)
try {
    if (count < 7)
        return 2;
    PendularBridges bridges(words[1], atof(words[2]), atof(words[3]));
    const double radius[2] = { atof(words[4]), atof(words[5]) };
    std::shared_ptr<chrono::ChBody> body[2];
    for (int i = 0; i < 2; ++i) {
        body[i] = std::make_shared<chrono::ChBody>();
        bridges.add(body[i], radius[i]);
    }
    for (int i = 6; i < count; ++i) {
        body[1]->place = { 0, radius[0] + radius[1] + atof(words[i]), 0 };
        bridges.apply();
        if (body[0]->forces[0].y != -body[1]->forces[0].y)
            return 3;
        std::printf("%.17g\n", body[0]->forces[0].y);
    }
    return 0;
} catch (const std::runtime_error &error) {
    std::printf("%s\n", error.what());
    return 0;
}
