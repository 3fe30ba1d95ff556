"""`python -m mjsim COMMAND`, as `undulator COMMAND`."""

import sys

from mjsim.commands.undulator import main

if __name__ == "__main__":
    sys.exit(main())
