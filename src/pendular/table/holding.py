"""Up to which volume all pairs of a table hold a bridge from contact on.

If one solid is wetted and the other is not, a large volume holds no bridge while the two touch: the stable branch
begins at a separation. A table has no such place, as its coordinate q runs from rupture to contact.
"""

import numpy as np
from numpy.typing import NDArray

from ..exact.batch import FOUND, RUPTURE, STABLE, answer
from ..exact.equations import VOLUME
from .samples import pairs_of
from .task import Task

Floats = NDArray[np.float64]

_VOLUMES_PER_DECADE, _SIZES = 16, 33
_HALVINGS = 24
_INSIDE = 1.0 - 1e-6  # of the limit: what is said, to six digits, is allowed


def refuse_without_contact(task: Task) -> None:
    """Refuse a range of volumes in which some pair holds no bridge at contact; say where it has to end."""
    count = 2 + int(_VOLUMES_PER_DECADE * np.log10(task.high / task.low))
    volumes = np.geomspace(task.low, task.high, count)
    holding = _hold(task, volumes)
    if holding.all():
        return
    first = int(np.argmin(holding))
    if first == 0:
        raise ValueError(
            f"reduced: a volume of {task.low:.6g} holds no bridge at contact for these contact angles and radius ratios"
        )
    low, high = volumes[first - 1 : first + 1]
    for _ in range(_HALVINGS):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if _hold(task, middle[None]).all() else (low, middle)
    low *= _INSIDE
    raise ValueError(
        f"reduced: ({task.low:.6g}, {task.high:.6g}) ends above {low:.6g}, the largest volume that holds a bridge at "
        "contact for these contact angles and all radius ratios"
    )


def _hold(task: Task, volumes: Floats) -> NDArray[np.bool_]:
    """Whether pairs of all sizes hold each volume at contact, and up to a rupture distance."""
    controls, sizes = (each.ravel() for each in np.meshgrid(volumes, np.linspace(*task.sizes, _SIZES), indexing="ij"))
    holding = np.ones(controls.size, bool)
    for side in range(task.sides):
        questions = np.column_stack([np.zeros(controls.size), pairs_of(task, controls, sizes, side)])
        for asked in (STABLE, RUPTURE):
            holding &= answer(asked, VOLUME, questions)[1] == FOUND
    return np.asarray(holding.reshape(volumes.size, -1).all(axis=1), bool)
