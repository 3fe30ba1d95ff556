"""`python -m mjsim.run`, as `undulator run`."""

import sys

from mjsim.commands.run import main

if __name__ == "__main__":
    sys.exit(main())
