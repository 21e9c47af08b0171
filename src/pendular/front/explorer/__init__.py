"""The explorer page: a pair, its bridge and its curves under the hand, computed in the browser that shows them."""
