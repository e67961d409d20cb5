"""check.py README.md -- compiler...: every ```cpp block with a main compiles bare, runs, and prints what README says.

What it must print stands in an ```output block right after, or in a comment behind the last brace: }   // prints this
A block that begins with "// NAME.cpp" is that file of the repository, to the letter."""
import pathlib
import re
import subprocess
import sys
import tempfile

FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```[ \t]*$", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"// (\S+\.cpp)\b")
TRAILING = re.compile(r"^\}[ \t]*// (.*)\Z", re.MULTILINE)


def programs(text):
    """Pairs (code, expected output or None) of all cpp blocks with a main."""
    fences = list(FENCE.finditer(text))
    for here, after in zip(fences, fences[1:] + [None]):
        if here[1] != "cpp" or "int main" not in here[2]:
            continue
        said = TRAILING.search(here[2].rstrip())
        if after and after[1] == "output" and not text[here.end():after.start()].strip():
            yield here[2], after[2].rstrip()
        else:
            yield here[2], said[1] if said else None


def complaints(text, compiler, repository=pathlib.Path()):
    found = list(programs(text))
    if not found:
        yield "no ```cpp block has a main"
    for number, (code, expected) in enumerate(found, 1):
        named = NAMED.match(code)
        if named and (not (repository / named[1]).exists() or (repository / named[1]).read_text() != code):
            yield f"block {number} is not {named[1]}"
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "program"
            program.with_suffix(".cpp").write_text(code)
            build = subprocess.run([*compiler, program.with_suffix(".cpp"), "-o", program], text=True, capture_output=True)
            if build.returncode != 0:
                yield f"block {number} does not compile:\n{build.stderr}"
                continue
            run = subprocess.run([program], text=True, capture_output=True, cwd=folder)
        print(f"block {number}: {run.stdout.rstrip()}")
        if run.returncode != 0:
            yield f"block {number} exits with {run.returncode}: {run.stderr}"
        if expected is not None and run.stdout.rstrip() != expected:
            yield f"block {number} prints\n{run.stdout}but README says\n{expected}"


def self_test(compiler):
    block = "```cpp\n#include <cstdio>\nint main() { std::puts(\"1\");\n}%s\n```\n"
    good = [block % "", block % "   // 1", block % "" + "\n```output\n1\n```\n", "```cpp\nno main\n```\n" + block % ""]
    bad = ["", "```cpp\n// none.cpp\nint main() {}\n```\n", "```cpp\nno main\n```\n", block % "   // 2", block % "" + "```output\n2\n```\n", block % " }", "```cpp\nint main() { return 1; }\n```\n"]
    wrong = [t for t in good if list(complaints(t, compiler))] + [t for t in bad if not list(complaints(t, compiler))]
    return [f"judged wrongly:\n{t}" for t in wrong]


split = sys.argv.index("--")
name, command = sys.argv[1], sys.argv[split + 1:]
if name == "--self-test":
    result = self_test(command)
else:
    result = list(complaints(pathlib.Path(name).read_text(), command, pathlib.Path(name).parent))
print("\n".join(result))
sys.exit(1 if result else 0)
