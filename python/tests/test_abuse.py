# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Whatever a program does with the package, it works or gets an exception that says what is wrong; Python lives on.

The cases are in abuse_*.py. One process runs them one after another and tells where it is. If it dies at one, that one
has failed, and another process goes on behind it.
"""
import importlib
import os
import re
import subprocess
import sys

import pytest

SECONDS = 45  # of one case, on a busy machine
MODULES = ("abuse_indices", "abuse_arrays", "abuse_outputs", "abuse_calls", "abuse_junk", "abuse_objects")


def load():
    """All cases by name, in the order of the files: a function, the exceptions that it may raise, their words."""
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    return {name: case for module in MODULES for name, case in importlib.import_module(module).CASES.items()}


def run(begin):
    """Runs the cases from one on."""
    import faulthandler
    import warnings

    warnings.simplefilter("ignore")
    for name, (function, kinds, words) in list(load().items())[begin:]:
        print("begin", name, flush=True)
        faulthandler.dump_traceback_later(SECONDS, exit=True)
        try:
            function()
            verdict = f"it raised no {kinds.__name__}" if kinds else "as expected"
        except BaseException as error:
            text = f"{type(error).__name__}: {error}"
            right = kinds and isinstance(error, kinds) and re.search(words, str(error))
            verdict = "as expected" if right else text.replace("\n", " ")
        faulthandler.cancel_dump_traceback_later()
        print("end", verdict, flush=True)


@pytest.fixture(scope="session")
def verdicts():
    """What became of each case."""
    names, found = list(load()), {}
    environment = {**os.environ, "MALLOC_PERTURB_": "165"}  # glibc: what nobody has written is no zero
    while len(found) < len(names):
        child = subprocess.run([sys.executable, __file__, str(len(found))], capture_output=True, text=True,
                               errors="replace", check=False, env=environment)
        for line in child.stdout.splitlines():
            word, _, rest = line.partition(" ")
            if word == "begin":
                found[rest] = last = None
                last = rest
            elif word == "end":
                found[last] = rest
        died = [name for name, verdict in found.items() if verdict is None]
        for name in died:
            found[name] = f"Python ended with {child.returncode}: {child.stderr[-2000:]}"
        if not died and child.returncode:
            assert len(found) == len(names), child.stderr
            found[last] = f"Python ended with {child.returncode} after all cases: {child.stderr[-2000:]}"
    return found


def test_there_are_many_cases():
    assert len(load()) > 60


@pytest.mark.parametrize("name", load())
def test_python_lives_on(verdicts, name):
    assert verdicts[name] == "as expected"


if __name__ == "__main__":
    run(int(sys.argv[1]))
