"""What the physics stands on: kernels and the ways to run them, checks of arguments, files, units."""
