"""Friction of rigid bodies that slide over rubber and other viscoelastic materials, with error bars.

>>> import viscofriction as vf
>>> rubber = vf.Prony(1e6, [(1e7, 1e-3), (3e6, 1e-1)])
>>> friction = vf.slide(vf.Sphere(5e-3), rubber, normal_force=2.0, velocity=[1e-3, 1e-2, 1e-1])
>>> friction.mu.shape
(3,)

All numbers are in SI. Every result has an error bar, or is exact. Wrong input is a ValueError; what could not be reached is a
NotReached, which holds what was.
"""

from importlib.metadata import version as _version

from . import (
    _bodies,
    _fitting,
    _forms,
    _friction,
    _indentation,
    _kinds,
    _materials,
    _results,
    _solving,
    _sweeping,
    _tables,
)
from ._bodies import *  # noqa: F403
from ._fitting import *  # noqa: F403
from ._forms import *  # noqa: F403
from ._friction import *  # noqa: F403
from ._indentation import *  # noqa: F403
from ._kinds import *  # noqa: F403
from ._materials import *  # noqa: F403
from ._results import *  # noqa: F403
from ._solving import *  # noqa: F403
from ._sweeping import *  # noqa: F403
from ._tables import *  # noqa: F403

__version__ = _version("viscofriction")
__all__ = [
    *_bodies.__all__,
    *_fitting.__all__,
    *_forms.__all__,
    *_friction.__all__,
    *_indentation.__all__,
    *_kinds.__all__,
    *_materials.__all__,
    *_results.__all__,
    *_solving.__all__,
    *_sweeping.__all__,
    *_tables.__all__,
]
