"""Which small mistakes a header could hold: every place where one token, one condition or one statement would mean something else.

Reads tokens, not C++: operators are told from template brackets and references by the spaces that clang-format puts around them.
Comments, strings and preprocessor lines are left alone. What does not compile counts as found, so a bad guess here only costs time."""
import dataclasses
import re

TOKEN = re.compile(r"""
    (?P<skip>   //[^\n]* | /\*.*?\*/ | ^[ \t]*\#(?:[^\n\\]|\\.)* )
  | (?P<string> "(?:[^"\\]|\\.)*" | '(?:[^'\\]|\\.)+' )
  | (?P<number> 0x[\da-fA-F]+(?:\.[\da-fA-F]*)?(?:p[+-]?\d+)?[uUlLfF]* | \d[\d']*(?:\.\d*)?(?:e[+-]?\d+)?[uUlLfF]* )
  | (?P<word>   [A-Za-z_]\w* )
  | (?P<op>     <<= | >>= | -> | :: | \+\+ | -- | && | \|\| | << | >> | [-+*/%&|^<>=!]= | . )""", re.VERBOSE | re.MULTILINE | re.DOTALL)

BINARY = {"<": ["<="], "<=": ["<"], ">": [">="], ">=": [">"], "==": ["!="], "!=": ["=="],
          "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"], "<<": [">>"], ">>": ["<<"],
          "&": ["|"], "|": ["&"], "^": ["|"], "&&": ["||"], "||": ["&&"],
          "+=": ["-=", "="], "-=": ["+=", "="], "*=": ["/="], "/=": ["*="], "|=": ["&=", "="], "&=": ["|=", "="],
          "?": ["|| true ?", "&& false ?"]}
SWAPS = [("x0", "x1"), ("y0", "y1"), ("x", "y"), ("z", "w"), ("width", "height"), ("nearest", "farthest"), ("lower", "upper"),
         ("columns", "rows"), ("right", "upward"), ("e", "m"), ("near_w", "far_w"), ("next_set", "next_clear"), ("all", "any"),
         ("set", "reset"), ("lesser", "greater"), ("floor_to_int", "ceil_to_int")]
SWAP = {a: b for pair in SWAPS for a, b in (pair, pair[::-1])}
ASSIGN = {"=", "+=", "-=", "*=", "/=", "|=", "&=", "^="}
ANSWERS = {"if": ["true", "false"], "while": ["false"], "for": ["false"], "requires": ["true"]}
FLIP = {"true": "false", "false": "true"}
NOT_A_STATEMENT = set("""alignas auto case class concept const constexpr consteval default delete do else enum explicit for friend if inline
    namespace noexcept operator private public requires return static static_assert struct switch template typedef typename using while""".split())
REQUIREMENT = re.compile(r"^ *\{ .* \} -> .*;$", re.MULTILINE) # of a concept: any number would do as an example
OPEN, CLOSE = "([{", ")]}"


@dataclasses.dataclass(frozen=True)
class Token:
    kind: str
    text: str
    start: int
    end: int


@dataclasses.dataclass(frozen=True)
class Mutant:
    """text[start:end] replaced; `before` and `after` are the changed lines, which say the same wherever in the file they move."""
    line: int
    column: int
    before: str
    after: str
    text: str
    start: int
    end: int
    replacement: str


def tokens_of(text):
    return [Token(m.lastgroup, m.group(), m.start(), m.end()) for m in TOKEN.finditer(text)
            if m.lastgroup != "skip" and not m.group().isspace()]


def closing(tokens, i):
    """The index of the bracket that closes tokens[i]."""
    depth = 0
    for k in range(i, len(tokens)):
        if tokens[k].kind == "op":
            depth += (tokens[k].text in OPEN) - (tokens[k].text in CLOSE)
        if depth == 0:
            return k
    return len(tokens) - 1


def opening(tokens, i):
    """The index of the bracket that tokens[i] closes."""
    return next(k for k in range(i - 1, -1, -1) if tokens[k].text in OPEN and closing(tokens, k) == i)


def split(tokens, begin, end, mark=";"):
    """Ranges between the marks that stand outside all brackets of tokens[begin:end], up to a bracket that closes one around it."""
    ranges, i, first = [], begin, begin
    while i < end and not (tokens[i].kind == "op" and tokens[i].text in CLOSE):
        if tokens[i].text == mark:
            ranges.append((first, i))
            first = i + 1
        i = closing(tokens, i) + 1 if tokens[i].kind == "op" and tokens[i].text in OPEN else i + 1
    return ranges + [(first, i)]


def other_numbers(text):
    """A whole number becomes its neighbours, 0.0 becomes 1.0, any other is doubled and halved."""
    whole = re.fullmatch(r"(0x[\da-fA-F]+|[\d']+)([uUlL]*)", text)
    if not whole:
        return [text.replace("0", "1", 1)] if re.fullmatch(r"0\.0*f?", text) else [f"(2 * {text})", f"({text} / 2)"]
    value, suffix = int(whole[1].replace("'", ""), 0), whole[2]
    return [(hex(n) if text.startswith("0x") else str(n)) + suffix for n in ([value + 1, value - 1] if value else [1])]


def is_expression(tokens, begin, end):
    """Is tokens[begin:end] an assignment or a call, so that a program could do without it? Declarations are not."""
    first = tokens[begin]
    if first.text in NOT_A_STATEMENT or (first.kind != "word" and first.text not in ("++", "--", "*")):
        return False
    i, previous = begin, first
    while i < end:
        t = tokens[i]
        if t.text in ASSIGN:
            return tokens[i + 1].text not in ("default", "delete")
        spaced = t.start > previous.end
        if t.text == "{" or (spaced and (t.text in BINARY or previous.kind == "word" or previous.text in (">", ">>", "*", "&", ")"))):
            return False
        i = closing(tokens, i) if t.kind == "op" and t.text in OPEN else i
        previous, i = tokens[i], i + 1
    return first.text in ("++", "--") or tokens[end - 1].text in (")", "++", "--")


def edits(text):
    """(start, end, replacement), one for each mistake."""
    tokens = tokens_of(text)
    examples = [m.span() for m in REQUIREMENT.finditer(text)]

    def span(begin, end, replacement):
        return tokens[begin].start, tokens[end - 1].end, replacement

    for i, t in enumerate(tokens):
        before, after = (tokens[i - 1] if i else t), (tokens[i + 1] if i + 1 < len(tokens) else t)
        if t.kind == "number":
            if any(begin <= t.start < end for begin, end in examples):
                continue
            yield from (span(i, i + 1, n) for n in other_numbers(t.text))
        elif t.kind == "op":
            if text[t.start - 1].isspace() and text[t.end].isspace():
                yield from (span(i, i + 1, other) for other in BINARY.get(t.text, []))
            elif t.text in ("!", "~", "-") and not text[t.end].isspace() and before.text not in (")", "operator") and before.kind != "number":
                yield span(i, i + 1, "")
            elif t.text in ("++", "--") and not (before.text == ";" and text[before.start + 1] == " "): # a loop that never ends tells nothing
                yield span(i, i + 1, "--" if t.text == "++" else "++")
        elif t.text in FLIP:
            yield span(i, i + 1, FLIP[t.text])
        elif t.text in SWAP and (before.text == "." or (after.text == "(" and (before.kind != "word" or before.text == "return"))):
            yield span(i, i + 1, SWAP[t.text])
        elif t.text in ANSWERS:
            k = i + 2 if after.text == "constexpr" else i + 1
            parts = split(tokens, k + 1, closing(tokens, k)) if tokens[k].text == "(" else []
            if t.text == "for":
                parts = parts[1:2] if len(parts) == 3 else []
            if t.text == "requires" and parts and tokens[closing(tokens, k) + 1].text == "{": # its parameters
                parts = []
            yield from (span(*part, answer) for part in parts[-1:] for answer in ANSWERS[t.text])
        elif t.text == "return":
            end = split(tokens, i, len(tokens))[0][1] if after.text != ";" else i + 1
            if after.text not in ("false", "0") or end > i + 2: # which {} means already
                yield span(i, end, "") if end == i + 1 else span(i + 1, end, "{}")
        elif t.text in ("break", "continue"):
            yield span(i, i + 1, "")
        if before.text in (";", "{", "}", ")", "else") and t.kind != "string":
            end = split(tokens, i, min(i + 200, len(tokens)))[0][1]
            if end < len(tokens) and tokens[end].text == ";" and end > i and is_expression(tokens, i, end):
                yield span(i, end, "")


def mutants_of(text):
    """Every mutant of a header, each once, in the order of its lines."""
    seen, found = {text}, []
    for start, end, replacement in sorted(edits(text), key=lambda edit: edit[:2]):
        changed = text[:start] + replacement + text[end:]
        if changed in seen:
            continue
        seen.add(changed)
        first = text.rfind("\n", 0, start) + 1
        last = text.find("\n", end)
        before, after = (" ".join(part.split()) for part in (text[first:last], text[first:start] + replacement + text[end:last]))
        found.append(Mutant(text.count("\n", 0, start) + 1, start - first + 1, before, after, changed, start, end, replacement))
    return found
