"""The public names, for the package, which loads each on first use, and for type checkers."""

import typing

from ._version import __version__ as __version__
from .ask.by_law import RangeWarning as RangeWarning
from .ask.face import bridge as bridge
from .ask.face import curve as curve
from .ask.face import rupture as rupture
from .ask.film import Filmed as Filmed
from .ask.film import condensation_separation as condensation_separation
from .ask.film import film_thickness as film_thickness
from .ask.film import filmed as filmed
from .ask.liquid import KelvinWarning as KelvinWarning
from .ask.liquid import Liquid as Liquid
from .ask.liquid import humidity_from_suction as humidity_from_suction
from .ask.liquid import suction_from_humidity as suction_from_humidity
from .ask.mesh import Mesh as Mesh
from .ask.pair import Pair as Pair
from .ask.problem import ConvergenceWarning as ConvergenceWarning
from .ask.result import Bridge as Bridge
from .ask.result import Profile as Profile
from .ask.shapes import Cone as Cone
from .ask.shapes import Convex as Convex
from .ask.shapes import Disc as Disc
from .ask.shapes import Paraboloid as Paraboloid
from .codes.grains.labelled import packing_dataset as packing_dataset
from .codes.grains.reading import read_packing as read_packing
from .codes.grains.writing import write_packing as write_packing
from .codes.measured_curve import MeasuredCurve as MeasuredCurve
from .codes.measured_curve import read_curve as read_curve
from .codes.mesh_files import write_mesh as write_mesh
from .comparison import Comparison as Comparison
from .comparison import ErrorMap as ErrorMap
from .comparison import Recommendation as Recommendation
from .comparison import compare as compare
from .comparison import error_map as error_map
from .comparison import recommend as recommend
from .dataset.base import load_dataset as load_dataset
from .dataset.base import make_dataset as make_dataset
from .dataset.base import save_dataset as save_dataset
from .dataset.interpolation import interpolate as interpolate
from .dataset.interpolation import interpolate_rupture as interpolate_rupture
from .dataset.interpolation import interpolation_error as interpolation_error
from .fitting import Controls as Controls
from .fitting import Fit as Fit
from .fitting import FitWarning as FitWarning
from .fitting import fit as fit
from .fitting import fit_controls as fit_controls
from .packing.blocks import wet_in_blocks as wet_in_blocks
from .packing.forces import BridgeState as BridgeState
from .packing.forces import ContactForces as ContactForces
from .packing.forces import contact_energy as contact_energy
from .packing.forces import contact_forces as contact_forces
from .packing.heap import Packing as Packing
from .packing.heap import PackingWarning as PackingWarning
from .packing.heap import Wall as Wall
from .packing.lattice import lattice_packing as lattice_packing
from .packing.limit import pendular_limit as pendular_limit
from .packing.loosening import loosened as loosened
from .packing.precision import centre_noise as centre_noise
from .packing.random_packing import random_packing as random_packing
from .packing.retention import retention as retention
from .packing.sieve import sieved_radii as sieved_radii
from .packing.state import State as State
from .packing.state import load_state as load_state
from .packing.wet import wet as wet
from .packing.wetted import Wet as Wet
from .paths import BridgePath as BridgePath
from .paths import path as path
from .table import Table as Table
from .table import ToleranceWarning as ToleranceWarning
from .table import load_table as load_table
from .table import tabulate as tabulate

if typing.TYPE_CHECKING:
    import pendular.laws as _laws

    laws: _laws.Registry  # to a checker no module is a mapping
else:
    from . import laws as laws
