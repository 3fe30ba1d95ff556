"""`python -m mjsim.run`, as `undulator run`."""

import sys

from mjsim.commands.undulator import start

if __name__ == "__main__":
    sys.exit(start(["run", *sys.argv[1:]]))
