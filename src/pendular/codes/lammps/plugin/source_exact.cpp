/* Bridges of the exact solver, one by one: microseconds each, at any size and any contact angle.
   SPDX-License-Identifier: BSD-3-Clause */
#include "fmt/format.h"
#include "source.h"

namespace pendular_lammps {
namespace {

    class ExactSolver : public Source {
    public:
        ExactSolver(double angle1, double angle2) : angle1(angle1), angle2(angle2) {}

        bool holds(int) const override { return true; }
        bool is_of_two_angles() const override { return angle1 != angle2; }

        double rupture(int control, double held, const Solids &solids, double tension) const override
        {
            const pendular_pair pair = pair_of(solids, tension);
            pendular_state end;
            const int status = pendular_rupture(control, held, &pair, &end);
            return status == PENDULAR_FOUND ? end.separation : status == PENDULAR_NO_BRIDGE ? 0.0 : NAN;
        }

        double pull(int control, Bridge &bridge, const Solids &solids, double tension, double separation) const override
        {
            const pendular_pair pair = pair_of(solids, tension);
            if (!bridge.state) {
                bridge.state = std::make_unique<pendular_state>();
                bridge.state->separation = NAN;
            }
            pendular_state &state = *bridge.state;
            bridge.slope = NAN; /* there is no cell */
            return pendular_bridge_near(control, std::fmax(separation, 0.0), bridge.held, &pair, &state)
                    == PENDULAR_FOUND
                ? state.force
                : NAN;
        }

        double energy(
            int control, double held, const Solids &solids, double tension, double separation) const override
        {
            const pendular_pair pair = pair_of(solids, tension);
            pendular_state end, state;
            if (pendular_rupture(control, held, &pair, &end) != PENDULAR_FOUND
                || !find(control, held, pair, separation, state))
                return NAN;
            const double overlap = std::fmax(-separation, 0.0);
            return potential(control, state, tension) - potential(control, end, tension) - overlap * state.force;
        }

        double liquid(
            int control, double held, const Solids &solids, double tension, double separation) const override
        {
            pendular_state state;
            if (!find(control, held, pair_of(solids, tension), separation, state))
                return NAN;
            return control == PENDULAR_SUCTION ? state.volume : state.curvature * tension;
        }

        std::string refusal(int control, double held, const Solids &solids, double tension) const override
        {
            const pendular_pair pair = pair_of(solids, tension);
            pendular_state end;
            const char *why = pendular_rupture(control, held, &pair, &end) == PENDULAR_BAD_INPUT
                ? "is out of range"
                : "has no bridge that the solver could find";
            return fmt::format("{} {:.6g} between radii {:.6g} and {:.6g} {}",
                control == PENDULAR_SUCTION ? "suction" : "volume", held, solids.radius1, solids.radius2, why);
        }

    private:
        double angle1, angle2;

        pendular_pair pair_of(const Solids &solids, double tension) const
        {
            return {solids.radius1, solids.radius2, angle1, angle2, tension};
        }

        static bool find(
            int control, double held, const pendular_pair &pair, double separation, pendular_state &state)
        {
            return pendular_bridge(control, std::fmax(separation, 0.0), held, &pair, &state) == PENDULAR_FOUND;
        }

        /* Of the surfaces, and of the reservoir that holds the suction. */
        double potential(int control, const pendular_state &state, double tension) const
        {
            const double wetted
                = std::cos(angle1) * state.wetted_area1 + std::cos(angle2) * state.wetted_area2;
            const double work = control == PENDULAR_SUCTION ? state.curvature * state.volume : 0.0;
            return tension * (state.area - wetted + work);
        }
    };
}    // namespace

std::shared_ptr<const Source> exact_solver(double contact_angle1, double contact_angle2)
{
    return std::make_shared<ExactSolver>(contact_angle1, contact_angle2);
}

}    // namespace pendular_lammps
