"""Runs compilers and tests within limits, and reads what a test said."""
import os
import re
import resource
import signal
import subprocess

FOUND_BY_TEST, FOUND_BY_COMPILER, FOUND_BY_CLOCK, SURVIVED = "test", "compiler", "clock", "survived"
OPTIONS = ("-aa=1", "-nc") # of doctest: the first check that fails says enough


def limited(seconds, command, memory="unlimited", **more):
    """Runs a command under a limit of processor time, so that a busy machine does not count as an endless loop; and of memory in kB.
    One that waits for ever, as for a lock that it held when it died, is stopped by the clock, and counts as one without end."""
    shell = 'ulimit -S -t "$0"; ulimit -S -v "$1"; shift; exec "$@"'
    command = ["sh", "-c", shell, str(int(seconds) + 1), memory, *map(str, command)]
    try:
        return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=120 + 20 * seconds, **more)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, -signal.SIGXCPU, "", "CPU time limit")


def run_test(seconds, command, sanitized, **environment):
    """Runs a test in 4 GB: the sanitizers keep to that themselves, for the shell's limit would forbid them their shadow."""
    return limited(seconds, command, "unlimited" if sanitized else "4000000",
                   env={**os.environ, "ASAN_OPTIONS": "detect_leaks=0:hard_rss_limit_mb=4000", **environment})


def processor_time():
    """Seconds of all children so far: beside other jobs too many, which only makes a limit generous."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def heard(ran, name):
    """(answer, what said so) of a test program of that name that ran within its limits."""
    if ran.returncode == 0 and re.search(r"test cases: +[1-9]", ran.stdout):
        return SURVIVED, ""
    if ran.returncode == -signal.SIGKILL:
        raise RuntimeError(f"{name} was killed from outside")
    if ran.returncode == -signal.SIGXCPU:
        return FOUND_BY_CLOCK, name
    case = re.search(r"^TEST CASE: +(.*)$", ran.stdout, re.MULTILINE)
    return FOUND_BY_TEST, f"{name}: {case[1] if case else 'died'}"
