"""Files of a bridge's surface: for ParaView and printers by meshio, and to go on from with Surface Evolver [1].

References
----------
.. [1] Brakke, The Surface Evolver, Experimental Mathematics 1 (1992) 141, doi:10.1080/10586458.1992.10504253
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from .._version import __version__
from ..ask.mesh import SURFACES, Mesh
from ..ask.pair import Pair
from ..ask.result import Bridge
from ..ground.check import as_path, instance
from ..ground.files import in_one_line, whole
from .grains.found import optional

__all__ = ["write_mesh"]

_SUFFIXES = (".vtu", ".stl", ".obj", ".ply", ".fe")
_LIQUID_GAS, _FIRST_DRY = 0, 3


def write_mesh(path: Any, pair: Pair, bridge: Bridge, around: int = 96) -> None:
    """Write the surfaces of a bridge and its solids as triangles.

    Parameters
    ----------
    path : path
        Its suffix tells the format: ``.vtu`` for ParaView, with the number of the surface at each triangle; ``.stl``,
        ``.obj`` and ``.ply`` for printers and modellers; ``.fe``, the liquid alone as a start file for Surface Evolver.
    pair : Pair
        The solids.
    bridge : Bridge
        A single one between them.
    around : int
        Points of a ring about the axis, 8 to 1000.

    Raises
    ------
    ValueError
        For another suffix, a bridge without a mesh (see `Bridge.mesh`), or a file that cannot be written.

    Notes
    -----
    Lengths are in metres, but for ``.fe``, whose lengths are over the larger contact radius and whose tension is 1: it
    says in its head what a unit of its energy and of its pressure is. It holds the volume; contact lines slide on the
    solids, and the wetted surfaces have the tension -cos θ. Evolver's pressure is the suction with the other sign.

    Examples
    --------
    >>> import pendular as pl
    >>> grains = pl.Pair(radius=50e-6, contact_angle=0.3)
    >>> b = pl.bridge(grains, 1e-6, volume=1e-15, liquid=pl.Liquid(surface_tension=0.0728))
    >>> pl.write_mesh("bridge.step", grains, b)
    Traceback (most recent call last):
        ...
    ValueError: path: 'bridge.step' does not end in .vtu, .stl, .obj, .ply or .fe
    """
    file = as_path("path", path)
    instance("pair", pair, Pair)
    instance("bridge", bridge, Bridge)
    suffix = file.suffix.lower()
    if suffix not in _SUFFIXES:
        raise ValueError(f"path: '{file}' does not end in {', '.join(_SUFFIXES[:-1])} or {_SUFFIXES[-1]}")
    mesh = bridge.mesh(around)
    with in_one_line("path", file):
        if suffix == ".fe":
            with whole(file) as draft:
                draft.write_text("\n".join(_evolver_lines(pair, bridge, mesh)) + "\n", encoding="ascii")
        else:
            _by_meshio(file, mesh)


def _by_meshio(file: Path, mesh: Mesh) -> None:
    suffix = file.suffix.lower()
    try:
        meshio = optional("meshio")
    except ValueError as error:
        raise ValueError(f"path: for {suffix} {error}") from error
    names = {"surface": [mesh.surface]} if suffix == ".vtu" else None  # the others hold shapes alone
    record = meshio.Mesh(mesh.points, [("triangle", mesh.triangles.astype(np.int32))], cell_data=names)
    with whole(file) as draft:
        record.write(draft, **({"binary": True} if suffix == ".stl" else {}))


# -- Surface Evolver -------------------------------------------------------------------------------------------------


def _evolver_lines(pair: Pair, bridge: Bridge, mesh: Mesh) -> Iterator[str]:
    """Start file: what it is, the solids as constraints, vertices, edges, faces, and the liquid as a body."""
    unit = float(np.max(bridge.contact_radius))
    gamma = bridge._surface_tension
    yield f"// Capillary bridge by Pendular {__version__}: the axis is x, the solid of constraint 1 lies at x < 0."
    yield f"// Lengths are over {unit!r} m, energies over {gamma * unit**2!r} J, pressures over {gamma / unit!r} Pa."
    yield f"// Exact: surface energy {bridge.surface_energy / (gamma * unit**2)!r},"
    yield f"// suction {bridge.suction * unit / gamma!r} (the body's pressure with the other sign)."
    cosines = [math.cos(angle) for angle in pair.contact_angles]
    for solid, side in enumerate((-1.0, 1.0)):
        pole, radius = (0.0, bridge.separation / unit)[solid], float(pair.radii[solid]) / unit
        yield f"constraint {solid + 1}"
        if np.isinf(radius):
            yield f"formula: x = {pole!r}"
        else:
            yield f"formula: (x - ({pole + side * radius!r}))^2 + y^2 + z^2 = {radius**2!r}"
    liquid = mesh.surface < _FIRST_DRY
    triangles, surface = mesh.triangles[liquid], mesh.surface[liquid]
    touches = [np.isin(np.arange(len(mesh.points)), triangles[surface == name]) for name in range(_FIRST_DRY)]
    yield from _vertices(mesh, touches, unit)
    yield from _edges_and_faces(triangles, surface, touches, cosines)
    everything = " ".join(map(str, range(1, len(triangles) + 1)))
    yield f"bodies\n1 {everything} volume {bridge.volume / unit**3!r}\nread"


def _vertices(mesh: Mesh, touches: list[Any], unit: float) -> Iterator[str]:
    """Points of the liquid; those inside of a wetted surface stay where they are."""
    yield "vertices"
    for i in np.flatnonzero(np.any(touches, axis=0)):
        place = " ".join(map(repr, (mesh.points[i] / unit).tolist()))
        solid = 1 if touches[1][i] else 2 if touches[2][i] else 0
        held = f" constraint {solid}" if solid else ""
        yield f"{i + 1} {place}{held}{'' if touches[_LIQUID_GAS][i] else ' fixed'}"


def _edges_and_faces(triangles: Any, surface: Any, touches: list[Any], cosines: list[float]) -> Iterator[str]:
    """Edges with the constraint of a wetted surface, and faces as their signed numbers."""
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2)
    edges, number = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    signed = np.where(sides[:, 0] < sides[:, 1], number.ravel() + 1, -number.ravel() - 1).reshape(-1, 3)
    belongs = np.zeros(len(edges), int)
    for solid in (1, 2):
        belongs[np.abs(signed[surface == solid]).ravel() - 1] = solid
    yield "edges"
    for i, ((one, other), solid) in enumerate(zip(edges.tolist(), belongs.tolist(), strict=True), start=1):
        yield f"{i} {one + 1} {other + 1}{f' constraint {solid}' if solid else ''}"
    yield "faces"
    for i, (face, name) in enumerate(zip(signed.tolist(), surface.tolist(), strict=True), start=1):
        held = f" constraint {name} tension {-cosines[name - 1]!r}" if name else ""
        yield f"{i} {' '.join(map(str, face))}{held} // {SURFACES[name]}"
