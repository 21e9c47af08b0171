"""The exact solver: a bridge is four numbers and four equations, for numbers only."""
