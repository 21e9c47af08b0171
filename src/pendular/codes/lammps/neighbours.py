"""The neighbour list of LAMMPS, read by compiled code where it lies, as pairs that may hold a bridge."""

import ctypes
from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numpy.typing import NDArray

from ...ground.compile import compiled, kernel

__all__ = [
    "ELSEWHERE",
    "MIRROR",
    "Candidates",
    "candidates_of",
    "find_pairs",
    "list_index",
    "local_atoms",
    "no_candidates",
    "tags_of",
]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Indices = NDArray[np.int32]

ELSEWHERE = -1  # the second atom belongs to another rank
MIRROR = -2  # as well, and that rank decides whether the pair has a bridge
_ATOM_BITS = 0x1FFFFFFF  # the upper bits of a neighbour mark bonds


class Candidates(NamedTuple):
    """Pairs close to each other, in rows of their first atoms."""

    start: Integers  # (local atoms,): first pair of an atom
    stop: Integers  # (local atoms,): after its last
    first: Indices  # (pairs,): local atom
    second: Indices  # (pairs,): local atom, or image that shows where it is
    target: Indices  # (pairs,): local atom that feels the opposite force, ELSEWHERE or MIRROR
    tags: Integers  # (all atoms,)


def _ask_element(typing_context: Any, function: Any, handle: Any, index: Any, row: Any, answer: Any) -> Any:
    """Ask the function at an address for a row of a list: the atom, the neighbours and where they are."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, handle, index, row, answer = arguments
        integer, wide, pointer = ir.IntType(32), ir.IntType(64), ir.IntType(8).as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [pointer, integer, integer, pointer, pointer, pointer])
        places = [builder.add(answer, ir.Constant(wide, 8 * k)) for k in range(3)]
        builder.call(
            builder.inttoptr(address, kind.as_pointer()),
            [
                builder.inttoptr(handle, pointer),
                builder.trunc(index, integer),
                builder.trunc(row, integer),
                *(builder.inttoptr(place, pointer) for place in places),
            ],
        )
        return context.get_dummy_value()

    return types.void(*[types.int64] * 5), generate


def _load_int32(typing_context: Any, address: Any, index: Any) -> Any:
    """Element of an array of 32-bit integers at an address."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        base = builder.inttoptr(arguments[0], ir.IntType(32).as_pointer())
        return builder.sext(builder.load(builder.gep(base, [arguments[1]])), ir.IntType(64))

    return types.int64(types.int64, types.int64), generate


_element: Any = intrinsic(_ask_element)
_int32_at: Any = intrinsic(_load_int32)


@kernel
def _rows(function: int, handle: int, index: int, rows: Integers) -> int:
    """Atom, number and address of the neighbours in each row; the sum of the numbers."""
    answer = np.zeros(3, np.int64)
    total = 0
    for row in range(rows.shape[0]):
        _element(function, handle, np.int64(index), np.int64(row), np.int64(answer.ctypes.data))
        for k in range(3):
            rows[row, k] = answer[k]
        total += answer[1]
    return total


@kernel
def local_atoms(tags: Integers, local: int, size: int) -> Indices:
    """Local atom of each tag below size, or -1."""
    atoms = np.full(size, -1, np.int32)
    for i in range(local):
        atoms[tags[i]] = i
    return atoms


@kernel
def _keep(rows: Integers, tags: Integers, local: int, atoms: Indices, out: Candidates) -> int:
    """Copy the pairs of the list, each once on this rank; their number."""
    count = 0
    for row in range(rows.shape[0]):
        i = rows[row, 0]
        out.start[i] = count
        for k in range(rows[row, 1]):
            j = _int32_at(rows[row, 2], k) & _ATOM_BITS
            owner = j if j < local else np.int64(atoms[tags[j]])
            if j >= local and owner >= 0 and tags[i] >= tags[j]:
                continue  # the image of this pair is the one that is kept
            out.first[count], out.second[count] = i, j
            if owner >= 0:
                out.target[count] = owner
            else:
                out.target[count] = ELSEWHERE if tags[i] < tags[j] else MIRROR
            count += 1
        out.stop[i] = count
    return count


def list_index(lammps: Any) -> int:
    """Number of the neighbour list of the pair style zero."""
    try:
        index: int = lammps.find_pair_neighlist("zero")
    except Exception:  # LAMMPS raises no other class
        index = -1
    if index < 0:
        raise ValueError("pair_style: there is no 'zero', whose neighbour list is to be read; use hybrid/overlay")
    return index


def no_candidates() -> Candidates:
    """Before there is a list."""
    wide, narrow = np.empty(0, np.int64), np.empty(0, np.int32)
    return Candidates(wide, wide, narrow, narrow, narrow, wide)


def candidates_of(lammps: Any, index: int, tags: Integers, local: int, atoms: Indices) -> Candidates:
    """Pairs of a neighbour list of a running LAMMPS."""
    function = ctypes.cast(lammps.lib.lammps_neighlist_element_neighbors, ctypes.c_void_p).value
    handle = lammps.lmp if isinstance(lammps.lmp, int) else lammps.lmp.value
    rows = np.zeros((lammps.lib.lammps_neighlist_num_elements(lammps.lmp, index), 3), np.int64)
    listed = compiled(_rows)(function, handle, index, rows)
    first, second, target = np.empty((3, listed), np.int32)
    start, stop = np.zeros((2, local), np.int64)
    pairs = Candidates(start, stop, first, second, target, tags)
    count = compiled(_keep)(rows, tags, local, atoms, pairs)
    return pairs._replace(**{name: getattr(pairs, name)[:count].copy() for name in ("first", "second", "target")})


@kernel
def _nearest(pairs: Candidates, x: Floats, atom: int, partner: int) -> tuple[int, float]:
    """Pair in the row of an atom whose other end has a tag, the nearest if there are several, or -1."""
    best, least = -1, np.inf
    for c in range(pairs.start[atom], pairs.stop[atom]):
        j = pairs.second[c]
        if pairs.tags[j] == partner:
            square = 0.0
            for k in range(3):
                square += (x[j, k] - x[atom, k]) ** 2
            if square < least:
                best, least = c, square
    return best, least


@kernel
def find_pairs(pairs: Candidates, x: Floats, atoms: Indices, tags: Integers) -> Integers:
    """Candidate that joins each of some pairs of tags, or -1."""
    found = np.empty(tags.shape[0], np.int64)
    for bridge in range(tags.shape[0]):
        best, least = -1, np.inf
        for end in range(2):
            tag, partner = tags[bridge, end], tags[bridge, 1 - end]
            atom = np.int64(atoms[tag]) if tag < atoms.size else -1
            if atom >= 0:
                c, square = _nearest(pairs, x, int(atom), partner)
                if square < least:
                    best, least = c, square
        found[bridge] = best
    return found


@kernel
def tags_of(pairs: Candidates, some: Integers) -> Integers:
    """Tags of some pairs, the smaller first."""
    tags = np.empty((some.size, 2), np.int64)
    for row in range(some.size):
        one, other = pairs.tags[pairs.first[some[row]]], pairs.tags[pairs.second[some[row]]]
        tags[row, 0], tags[row, 1] = min(one, other), max(one, other)
    return tags
