"""The data base of bridges of the article: a grid of exact bridges, and interpolation in it."""
