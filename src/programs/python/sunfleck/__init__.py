"""sunfleck: how sunlight spreads in three-dimensional plant canopies.

    import sunfleck

    result = sunfleck.run("scenes/maize_sparse.toml", error=0.01)
    result.bands["PAR"]["absorbed_vegetation"]   # W m-2 of ground
    result["PAR_absorbed"]                       # W m-2, one number per triangle

The module uses the engine of the program `sunfleck`: same scene files, same options, same numbers, bit for bit. Axes are X
south, Y up, Z west, or x east, y north, z up in scenes with axes = "east-north-up"; lengths are in metres, fluxes in W m-2,
angles in degrees. `Simulation` keeps the tree and the device for scenes that are simulated again under other light; `day`
simulates one or more days; `sweep` simulates several optical properties at once; `sun_position` and `sky` need no canopy;
`sunfleck.caribu` offers CARIBU's interface.
"""

from ._core import commit as __commit__
from ._core import version as __version__
from ._day import DayResult, day
from ._errors import DeviceError, Error, InputError, MissingFileError, SunfleckError
from ._light import Sky, sky, sun_position
from ._result import Result
from ._simulation import UNCHANGED, Simulation, run
from ._sweep import Variant, sweep

__all__ = [
    "UNCHANGED", "DayResult", "DeviceError", "Error", "InputError", "MissingFileError", "Result", "Simulation", "Sky",
    "SunfleckError", "Variant", "__commit__", "__version__", "day", "run", "sky", "sun_position", "sweep",
]  # fmt: skip
