# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads the part of IDL that Orca uses, and rejects the rest with the line and the remedy.

Allowed: include guards, #include "x.idl", module orca { module idl { ... }; };, enum, struct with single inheritance,
and fields of the types in idl_model.PRIMITIVES, of enums and structs declared before, as sequence<T> or T name[N].
Files of other projects declare their types in one module of their own, module my { ... };, and name Orca's types orca::idl::T.
Every type needs a `///` comment before it, every field a `///<` comment after it. The comment of a double starts with
its unit in brackets: `double speed;  ///< [m/s] forward positive`.

A line `/// @travels` in the comment before a plain struct says that it can also be sent on its own, with OrcaObject's header in
front (ADR 0031). Its base, if it has one, must be marked too.
A line `/// @bulk` before a sequence of octets or numbers says that it may be long: it need not be copied between processes (ADR 0104).
"""

import difflib
import re
from pathlib import Path
from typing import Optional

from idl_model import PRIMITIVES, Enum, Field, IdlError, IdlFile, Struct

TOKEN = re.compile(
    r"(?P<space>[ \t\r]+)|(?P<newline>\n)|(?P<after>///<[^\n]*)|(?P<before>///[^\n]*)|(?P<comment>//[^\n]*)"
    r"|(?P<directive>\#[^\n]*)|(?P<word>[A-Za-z_]\w*)|(?P<number>\d+)|(?P<sign>[{}<>;:,\[\]=()@/*.\"'-])"
)
RESERVED = ("orca", "std", "eprosima")  # namespaces that generated code uses
# Words that mean something else in C++ or in the headers of the standard library.
KEYWORDS = frozenset(
    """alignas alignof and and_eq asm auto bitand bitor bool break case catch char class co_await co_return co_yield compl concept const
    const_cast consteval constexpr constinit continue decltype default delete do double dynamic_cast else enum explicit export extern
    false float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected
    public register reinterpret_cast requires return short signed sizeof static static_assert static_cast struct switch template this
    thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t while xor xor_eq
    assert errno linux major makedev minor stderr stdin stdout unix""".split()
)
MACROS = re.compile(r"BUFSIZ|EDOM|EOF|ERANGE|HUGE_VAL|INFINITY|NAN|NULL|RAND_MAX|SIG(ABRT|FPE|HUP|ILL|INT|KILL|SEGV|TERM)")
MOST_ELEMENTS = 100_000  # of an array, which is part of each object
TRAVELS = "@travels"  # in the comment before a plain struct
BULK = "@bulk"  # the comment before a sequence of octets or numbers
BULK_ELEMENTS = [p for name, p in PRIMITIVES.items() if name not in ("boolean", "string")]
HINTS = {
    "float": "use double",
    "short": "use long",
    "char": "use octet or string",
    "wstring": "use string",
    "any": "name the type",
    "union": "use a struct with an enum that says which fields count",
    "typedef": "write the type out",
    "const": "write the number out",
    "map": "use two sequences",
    "bitmask": "use booleans",
}


class Token:
    def __init__(self, kind: str, text: str, line: int):
        self.kind, self.text, self.line = kind, text, line


def tokenize(text: str, name: str) -> list[Token]:
    tokens, at, line = [], 0, 1
    while at < len(text):
        match = TOKEN.match(text, at)
        if not match:
            raise IdlError(f"{name}:{line}: unexpected character {text[at]!r}")
        kind = match.lastgroup
        if kind == "newline":
            line += 1
        elif kind not in ("space", "comment"):
            tokens.append(Token(kind, match.group(), line))
        at = match.end()
    tokens.append(Token("end", "the end of the file", line))
    return tokens


class Parser:
    """The parser of one file. `known` maps the names of types declared before to the types, and is extended."""

    def __init__(self, text: str, name: str, known: dict, load):
        self.name, self.known, self.load = name, known, load
        self.tokens = tokenize(text, name)
        self.at = 0
        self.file = IdlFile(name, [], [], [])

    # -- reading tokens

    def error(self, message: str, token: Token = None) -> IdlError:
        return IdlError(f"{self.name}:{(token or self.peek()).line}: {message}")

    def peek(self) -> Token:
        return self.tokens[self.at]

    def next(self) -> Token:
        token = self.tokens[self.at]
        if token.kind != "end":
            self.at += 1
        return token

    def accept(self, text: str) -> bool:
        if self.peek().text != text:
            return False
        self.next()
        return True

    def expect(self, text: str) -> Token:
        if self.peek().text != text:
            raise self.error(f"found '{self.peek().text}', expected '{text}'")
        return self.next()

    def identifier(self, what: str, pattern: str, style: str) -> Token:
        token = self.next()
        if token.kind != "word":
            raise self.error(f"found '{token.text}', expected the name of {what}", token)
        if not re.fullmatch(pattern, token.text):
            raise self.error(f"'{token.text}': the name of {what} is written {style}", token)
        if token.text in KEYWORDS or MACROS.fullmatch(token.text):
            raise self.error(f"'{token.text}' cannot be the name of {what}: it means something else in C++", token)
        return token

    def comment_before(self) -> str:
        lines = []
        while self.peek().kind == "before":
            lines.append(self.next().text[3:].strip())
        return " ".join(lines)

    def comment_after(self) -> str:
        lines = []
        while self.peek().kind == "after":
            lines.append(self.next().text[4:].strip())
        return " ".join(lines)

    # -- the grammar

    def parse(self) -> IdlFile:
        guard = self.skip_guard()
        while self.peek().kind == "directive":
            self.directive()
        end = self.open_modules(guard)
        while not self.accept("}"):
            self.definition()
        for sign in end:
            self.expect(sign)
        if self.next().text != "#endif" or self.peek().kind != "end":
            raise self.error("nothing may follow the modules but the '#endif' of the include guard")
        return self.file

    def skip_guard(self) -> str:
        guard = f"ORCA_{Path(self.name).stem.upper()}_IDL"
        first = re.fullmatch(r"#ifndef (\w+)", self.next().text)
        if first is None or self.next().text != f"#define {first[1]}":
            raise self.error(f"the file must start with its include guard: #ifndef {guard}, #define {guard}")
        return first[1]

    def open_modules(self, guard: str):
        """Returns the signs that end the modules, after the first brace."""
        self.expect("module")
        if self.accept("orca"):
            own = f"ORCA_{Path(self.name).stem.upper()}_IDL"
            if guard != own:
                raise self.error(f"the file must start with its include guard: #ifndef {own}, #define {own}")
            for text in ("{", "module", "idl", "{"):
                self.expect(text)
            return (";", "}", ";")
        token = self.identifier("a module", r"[a-z][a-z0-9_]*", "in snake_case")
        if token.text in RESERVED:
            raise self.error(f"'{token.text}' cannot be a module: the code made of it uses that name", token)
        self.file.module = token.text
        self.expect("{")
        return (";",)

    def directive(self):
        token = self.next()
        match = re.fullmatch(r'#include "(\w+\.idl)"', token.text)
        if not match:
            raise self.error(f"found '{token.text}', expected '#include \"name.idl\"'", token)
        try:
            self.file.includes.append(self.load(match.group(1)))
        except FileNotFoundError:
            raise self.error(f"there is no file '{match.group(1)}' beside this one, or among Orca's", token) from None

    def definition(self):
        text = self.comment_before()
        token = self.next()
        readers = {"enum": self.enum, "struct": self.struct}
        if token.text not in readers:
            hint = HINTS.get(token.text)
            raise self.error(f"found '{token.text}', expected 'enum' or 'struct'" + (f": {hint}" if hint else ""), token)
        if not text:
            raise self.error(f"this {token.text} needs a '///' comment before it that says what it means", token)
        readers[token.text](text)

    def type_name(self, what: str) -> Token:
        token = self.identifier(what, r"[A-Z][A-Za-z0-9]*", "in PascalCase")
        if self.full_name(token.text) in self.known:
            raise self.error(f"'{token.text}' is declared already", token)
        return token

    def full_name(self, word: str) -> str:
        return f"{self.file.module}.{word}" if self.file.module else word

    def enum(self, text: str):
        name = self.type_name("an enum")
        scope = [k for k in self.known.values() if isinstance(k, Enum) and k.module == self.file.module]
        taken = {e: k.name for k in scope for e in k.enumerators}
        enumerators = []
        self.expect("{")
        while not self.accept("}"):
            token = self.identifier("an enumerator", r"[A-Z][A-Z0-9_]*", "in CAPITALS")
            if token.text in taken or token.text in enumerators:
                owner = taken.get(token.text, name.text)
                raise self.error(f"'{token.text}' is an enumerator of {owner} already; they share one scope in C++", token)
            enumerators.append(token.text)
            comma = self.accept(",")
            self.comment_after()
            if not comma and self.peek().text != "}":
                raise self.error(f"found '{self.peek().text}', expected ',' or '}}'")
        self.expect(";")
        if not enumerators:
            raise self.error(f"enum {name.text} has no enumerators", name)
        full = self.full_name(name.text)
        self.known[full] = Enum(full, enumerators, text)
        self.file.enums.append(self.known[full])

    def struct(self, text: str):
        name = self.type_name("a struct")
        base = None
        if self.accept(":"):
            token = self.next()
            base = self.resolve(self.scoped(token.text), token)
            if not isinstance(base, Struct):
                raise self.error(f"'{token.text}' is no struct; only a struct can be inherited", token)
        struct = Struct(self.full_name(name.text), base, text.replace(TRAVELS, "").strip())
        if TRAVELS in text:
            struct.header = self.header_for(struct, name)
        self.expect("{")
        while not self.accept("}"):
            self.field(struct)
        self.expect(";")
        if not struct.fields:
            raise self.error(f"struct {name.text} needs a field of its own", name)
        names = struct.text_names
        for twice in {n for n in names if names.count(n) > 1}:
            raise self.error(f"'{twice}' would be twice on an element of {name.text}: its first field is a struct, whose fields are "
                             "written there too; put another field first", name)
        self.known[struct.name] = struct
        self.file.structs.append(struct)

    def header_for(self, struct: Struct, name: Token) -> Struct:
        header = self.known.get("OrcaObject")
        if header is None:
            raise self.error(f"{TRAVELS} needs OrcaObject: #include the file that declares it", name)
        if struct.is_object:
            raise self.error(f"{struct.name} derives from OrcaObject and travels without {TRAVELS}", name)
        if struct.base and not struct.base.travels:
            raise self.error(f"{struct.name} can travel only if {struct.base.name} does: mark that with {TRAVELS} too", name)
        return header

    def field(self, struct: Struct):
        start = self.peek()
        mark = self.comment_before()
        if mark not in ("", BULK):
            raise self.error(f"found '/// {mark}': what a field means stands behind it, after '///<'; before it only {BULK} may stand", start)
        start = self.peek()
        sequence = self.accept("sequence")
        if sequence:
            self.expect("<")
        kind = self.field_type()
        if sequence:
            if self.accept(","):
                raise self.error("bounded sequences are not supported: write sequence<T>", start)
            self.expect(">")
            if kind is PRIMITIVES["boolean"]:
                raise self.error("sequence<boolean> is not supported: use sequence<octet>", start)
        if mark and not (sequence and kind in BULK_ELEMENTS):
            raise self.error(f"{BULK} is for a sequence of octets or numbers only", start)
        name = self.identifier("a field", r"[a-z][a-z0-9_]*", "in snake_case")
        if any(f.name == name.text for f in struct.all_fields):
            raise self.error(f"{struct.name} has a field '{name.text}' already, of its own or inherited", name)
        if struct.header and any(f.name == name.text for f in struct.header.all_fields):
            raise self.error(f"'{name.text}' is a field of OrcaObject, which {struct.name} gets where it travels", name)
        array = self.array_size(sequence)
        self.expect(";")
        unit, text = self.field_comment(kind, name)
        struct.fields.append(Field(name.text, kind, unit, text, sequence, array, bool(mark)))

    def array_size(self, sequence: bool):
        if not self.accept("["):
            return None
        token = self.next()
        if token.kind != "number" or int(token.text) == 0:
            raise self.error(f"found '{token.text}', expected the number of elements, at least 1", token)
        if int(token.text) > MOST_ELEMENTS:
            raise self.error(f"an array has at most {MOST_ELEMENTS:,} elements, because each object holds all of them: write sequence<T>", token)
        if sequence:
            raise self.error("an array of sequences is not supported: put the sequence into a struct", token)
        self.expect("]")
        return int(token.text)

    def field_type(self):
        token = self.next()
        words = token.text
        if words == "unsigned":
            words += " " + self.expect("long").text
        if words in ("long", "unsigned long") and self.accept("long"):
            words += " long"
        if words == "sequence":
            raise self.error("a sequence of sequences is not supported: put the inner one into a struct", token)
        return self.resolve(self.scoped(words), token)

    def scoped(self, word: str) -> str:
        """Returns the name that begins with a word, with the modules before it: "orca::idl::Pose2D"."""
        while self.accept(":"):
            self.expect(":")
            word += "::" + self.next().text
        return word

    def resolve(self, name: str, token: Token):
        module, _, word = name.rpartition("::")
        full = self.full_name(name) if not module else word if module == "orca::idl" else f"{module}.{word}"
        found = PRIMITIVES.get(name) or self.known.get(full)
        if found:
            return found
        if name in ("@", "/"):
            raise self.error("annotations and block comments are not supported: write '///<' comments", token)
        if name in HINTS:
            raise self.error(f"'{name}' is not supported: {HINTS[name]}", token)
        near = difflib.get_close_matches(name, [*PRIMITIVES, *map(self.spelt, self.known.values())], 1)
        if not module and name in self.known:
            near = [self.spelt(self.known[name])]
        hint = f"; did you mean '{near[0]}'?" if near else "; declare it before, or #include the file that does"
        raise self.error(f"unknown type '{name}'{hint}", token)

    def spelt(self, known) -> str:
        """How this file names a type."""
        return known.word if known.module == self.file.module else f"{known.module or 'orca::idl'}::{known.word}"

    def field_comment(self, kind, name: Token):
        comment = self.comment_after()
        match = re.match(r"\[([^\]]*)\]\s*(.*)", comment)
        unit, text = match.groups() if match else ("", comment)
        if kind is PRIMITIVES["double"] and not unit:
            raise self.error(f"the number '{name.text}' needs its unit: '///< [m] ...', [1] for none", name)
        if not unit and not text:
            raise self.error(f"the field '{name.text}' needs a '///<' comment that says what it means", name)
        return unit, text


def read_text(path: Path) -> str:
    data = path.read_bytes()
    if not data.isascii():
        line, byte = next((n, b) for n, text in enumerate(data.splitlines(), 1) for b in text if b > 127)
        raise IdlError(f"{path.name}:{line}: the byte 0x{byte:02x} is no ASCII; write plain letters")
    return data.decode("ascii")


def load_files(paths: list[Path], orca: Optional[Path] = None) -> list[IdlFile]:
    """Parses the files and their includes, in the same folder or in `orca`; each file comes once, after its includes."""
    loaded: dict[str, IdlFile] = {}
    known: dict = {}
    open_files: list[str] = []

    def load(path: Path) -> IdlFile:
        if path.name in open_files:
            raise IdlError(f"{path.name}:1: the file includes itself: {' -> '.join([*open_files, path.name])}")
        if path.name not in loaded:
            text = read_text(path)
            open_files.append(path.name)
            parser = Parser(text, path.name, known, lambda name: load(found(path.parent / name)))
            loaded[path.name] = parser.parse()
            open_files.pop()
        return loaded[path.name]

    def found(path: Path) -> Path:
        return orca / path.name if orca is not None and not path.exists() else path

    for path in paths:
        load(path)
    return list(loaded.values())
