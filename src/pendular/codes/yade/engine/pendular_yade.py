"""Exact capillary bridges in YADE: any sizes of grains, clumps, walls, facets, boxes, periodic cells, both controls.

    pendular export table --contact-angle 20 --out w.bridges
    pendular export yade-engine --out engine

    import sys
    sys.path.append("engine")
    from pendular_yade import Bridges

    bridges = Bridges("w.bridges", suction=5e3, surface_tension=0.0728)
    O.engines = [ForceResetter(), InsertionSortCollider(...), InteractionLoop(...),
                 PyRunner(command="bridges.step()", iterPeriod=1, initRun=True), NewtonIntegrator()]

A bridge forms where two grains, or a grain and a wall, touch, and lives to its rupture distance. A grain has one bridge
with all the facets, boxes and walls that lie in nearly one direction from it.

Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty.
"""

import ctypes
from array import array
from collections import deque
from pathlib import Path

import numpy as np

_HERE = Path(__file__).resolve().parent
_RUPTURE, _LIQUID, _ENERGY = 0, 2, -2  # answers of pendular_table.h
_SPHERE, _FACET, _BOX = -1, 3, 4  # kinds of bodies in pendular_yade.c, beside the axes of walls
_SIZES = 17
_MARGIN = 1.02  # for sizes between those that are tried


class _Heap(ctypes.Structure):
    """Neighbours and bodies as pendular_yade.c has them."""

    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("grains", "walls")),
        ("surface_tension", ctypes.c_double),
        *((name, ctypes.c_size_t) for name in ("pairs", "bodies", "surfaces")),
        *((name, ctypes.c_void_p) for name in ("first", "second", "beside", "has_bridge", "volumes", "places")),
        *((name, ctypes.c_void_p) for name in ("radius", "kind", "surface_of", "surface", "at_surfaces", "is_hidden")),
        ("out_of_range", ctypes.c_size_t),
        ("forms_apart", ctypes.c_int),
    )


class Bridges:
    """The bridges of all spheres and walls of a simulation.

    Parameters
    ----------
    table : str
        File that ``pendular export table`` wrote, of one contact angle.
    suction, volume : float
        What is held, that of the table: the suction, [Pa], or the liquid of each bridge, [m3]. It may be set anew
        between two steps: ``bridges.held = 6e3``.
    surface_tension : float
        [N/m].
    wall_table : str, optional
        File of bridges with walls, if their contact angle is another one; the first angle is that of the grains.
    distant : bool
        Whether all pairs within reach have a bridge at the first step, and not only those that touch.
    skin : float, optional
        How far two grains may approach before neighbours are sought anew; else a tenth of the smallest radius, [m].
    film : float or dict, optional
        Liquid on each sphere, or on those whose ids are given, [m3]. Then a bridge takes its liquid from its two
        grains, at most `volume`, and gives it back when it breaks.
    share : float
        What a grain offers of its film to the bridges that form on it in a step.
    """

    def __init__(
        self, table, *, surface_tension, suction=None, volume=None, wall_table=None, distant=False, skin=None,
        film=None, share=1.0,
    ):  # fmt: skip
        self._c = _library()
        self._grains = self._opened(table)
        self._walls = self._grains if wall_table is None else self._opened(wall_table)
        is_volume, sides, *_ = self._about(self._grains)
        if sides == 2:
            raise ValueError(f"table: {str(table)!r} has two contact angles; grains have one, and walls a wall_table")
        if self._about(self._walls)[0] != is_volume:
            raise ValueError(f"wall_table: {str(wall_table)!r} does not hold what the table of the grains holds")
        name, other = ("volume", suction) if is_volume else ("suction", volume)
        self.held = volume if is_volume else suction
        if self.held is None or other is not None:
            raise ValueError(f"{name}: is what {str(table)!r} holds; give it, and it alone")
        if not surface_tension > 0.0:
            raise ValueError(f"surface_tension: {surface_tension!r} is not positive")
        if film is not None and not is_volume:
            raise ValueError(f"film: {str(table)!r} holds the suction, and a reservoir gives the liquid")
        if not 0.0 < share <= 1.0:
            raise ValueError(f"share: {share!r} is not in (0, 1]")
        self.surface_tension = surface_tension
        self._given_film, self.share = film, share
        self._name, self._forms_apart, self._skin = name, distant, skin
        self._bodies, self._former_walls = None, set()
        self._ids = np.empty(0, int)
        self._first = self._second = np.empty(0, np.int32)
        self._has_bridge = np.empty(0, np.uint8)
        self._film, self._volumes = np.empty(0), np.empty(0)

    # What is asked ---------------------------------------------------------------------------------------------------

    def found(self):
        """The bridges of the last step, as a structured array: two ids, separation, force, liquid, energy, volume.

        The liquid is the volume of a bridge under suction, [m3], and its suction at constant volume, [Pa].
        """
        at = np.flatnonzero(self._has_bridge)
        numbers = ("separation", "force", "liquid", "energy", "volume")
        kinds = [("id1", int), ("id2", int), *((each, float) for each in numbers)]
        rows = np.empty(at.size, kinds)
        rows["id1"], rows["id2"] = self._ids[self._first[at]], self._ids[self._second[at]]
        rows["separation"], rows["force"] = self._separation[at], self._attraction[at]
        for n, pair in enumerate(at):
            rows["liquid"][n], rows["energy"][n] = (self._value(asked, pair) for asked in (_LIQUID, _ENERGY))
        if self._given_film is not None:
            rows["volume"] = self._volumes[at]
        else:
            rows["volume"] = self.held if self._name == "volume" else rows["liquid"]
        return rows

    def films(self):
        """Liquid on each sphere, [m3], as a dictionary of ids; for one that is changed, `set_film`."""
        spheres = self._spheres if self._bodies else np.empty(0, int)
        return dict(zip(self._ids[spheres].tolist(), self._film[spheres].tolist(), strict=True))

    def set_film(self, number, volume):
        """Liquid on the sphere of an id, [m3], after the first step."""
        self._film[np.searchsorted(self._ids, number)] = volume

    def step(self):
        """Add the forces of the bridges, for YADE's next step."""
        from yade import O
        from yade._utils import coordsAndDisplacements

        lists = (coordsAndDisplacements(axis)[0] for axis in range(3))
        places = np.array(
            [np.frombuffer(array("d", each)) for each in lists]
        )  # in half the time of the lists themselves
        if (len(O.bodies), places.shape[1]) != self._bodies:
            self._take_bodies(O)
        self._turn()
        cell = np.array([[O.cell.hSize[i][k] for k in range(3)] for i in range(3)]) if O.periodic else None
        if self._is_stale(places, cell):
            self._seek(places, cell)
        forces = np.zeros_like(places)
        beside = None if cell is None else np.ascontiguousarray(self._shift @ cell.T)
        heap = self._heap(places, beside)
        if self._shapes.size:
            self._c.pendular_yade_settle(ctypes.byref(heap), _at(self._film))
        status, held = 0, ctypes.c_double(self.held)
        if self._given_film is not None:
            room = np.empty_like(self._film)
            share = ctypes.c_double(self.share)
            status = self._c.pendular_yade_exchange(ctypes.byref(heap), held, share, _at(self._film), _at(room))
        if not status:
            out = map(_at, (forces, self._separation, self._attraction))
            status = self._c.pendular_yade_step(ctypes.byref(heap), held, *out)
        if status:
            raise ValueError(self._told(*self._partner(heap.out_of_range)))
        self._forms_apart = False
        pulled = np.flatnonzero(forces.any(axis=0))
        rows = zip(*forces[:, pulled].tolist(), strict=True)
        deque(map(O.forces.addF, self._ids[pulled].tolist(), rows), 0)  # the quickest of all loops

    # Bodies and neighbours -------------------------------------------------------------------------------------------

    def _take_bodies(self, omega):
        """Ids, radii and walls of the simulation."""
        bodies = list(omega.bodies)
        bridged = self._ids[np.stack([self._first, self._second])[:, self._has_bridge > 0]]
        volumes, films = self._volumes[self._has_bridge > 0], dict(zip(self._ids.tolist(), self._film, strict=True))
        self._bodies = len(omega.bodies), len(bodies)
        ids = np.array([body.id for body in bodies])
        kinds = [body.shape.__class__.__name__ for body in bodies]
        radius = [body.shape.radius if kind == "Sphere" else np.nan for body, kind in zip(bodies, kinds, strict=True)]
        self._ids, self._radius = ids, np.array(radius)
        self._kind = np.array([_kind_of(body.shape) for body in bodies], np.int8)
        self._turned = [body for body, kind in zip(bodies, self._kind, strict=True) if kind >= _FACET]
        self._surfaces = np.flatnonzero(self._kind >= _FACET)
        self._shapes = np.zeros((self._surfaces.size, 18))  # three corners or half the edges, and a rotation
        for row, body in zip(self._shapes, self._turned, strict=True):
            corners = np.ravel(body.shape.vertices if hasattr(body.shape, "vertices") else body.shape.extents)
            row[: corners.size] = corners
        self._surface_of = np.zeros(ids.size, np.int32)
        self._surface_of[self._surfaces] = np.arange(self._surfaces.size)
        self._clump = np.array([body.clumpId if body.isClumpMember else -1 for body in bodies])
        self._spheres, self._planes = np.flatnonzero(self._radius > 0.0), np.flatnonzero(self._kind >= 0)
        if omega.periodic and self._planes.size:
            raise ValueError("bodies: walls have no place in a periodic cell")
        self._sought = None
        self._film = np.array([films.get(number, self._first_film(number)) for number in ids.tolist()])
        self._film[self._kind >= 0] = 0.0
        is_there = np.isin(bridged, ids)
        halves = [1.0 if other in self._former_walls else 0.5 for other in bridged[1].tolist()]
        for pair, (its, others), volume in zip(bridged.T, is_there.T, volumes * halves, strict=True):
            if its != others:  # the grain that is left has its part of the liquid
                left = np.searchsorted(ids, pair[0 if its else 1])
                self._film[left] += volume * (self._kind[left] < 0)
        self._former_walls = set(ids[self._planes].tolist())
        stands = is_there.all(axis=0)  # bridges of bodies that are still there
        self._first, self._second = (np.searchsorted(ids, column).astype(np.int32) for column in bridged[:, stands])
        self._has_bridge, self._volumes = np.ones(self._first.size, np.uint8), volumes[stands]

    def _is_stale(self, places, cell):
        """Whether grains may have come near that are no neighbours yet."""
        if self._sought is None or self._sought_for != (self.held, self.surface_tension):
            return True
        if (cell is None) != (self._sought_cell is None):
            return True
        strain = np.zeros((3, 3)) if cell is None else cell @ np.linalg.inv(self._sought_cell) - np.eye(3)
        moved = places - self._sought - strain @ self._sought
        ways = np.sqrt((moved * moved).sum(axis=0))
        turned = np.linalg.norm(self._shapes[:, 9:] - self._sought_turns, axis=1)
        ways[self._surfaces] += turned * self._widths
        farthest = 2.0 * ways.max(initial=0.0)
        return farthest + np.linalg.norm(strain) * self._longest > self._near

    def _seek(self, places, cell):
        """Pairs of neighbours, with the bridges that they have."""
        radii = self._radius[self._spheres]
        self._near = 0.1 * radii.min(initial=np.inf) if self._skin is None else self._skin
        self._sought, self._sought_cell, self._sought_for = places, cell, (self.held, self.surface_tension)
        far = self._near + self._reach(radii)
        self._sought_turns = self._shapes[:, 9:].copy()
        self._longest = far + 2.0 * radii.max(initial=0.0)  # between centres
        if cell is None:
            pairs = [*_near_spheres(self._spheres, places[:, self._spheres].T, radii, far)]
        else:
            one, other, self._shift = _near_in_cell(places[:, self._spheres].T, radii, far, cell)
            pairs = [np.column_stack([self._spheres[one], self._spheres[other]])]
        pairs += [self._near_wall(wall, places, far) for wall in self._planes]
        both = np.concatenate(pairs) if pairs else np.empty((0, 2), int)
        clumps = self._clump[both]
        is_free = (clumps[:, 0] < 0) | (clumps[:, 0] != clumps[:, 1])  # grains of one clump have none with each other
        both = both[is_free]
        if cell is not None:
            self._shift = self._shift[is_free]
        kept, volumes = self._keys(self._first, self._second)[self._has_bridge > 0], self._volumes[self._has_bridge > 0]
        lost = ~np.isin(kept, keys := self._keys(*both.T))
        for key, volume in zip(kept[lost].tolist(), volumes[lost], strict=True):  # left behind since they were sought
            self._give_back(*divmod(key, self._radius.size), volume)
        self._first, self._second = (np.ascontiguousarray(column, np.int32) for column in both.T)
        self._has_bridge = np.isin(keys, kept).astype(np.uint8)
        self._volumes = np.zeros(keys.size)
        if kept.size:
            order = np.argsort(kept)
            at = np.searchsorted(kept, keys[self._has_bridge > 0], sorter=order)
            self._volumes[self._has_bridge > 0] = volumes[order[at]]
        self._separation, self._attraction = np.empty(keys.size), np.empty(keys.size)
        at = np.flatnonzero(self._kind[self._second] >= 0)
        self._at_surfaces = at[np.argsort(self._first[at], kind="stable")].astype(np.int32)
        self._is_hidden = np.zeros(keys.size, np.uint8)

    def _near_wall(self, wall, places, far):
        """Pairs of spheres with a wall, a facet or a box."""
        kind, radii, way = self._kind[wall], self._radius[self._spheres], places[:, self._spheres] - places[:, [wall]]
        if kind < _FACET:
            near = self._spheres[np.abs(way[kind]) - radii < far]
            return np.column_stack([near, np.full_like(near, wall)])
        near = self._spheres[np.linalg.norm(way, axis=0) - radii - self._widths[self._surface_of[wall]] < far]
        first, second = near.astype(np.int32), np.full(near.size, wall, np.int32)
        gaps = np.empty(near.size)
        heap = self._heap(places, None, first=_at(first), second=_at(second), pairs=near.size)
        self._c.pendular_yade_gaps(ctypes.byref(heap), _at(gaps))
        return np.column_stack([near, second])[gaps < far]

    def _heap(self, places, beside, **others):
        """What C looks at."""
        named = {"places": places, "radius": self._radius, "kind": self._kind, "surface_of": self._surface_of}
        named |= {"surface": self._shapes, "first": self._first, "second": self._second}
        if not others:
            named |= {"has_bridge": self._has_bridge, "at_surfaces": self._at_surfaces, "is_hidden": self._is_hidden}
            named |= {"volumes": self._volumes} if self._given_film is not None else {}
            named |= {"beside": beside} if beside is not None else {}
            others = {"pairs": self._first.size, "surfaces": self._at_surfaces.size}
        return _Heap(
            grains=ctypes.addressof(self._grains), walls=ctypes.addressof(self._walls),
            surface_tension=self.surface_tension, bodies=self._radius.size, forms_apart=self._forms_apart,
            **{name: _at(numbers) for name, numbers in named.items()} | others,
        )  # fmt: skip

    def _turn(self):
        """Take the rotations of facets and boxes, and how far their corners are from their centres."""
        for row, body in zip(self._shapes, self._turned, strict=True):
            turn = body.state.ori.toRotationMatrix()
            row[9:] = [turn[i][k] for i in range(3) for k in range(3)]
        facets = self._kind[self._surfaces] == _FACET
        reach = np.linalg.norm(self._shapes[:, :9].reshape(-1, 3, 3), axis=2).max(axis=1, initial=0.0)
        self._widths = np.where(facets, reach, np.linalg.norm(self._shapes[:, :3], axis=1))

    def _first_film(self, number):
        """Liquid on a sphere that has just come."""
        if isinstance(self._given_film, dict):
            return self._given_film.get(number, 0.0)
        return self._given_film or 0.0

    def _give_back(self, one, other, volume):
        """The liquid of a bridge that broke, to its grains."""
        walls = self._kind[[one, other]] >= 0
        self._film[[one, other]] += np.where(walls, 0.0, volume / np.count_nonzero(~walls))

    def _keys(self, first, second):
        """A number for each pair, whichever of the two is first."""
        low, high = np.minimum(first, second).astype(np.int64), np.maximum(first, second).astype(np.int64)
        return low * self._radius.size + high

    def _reach(self, radii):
        """Largest rupture distance of all pairs of sizes; those that the table does not know are refused in touch."""
        if not radii.size:
            return 0.0
        sizes = np.geomspace(radii.min(), radii.max(), _SIZES)
        partners = [(self._grains, size, other) for size in sizes for other in sizes]
        partners += [(self._walls, size, np.inf) for size in sizes] if self._planes.size else []
        held = max(self.held, self._volumes.max(initial=0.0))
        ends = [
            self._asked(table, _RUPTURE, 0.0, self._known(table, held, *radii), *radii) for table, *radii in partners
        ]
        return _MARGIN * float(np.nan_to_num(ends).max())

    def _known(self, table, held, radius1, radius2):
        """The most liquid up to this that the table knows for a pair, for films may give less; else what is held."""
        if self._given_film is None:
            return held
        mean = 2.0 / (1.0 / radius1 + 1.0 / radius2)
        return min(held, (1.0 - 1e-9) * self._about(table)[3] * mean**3)

    # The table -------------------------------------------------------------------------------------------------------

    def _opened(self, path):
        table = ctypes.create_string_buffer(self._c.pendular_yade_size())
        code = self._c.pendular_yade_open(str(path).encode(), table)
        if code:
            raise ValueError(f"table: {str(path)!r}: {self._c.pendular_yade_error(code).decode()}")
        return table

    def _about(self, table):
        numbers = np.empty(6)
        self._c.pendular_yade_about(table, ctypes.c_void_p(numbers.ctypes.data))
        return numbers.tolist()

    def _asked(self, table, asked, separation, held, radius1, radius2):
        numbers = map(ctypes.c_double, (separation, held, radius1, radius2, self.surface_tension))
        return self._c.pendular_yade_value(table, asked, *numbers)

    def _partner(self, pair):
        """Table and radii of a pair."""
        i, j = self._first[pair], self._second[pair]
        if self._kind[j] >= 0:
            return self._walls, self._radius[i], np.inf
        return self._grains, self._radius[i], self._radius[j]

    def _value(self, asked, pair):
        table, radius1, radius2 = self._partner(pair)
        held = self.held if self._given_film is None else self._volumes[pair]
        return self._asked(table, asked, self._separation[pair], held, radius1, radius2)

    def _told(self, table, radius1, radius2):
        _, _, low, high, least, largest = self._about(table)
        pair = f"radii {radius1:g} and {radius2:g} and surface tension {self.surface_tension:g}"
        covered = f"reduced {self._name} {low:g} to {high:g}, radius ratio {least:g} to {largest:g}"
        return f"{self._name}: {self.held:g} with {pair} is out of the range of its table: {covered}"


def _at(numbers):
    """Where C finds the numbers of an array."""
    return ctypes.c_void_p(numbers.ctypes.data)


def _kind_of(shape):
    """Number of a kind of body: the axis of a wall, else as in pendular_yade.c; what is no wall is a sphere."""
    name = shape.__class__.__name__
    return shape.axis if name == "Wall" else {"Facet": _FACET, "Box": _BOX}.get(name, _SPHERE)


def _near_spheres(numbers, places, radii, far):
    """Pairs of spheres whose surfaces are nearer than so far: by classes of size, each twice as large as the last."""
    if not radii.size:
        return
    classes = np.floor(np.log2(radii / radii.min())).astype(int)
    groups = [np.flatnonzero(classes == each) for each in np.unique(classes)]
    for n, group in enumerate(groups):
        for other in groups[n:]:
            within = far + radii[group].max() + radii[other].max()
            for one, its in _in_cells(places[group], places[other], within):
                i, j = group[one], other[its]
                gap = np.sqrt(((places[i] - places[j]) ** 2).sum(axis=1)) - radii[i] - radii[j]
                is_pair = (gap < far) & ((i < j) if other is group else True)
                yield np.column_stack([numbers[i[is_pair]], numbers[j[is_pair]]])


def _near_in_cell(places, radii, far, cell):
    """The same in a periodic cell: numbers of two spheres, and by how many edges the second is to be moved."""
    inverse = np.linalg.inv(cell)
    widths = 1.0 / np.linalg.norm(inverse, axis=1)
    within = far + 2.0 * radii.max(initial=0.0)
    if np.any(widths < 2.0 * within):
        raise ValueError(f"cell: its width {widths.min():g} is less than twice {within:g}, how far bridges reach")
    turns = np.floor(places @ inverse.T)
    fractions = places @ inverse.T - turns
    number, shift = [np.arange(radii.size)], [np.zeros((radii.size, 3))]
    for step in np.ndindex(3, 3, 3):
        if step == (1, 1, 1):
            continue
        image = fractions + step - 1.0
        near = np.flatnonzero(((image > -within / widths) & (image < 1.0 + within / widths)).all(axis=1))
        number.append(near)
        shift.append(np.tile(np.subtract(step, 1.0), (near.size, 1)))
    number, shift = np.concatenate(number), np.concatenate(shift)
    points = (fractions[number] + shift) @ cell.T
    found = [*_near_spheres(np.arange(number.size), points, radii[number], far)]
    pairs = np.concatenate(found) if found else np.empty((0, 2), int)
    pairs = np.where(pairs[:, :1] <= pairs[:, 1:], pairs, pairs[:, ::-1])  # a sphere itself before images
    one, other = number[pairs].T
    is_image = pairs[:, 1] >= radii.size
    chosen = (pairs[:, 0] < radii.size) & (~is_image | (one < other))
    one, other, apart = one[chosen], other[chosen], shift[pairs[chosen, 1]]
    return one, other, apart - turns[other] + turns[one]


def _in_cells(places, others, size):
    """Pairs of points in the same cell, or in two that touch, one kind of neighbour after another."""
    low = np.minimum(places.min(axis=0), others.min(axis=0))
    cells, its_cells = (1 + np.floor((each - low) / size).astype(np.int64) for each in (places, others))
    counts = 2 + np.maximum(cells.max(axis=0), its_cells.max(axis=0))
    strides = np.array([counts[1] * counts[2], counts[2], 1])
    keys = its_cells @ strides
    order = np.argsort(keys)
    keys = keys[order]
    for shift in np.ndindex(3, 3, 3):
        wanted = (cells + shift - 1) @ strides
        start, stop = (np.searchsorted(keys, wanted, side) for side in ("left", "right"))
        found = stop - start
        one = np.repeat(np.arange(found.size), found)
        place = np.arange(one.size) - np.repeat(np.cumsum(found) - found, found)
        yield one, order[np.repeat(start, found) + place]


def _library():
    """The functions of C that stand beside this file."""
    path = _HERE / "libpendular_yade.so"
    if not path.exists():
        command = "cc -O3 -march=native -shared -fPIC -o libpendular_yade.so pendular_yade.c -lm"
        raise ValueError(f"engine: '{path}' is not there; in its folder: {command}")
    library = ctypes.CDLL(str(path))
    library.pendular_yade_size.restype = ctypes.c_size_t
    library.pendular_yade_error.restype = ctypes.c_char_p
    library.pendular_yade_value.restype = ctypes.c_double
    return library
