"""The Young-Laplace equation, solved exactly for axisymmetric bridges between two solids."""
