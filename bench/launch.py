"""Run a command and note its seconds, peak memory and exit code: launch.py REPORT COMMAND...

A process of its own, because the kernel starts a child's account of peak memory with what its
parent holds, and the bench itself holds much.
"""

import os
import sys
import time

report, command = sys.argv[1], sys.argv[2:]
start = time.perf_counter()
child = os.posix_spawnp(command[0], command, os.environ)
_, status, usage = os.wait4(child, 0)
seconds = time.perf_counter() - start
with open(report, "w") as file:
    file.write(f"{seconds} {usage.ru_maxrss} {os.waitstatus_to_exitcode(status)}")
