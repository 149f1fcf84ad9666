#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Time and memory of `iride radiosity room` over the number of patches, as JSON:

    scripts/radiosity.py build/release/iride > cost.json
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time

RUNS = [("rays", n, w) for w in (1, 40) for n in (1000, 3000, 10000)] + [
    ("hierarchical", n, w) for w in (1, 40) for n in (1000, 3000, 10000, 30000, 100000, 300000)]


def measured(program, method, patches, wavelengths):
    """The run's own account of it, its seconds, and the most memory that it held at a time."""
    command = [program, "radiosity", "room", "--form-factors", method, "--patches", str(patches), "--wavelengths",
               str(wavelengths), "--memory", "16"]
    with tempfile.TemporaryFile("w+") as said:
        start = time.monotonic()
        child = subprocess.Popen(command, stdout=said, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - start
        said.seek(0)
        text = said.read()
    if child.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {child.returncode}")
    links = re.search(r"(\d+) links", text)
    return {"method": method, "patches": int(re.match(r"(\d+) patches", text)[1]), "wavelengths": wavelengths,
            "seconds": seconds, "bytes": usage.ru_maxrss * 1024, "links": int(links[1]) if links else None}


print(json.dumps({"threads": os.cpu_count(), "runs": [measured(sys.argv[1], *run) for run in RUNS]}, indent=1))
