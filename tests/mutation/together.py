"""Many mutants of a header in one text, each asleep until it is called by its number: one compile for hundreds instead of one for each.

A statement that mutants change becomes a choice between its variants, and so do the value that a variable begins with and a condition;
of what is declared in a block and computed by the compiler there, all that follows it in the block is the choice. What does not run (a
signature, a constant of a class, a template's argument) must be compiled alone, and so must what the compiler refuses here.
While the compiler computes, every mutant sleeps. So one that is found here would be found alone, and one that is not may still be."""
import collections
import dataclasses
import re

from mutants import closing, is_expression, opening, split, tokens_of

AWAKE = """#ifndef GNOMON_AWAKE
#include <cstdio>
#include <cstdlib>
namespace gnomon_mutation {
inline const int awake = std::getenv("GNOMON_MUTANT") ? std::atoi(std::getenv("GNOMON_MUTANT")) : 0;
inline bool called = false;
inline const struct report {
    ~report() { called && std::fputs("GNOMON_CALLED", stderr); }
} at_exit;
}
#define GNOMON_AWAKE(n) (!__builtin_is_constant_evaluated() && ::gnomon_mutation::awake == (n) && (::gnomon_mutation::called = true))
#endif
"""
# How a choice is written: what comes first, a variant, what stands around the text as it was, and what comes last.
STATEMENT = "{ ", "if (GNOMON_AWAKE(%d)) { %s } else", ("{ ", " }"), " }"
VALUE = "(", "GNOMON_AWAKE(%d) ? (%s) :", ("(", ")"), ")"
CONDITION = "(", "GNOMON_AWAKE(%d) ? static_cast<bool>(%s) :", ("static_cast<bool>(", ")"), ")"
STEP = "(", "GNOMON_AWAKE(%d) ? static_cast<void>(%s) :", ("static_cast<void>(", ")"), ")"
BODY_AFTER = {")", "const", "noexcept", "override", "mutable", "else", "do"}
COMPUTED = {"constexpr", "template", "using", "concept", "enum", "static_assert"}
NO_CHOICE = {"case", "default", "public", "private", "else", "template", "struct", "using", "static_assert", ";"}


def is_body(tokens, i):
    """Does tokens[i], a brace, open a list of statements? Lists of values, classes, namespaces and requirements are none."""
    if tokens[i - 1].text == ")":
        return tokens[opening(tokens, i - 1) - 1].text != "requires"
    if tokens[i - 1].text in BODY_AFTER:
        return True
    if tokens[i - 1].text == "]": # of a lambda without parameters, not of an array
        return tokens[opening(tokens, i - 1) - 1].text in ("=", "(", ",", "{", ";", "return")
    for k in range(i - 1, max(i - 12, 0), -1): # -> type {
        if tokens[k].text == "->":
            return tokens[k - 1].text in (")", "noexcept", "mutable")
        if tokens[k].text in ";{}()=":
            return False
    return False


@dataclasses.dataclass(frozen=True)
class Site:
    """text[start:end] of a header, and how a choice is written there."""
    start: int
    end: int
    form: tuple


class Parser:
    """Finds every site of a header. Like mutants.py it reads tokens, not C++: the compiler has the last word."""

    def __init__(self, tokens):
        self.tokens, self.sites, i, begin = tokens, [], 0, 0
        while i < len(tokens):
            text, before = tokens[i].text, tokens[i - 1].text
            if text == "{" and is_body(tokens, i):
                i = begin = self.block(i)
            elif text == ":" and before in (")", "noexcept"):
                i = begin = self.initialisers(i + 1)
            else:
                if text == "=" and before != "operator" and not COMPUTED & {t.text for t in tokens[begin:i]}:
                    self.add(VALUE, *split(tokens, i + 1, len(tokens), ",")[0]) # of a member, or of a parameter
                i += 1
                begin = i if text in (";", "{", "}") else begin

    def place(self, form, begin, end):
        if begin < end:
            self.sites.append(Site(self.tokens[begin].start, self.tokens[end - 1].end, form))

    def add(self, form, begin, end):
        self.place(form, begin, end)
        self.lambdas(begin, end)

    def lambdas(self, begin, end):
        i = begin
        while i < end:
            opens = self.tokens[i].text == "{" and (self.tokens[i - 1].text == "]" or is_body(self.tokens, i))
            i = self.block(i) if opens else i + 1

    def initialisers(self, i):
        """Reads those of a constructor, value by value, and its body."""
        while self.tokens[i].kind == "word" and self.tokens[i + 1].text in ("(", "{"):
            end = closing(self.tokens, i + 1)
            for part in split(self.tokens, i + 2, end, ","):
                self.add(VALUE, *part)
            i = end + 1 + (self.tokens[end + 1].text == ",")
        return self.block(i) if self.tokens[i].text == "{" else i

    def block(self, i):
        end = closing(self.tokens, i)
        i += 1
        while i < end:
            after = self.statement(i, end)
            self.place(STATEMENT, i, end) # what is declared here, with all that it is for
            i = after
        return end + 1

    def statement(self, i, limit):
        """Reads the statement that begins at i; where the next one does."""
        tokens, first, text = self.tokens, i, self.tokens[i].text
        if text == "GNOMON_UNROLL":
            i = closing(tokens, i + 1) + 1
            text = tokens[i].text
        if text == "{":
            return self.block(i)
        if text in ("do", "if", "while", "for", "switch"):
            end = self.loop(i, limit) if text == "do" else self.control(i, limit)
            self.place(STATEMENT, first, end)
            return end
        end = split(tokens, i, limit)[0][1]
        if end >= limit or tokens[end].text != ";" or text in NO_CHOICE:
            return end + 1
        if text in ("return", "break", "continue") or is_expression(tokens, i, end):
            self.add(STATEMENT, i, end + 1)
        elif "constexpr" in {t.text for t in tokens[i:min(i + 4, end)]}:
            self.lambdas(i, end)
        else:
            self.declaration(i, end)
        return end + 1

    def loop(self, i, limit):
        """Of do and its while."""
        i = self.statement(i + 1, limit)
        end = closing(self.tokens, i + 1)
        self.add(CONDITION, i + 2, end)
        return end + 2

    def control(self, i, limit):
        tokens, text = self.tokens, self.tokens[i].text
        computed = tokens[i + 1].text == "constexpr"
        end = closing(tokens, i + 1 + computed)
        parts = split(tokens, i + 2 + computed, end)
        if text in ("if", "while") and not computed:
            self.add(CONDITION, *parts[-1])
        if text == "for" and len(parts) == 3:
            self.declaration(*parts[0])
            self.add(CONDITION, *parts[1])
            self.add(STEP, *parts[2])
        i = self.statement(end + 1, limit)
        return self.statement(i + 1, limit) if text == "if" and i < limit and tokens[i].text == "else" else i

    def declaration(self, begin, end):
        for first, last in split(self.tokens, begin, end, ","):
            equals = split(self.tokens, first, last, "=")[0][1]
            if equals < last and self.tokens[equals].text == "=":
                self.add(VALUE, equals + 1, last)
            else:
                self.lambdas(first, last)


def one_line(text):
    """Without comments, so that a line belongs to one variant."""
    words, end = [], 0
    for t in tokens_of(text):
        words.append(" " * (t.start > end) + t.text)
        end = t.end
    return "".join(words)


class Together:
    """The text of a header with all its mutants, which have the numbers 1, 2, ... in the order given."""

    def __init__(self, text, mutants):
        self.text, self.mutants, self.inside = text, dict(enumerate(mutants, 1)), {}
        sites = Parser(tokens_of(text)).sites
        self.wider = {}
        for number, m in self.mutants.items():
            around = [site for site in sites if site.start <= m.start and m.end <= site.end]
            if around:
                self.inside[number], *self.wider[number] = sorted(around, key=lambda site: site.end - site.start)[:2]

    def drop(self, numbers):
        """Each of them gets a wider site, once."""
        for number in numbers & self.inside.keys():
            wider = self.wider.pop(number, [])
            self.inside.pop(number)
            self.inside.update((number, site) for site in wider)

    def write(self):
        """The text; the numbers of the mutants that each line is there for are in self.owners from then on."""
        self.lines, self.variants = [""], set()
        self.owners, self.members = collections.defaultdict(set), collections.defaultdict(list)
        for number, site in self.inside.items():
            self.members[site].append(number)
        self.put(AWAKE)
        self.put_range(0, len(self.text), sorted(self.members, key=lambda site: (site.start, -site.end)), set())
        return "\n".join(self.lines)

    def put(self, text, owners=frozenset()):
        first, *others = text.split("\n")
        self.owners[len(self.lines)] |= owners
        self.lines[-1] += first
        for line in others:
            self.lines.append(line)
            self.owners[len(self.lines)] |= owners

    def put_range(self, start, end, sites, owners):
        """text[start:end], the sites therein as choices; one may stand within another."""
        while sites:
            site, sites = sites[0], sites[1:]
            inner = [s for s in sites if s.start < site.end]
            sites = sites[len(inner):]
            self.put(self.text[start:site.start], owners)
            self.put_choice(site, inner, owners)
            start = site.end
        self.put(self.text[start:end], owners)

    def put_choice(self, site, inner, owners):
        first, variant, (before, after), last = site.form
        together = owners | set(self.members[site])
        self.put("\n" + first, together)
        for number in self.members[site]:
            m = self.mutants[number]
            changed = one_line(f"{self.text[site.start:m.start]} {m.replacement} {self.text[m.end:site.end]}")
            self.put("\n")
            self.variants.add(len(self.lines))
            self.put(variant % (number, changed), owners | {number})
        self.put("\n")
        self.put(before, together)
        self.put_range(site.start, site.end, inner, together)
        self.put(after + last + "\n", together)

    def to_blame(self, name, messages):
        """Numbers of the mutants that a compiler's errors are about: those in whose own lines there are errors, for these may have
        brought about all others; if there are none, of any line; if there is none, of the first line that a note names."""
        own, any_, noted, told = set(), set(), set(), True
        for line in messages.splitlines():
            at = re.search(re.escape(name) + r":(\d+):\d+", line)
            is_error = re.search(r": (fatal )?error: ", line)
            told = told and not is_error
            if at and not told:
                owners = self.owners[int(at[1])] & self.inside.keys()
                blamed = noted if not is_error else own if int(at[1]) in self.variants else any_
                blamed |= owners
                told = bool(owners)
        return own or any_ or noted
