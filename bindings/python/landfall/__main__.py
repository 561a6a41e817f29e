"""python -m landfall: the `landfall` command."""

import sys

from landfall.cli import main

sys.exit(main())
