"""Charts, maps and figures, and what only examples use: built on the product, not part of it."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
