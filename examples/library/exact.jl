# Exact bridges between two grains that are pulled apart. Not run where it was written: no Julia was at hand; its calls are
# compared with pendular.h.
#
# pendular export library --out lib
# julia exact.jl lib/libpendular.so
const library = abspath(ARGS[1])
const SUCTION, VOLUME = Cint(0), Cint(1)
const FOUND, NO_BRIDGE, FAILED, BAD_INPUT = Cint.(0:3)

struct Pair
    radius1::Cdouble
    radius2::Cdouble
    contact_angle1::Cdouble
    contact_angle2::Cdouble
    surface_tension::Cdouble
end

struct State
    separation::Cdouble
    curvature::Cdouble
    force::Cdouble
    volume::Cdouble
    area::Cdouble
    across_tensor::Cdouble
    axial_tensor::Cdouble
    stiffness::Cdouble
    neck_radius::Cdouble
    neck_inside::Cdouble
    radius1::Cdouble
    radius2::Cdouble
    filling1::Cdouble
    filling2::Cdouble
    wetted_area1::Cdouble
    wetted_area2::Cdouble
    middle_radius::Cdouble
    middle_slope::Cdouble
    half_length::Cdouble
    unstable_directions::Cdouble
    sideways_stable::Cdouble
end

function rupture(control, held, pair)
    state = Ref{State}()
    status = ccall((:pendular_rupture, library), Cint, (Cint, Cdouble, Ref{Pair}, Ref{State}),
        control, held, pair, state)
    return status, state[]
end

function bridges(control, separations, held, pairs)
    states, statuses = Vector{State}(undef, length(pairs)), Vector{Cint}(undef, length(pairs))
    ccall((:pendular_bridges, library), Cint,
        (Cint, Csize_t, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Pair}, Ptr{State}, Ptr{Cint}),
        control, length(pairs), separations, held, pairs, states, statuses)
    return statuses, states
end

grains, suction = Pair(50e-6, 100e-6, 0.35, 0.35, 0.0728), 14e3
status, last = rupture(SUCTION, suction, grains)
status == FOUND || error("no end of the bridge: status $status")
println("breaks at $(last.separation) m")
println("separation [m], status, force [N], stiffness [N/m], volume [m3]")
separations = [0.22 * i * last.separation for i in 0:5]
statuses, states = bridges(SUCTION, separations, fill(suction, 6), fill(grains, 6))
for (separation, status, state) in zip(separations, statuses, states)
    println("$separation $status $(state.force) $(state.stiffness) $(state.volume)")
end
