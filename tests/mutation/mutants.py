# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the places of a C++ text that can be changed into a small mistake: one comparison, constant, condition or return.

Works on the text, without a compiler: a place that turns out not to compile is no mutant. Comments, strings, preprocessor
lines, assertions (they are not part of a release build), what is compiled only with a sanitizer (the builds of run.py have
none) or for another processor, and declarations of templates are left alone.
"""
import platform
import re
from dataclasses import dataclass

# What is never changed, longest first: comments, raw and plain strings, characters, preprocessor lines, assertions.
_SKIPPED = re.compile(r"""
    //[^\n]* | /\*.*?\*/
  | ^[ \t]*\#(?:\\\n|[^\n])*
  | R"(?P<tag>[^()\s\\]{0,16})\(.*?\)(?P=tag)" | "(?:\\.|[^"\\\n])*" | (?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'
  | \b(?:static_assert|assert)\([^;]*\);
  | \btemplate\ <[^{;]*?>\n | \brequires\b[^{;\n]* | \boperator\s*(?:[<>=!]=?|<=>|&&|\|\|)
""", re.VERBOSE | re.MULTILINE | re.DOTALL)

# Questions whose answer is known here: macros of sanitizers, which are not defined, and of processors.
_CONDITIONAL = re.compile(r"[ \t]*#(?P<word>ifdef|ifndef|if|elif|else|endif)\b(?P<condition>.*)")
_KNOWN_QUESTION = re.compile(r" (?:defined\(__(?:SANITIZE_\w+|x86_64|i386|aarch64)__\)(?: \|\| |$))+")
_THIS_PROCESSOR = f"__{platform.machine()}__"

# clang-format sets blanks around binary operators and none inside of template brackets.
_COMPARISON = re.compile(r"(?<= )(?P<op><=|>=|==|!=|<|>)(?= (?!\{))")
_OTHER_COMPARISON = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
_JUNCTION = re.compile(r"(?<= )(?P<op>&&|\|\|)(?= )")
_NUMBER = re.compile(r"(?<![\w.'])(?P<number>\d+)(?P<suffix>[uUlL]{0,3})(?![\w.'])")
_TRUTH = re.compile(r"\b(?P<truth>true|false)\b")
_CONDITION = re.compile(r"\b(?P<word>if|while) \((?P<condition>(?:[^(){};\n]|\((?:[^(){};\n]|\([^(){};\n]*\))*\))+)\)(?= |\n)")
_RETURN = re.compile(r"\breturn (?P<value>[^;{}\n]+);")


@dataclass(frozen=True)
class Mutant:
    """One change of one file: `start` and `end` are offsets of what `new` replaces."""
    path: str
    line: int
    kind: str
    start: int
    end: int
    old: str
    new: str

    def text(self):
        return f"{self.path}:{self.line}: {self.kind}: {self.old!r} -> {self.new!r}"

    def applied_to(self, source):
        return source[:self.start] + self.new + source[self.end:]


def _without_other_builds(source):
    """The source with the lines that another sanitizer or processor would compile replaced by blanks, offsets kept."""
    kept, open_blocks = [], []  # of each block: [is the branch compiled, was an earlier one]; None: not known
    for line in source.splitlines(keepends=True):
        directive = _CONDITIONAL.match(line)
        word = directive["word"] if directive else ""
        if word.startswith("if") or (word == "elif" and open_blocks[-1]):
            known = word in ("if", "elif") and _KNOWN_QUESTION.fullmatch(directive["condition"])
            true = bool(known) and _THIS_PROCESSOR in directive["condition"]
            earlier = any(open_blocks.pop()) if word == "elif" else False
            open_blocks.append([true and not earlier, earlier] if known else None)
        elif word == "else" and open_blocks[-1]:
            open_blocks[-1] = [not any(open_blocks[-1]), True]
        elif word == "endif":
            open_blocks.pop()
        compiled = all(block is None or block[0] for block in open_blocks)
        kept.append(line if compiled or word else re.sub(r"[^\n]", " ", line))
    return "".join(kept)


def _blanked(source):
    """The source with what must not change replaced by blanks, offsets kept."""
    return _SKIPPED.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), _without_other_builds(source))


def _changed_comparison(match):
    yield "comparison", match.span("op"), _OTHER_COMPARISON[match["op"]]


def _changed_junction(match):
    yield "condition", match.span("op"), "||" if match["op"] == "&&" else "&&"


def _changed_number(match):
    yield "constant", match.span("number"), str(int(match["number"]) + 1)


def _changed_truth(match):
    yield "constant", match.span("truth"), "false" if match["truth"] == "true" else "true"


def _negated_condition(match):
    if not re.search(r"\b(?:const|auto)\b[^=]*=|\w[&*]? \w+ = ", match["condition"]):  # declares a variable
        yield "condition", match.span("condition"), f"!({match['condition']})"


def _changed_return(match):
    value = match["value"]
    if value in ("true", "false", "nullptr", "std::nullopt", "ok()") or re.fullmatch(r"\d+", value):
        return  # a constant already, or what {} would give as well
    yield "return", match.span("value"), "!(" + value + ")" if re.search(r"[<>=!]= | [<>] |&&|\|\||^!|\.empty\(\)$", value) \
        else "{}"


_CHANGES = ((_COMPARISON, _changed_comparison), (_JUNCTION, _changed_junction), (_NUMBER, _changed_number),
            (_TRUTH, _changed_truth), (_CONDITION, _negated_condition), (_RETURN, _changed_return))


def mutants_of(path, source):
    """Every mutant of a file, in the order of the text."""
    blanked = _blanked(source)
    found = []
    for pattern, change in _CHANGES:
        for match in pattern.finditer(blanked):
            for kind, (start, end), new in change(match):
                line = source.count("\n", 0, start) + 1
                new = new.replace(blanked[start:end], source[start:end])  # with its strings again
                found.append(Mutant(path, line, kind, start, end, source[start:end], new))
    return sorted(found, key=lambda mutant: (mutant.start, mutant.kind, mutant.new))
