"""Names what figures were measured on."""

import datetime
import os
import platform
import subprocess
import textwrap
from pathlib import Path


def describe():
    """Processor, cores, memory, system, compilers and date, each as a short text."""
    return {
        "processor": field("/proc/cpuinfo", "model name"),
        "family and model": f"{field('/proc/cpuinfo', 'cpu family')}/{field('/proc/cpuinfo', 'model')}",
        "cores": str(os.cpu_count()),
        "memory": f"{int(field('/proc/meminfo', 'MemTotal').split()[0]) / 2**20:.0f} GiB",
        "system": f"{platform.system()} {platform.release().split('-')[0]}, {platform.machine()}",
        "compilers": f"{first_line('rustc', '--version')}; {first_line('g++', '--version')}",
        "load before the run": f"{os.getloadavg()[0]:.1f}",
        "date": datetime.date.today().isoformat(),
    }


def sentence(machine):
    """The description as a paragraph of a document."""
    return textwrap.fill("; ".join(f"{name}: {value}" for name, value in machine.items()) + ".", 118)


def field(path, name):
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            key, _, value = line.partition(":")
            if key.strip() == name:
                return value.strip()
    return "unknown"


def first_line(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError, IndexError):
        return f"no {Path(command[0]).name}"
