"""check.py INCLUDE EXCLUSIONS REPORT...: is every line, branch and function of the headers run by the tests?

A REPORT is what `llvm-cov export` says of one test program. They are merged here: instances of a template count as one, so a branch is
covered if any instance took it, in any program. llvm-cov says nothing of a template without instances, of what only the compiler
calls, and of a header that nobody includes; so the compiler is asked which functions there are. A condition that is a constant in
every instance has none. MC/DC is reported, not demanded.

An exclusion is a line of four fields, HEADER | line, branch or function | the source line, trimmed | the reason. It excludes one
complaint, and fails if there is none."""
import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

CODE, DECISION_BRANCH = 0, 6  # kinds of regions in a report
FUNCTIONS = {"FunctionDecl", "CXXMethodDecl", "CXXConstructorDecl", "CXXDestructorDecl", "CXXConversionDecl"}


class Condition:
    """One condition at one place, over all instances."""

    def __init__(self):
        self.true = self.false = 0


class Header:
    def __init__(self, path):
        self.source = path.read_text().splitlines()
        self.lines = collections.Counter()  # line -> times run
        self.begins = collections.Counter()  # (line, column) where the code of a function begins -> calls
        self.functions = {}  # (line, column) of a function -> calls
        self.conditions = collections.defaultdict(Condition)  # (line, column, last line, end column) -> Condition
        self.decisions = set()  # (line, column) where MC/DC is measured
        self.shown = collections.defaultdict(bool)  # the place of a condition -> was it shown to decide by itself?
        self.complaints = []  # (line, kind, text)

    def measured(self):
        """MC/DC: condition -> was it shown to decide by itself? Constants, which are no branches, are left out."""
        return {place: shown for place, shown in self.shown.items() if place in self.conditions}

    def text(self, place):
        line, column, last, end = place
        return self.source[line - 1][column - 1:end - 1] if line == last else self.source[line - 1][column - 1:] + " ..."


def line_counts(segments):
    """Pairs (line, count) of the lines that hold code, as llvm-cov counts: the busiest region that begins there or spans it."""
    by_line = collections.defaultdict(list)
    for segment in segments:
        by_line[segment[0]].append(segment)
    wrapped = None
    for line in range(min(by_line, default=0), max(by_line, default=-1) + 1):
        here = by_line.get(line, [])
        begins = [s for s in here if s[3] and s[4] and not s[5]]
        skipped = bool(here) and not here[0][3] and here[0][4]
        if begins or (wrapped and wrapped[3] and not skipped):
            yield line, max([s[2] for s in begins] + ([wrapped[2]] if wrapped and wrapped[3] else []))
        if here:
            wrapped = here[-1]


def add_function(headers, function):
    """Adds one instance of a function to what is known of its header."""
    mine = [headers.get(name) for name in function["filenames"]]
    begin = function["regions"][0]
    header = mine[begin[5]]
    if header is None or all(region[:4] == [*begin[:2], begin[0], begin[1] + 1] for region in function["regions"]):
        return  # one character is no body: the function is defaulted, and clang counts nothing in it
    header.begins[begin[0], begin[1]] += function["count"]
    for *place, true, false, file, _, _ in function["branches"]:
        if mine[file] is header:
            header.conditions[tuple(place)].true += true
            header.conditions[tuple(place)].false += false
    for line, column, last, end, file, _, shown in function["mcdc_records"]:
        def within(regions, kind):
            return {tuple(r[:4]) for r in regions if r[-1] == kind and r[-3] == file and (line, column) <= (r[0], r[1]) and (r[2], r[3]) <= (last, end)}
        if mine[file] is not header:
            continue
        places = within(function["branches"], DECISION_BRANCH)
        if len(places) != len(shown):  # constants are no branches, so go by the regions that hold no other
            code = within(function["regions"], CODE)
            places = [p for p in code if not any(p != q and p[:2] <= q[:2] and q[2:] <= p[2:] for q in code)]
        if len(places) == len(shown):
            header.decisions.add((line, column))
            for place, independent in zip(sorted(places), shown):
                header.shown[place] |= independent


def what_there_is(compiler, include, headers):
    """All functions with a body, and all decisions in them, by the compiler's syntax tree: functions as pairs of where they and
    their bodies begin, decisions as where they begin, each of them (header, line, column)."""
    names = sorted(p.relative_to(include).as_posix() for p in include.rglob("*.hpp"))
    source = "".join(f"#include <{name}>\n" for name in names)
    command = [compiler, "-std=c++20", f"-I{include}", "-fsyntax-only", "-Xclang", "-ast-dump=json", "-Xclang", "-ast-dump-filter=gnomon",
               "-DNDEBUG", "-x", "c++", "-"]
    run = subprocess.run(command, input=source, text=True, capture_output=True)
    if run.returncode != 0:
        sys.exit(run.stderr)
    functions, decisions = set(), set()
    at = {"file": None, "line": None}  # a location leaves out what it shares with the one before

    def walk(node, in_body, in_decision):
        """Returns where a node begins; children are visited in the order in which they were printed."""
        begin = None
        kind = node.get("kind")
        written = not node.get("isImplicit") and not node.get("explicitlyDefaulted")
        logical = kind == "BinaryOperator" and node.get("opcode") in ("&&", "||")
        for key, value in node.items():
            if key in ("loc", "range"):
                begin = locate(value) if key == "range" else locate(value) and begin
                if key == "range" and logical and in_body and not in_decision and begin:
                    decisions.add(begin)
            elif key == "inner":
                for child in value:
                    inside = in_body or child.get("kind") == "CompoundStmt"
                    where = walk(child, inside, logical or (in_decision and kind == "ParenExpr"))
                    if kind in FUNCTIONS and child.get("kind") == "CompoundStmt" and begin and where and written:
                        functions.add((begin, where))
        return begin

    def locate(value):
        """Follows all locations of a loc or range; returns the first."""
        first = None
        if "offset" in value:
            at["file"], at["line"] = value.get("file", at["file"]), value.get("line", at["line"])
            first = (headers.get(at["file"]), at["line"], value["col"])
        for inner in value.values():
            if isinstance(inner, dict):
                found = locate(inner)
                first = first or found
        return first if first and first[0] else None

    text, decoder, place = run.stdout, json.JSONDecoder(), 0
    while (place := text.find("{", place)) >= 0:
        node, place = decoder.raw_decode(text, place)
        walk(node, False, False)
    return functions, decisions


def judge(include, reports, compiler):
    """The headers by name, with their complaints."""
    paths = {str(p): Header(p) for p in sorted(include.rglob("*.hpp"))}
    for report in reports:
        data = json.loads(pathlib.Path(report).read_text())["data"][0]
        for file in data["files"]:
            if file["filename"] in paths:
                header = paths[file["filename"]]
                for line, count in line_counts(file["segments"]):
                    if header.source[line - 1].split("//")[0].strip():
                        header.lines[line] += count
        for function in data["functions"]:
            add_function(paths, function)
    functions, decisions = what_there_is(compiler, include, paths)
    for (header, *begin), (_, *body) in functions:
        calls = [count for place, count in header.begins.items() if tuple(begin) <= place <= tuple(body)]
        header.functions[tuple(begin)] = sum(calls)
    for header in paths.values():
        header.unmeasured = sorted({line for h, line, column in decisions if h is header and (line, column) not in header.decisions
                                    and header.lines[line] > 0})
        header.complaints += [(line, "line", "is never run") for line, count in header.lines.items() if count == 0]
        header.complaints += [(line, "function", "is never called") for (line, _), count in header.functions.items() if count == 0]
        for place, c in header.conditions.items():
            missing = [word for word, count in (("true", c.true), ("false", c.false)) if count == 0]
            if missing:
                header.complaints.append((place[0], "branch", f"`{header.text(place)}` is never {' and never '.join(missing)}"))
    return {pathlib.Path(path).relative_to(include).as_posix(): header for path, header in paths.items()}


def exclude(headers, exclusions):
    """Takes the excluded complaints out of the headers; returns the exclusions that excluded nothing or are not written well."""
    wrong = []
    for number, text in enumerate(exclusions.read_text().splitlines(), 1):
        if not text.strip() or text.startswith("#"):
            continue
        fields = [field.strip() for field in text.split(" | ")]
        if len(fields) != 4 or not all(fields) or fields[0] not in headers:
            wrong.append(f"{exclusions.name}:{number}: not of the form HEADER | KIND | SOURCE LINE | REASON: {text}")
            continue
        header = headers[fields[0]]
        fits = [c for c in header.complaints if c[1] == fields[1] and header.source[c[0] - 1].strip() == fields[2]]
        if fits:
            header.complaints.remove(min(fits))
        else:
            wrong.append(f"{exclusions.name}:{number}: excludes nothing any more: {text}")
    return wrong


def percent(part, whole):
    return f"{100 * part / whole:6.1f} % of {whole:4}" if whole else f"{'-':>8} of    0"


def table(headers):
    """Prints the table, before exclusions, and what MC/DC misses; returns the sums."""
    print(f"{'':40}{'lines':>16}{'functions':>18}{'branches':>18}{'MC/DC':>18}")
    totals = [0] * 8
    for name, header in headers.items():
        conditions = header.conditions.values()
        measured = header.measured()
        row = [sum(n > 0 for n in header.lines.values()), len(header.lines),
               sum(n > 0 for n in header.functions.values()), len(header.functions),
               sum((c.true > 0) + (c.false > 0) for c in conditions), 2 * len(conditions),
               sum(measured.values()), len(measured)]
        totals = [a + b for a, b in zip(totals, row)]
        print(f"{name:40}" + ("  ".join(percent(*row[i:i + 2]) for i in (0, 2, 4, 6)) if row[1] or row[3] else "  nothing that runs"))
    print(f"{'all':40}" + "  ".join(percent(*totals[i:i + 2]) for i in (0, 2, 4, 6)))
    for name, header in headers.items():
        for place, independent in sorted(header.measured().items()):
            if not independent:
                print(f"MC/DC {name}:{place[0]}: `{header.text(place)}` never decided by itself: {header.source[place[0] - 1].strip()}")
        for line in header.unmeasured:
            print(f"MC/DC {name}:{line}: clang does not measure it: {header.source[line - 1].strip()}")
    return totals


def complaints(headers, exclusions, absent):
    """What is neither run nor excluded, but for lines that name lanes which the processor has not."""
    wrong = exclude(headers, exclusions)
    all_of_them = [f"{name}:{line}: {what}: {header.source[line - 1].strip()}" for name, header in headers.items()
                   for line, _, what in sorted(header.complaints)]
    could_run = [c for c in all_of_them if not any(lanes in c for lanes in absent)]
    if len(could_run) < len(all_of_them):
        print(f"not asked for, since the processor has no {' or '.join(absent)}: {len(all_of_them) - len(could_run)} lines")
    return could_run + wrong


def absent_lanes():
    """Those that the headers know and this processor has not."""
    flags = pathlib.Path("/proc/cpuinfo").read_text().split()
    return [lanes for lanes, flag in (("avx512", "avx512vnni"), ("avx2", "avx2")) if flag not in flags]


FLAGS = "-std=c++20 -O0 -DNDEBUG -fprofile-instr-generate -fcoverage-mapping -fcoverage-mcdc".split()


def self_test(compiler):
    """Pairs of a small header and a main that runs it, and what must be said: none or the words. A fault never found is a MISSED."""
    tested = "inline int tested(int a) { return a > 0 ? 1 : 2; }"
    both = "tested(1) + tested(0)"
    cases = [
        (tested, both, "", None),
        (tested, "tested(1)", "", "`a > 0` is never false"),
        (tested, "0", "", "is never called"),
        (tested + "\ninline int untested(int a) { return a; }", both, "", "x.hpp:3: is never called"),
        (tested + "\ntemplate <typename T> T untested(T a) { return a; }", both, "", "x.hpp:3: is never called"),
        ("template <typename T> struct s { int used() { return 1; } int unused() { return 2; } };", "s<int>{}.used()", "", "is never called"),
        ("template <int N> int constant() { if (N > 1) return 1; return 2; }", "constant<1>()", "", None),
        ("template <int N> int constant(int a) { return N > 1 || a > 1 ? 1 : 2; }", "constant<2>(0)", "", "`a > 1` is never true and never false"),
        ("template <typename T> int merged(T a) { return a > 0 ? 1 : 2; }", "merged(1) + merged(0.0)", "", None),
        ("inline int lines(int a) {\nif (a > 0)\nreturn 1;\nreturn 2;\n}", "lines(0)", "", "x.hpp:4: is never run"),
        ("consteval int compiler_only() { return 1; }", "compiler_only()", "", "is never called"),
        ("consteval int compiler_only() { return 1; }", "compiler_only()",
         "x.hpp | function | consteval int compiler_only() { return 1; } | the compiler runs it", None),
        (tested, both, "x.hpp | line | return 3; | was there once", "excludes nothing any more"),
        (tested, both, "x.hpp | line | return 3;", "not of the form"),
        (tested, both, "gone.hpp | line | return 3; | reason", "not of the form"),
        ("struct s { int a, b; friend bool operator==(s, s) = default; };", "s{1, 2} == s{1, 2}", "", None),
        ("struct s { int a; explicit s(int b) : a(b) {} };", "s(1).a", "", None),
        ("#define GNOMON_NOTHING 1", "0", "", None),
        ("inline int lanes_to_come() { return 1; }", "0", "", None),
    ]
    missed = 0
    for code, call, excluded, words in cases:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "x.hpp").write_text(f"namespace gnomon {{\n{code}\n}}\n")
            (folder / "main.cpp").write_text(f"#include \"x.hpp\"\nusing namespace gnomon;\nint main() {{ return ({call}) > 99; }}\n")
            (folder / "exclusions.txt").write_text(excluded)
            report = run_and_report(compiler, folder)
            headers = judge(folder, [report], compiler)
            found = complaints(headers, folder / "exclusions.txt", ["lanes_to_come"])
        right = not found if words is None else any(words in c for c in found)
        print(f"{'judged' if right else 'MISSED'} {code!r} called by {call}: {'; '.join(found) or 'nothing to complain of'}")
        missed += not right
    return missed


def run_and_report(compiler, folder):
    """Builds and runs main.cpp of a folder; returns the report of llvm-cov."""
    version = "".join(compiler.partition("-")[1:])
    report = folder / "report.json"
    subprocess.run([compiler, *FLAGS, folder / "main.cpp", "-o", folder / "main"], check=True)
    subprocess.run([folder / "main"], check=True, env={"LLVM_PROFILE_FILE": str(folder / "main.profraw")})
    subprocess.run([f"llvm-profdata{version}", "merge", folder / "main.profraw", "-o", folder / "main.profdata"], check=True)
    with report.open("w") as out:
        subprocess.run([f"llvm-cov{version}", "export", folder / "main", f"-instr-profile={folder / 'main.profdata'}"], check=True, stdout=out)
    return report


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--compiler", default="clang++-19")
    arguments.add_argument("--self-test", action="store_true")
    arguments.add_argument("include", type=pathlib.Path, nargs="?")
    arguments.add_argument("exclusions", type=pathlib.Path, nargs="?")
    arguments.add_argument("report", nargs="*")
    given = arguments.parse_args()
    if given.self_test:
        sys.exit(1 if self_test(given.compiler) else 0)
    headers = judge(given.include.resolve(), given.report, given.compiler)
    totals = table(headers)
    found = complaints(headers, given.exclusions, absent_lanes())
    print("\n".join(found))
    sys.exit(1 if found or not totals[0] else 0)


main()
