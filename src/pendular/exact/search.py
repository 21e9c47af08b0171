"""Finding a stable bridge of two solids that hold something, wherever Newton's method alone does not.

First at other separations. A volume or a pressure is held by a spherical drop then, whose branch is followed over its
folds; where the drop swallows a solid, it is the bridge of two solids that are wetted less, and leads to the one sought
by a morph. At last by a morph from an easy problem: two solids that are wetted alike, and a little liquid.
"""

import math

from ..ground.compile import kernel
from .algebra import Four
from .curve import Stance, set_out
from .drop import drop_between
from .equations import VOLUME, system_at
from .follow import BRANCH_ENDS, Nodes, beyond, follow, just_after
from .guess import guess_at
from .locate import ENDED, LOST
from .morph import Task, held_of, morph
from .newton import newton_to
from .solids import Solid

_LAST_DIGITS = 2e-12
_EASY_ANGLE = 0.5
_EASY_VOLUME = 0.2 / math.pi  # V/π over R̄³
_SHARES = (0.5, 0.2, 0.8, 0.1, 0.35, 0.0, 1.2, 0.05, 0.02)  # of the natural separation, where to look
_LEAST_ANGLES = (0.0, 0.3, 0.1, 0.03, 1.0, 0.01, 3e-3, 1e-3, 1e-4, 1e-5)  # of solids that no drop swallows
_LEAST_OPENING = 1e-6  # of a drop that is an anchor itself
_MORPH_SHARES = (0.2, 0.5, 0.1, 0.0, 0.03, 1.0, 0.3, 0.7)
_ALIKE_FROM = 6  # attempts by a morph from which on the easy problem has equal solids
_MOST_FOLDS = 3
_MOST_STEPS = 14


@kernel
def at_separation(task: Task, separation: float) -> Task:
    """The same task at another separation."""
    return Task(separation, task.value, task.curvature1, task.angle1, task.curvature2, task.angle2, task.control)


@kernel
def are_alike(first: Solid, second: Solid) -> bool:
    """Whether two solids are mirror images, but for the last digits of a radius or an angle."""
    return (abs(first.curvature - second.curvature) <= _LAST_DIGITS * max(first.curvature, second.curvature)) & (
        abs(first.contact_angle - second.contact_angle) <= _LAST_DIGITS
    )


@kernel
def is_symmetric(task: Task) -> bool:
    """Whether the two solids are mirror images."""
    held = held_of(task)
    return are_alike(held.first, held.second)


@kernel
def are_planes(task: Task) -> bool:
    """Whether both solids are planes."""
    return task.curvature1 + task.curvature2 == 0.0


@kernel
def directly(task: Task) -> tuple[Stance, int]:
    """Where Newton's method leads from a guess: the bridge and its index, -1 where it did not converge."""
    held = held_of(task)
    z, is_met = newton_to(guess_at(held, task.separation), task.separation, held, _MOST_STEPS)
    stance, _curve = set_out(z, held, is_symmetric(task), 1.0)
    return stance, stance.unstable if is_met and stance.opening > 0.0 else -1


@kernel
def _easy(task: Task, alike: bool) -> Task:
    """An easy problem near to a task: both solids wetted alike, or even the same."""
    mean = 0.5 * (task.curvature1 + task.curvature2)
    k1, k2 = (mean, mean) if alike else (task.curvature1, task.curvature2)
    if task.control == VOLUME:
        value = min(task.value, _EASY_VOLUME / mean**3) if mean > 0.0 else task.value
        separation = min(task.separation * (value / task.value) ** (1.0 / 3.0), 0.5 * (math.pi * value) ** (1.0 / 3.0))
    else:
        value = max(task.value, mean)
        separation = min(task.separation, 0.1 / value)
    return Task(separation, value, k1, _EASY_ANGLE, k2, _EASY_ANGLE, task.control)


@kernel
def _woken(z: Four, task: Task, nodes: Nodes) -> tuple[Stance, bool]:
    """A stable bridge on the curve through any one: over the folds, both ways."""
    held, symmetric = held_of(task), is_symmetric(task)
    stance, _curve = set_out(z, held, symmetric, 1.0)
    if not stance.opening > 0.0:
        return stance, False
    if stance.unstable == 0:
        return stance, True
    for going in (1.0, -1.0):
        stance, curve = set_out(z, held, symmetric, going)
        for _ in range(_MOST_FOLDS):
            walk = follow(stance, curve, math.nan, BRANCH_ENDS, nodes[:0])
            if walk.event in (LOST, ENDED):
                break
            stance, curve = beyond(walk)
            if stance.unstable == 0:
                return just_after(stance, curve), True
    return stance, False


@kernel
def _from_drop(task: Task, nodes: Nodes) -> tuple[Stance, bool]:
    """The spherical drop, or where it swallows a solid, the bridge to which that of solids wetted less leads."""
    held, symmetric = held_of(task), is_symmetric(task)
    stance, _curve = set_out(guess_at(held, task.separation), held, symmetric, 1.0)
    for least in _LEAST_ANGLES:
        angle1, angle2 = max(task.angle1, least), max(task.angle2, least)
        is_own = angle1 == task.angle1 and angle2 == task.angle2
        if is_own and least > 0.0:  # tried as the first
            continue
        easy = Task(task.separation, task.value, task.curvature1, angle1, task.curvature2, angle2, task.control)
        z, is_drop = drop_between(held_of(easy))
        if not is_drop:
            continue
        if is_own:
            stance, _curve = set_out(z, held, symmetric, 1.0)
            if stance.opening > _LEAST_OPENING:
                stance, is_stable = _woken(z, task, nodes)
                if is_stable:
                    return stance, True
            continue
        separation = system_at(z, held_of(easy), True, True).separation.value
        hard = at_separation(task, separation)
        z, is_reached = morph(z, at_separation(easy, separation), hard)
        if is_reached:
            stance, is_stable = _woken(z, hard, nodes)
            if is_stable:
                return stance, True
    return stance, False


@kernel
def anchor(task: Task, nodes: Nodes) -> tuple[Stance, bool]:
    """A stable bridge that holds what is asked, near the separation of the task if possible."""
    stance, index = directly(task)
    if index == 0:
        return stance, True
    natural = _natural_separation(task)
    for share in _SHARES:
        if share == 0.0 and are_planes(task):  # at contact they leave no room
            continue
        stance, index = directly(at_separation(task, share * natural))
        if index == 0:
            return stance, True
    stance, is_stable = _from_drop(task, nodes)
    if is_stable:
        return stance, True
    for attempt in range(len(_MORPH_SHARES) + 1):
        if attempt > 0 and _MORPH_SHARES[attempt - 1] == 0.0 and are_planes(task):
            continue
        separation = task.separation if attempt == 0 else _MORPH_SHARES[attempt - 1] * natural
        hard = at_separation(task, separation)
        easy = _easy(hard, attempt > _ALIKE_FROM)
        easy_held = held_of(easy)
        z, is_met = newton_to(guess_at(easy_held, easy.separation), easy.separation, easy_held, _MOST_STEPS)
        if is_met:
            z, reached = morph(z, easy, hard)
            if reached:
                stance, is_stable = _woken(z, hard, nodes)
                if is_stable:
                    return stance, True
    return stance, False


@kernel
def _natural_separation(task: Task) -> float:
    """A separation of the order of the rupture distance."""
    if task.control == VOLUME:
        return (math.pi * task.value) ** (1.0 / 3.0)
    return 1.0 / (abs(task.value) + 2.0 * (task.curvature1 + task.curvature2))
