# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the functions of a C++ text with their length and complexity, in one pass over the tokens.

Length is the number of lines that hold code, from the head to the closing brace. Complexity is one more than the number
of decisions (McCabe). A lambda counts as part of the function around it, a TEST_CASE as a function. This is enough
for statistics: code that only a preprocessor can read is skipped, not guessed.
"""
import re
from dataclasses import dataclass

_TOKEN = re.compile(r"""
    (?P<space>\s+)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
  | (?P<text>(?:u8|[uUL])?R"(?P<tag>[^()\s\\]{0,16})\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+')
  | (?P<word>[A-Za-z_]\w*|[0-9][\w.']*)
  | (?P<sign>::|->|&&|\|\||.)
""", re.VERBOSE | re.MULTILINE | re.DOTALL)
_DECISIONS = {"if", "for", "while", "case", "catch", "&&", "||", "?", "and", "or"}
_TYPES = {"class", "struct", "union"}


@dataclass(frozen=True)
class Token:
    text: str
    line: int


@dataclass(frozen=True)
class Function:
    name: str
    line: int
    length: int
    complexity: int


def tokens_of(text):
    tokens, line = [], 1
    for match in _TOKEN.finditer(text):
        if match["word"] or match["sign"]:
            tokens.append(Token(match[0], line))
        elif match["text"]:
            tokens.append(Token('""', line))
        line += match[0].count("\n")
    return tokens


def closing(tokens, start):
    """Returns the index of the bracket that closes the one at start (or the last index of a broken text)."""
    pairs = {"{": "}", "(": ")", "[": "]"}
    opens, closes, depth = tokens[start].text, pairs[tokens[start].text], 0
    for i in range(start, len(tokens)):
        depth += (tokens[i].text == opens) - (tokens[i].text == closes)
        if depth == 0:
            return i
    return len(tokens) - 1


def _outside_brackets(head):
    """Returns the head's tokens at depth 0; a bracketed group leaves its two brackets."""
    kept, depth = [], 0
    for token in head:
        if token.text in (")", "]", "}"):
            depth -= 1
        if depth == 0:
            kept.append(token.text)
        if token.text in ("(", "[", "{"):
            depth += 1
    return kept


def _without_template(words):
    """Removes a leading "template <...>", whose parameters may contain the word class."""
    while words[:2] == ["template", "<"]:
        depth, i = 0, 1
        for i in range(1, len(words)):
            depth += (words[i] == "<") - (words[i] == ">")
            if depth == 0:
                break
        words = words[i + 1:]
    return words


def _is_member_initialiser(words, head):
    """Returns whether the brace after this head is that of "member_{", as in A() : member_{1} {."""
    if ")" not in words or ":" not in words[words.index(")"):]:
        return False
    return bool(re.match(r"[A-Za-z_>]", head[-1].text)) and head[-1].text not in ("const", "noexcept", "override", "try")


def kind_of(head):
    """Returns what the brace after the head opens: scope, function, initialiser (part of a longer statement) or enum."""
    words = _without_template(_outside_brackets(head))
    if not words or "namespace" in words or words[0] == "extern":
        return "scope"
    if "enum" in words:
        return "enum"
    if _TYPES & set(words) and "(" not in words[: min(words.index(t) for t in _TYPES if t in words)]:
        return "function" if _names_a_function(words) else "scope"
    if "(" not in words or "=" in words[: words.index("(")] and "operator" not in words:
        return "initialiser"
    return "initialiser" if _is_member_initialiser(words, head) else "function"


def _names_a_function(words):
    """Tells functions from types: "struct stat read(...)" is a function, "class A : public B<int()>" is a type."""
    before = words[: words.index(":")] if ":" in words else words
    return "(" in before and not any(w in ("alignas", "__attribute__", "final") for w in before)


def _name(head):
    words = _outside_brackets(head)
    where = words.index("(")
    start = where
    while start > 0 and (re.match(r"[A-Za-z_~]", words[start - 1]) or words[start - 1] in ("::", "~")):
        start -= 1
        if words[start] != "::" and start > 0 and words[start - 1] not in ("::", "~"):
            break
    if "operator" in words[:where]:
        start = words.index("operator")
    return "".join(words[start:where]) or "operator()"


def _function(head, tokens, opening, end):
    body = tokens[opening:end + 1]
    lines = {t.line for t in head} | {t.line for t in body}
    complexity = 1 + sum(t.text in _DECISIONS for t in body)
    return Function(_name(head), head[0].line, len(lines), complexity)


def functions_of(text):
    """Returns all functions with a body, in their order. It never fails, but leaves out code that it cannot read."""
    tokens, head, found, i = tokens_of(text), [], [], 0
    while i < len(tokens):
        word = tokens[i].text
        if word == "{":
            end, kind = closing(tokens, i), kind_of(head)
            if kind == "function":
                found.append(_function(head, tokens, i, end))
            if kind == "initialiser":
                head += tokens[i:end + 1]
            else:
                head = []
            i = i + 1 if kind == "scope" else end + 1
            continue
        if word in (";", "}") or (word == ":" and head and head[-1].text in ("public", "private", "protected")):
            head = []
        elif word in ("(", "["):
            end = closing(tokens, i)
            head += tokens[i:end + 1]
            i = end
        else:
            head.append(tokens[i])
        i += 1
    return found
