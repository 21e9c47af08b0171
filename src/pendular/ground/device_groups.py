"""Items on a GPU in groups of one key: a counting sort, by atomic counters."""

from typing import Any, NamedTuple

import numpy as np

from .device import THREADS, blocks_for, cuda, on_host

__all__ = ["Groups", "group"]


class Groups(NamedTuple):
    """Items by their keys."""

    start: Any  # (keys + 1,): where the items of a key begin
    items: Any  # numbers of the items


@cuda.jit
def count_items(keys: Any, start: Any) -> None:
    i = cuda.grid(1)
    if i < keys.size and 0 <= keys[i] < start.size - 1:
        cuda.atomic.add(start, keys[i] + 1, 1)


@cuda.jit
def place_items(keys: Any, end: Any, items: Any) -> None:
    i = cuda.grid(1)
    if i < keys.size and 0 <= keys[i] < end.size - 1:
        items[cuda.atomic.add(end, keys[i], 1)] = i


@cuda.jit
def put_in_order(start: Any, items: Any) -> None:
    """Items of each key in ascending order, of which there are few."""
    key = cuda.grid(1)
    if key < start.size - 1:
        for i in range(start[key] + 1, start[key + 1]):
            item, k = items[i], i
            while k > start[key] and items[k - 1] > item:
                items[k] = items[k - 1]
                k -= 1
            items[k] = item


def group(keys: Any, count: int, stream: Any, in_order: bool) -> Groups:
    """Group items by their keys from 0 to a count; others belong to no group.

    In order they ascend in each group, which is for groups of few items; else they lie in any order.
    """
    start = cuda.to_device(np.zeros(count + 1, np.int64), stream=stream)
    items = cuda.device_array(max(keys.size, 1), np.int64, stream=stream)
    if keys.size:
        count_items[blocks_for(keys.size), THREADS, stream](keys, start)
    begins = np.cumsum(on_host(start, stream))
    start, end = (cuda.to_device(begins, stream=stream) for _ in range(2))
    if keys.size:
        place_items[blocks_for(keys.size), THREADS, stream](keys, end, items)
        if in_order and count:
            put_in_order[blocks_for(count), THREADS, stream](start, items)
    return Groups(start, items)
