"""The kernels for spheres, retold for surfaces of any kind: the same code, with other answers about a solid."""

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

from ...ground.compile import is_kernel
from .. import clearance, equations, stability, state
from ..algebra import Four
from ..equations import Held, System
from ..solids import sphere
from . import surfaces
from .side import Sided, has_side, on_side


def _is_clearly_outside(_system: Any, _held: Any, least: float, most: float, force: float, curvature: float) -> bool:
    """Whether a meridian runs forward and is nowhere bent outwards, so that no convex solid can be met again."""
    half = 0.5 * curvature
    at_least, at_most = force / least - half * least, force / most - half * most
    bend = half + min(force / (least * least), force / (most * most))
    return min(at_least, at_most) > 0.0 and bend >= 0.0


def _sideways_later(_force: float, _held: Any) -> float:
    return 1.0


def _system_at(z: Four, held: Held, fine: bool, with_volume: bool) -> System:
    """All equations; on the side of a cylinder the volume is always among them."""
    if has_side(held):
        return on_side(_copied(equations.system_at)(z, held, fine, True), held)
    system: System = _copied(equations.system_at)(z, held, fine, with_volume)
    return system


def _ladder_at(z: Four, system: System) -> stability.Ladder:
    ladder = system.ladder if isinstance(system, Sided) else system
    return stability.ladder_at(z, ladder)


_ANSWERS: dict[Any, Callable[..., Any]] = {
    equations.system_at: _system_at,
    stability.ladder_at: _ladder_at,
    sphere.contact_with: surfaces.contact_with,
    sphere.half_filling_angle: surfaces.half_filling_angle,
    sphere.depth_inside: surfaces.depth_inside,
    clearance.is_clearly_outside: _is_clearly_outside,
    state.sideways_of: _sideways_later,
}


def retold(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel as it is between surfaces of any kind."""
    return _ANSWERS[kernel] if kernel in _ANSWERS else _copied(kernel)


@cache
def _copied(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel in which all that it calls is retold."""
    assert isinstance(kernel, FunctionType)
    known, names = kernel.__globals__, kernel.__code__.co_names
    scope = {name: retold(known[name]) if is_kernel(known[name]) else known[name] for name in names if name in known}
    return FunctionType(kernel.__code__, scope, kernel.__name__, kernel.__defaults__, kernel.__closure__)
