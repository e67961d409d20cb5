"""Tests with many mutants of a header in them, of which a variable of the environment wakes up one: see together.py."""
import re
import shutil
import threading
import time

from limits import OPTIONS, SURVIVED, heard, limited, run_test
from together import Together

SLOW = 0.1 # seconds that a test case takes to be run by itself, after the quicker ones
# Mutants in a crowd: of all that change one function of lanes, the optimiser takes four times as long as of these by turns.
MANY = {"-O0": 256, "-O1": 64}


def level_of(header, sanitized=False):
    """By whether compiling its tests takes longer or running them. Lanes under sanitizers take the optimiser twenty times as long."""
    quick = ("gnomon/gl/", "gnomon/backend/", "gnomon/geometry/") if sanitized else ("gnomon/gl/",)
    return "-O0" if header.startswith(quick) else "-O1"


class Part:
    """Some test cases of a program: all the quick ones, or a slow one. How often it was asked, and how often it found a mutant."""

    def __init__(self, program, seconds, *options):
        self.program, self.seconds, self.options, self.asked, self.found = program, seconds, options, 0, 0

    def promise(self, header):
        """Mutants found per second, guessed from the names at first."""
        guess = 0.6 if self.program.test.is_of(header) else 0.3
        return (self.found + 2 * guess) / (self.asked + 2) / (self.seconds + 0.05)

    def run(self, number):
        """(answer, what said so, was the mutant called?)"""
        self.asked += 1
        ran = run_test(3 + 3 * self.seconds, [self.program.path, *OPTIONS, *self.options], self.program.sanitized,
                       GNOMON_MUTANT=str(number))
        answer, said = (SURVIVED, "") if self.options and ran.returncode == 0 else heard(ran, self.program.test.name)
        self.found += answer != SURVIVED
        return answer, said, "GNOMON_CALLED" in ran.stderr


class Program:
    """One test and the numbers of the mutants in it."""

    def __init__(self, test, path, sanitized):
        self.test, self.path, self.sanitized, self.numbers, self.parts = test, path, sanitized, frozenset(), []

    def prove(self, numbers):
        """It must pass as long as all sleep, or it says what fails. The times are the measure from then on."""
        ran = run_test(600, [self.path, *OPTIONS, "-d=1"], self.sanitized)
        answer, said = heard(ran, self.test.name)
        if answer != SURVIVED:
            return f"it fails: {said}"
        times = re.findall(r"^([\d.]+) s: (.*)$", ran.stdout, re.MULTILINE)
        slow = {re.sub("[,*]", "?", case): float(seconds) for seconds, case in times if float(seconds) > SLOW}
        if len(slow) < len(times):
            quick = sum(float(seconds) for seconds, _ in times) - sum(slow.values())
            self.parts.append(Part(self, quick, *(["-tce=" + ",".join(slow)] if slow else [])))
        self.parts += [Part(self, seconds, "-tc=" + case) for case, seconds in slow.items()]
        self.numbers = frozenset(numbers)
        return ""


class Crowd:
    """Some mutants of one header, and a program for each test near it, compiled when it is first asked. With options, which are those
    of sanitizers, only for the tests that are the header's own, or if there are none, for the shortest that calls the mutant."""

    def __init__(self, tree, header, members, options):
        self.tree, self.header, self.options = tree, header, options
        self.name = f"{header}:{members[0].line}:{members[0].column}" + " sanitized" * bool(options)
        self.overlay = tree.build / "together" / re.sub(r"\W", "_", self.name)
        shutil.rmtree(self.overlay, ignore_errors=True)
        (self.overlay / header).parent.mkdir(parents=True)
        self.number = {m.text: k for k, m in enumerate(members, 1)}
        self.together = Together(tree.text[header], members)
        self.programs, self.last, self.lock = {}, None, threading.Lock()

    def ask(self, mutant, callers=(), own_alone=False):
        """(answer, what said so) of the tests near the header; of those of many sets of lanes one set, and at last all of them. And the
        tests that have called the mutant and passed. Callers are some that are known to; `own_alone` asks the header's own tests and no others."""
        number, passed = self.number[mutant.text], set()
        if number not in self.together.inside:
            return (SURVIVED, ""), passed
        near = sorted((t for t in self.tree.concerned(self.header) if t.is_near(self.header)), key=lambda t: (t.name, t.isa or ""))
        all_lanes = [t for t in near if t.has_many_isas and not t.isa and t.is_of(self.header) and not self.options]
        near = [t for t in near if t.has_many_isas == bool(t.isa)]
        own = [t for t in near if t.is_of(self.header)]
        others = [t for t in near if t not in own]
        if self.options:
            others = [] if own else sorted(callers, key=lambda t: t.path.stat().st_size)[:1]
        for tests in (own,) if own_alone or (own and self.tree.near) else (own, others, all_lanes):
            if tests is not own and own and not passed:
                break # what none of its own calls is computed by the compiler, as constants are
            todo = {part for t in tests if t in self.programs for part in self.program(t).parts}
            waiting = sorted((t for t in tests if t not in self.programs), key=lambda t: t.likelihood(self.header))
            while todo or waiting:
                if not todo: # one more is compiled if those that are have passed
                    todo |= set(self.program(waiting.pop()).parts)
                    continue
                part = self.last if self.last in todo else max(todo, key=lambda part: part.promise(self.header))
                todo.remove(part)
                if number not in part.program.numbers:
                    continue
                answer, said, called = part.run(number)
                if called:
                    passed.add(part.program.test)
                    part.program.test.count(self.header, answer != SURVIVED)
                if answer != SURVIVED:
                    self.last = part # the next mutant stands beside this one
                    return (answer, said), passed
        return (SURVIVED, ""), passed

    def program(self, test):
        """Compiled and proved, if it was not yet. One that cannot be has no parts."""
        with self.lock:
            if test not in self.programs:
                began = time.monotonic()
                program = self.programs[test] = Program(test, self.overlay / re.sub(r"\W", "_", f"{test.name} {test.isa or ''}".strip()),
                                                                bool(self.options))
                complaint = self.compile(program) or program.prove(self.together.inside)
                said = f"not together, {complaint[-300:]}" if complaint else f"{len(program.numbers)} of {len(self.number)} mutants together"
                print(f"{self.name} in {program.path.name}: {said}, {time.monotonic() - began:.0f} s", flush=True)
            return self.programs[test]

    def compile(self, program):
        """Leaves out what the compiler refuses; says what is wrong if it refuses the rest too."""
        compiler, linker = self.tree.flavour(level_of(self.header, bool(self.options)), *program.test.options, *self.options)
        command = [*compiler, "-ferror-limit=0", f"-I{self.overlay}", f"-I{self.tree.include}", "-c", program.test.path]
        blamed = True
        while blamed:
            (self.overlay / self.header).write_text(self.together.write())
            done = limited(120, [*command, "-fsyntax-only"])
            blamed = self.together.to_blame(self.header, done.stderr)
            self.together.drop(blamed)
        code = program.path.with_suffix(".o")
        if done.returncode == 0:
            done = limited(1200, [*command, "-o", code])
        if done.returncode == 0:
            done = limited(300, [*linker, code, "-o", program.path])
        code.unlink(missing_ok=True)
        return done.stderr if done.returncode else ""
