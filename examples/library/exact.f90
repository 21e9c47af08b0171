! The exact bridge between two grains that are pulled apart, each sought from the one before.
!
! pendular export library --out lib
! gfortran -std=f2008 -O2 -o exact exact.f90 lib/libpendular.a
! ./exact
module pendular
    use, intrinsic :: iso_c_binding
    implicit none

    integer(c_int), parameter :: suction_held = 0, volume_held = 1
    integer(c_int), parameter :: found = 0, no_bridge = 1, failed = 2, bad_input = 3

    type, bind(c) :: pair_type
        real(c_double) :: radius1, radius2, contact_angle1, contact_angle2, surface_tension
    end type

    type, bind(c) :: state_type
        real(c_double) :: separation, curvature, force, volume, area, across_tensor, axial_tensor, stiffness
        real(c_double) :: neck_radius, neck_inside, radius1, radius2, filling1, filling2, wetted_area1, wetted_area2
        real(c_double) :: middle_radius, middle_slope, half_length, unstable_directions, sideways_stable
    end type

    interface
        function pendular_bridge(control, separation, held, pair, state) bind(c) result(status)
            import
            integer(c_int), value :: control
            real(c_double), value :: separation, held
            type(pair_type), intent(in) :: pair
            type(state_type), intent(out) :: state
            integer(c_int) :: status
        end function

        function pendular_bridge_near(control, separation, held, pair, state) bind(c) result(status)
            import
            integer(c_int), value :: control
            real(c_double), value :: separation, held
            type(pair_type), intent(in) :: pair
            type(state_type), intent(inout) :: state
            integer(c_int) :: status
        end function

        function pendular_rupture(control, held, pair, state) bind(c) result(status)
            import
            integer(c_int), value :: control
            real(c_double), value :: held
            type(pair_type), intent(in) :: pair
            type(state_type), intent(out) :: state
            integer(c_int) :: status
        end function
    end interface
end module

program exact
    use pendular
    implicit none

    real(c_double), parameter :: suction = 14e3_c_double                                   ! [Pa]
    type(pair_type), parameter :: grains = pair_type(50e-6_c_double, 100e-6_c_double, &    ! [m]
        0.35_c_double, 0.35_c_double, 0.0728_c_double)                                     ! [rad], [rad], [N/m]
    type(state_type) :: end, state
    real(c_double) :: separation
    integer(c_int) :: i, status

    status = pendular_rupture(suction_held, suction, grains, end)
    if (status /= found) stop 'no end of the bridge'
    print '(a, es24.16e3, a)', 'breaks at ', end%separation, ' m'
    print '(a)', 'separation [m], status, force [N], stiffness [N/m], volume [m3]'
    status = pendular_bridge(suction_held, 0.0_c_double, suction, grains, state)
    do i = 0, 5
        separation = 0.22_c_double * i * end%separation
        status = pendular_bridge_near(suction_held, separation, suction, grains, state)
        print '(es24.16e3, i3, 3es25.16e3)', separation, status, state%force, state%stiffness, state%volume
    end do
end program
