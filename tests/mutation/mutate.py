"""Breaks include/gnomon one small piece at a time; each time some test must turn red.

A mutant is a header with one change. The tests whose includes reach that header are compiled with many of its mutants in them, which
sleep but for one (together.py, crowd.py), and their cases are run, the likeliest first, until one fails: that takes most mutants half a
second. What cannot sleep, as a constant, is compiled by itself, one test a program; a test of many sets of lanes is asked about one of
them before. What survives them all must also survive the files that must not compile, and the header's own tests under sanitizers.
Then it has to stand in survivors.txt with a reason; of what stands there the header's own tests are asked while it can sleep, which is soon told.

Answers are kept in build/mutation/results.tsv, so an interrupted run goes on: one that was found counts until its header changes,
a survivor until a test that reaches it does. Remove the file to begin anew. A header of which every mutant is found or explained is
entered in whole.txt, and asked about again only by name, or once it has changed."""
import argparse
import collections
import concurrent.futures
import hashlib
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import threading
import time

import mutants
from crowd import MANY, Crowd, level_of
from limits import FOUND_BY_CLOCK, FOUND_BY_COMPILER, FOUND_BY_TEST, OPTIONS, SURVIVED, heard, limited, processor_time, run_test

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
SANITIZERS = ("-DNDEBUG", "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all") # asserts have had their say
FAR = 3.0 # seconds of processor time that a test of another folder may take to be asked: what only such a one sees deserves a test of its own
# What no test case of this machine judges, and what does.
ELSEWHERE = {"gnomon/simd/neon.hpp": "it is for another processor: ./tests/run --matrix tests-aarch64",
             "gnomon/simd/wasm.hpp": "it is for another processor: ./tests/run --matrix tests-wasm",
             "gnomon/gl/enums.hpp": "tests/architecture/gl_enums.py holds each number against Khronos' header"}
# The lanes that are soonest compiled, for the mutants of a header. Tests that include support/one_isa.hpp leave out all others.
PROCESSOR = set(re.findall(r"\bavx\w*", pathlib.Path("/proc/cpuinfo").read_text()))
ANY_ISA = "avx2" if "avx2" in PROCESSOR else "emulated<48>" # twice as long to compile
ALL_THERE_IS = "avx512" if "avx512_vnni" in PROCESSOR else "emulated<48>" # has what lanes need not have
ONE_ISA = {"gnomon/simd/sse2.hpp": "sse2", "gnomon/simd/avx2.hpp": "avx2", "gnomon/simd/avx512.hpp": "avx512",
           "gnomon/simd/emulated.hpp": "avx512", # against which emulated<64> is held
           "gnomon/backend/simd_wide.hpp": ALL_THERE_IS, "gnomon/backend/simd_words.hpp": ALL_THERE_IS}
LEFT_OUT = "left out"


def digest(*parts):
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def folder_of(header):
    """Where its tests stand: gnomon/grid/bit_row.hpp is of grid, gnomon/rect.hpp of unit, gnomon/soft_shadow_map.hpp of facade."""
    if header == "gnomon/soft_shadow_map.hpp":
        return "facade"
    return "unit" if header.count("/") == 1 else header.split("/")[1]


class Test:
    """One source of tests/, perhaps for one set of lanes: which headers it reaches, how long it takes, how often it was asked and how
    often it found a mutant."""

    def __init__(self, tree, path, isa=None):
        self.path, self.name, self.isa = path, path.relative_to(tree.tests).as_posix(), isa
        self.options = (f"-DGNOMON_TEST_ONE_ISA=gnomon::{isa}",) if isa else ()
        reached = tree.closure(path)
        self.names = set().union(*(tree.own_headers(p) for p in reached | {path} if p.parent == path.parent))
        self.reaches = {p.relative_to(tree.include).as_posix() for p in reached if p.is_relative_to(tree.include)}
        self.key = digest(path.read_text(), *self.options, *(p.read_text() for p in sorted(reached)))
        self.has_many_isas = tree.tests / "support" / "one_isa.hpp" in reached
        self.seconds, self.level, self.code = None, "-O0", None
        self.asked, self.found, self.lock = collections.Counter(), collections.Counter(), threading.Lock()

    def is_of(self, header):
        """Is this the file that is named after the header, or does it include it itself, or what stands beside it?"""
        return self.name == f"{folder_of(header)}/{pathlib.Path(header).stem}.cpp" or header in self.names

    def is_near(self, header):
        return self.is_of(header) or self.name.startswith(folder_of(header) + "/")

    def count(self, header, found):
        self.asked[header] += 1
        self.found[header] += found

    def likelihood(self, header):
        """By which tests are compiled that have no time yet: what found most, what is named after the header, what is short."""
        return self.found[header], self.name.endswith(f"/{pathlib.Path(header).stem}.cpp"), -self.path.stat().st_size

    def promise(self, header):
        """Mutants of the header found per second, guessed from the names at first."""
        guess = 0.6 if self.is_of(header) else 0.3 if self.is_near(header) else 0.05
        return (self.found[header] + 2 * guess) / (self.asked[header] + 2) / (self.seconds or 1)


class Tree:
    """include/ and tests/ of a project, and the folder for what is built from them."""

    def __init__(self, root, compiler):
        self.root, self.include, self.tests, self.build = root, root / "include", root / "tests", root / "build" / "mutation"
        self.build.mkdir(parents=True, exist_ok=True)
        self.compiler = compiler
        self.headers = sorted(p.relative_to(self.include).as_posix() for p in self.include.rglob("*.hpp"))
        self.text = {header: (self.include / header).read_text() for header in self.headers}
        self.sources = [Test(self, p) for p in sorted(self.tests.glob("*/*.cpp")) if p.parent.name not in ("compile_fail", "coverage", "fuzz", "golden", "odr")]
        self.sources += [Test(self, t.path, isa) for t in self.sources if t.has_many_isas for isa in sorted({ANY_ISA, *ONE_ISA.values()})]
        self.refusals = [Test(self, p) for p in sorted((self.tests / "compile_fail").glob("*.cpp"))]
        self.flavours, self.crowds, self.lock = {}, {}, threading.Lock()
        self.alone = self.near = False # as the options say

    def concerned(self, header):
        """The tests that reach a header; those of many sets of lanes twice, with one set and with all, or if it must be near with one."""
        isas = (None, ONE_ISA.get(header, ANY_ISA))
        return {t for t in self.sources if header in t.reaches and t.isa in isas and not (self.near and t.has_many_isas and not t.isa)}

    def crowd(self, header, mutant, *options):
        """The one that a mutant is in."""
        with self.lock:
            if (header, options) not in self.crowds:
                members = mutants.mutants_of(self.text[header])
                many = MANY[level_of(header)]
                crowds = [Crowd(self, header, members[k:k + many], options) for k in range(0, len(members), many)]
                self.crowds[header, options] = {text: crowd for crowd in crowds for text in crowd.number}
            return self.crowds[header, options][mutant.text]

    def ask_together(self, header, mutant):
        """(answer, what said so) of the tests near the header, then under sanitizers; and for both the tests that called the mutant and
        passed."""
        answer, called = self.crowd(header, mutant).ask(mutant)
        if answer[0] != SURVIVED or not called or self.near:
            return answer, called, set()
        (answer, said), sanitized = self.crowd(header, mutant, *SANITIZERS).ask(mutant, called)
        return (answer, f"{said} (sanitizers)"), called, sanitized

    def own_headers(self, path):
        return {name for quote, name in INCLUDE.findall(path.read_text()) if name in self.headers}

    def closure(self, path):
        """The headers of the project that a file brings along, by way of others, and those of tests/support."""
        seen, todo = set(), [path]
        while todo:
            here = todo.pop()
            for quote, name in INCLUDE.findall(here.read_text()):
                there = self.include / name if quote == "<" else (here.parent / name).resolve()
                if there not in seen and there.exists():
                    seen.add(there)
                    todo.append(there)
        return seen

    def flavour(self, *options):
        """Compiler options that bring a precompiled header and doctest's main, made for these options once. What a mutant leaves
        without a value is given one, or the optimiser might take whichever the others left."""
        with self.lock:
            if options not in self.flavours:
                folder = self.build / digest(*options)
                folder.mkdir(exist_ok=True)
                standard = {name for folder_ in (self.include, self.tests) for p in folder_.rglob("*.?pp")
                            for quote, name in INCLUDE.findall(p.read_text())
                            if quote == "<" and name not in self.headers and not name.endswith((".h", "main.hpp"))}
                (folder / "all.hpp").write_text("".join(f"#include <{name}>\n" for name in sorted(standard)))
                line = [self.compiler, "-std=c++20", "-w", "-D_GLIBCXX_ASSERTIONS", "-DGNOMON_TEST_STOPS_AT_FIRST", "-DGNOMON_TEST_ARRAYS",
                        "-ftrivial-auto-var-init=pattern", *options, "-fuse-ld=lld", f'-DGNOMON_TEST_DATA="{self.tests}/data"']
                subprocess.run([*line, "-x", "c++-header", "-fpch-instantiate-templates", folder / "all.hpp", "-o", folder / "all.pch"], check=True)
                subprocess.run([*line, "-c", self.tests / "main.cpp", "-o", folder / "main.o"], check=True)
                self.flavours[options] = [*line, "-include-pch", folder / "all.pch"], [*line, folder / "main.o"]
            return self.flavours[options]


def code_of(work):
    return hashlib.sha256((work / "code.o").read_bytes()).hexdigest()[:16]


def ask(tree, test, overlay, work, options=(), peek=False):
    """(answer, what said so) of one test for the headers in `overlay`, which hide those of include/. The code of no mutant need not run.

    A peek compiles as quickly as can be and runs for a second: that finds most mutants, and says nothing about the rest."""
    program, code = work / "program", work / "code.o"
    compiler, linker = tree.flavour("-O0" if peek else test.level, *test.options, *options)
    allowed = 600 if options else 300
    built = limited(allowed, [*compiler, f"-fmacro-prefix-map={overlay}={tree.include}", f"-I{overlay}", f"-I{tree.include}", "-c", test.path, "-o", code])
    if built.returncode == 0:
        if test.code == code_of(work) and not options and not peek:
            return SURVIVED, ""
        built = limited(120, [*linker, code, "-o", program])
    if re.search(r":\d+:\d+: (fatal )?error: |: error: undefined|CPU time limit", built.stderr):
        return FOUND_BY_COMPILER, test.name
    if built.returncode != 0: # not the mutant's fault: a full disk, no memory
        raise RuntimeError(f"{test.name} was not compiled: {built.stderr[-2000:]}")
    allowed = 0 if peek else 2 + 2 * (test.seconds or 60) * (5 if options else 1)
    ran = run_test(allowed, [program, *OPTIONS], bool(options))
    answer, said = heard(ran, test.name)
    if answer == FOUND_BY_CLOCK and peek:
        return SURVIVED, ""
    return answer, said + " (sanitizers)" if answer == FOUND_BY_TEST and options else said


def prove(tree, test):
    """A test must pass before it may judge; and its time is the measure for all that follow. Kept as long as nothing it reads changes.

    One that runs long is done sooner if the compiler takes its time: the quicker of two levels is its own from then on. The second
    is given up as the slower one once it has had twice the time of the first."""
    known = tree.build / "seconds.tsv"
    with test.lock:
        if test.seconds is None and known.exists():
            for key, level, seconds, code in (line.split() for line in known.read_text().splitlines()):
                if key == test.key:
                    test.level, test.seconds, test.code = level, float(seconds), code
        if test.seconds is None:
            times = []
            for test.level in ("-O1", "-O0"):
                times.append((*timed(tree, test), test.level))
                test.seconds = times[0][0]
            test.seconds, test.code, test.level = min(times)
            with known.open("a") as file:
                file.write(f"{test.key} {test.level} {test.seconds:.2f} {test.code}\n")


def timed(tree, test):
    """Seconds of processor time to compile and run a test that must pass, and which code it is."""
    tree.flavour(test.level, *test.options)
    with tempfile.TemporaryDirectory(dir=tree.build) as folder:
        began = processor_time()
        answer, said = ask(tree, test, tree.include, pathlib.Path(folder))
        if answer != SURVIVED and not (answer == FOUND_BY_CLOCK and test.seconds):
            raise SystemExit(f"mutate.py: {test.name} fails without any mutant: {answer} {said}")
        return processor_time() - began, code_of(pathlib.Path(folder))


def refused(tree, test, overlay):
    """Does the compiler alone find it, by a static_assert perhaps?"""
    compiler, _ = tree.flavour("-O0", *test.options)
    return limited(120, [*compiler, f"-I{overlay}", f"-I{tree.include}", "-fsyntax-only", test.path]).returncode == 1


def ask_each(tree, header, tests, overlay, work, passed):
    """The likeliest first. One that passed with the mutant called among the sleeping ones has only to be asked whether it compiles:
    no other code of its own would change than what the compiler computes."""
    while tests:
        test = max(tests, key=lambda t: t.promise(header))
        tests.remove(test)
        if test in passed:
            if refused(tree, test, overlay):
                return FOUND_BY_COMPILER, test.name
            continue
        prove(tree, test)
        if test.seconds > FAR and not test.is_near(header):
            continue
        answer = ask(tree, test, overlay, work, peek=True) if test.level != "-O0" else (SURVIVED, "")
        if answer[0] == SURVIVED:
            answer = ask(tree, test, overlay, work)
        test.count(header, answer[0] != SURVIVED)
        if answer[0] != SURVIVED:
            return answer
    return SURVIVED, ""


def misused(tree, header, overlay):
    """The first misuse that compiles, or is refused for another reason; or nothing."""
    check = ["cmake", f"-DCOMPILE={tree.compiler};-std=c++20;-I{overlay};-I{tree.include}", "-P", tree.tests / "compile_fail/check.cmake"]
    for refusal in tree.refusals:
        if header in refusal.reaches and limited(120, [check[0], f"-DSOURCE={refusal.path}", *check[1:]]).returncode != 0:
            return refusal.name
    return ""


def judge(tree, header, mutant):
    """The answer for one mutant: the first test that turns red, or that none does."""
    answer, passed, sanitized = ((SURVIVED, ""), set(), set()) if tree.alone else tree.ask_together(header, mutant)
    if answer[0] != SURVIVED or (tree.near and passed):
        return answer
    with tempfile.TemporaryDirectory(dir=tree.build) as folder:
        work = pathlib.Path(folder)
        overlay = work / "include"
        (overlay / header).parent.mkdir(parents=True)
        (overlay / header).write_text(mutant.text)
        is_refusal = mutant.before.lstrip().startswith("static_assert")
        if is_refusal and (said := misused(tree, header, overlay)):
            return FOUND_BY_COMPILER, said
        concerned = tree.concerned(header)
        of_folder = {t for t in concerned if t.is_near(header)}
        answer = ask_each(tree, header, set(of_folder), overlay, work, passed)
        if answer[0] != SURVIVED or tree.near:
            return answer
        one_isa = [t for t in of_folder if t.has_many_isas == bool(t.isa)]
        own = [t for t in one_isa if t.is_of(header)]
        for test in set(own or one_isa) - sanitized:
            answer = ask(tree, test, overlay, work, SANITIZERS)
            if answer[0] != SURVIVED:
                return answer
        if not is_refusal and (said := misused(tree, header, overlay)):
            return FOUND_BY_COMPILER, said
        return ask_each(tree, header, concerned - of_folder, overlay, work, set())


class Explained:
    """survivors.txt: paragraphs of `header: reason`, one line `- ` as it stands in the header, and lines `+ ` of its survivors."""

    def __init__(self, path):
        self.reasons = {}
        header = reason = before = None
        for number, line in enumerate(path.read_text().splitlines() if path.exists() else [], 1):
            if line.startswith("#"):
                continue
            if line.startswith("- "):
                before = line[2:]
            elif line.startswith("+ ") and header and before:
                self.reasons[header, before, line[2:]] = reason
            elif match := re.fullmatch(r"(gnomon/\S+\.hpp): (.+)", line):
                header, reason, before = match[1], match[2], None
            elif line.strip():
                raise SystemExit(f"{path}:{number}: neither `header: reason` nor `- ` nor `+ `")

    def impossible(self, tree):
        """Explanations of what is no mutant any more."""
        made = collections.defaultdict(set)
        for header in {header for header, _, _ in self.reasons} & set(tree.headers):
            made[header] = {(m.before, m.after) for m in mutants.mutants_of(tree.text[header])}
        return [f"{header}: no such mutant: {before}  ->  {after}" for header, before, after in self.reasons
                if (before, after) not in made[header]]

    def stale(self, tree, answers, whole):
        """Explanations of headers that are gone, of lines that do not stand there, and of mutants that a test finds by now."""
        complaints = []
        for (header, before, after), _ in self.reasons.items():
            if header not in tree.headers:
                complaints.append(f"{header} does not exist")
            elif header in whole and SURVIVED not in answers.get((header, before, after), ()):
                made = (header, before, after) in answers
                complaints.append(f"{header}: {'found by a test' if made else 'no such mutant'}: {before}  ->  {after}")
        return complaints


class Whole:
    """whole.txt: a line `header digest mutants` for each header of which every mutant was found or is explained, as it stood then."""

    def __init__(self, tree):
        self.tree, self.path = tree, tree.tests / "mutation" / "whole.txt"
        lines = self.path.read_text().splitlines() if self.path.exists() else []
        self.note = [line for line in lines if line.startswith("#")]
        self.entries = {line.split()[0]: line for line in lines if line and not line.startswith("#")}

    def line(self, header):
        return f"{header} {digest(self.tree.text[header])} {len(mutants.mutants_of(self.tree.text[header]))}"

    def __contains__(self, header):
        return header in self.entries and self.entries[header] == self.line(header)

    def enter(self, header):
        self.entries = {h: line for h, line in self.entries.items() if h in self.tree.headers} | {header: self.line(header)}
        self.path.write_text("".join(line + "\n" for line in [*self.note, *(self.entries[h] for h in sorted(self.entries))]))


def run(tree, given):
    wanted = chosen(tree, given)
    kept, log = {}, tree.build / "results.tsv"
    for line in log.read_text().splitlines() if log.exists() else []:
        key, name, answer, said, seconds = line.split("\t")
        kept[key, name] = answer, said, float(seconds)
    explained = Explained(tree.tests / "mutation" / "survivors.txt")
    answers, rows, lock, began = collections.defaultdict(list), {}, threading.Lock(), time.monotonic()
    state = {"done": 0, "new": 0, "shown": began}
    left = collections.Counter(header for header, _ in wanted)
    asked = {h for h in left if len({m.text for there, m in wanted if there == h}) == len(mutants.mutants_of(tree.text[h]))}

    def survivor_key(header):
        return digest(header, str(tree.near), *sorted(t.key for t in [*tree.concerned(header), *tree.refusals]))

    def one(job):
        header, mutant = job
        known = (header, mutant.before, mutant.after) in explained.reasons
        soon = given.quick or (known and not given.alone)
        found_key, survived_key, name = digest(header, tree.text[header]), survivor_key(header), digest(mutant.text)
        old = kept.get((found_key, name)) or kept.get((survived_key, name))
        start = time.monotonic()
        if not old and known and soon:
            (answer, said), _ = tree.crowd(header, mutant).ask(mutant, own_alone=True)
        elif not old and soon:
            (answer, said), called, _ = tree.ask_together(header, mutant)
            answer = LEFT_OUT if answer == SURVIVED and not called else answer
        else:
            answer, said = old[:2] if old else judge(tree, header, mutant)
        seconds = old[2] if old else time.monotonic() - start
        with lock:
            if not old and not (soon and answer in (SURVIVED, LEFT_OUT)):
                key = survived_key if answer == SURVIVED else found_key
                with log.open("a") as file:
                    file.write(f"{key}\t{name}\t{answer}\t{said}\t{seconds:.2f}\n")
            answers[header, mutant.before, mutant.after].append(answer)
            row = rows.setdefault(header, collections.Counter())
            row["seconds"] += seconds
            row[("explained" if known else "unexplained") if answer == SURVIVED else answer] += 1
            if answer == SURVIVED and not known:
                print(f"SURVIVED {header}:{mutant.line}:{mutant.column}\n- {mutant.before}\n+ {mutant.after}", flush=True)
            if given.verbose and answer != SURVIVED:
                print(f"{header}:{mutant.line}:{mutant.column} {answer} {said} {seconds:.1f} s: {mutant.after}", flush=True)
            left[header] -= 1
            if given.enter and header in asked and not left[header] and not row["unexplained"] and not row[LEFT_OUT]:
                Whole(tree).enter(header)
            state["done"] += 1
            state["new"] += not old
            now = time.monotonic()
            if now - state["shown"] > 20 or state["done"] == len(wanted):
                state["shown"] = now
                print(f"[{state['done']}/{len(wanted)}] {header}, {(now - began) / max(state['new'], 1):.2f} s a mutant", flush=True)

    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for _ in pool.map(one, wanted): # raises what a job raised
            pass

    stale = explained.stale(tree, answers, set() if given.quick else asked)
    print(f"\n{'':42}{'test':>7}{'compiler':>9}{'clock':>7}{'survived':>9}{'explained':>10}{'left out':>10}{'s each':>8}")
    lines = []
    for header, row in sorted(rows.items()):
        total = sum(n for what, n in row.items() if what != "seconds")
        print(f"{header:42}{row['test']:7}{row['compiler']:9}{row['clock']:7}{row['unexplained']:9}{row['explained']:10}{row[LEFT_OUT]:10}{row['seconds'] / total:8.2f}")
        lines.append("\t".join(map(str, (header, row["test"] + row["compiler"] + row["clock"], row["unexplained"], row["explained"], round(row["seconds"])))))
    print("".join(f"STALE {complaint}\n" for complaint in stale), end="")
    (tree.build / "summary.tsv").write_text("".join(line + "\n" for line in lines) + f"survivors.txt\t{len(explained.reasons)}\t{len(stale)}\t0\t0\n")
    return 1 if stale or any(row["unexplained"] for row in rows.values()) else 0


def chosen(tree, given):
    """The mutants that the options ask for."""
    wanted = []
    places = [re.fullmatch(r"(?:include/)?(.*?)(?::(\d+))?", place).groups() for place in given.only] or [("gnomon", None)]
    for place, line in places:
        here = [h for h in tree.headers if h == place or h.startswith(place.rstrip("/") + "/") or h == f"gnomon/{place}"
                or h.startswith(f"gnomon/{place.rstrip('/')}/")]
        if not here:
            raise SystemExit(f"mutate.py: no header is {place}")
        for h in [h for h in here if h in ELSEWHERE]:
            print(f"left out: {h}: {ELSEWHERE[h]}", flush=True)
            here.remove(h)
        if not given.only:
            known = Whole(tree)
            whole = [h for h in here if h in known]
            print(f"asked in full as they stand: {len(whole)} headers, see tests/mutation/whole.txt; their names ask again", flush=True)
            here = [h for h in here if h not in whole]
        wanted += [(h, m) for h in here for m in mutants.mutants_of(tree.text[h]) if line is None or m.line == int(line)]
    if given.sample:
        wanted = random.Random(given.seed).sample(wanted, min(given.sample, len(wanted)))
    return wanted


def main(line=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("only", nargs="*", metavar="PATH[:LINE]", help="headers or folders of include/; all of them if left out")
    parser.add_argument("--list", action="store_true", help="say how many mutants there are, and run none")
    parser.add_argument("--explained", action="store_true", help="say what survivors.txt explains and nobody can make, and run none")
    parser.add_argument("--near", action="store_true", help="ask the header's own tests alone, or those of its folder if it has none, in one set of lanes: quick, to work on these")
    parser.add_argument("--quick", action="store_true", help="only what need not be compiled alone, by the tests of the header's own folder, then under sanitizers")
    parser.add_argument("--alone", action="store_true", help="compile each mutant by itself: slow, and says the same")
    parser.add_argument("--enter", action="store_true", help="enter in whole.txt the headers of which every mutant is found or explained")
    parser.add_argument("--sample", type=int, metavar="N", help="only N mutants, drawn by --seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    parser.add_argument("--verbose", action="store_true", help="say what found each mutant")
    parser.add_argument("--compiler", default="clang++", help="a clang; %(default)s if left out")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2], help="the project; this one if left out")
    given = parser.parse_args(line)
    tree = Tree(given.root.resolve(), given.compiler)
    tree.alone, tree.near = given.alone, given.near
    if given.explained:
        complaints = Explained(tree.tests / "mutation" / "survivors.txt").impossible(tree)
        print("".join(f"STALE {complaint}\n" for complaint in complaints), end="")
        return 1 if complaints else 0
    if given.list:
        wanted = chosen(tree, given)
        for header, count in collections.Counter(h for h, _ in wanted).items():
            print(f"{header:42}{count:6}")
        print(f"{'':42}{len(wanted):6}")
        return 0
    return run(tree, given)


if __name__ == "__main__":
    sys.exit(main())
