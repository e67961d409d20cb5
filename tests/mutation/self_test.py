"""mutate.py must be able to find nothing: a project of one header, of which a test proves one half, and nothing the other."""
import argparse
import pathlib
import shutil
import sys
import tempfile

import mutate

HERE = pathlib.Path(__file__).resolve().parent
HEADER = """#pragma once
#include <concepts>
namespace gnomon {
constexpr int twice(int a) { return a * 2; }
constexpr int unproved(int a) { return a + 1; }
inline int sum() {
    struct {
        int digits[3] = {1, 2, 3}, beyond{};
    } of;
    int all = 0;
    for (int i = 0; i < 3; ++i) all += of.digits[i];
    return all;
}
inline int count(int n) {
    int i = 0;
    while (i != n) i += 1;
    return i;
}
template <int N>
    requires(N >= 0)
struct natural {};
template <typename T>
concept number = requires {
    { T(2) } -> std::same_as<T>;
};
} // namespace gnomon
"""
TEST = """#include <gnomon/small.hpp>
#include <doctest/doctest.h>
static_assert(gnomon::twice(1) == 2);
TEST_CASE("everything small but what is unproved") {
    CHECK(gnomon::twice(3) == 6);
    CHECK(gnomon::unproved(3) * 0 == 0);
    CHECK(gnomon::sum() == 6);
    CHECK(gnomon::count(3) == 3);
    CHECK(gnomon::count(0) == 0);
    gnomon::natural<0>{};
    static_assert(gnomon::number<int>);
}
"""
REFUSAL = """// expect: natural
#include <gnomon/small.hpp>
#if GNOMON_EXPECT_FAILURE
gnomon::natural<-1> n;
#endif
"""
SURVIVORS = """gnomon/small.hpp: nobody proves it.
- constexpr int unproved(int a) { return a + 1; }
+ constexpr int unproved(int a) { return {}; }
+ constexpr int unproved(int a) { return a - 1; }
+ constexpr int unproved(int a) { return a + 2; }
+ constexpr int unproved(int a) { return a + 0; }

gnomon/small.hpp: equivalent: nothing asks for the fourth.
- int digits[3] = {1, 2, 3}, beyond{};
+ int digits[4] = {1, 2, 3}, beyond{};
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--compiler", default="clang++")
    compiler = parser.parse_args().compiler
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for path, text in (("include/gnomon/small.hpp", HEADER), ("tests/unit/small.cpp", TEST), ("tests/compile_fail/natural.cpp", REFUSAL)):
            (root / path).parent.mkdir(parents=True)
            (root / path).write_text(text)
        (root / "tests/mutation").mkdir()
        for path in ("main.cpp", "compile_fail/check.cmake"):
            shutil.copy(HERE.parent / path, root / "tests" / path)
        explained, log = root / "tests/mutation/survivors.txt", root / "build/mutation/results.tsv"

        def run(*paragraphs, options=()):
            explained.write_text("\n".join(paragraphs))
            return mutate.main(["--root", str(root), "--compiler", compiler, *options])

        def kept():
            """mutant -> answer, and what said so: the last ones in the log"""
            return {line.split("\t")[1]: line.split("\t")[2:4] for line in log.read_text().splitlines()}

        def expect(true, sentence):
            print(f"{'as it must be' if true else 'WRONG'}: {sentence}", flush=True)
            wrong.extend([] if true else [sentence])

        expect(run() == 1, "a header with unexplained survivors fails")
        together = kept()
        answers = list(together.values())
        survivors = [answer for answer, _ in answers if answer == mutate.SURVIVED]
        expect(len(survivors) == SURVIVORS.count("+ c") + SURVIVORS.count("+ i"), "what no test asks about survives, and nothing else")
        for what, seen in (("a test finds", [mutate.FOUND_BY_TEST, "unit/small.cpp: everything small but what is unproved"]),
                           ("a static_assert finds", [mutate.FOUND_BY_COMPILER, "unit/small.cpp"]),
                           ("a loop without end finds", [mutate.FOUND_BY_CLOCK, "unit/small.cpp"]),
                           ("a file that must not compile finds", [mutate.FOUND_BY_COMPILER, "compile_fail/natural.cpp"])):
            expect(seen in answers, f"{what} a mutant")
        expect(any(said.endswith("(sanitizers)") for _, said in answers), "only sanitizers find an index off its array")
        log.unlink()
        run(options=["--alone"])
        alone = kept()
        expect(together.keys() == alone.keys() and all(mutate.SURVIVED not in (together[m][0], alone[m][0]) or together[m] == alone[m] for m in alone),
               "alone the same mutants are found as together")
        expect(run(SURVIVORS) == 0, "explained survivors pass")
        expect(len(log.read_text().splitlines()) == len(answers), "another run asks nothing again")
        whole = root / "tests/mutation/whole.txt"
        run(options=["--enter"])
        expect(not whole.exists(), "a header with unexplained survivors is not entered as whole")
        run(SURVIVORS, options=["--enter"])
        entered = whole.read_text()
        log.unlink()
        expect(run(SURVIVORS) == 0 and not log.exists(), "nothing is asked about a header that was entered as whole")
        whole.write_text(entered.replace(" ", " 0", 1))
        expect(run(SURVIVORS) == 0 and log.exists(), "but it is once it has changed")
        found = "- constexpr int twice(int a) { return a * 2; }\n+ constexpr int twice(int a) { return a / 2; }\n"
        expect(run(SURVIVORS, f"gnomon/small.hpp: it survives no more.\n{found}") == 1, "an explanation fails once a test finds the mutant")
        expect(run(SURVIVORS, "gnomon/small.hpp: gone.\n- int gone() { return 1; }\n+ int gone() { return 2; }\n") == 1,
               "an explanation fails once its line is gone")
        expect(run(SURVIVORS, "gnomon/gone.hpp: gone.\n- int gone;\n+ int;\n") == 1, "an explanation fails once its header is gone")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
