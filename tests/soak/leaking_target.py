"""A target with a leak, which the soak must detect: every half second the target opens one more descriptor, or allocates more memory.

    leaking_target.py descriptors|memory HIL_TARGET [OPTIONS OF HIL_TARGET...]
"""

import os
import signal
import subprocess
import sys

kept = []
target = subprocess.Popen(sys.argv[2:])
signal.signal(signal.SIGTERM, lambda *_: target.terminate())
while target.poll() is None:
    kept.append(os.open(os.devnull, os.O_RDONLY) if sys.argv[1] == "descriptors" else bytearray(os.urandom(64 << 10)))
    try:
        target.wait(0.5)
    except subprocess.TimeoutExpired:
        pass
sys.exit(target.returncode)
