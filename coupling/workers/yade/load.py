"""Makes `import yade` work: as a library, without the yade launcher, which opens network ports."""
import glob
import sys

folders = sorted(glob.glob("/usr/lib/*/yade-double/py"))
if not folders:
    raise ImportError("there is no folder yade-double/py under /usr/lib")
sys.path.insert(0, folders[0])

import yade.config  # noqa: E402
from yade import log  # noqa: E402

log.setLevel("NewtonIntegrator", log.ERROR)  # it warns of a density scaling that is meant (steps.py)

VERSION = yade.config.version
