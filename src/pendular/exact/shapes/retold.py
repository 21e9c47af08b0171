"""The kernels for spheres, retold for surfaces of any kind: the same code, with other answers about a solid."""

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

from ...ground.compile import is_kernel, kernel, marked_as
from .. import clearance, equations, stability, state
from ..algebra import Four
from ..equations import Held, System
from ..solids import sphere
from . import surfaces
from .side import AnySystem, for_ladder, has_side, off_side, on_side


@kernel
def _is_clearly_outside(
    _first: Any, _second: Any, _held: Any, least: float, most: float, force: float, curvature: float
) -> bool:
    """Whether a meridian runs forward and is nowhere bent outwards, so that no convex solid can be met again."""
    half = 0.5 * curvature
    at_least, at_most = force / least - half * least, force / most - half * most
    bend = half + min(force / (least * least), force / (most * most))
    return min(at_least, at_most) > 0.0 and bend >= 0.0


@kernel
def _sideways_later(_force: float, _held: Any) -> float:
    return 1.0


@kernel
def _system_at(z: Four, held: Held, fine: bool, with_volume: bool) -> AnySystem:
    """All equations; on the side of a cylinder the volume is always among them."""
    is_on_side = has_side(held)
    system = system_as_if_liquid(z, held, fine, with_volume or is_on_side)
    return on_side(system, held) if is_on_side else off_side(system)


@kernel
def _ladder_at(z: Four, system: AnySystem) -> stability.Ladder:
    return stability.ladder_at(z, for_ladder(system))


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
    """A copy of a kernel in which all that it calls is retold; one that asks nothing of a solid stays as it is."""
    assert isinstance(kernel, FunctionType)
    known = kernel.__globals__
    names = [name for name in kernel.__code__.co_names if name in known]
    scope = {name: retold(known[name]) if is_kernel(known[name]) else known[name] for name in names}
    if all(scope[name] is known[name] for name in names):
        return kernel
    copy = FunctionType(kernel.__code__, scope, kernel.__name__, kernel.__defaults__, kernel.__closure__)
    copy.__annotations__ = kernel.__annotations__
    return marked_as(kernel, copy)


system_as_if_liquid: Callable[..., System] = _copied(equations.system_at)  # that behind a side is counted with it
