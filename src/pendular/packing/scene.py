"""A heap as an image by PyVista, where it is installed: the same view as by `rendering`, with smooth edges."""

import io
import math
import pickle
import subprocess
import sys
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .rendering import LIGHT, SHADE, View, inside_of, meridians_of, shape_of
from .wetted import Wet

__all__ = ["scene_image"]

Floats = NDArray[np.float64]

_FACETS = 4_000_000  # of all grains and all menisci, each
_SIDES = 12, 64  # least and most of a round body


def scene_image(w: Wet, view: View, pixels: int, colours: tuple[Floats, Floats, Floats]) -> Floats | None:
    """Image of a heap; arguments and result as those of :func:`image_of`.

    A process of its own draws it, for one without a driver of OpenGL would die.

    Returns
    -------
    ndarray or None
        None where PyVista is not installed or cannot draw.
    """
    if find_spec("pyvista") is None:
        return None
    task = pickle.dumps((w, view, pixels, colours))
    done = subprocess.run([sys.executable, "-m", __name__], input=task, capture_output=True, check=False)
    return np.load(io.BytesIO(done.stdout)) if done.returncode == 0 else None


def _draw_as_asked() -> None:
    """Draw what is asked on the input, and write the image to the output."""
    import pyvista as pv

    task = pickle.load(sys.stdin.buffer)
    with pv.vtk_verbosity("off"):  # it would complain of a screen that is not there
        np.save(sys.stdout.buffer, _drawn(pv, *task))


def _drawn(pv: Any, w: Wet, view: View, pixels: int, colours: tuple[Floats, Floats, Floats]) -> Floats:
    columns, rows = shape_of(view, pixels)
    plotter = pv.Plotter(off_screen=True, window_size=[columns, rows], lighting="none")
    centres = inside_of(w)
    look = {"smooth_shading": True, "ambient": SHADE, "diffuse": 1.0 - SHADE, "specular": 0.0}
    plotter.add_mesh(_grains(pv, centres, w.heap.radii), color=colours[0].tolist(), **look)
    if len(w.bridges):
        plotter.add_mesh(_menisci(pv, w, centres), color=colours[1].tolist(), **look)
    plotter.add_light(pv.Light(position=tuple(LIGHT @ view.axes), light_type="scene light", positional=False))
    depths = centres @ view.axes[2]
    focus = (view.low + 0.5 * view.size) @ view.axes[:2] + float(depths.mean()) * view.axes[2]
    far = 2.0 * float(np.ptp(depths) + 4.0 * w.heap.radii.max())
    plotter.camera_position = [tuple(focus + far * view.axes[2]), tuple(focus), tuple(view.axes[1])]
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = 0.5 * float(view.size[1])
    plotter.set_background(colours[2].tolist())
    plotter.enable_anti_aliasing("msaa", multi_samples=8)
    plotter.renderer.ResetCameraClippingRange()
    image = plotter.screenshot(return_img=True)
    plotter.close()
    return np.asarray(image[::-1], float) / 255.0


def _sides(bodies: int) -> int:
    """Sides of round bodies, so many that all of them stay within the number of facets."""
    return int(np.clip(math.isqrt(_FACETS // max(1, bodies)), *_SIDES))


def _grains(pv: Any, centres: Floats, radii: Floats) -> Any:
    """All grains as one mesh."""
    points = pv.PolyData(centres)
    points["radius"] = radii
    sides = _sides(len(radii))
    ball = pv.Sphere(radius=1.0, theta_resolution=sides, phi_resolution=max(6, sides // 2))
    return points.glyph(scale="radius", orient=False, geom=ball)


def _menisci(pv: Any, w: Wet, centres: Floats) -> Any:
    """All menisci as one mesh."""
    ends, control, chosen = meridians_of(w, centres)
    around = _sides(len(chosen))
    along = max(4, around // 4)
    t = np.linspace(0.0, 1.0, along + 1)[None, :, None]
    meridian = (1 - t) ** 2 * ends[0][:, None] + 2 * t * (1 - t) * control[:, None] + t**2 * ends[1][:, None]
    axis = w.bridges.normal[chosen]
    helper = np.eye(3)[np.argmin(np.abs(axis), axis=1)]
    across = np.cross(axis, helper)
    across /= np.linalg.norm(across, axis=1)[:, None]
    other = np.cross(axis, across)
    turn = 2.0 * math.pi * np.arange(around) / around
    spokes = np.cos(turn)[:, None] * across[:, None] + np.sin(turn)[:, None] * other[:, None]
    first = w.bridges.pairs[chosen, 0]
    poles = centres[first] + w.heap.radii[first, None] * axis
    points = poles[:, None] + meridian[..., :1] * axis[:, None]
    points = points[:, :, None] + meridian[:, :, None, 1:] * spokes[:, None]
    ring, side = np.meshgrid(np.arange(along), np.arange(around), indexing="ij")
    step = (side + 1) % around
    corners = np.stack(
        [ring * around + side, ring * around + step, (ring + 1) * around + step, (ring + 1) * around + side]
    )
    facets = corners.reshape(4, -1).T + (np.arange(len(chosen)) * (along + 1) * around)[:, None, None]
    facets = np.concatenate([np.full((*facets.shape[:2], 1), 4), facets], axis=-1)
    return pv.PolyData(points.reshape(-1, 3), facets.ravel())


if __name__ == "__main__":
    _draw_as_asked()
