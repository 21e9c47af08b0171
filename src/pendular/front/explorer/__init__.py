"""The explorer page: a pair and its bridge, or a heap of grains, under the hand, computed in the browser."""
