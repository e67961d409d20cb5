"""What the three checks of this folder share: the headers, what they include, and the compiler's preprocessor."""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


def all_headers(include):
    """The headers as users name them: gnomon/texel/half.hpp."""
    return sorted(p.relative_to(include).as_posix() for p in (include / "gnomon").rglob("*.hpp"))


def includes(include, header):
    """Pairs (quote, name) of one header, in its order."""
    return INCLUDE.findall((include / header).read_text())


def closure(include, header):
    """All gnomon headers that a header brings along, itself among them."""
    seen, todo = set(), [header]
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo += [n for _, n in includes(include, name) if n.startswith("gnomon/") and (include / n).exists()]
    return seen


def preprocess(compiler, include, source, *options):
    run = subprocess.run([compiler, "-std=c++20", f"-I{include}", "-E", *options, "-x", "c++", "-"], input=source, text=True, capture_output=True)
    if run.returncode != 0:
        sys.exit(run.stderr)
    return run.stdout


def main(check, plants):
    """Runs check(include, compiler) -> complaints; with --self-test runs it on copies with one fault planted each, until
    it finds that.

    A plant is (header, text to append, words the complaint must hold)."""
    arguments = argparse.ArgumentParser()
    arguments.add_argument("include", type=pathlib.Path)
    arguments.add_argument("--compiler", default="c++")
    arguments.add_argument("--self-test", action="store_true")
    given = arguments.parse_args()
    if not given.self_test:
        complaints = list(check(given.include, given.compiler))
        print("\n".join(complaints))
        sys.exit(1 if complaints else 0)
    missed = 0
    for header, text, words in plants:
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "include"
            shutil.copytree(given.include, copy)
            with (copy / header).open("a") as file:
                file.write(text)
            found = any(words in c for c in check(copy, given.compiler))
        print(f"{'found ' if found else 'MISSED'} {text.strip()!r} in {header}")
        missed += not found
    sys.exit(1 if missed else 0)
