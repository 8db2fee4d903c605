# SPDX-License-Identifier: GPL-3.0-or-later
"""A class that needs more than 30 functions, or more than seven others to work with, is several ideas.

Counted is what a class declares: constructors, destructor, functions and operators, with and without a body; neither what
is deleted, nor what it inherits, nor the functions of the classes inside it, which are counted for themselves.

Its collaborators are the types of its data members that are classes of ours: held, referred to or pointed to, alone or in a
container, each type once. What is declared as `struct` is a value and does not count; but a struct of references or of functions
counts as many as it has of these, and a function (std::function) counts by itself. So nothing is gained by joining a class that
was cut with such a struct. Ports and parameters do not count: they are what the graph connects and sets.

DEBTS names the classes that were larger when the rule came for them, with what they have: they may shrink, and then the number here does, and not grow.
"""
import re

from cpp_functions import closing, tokens_of

FOLDERS = ("src/", "sim/")
MAX_FUNCTIONS = 30
MAX_COLLABORATORS = 7
PORTS = {"PushServer", "PushProxy", "PushServerHandle", "SendServer", "SendProxy", "SendServerHandle", "QueryServer", "QueryProxy",
         "QueryServerHandle", "Synchronizer", "Param", "SensorHW", "ActuatorHW", "MotionHW"}
TOOLS = {"Mutex"}
DEBTS = {
    ("Avoider", "functions"): 45, ("PushEdge", "functions"): 46, ("GoalFollower", "functions"): 42, ("Component", "functions"): 38,
    ("World", "functions"): 38,
    ("SupervisedRun", "collaborators"): 19, ("WatchedSystem", "collaborators"): 13, ("Applying", "collaborators"): 8,
    ("ControlDesk", "collaborators"): 13, ("HostedPart", "collaborators"): 11,
    ("OrderDesk", "collaborators"): 10, ("Run", "collaborators"): 10, ("Swap", "collaborators"): 11, ("Life", "collaborators"): 8,
    ("PortSet", "collaborators"): 8, ("QuietRun", "collaborators"): 8, ("Reporter", "collaborators"): 8,
    ("Shadow", "collaborators"): 8, ("System", "collaborators"): 9, ("Renewal", "collaborators"): 9,
}
_KEYS = ("class", "struct")
_NO_MEMBER_FUNCTION = {"using", "typedef", "friend", "static_assert", "enum", "class", "struct", "union"}


def _angles(words, start):
    """Index of the > that closes the < at start, or None if it opens no template."""
    depth = 0
    for i in range(start, len(words)):
        if words[i] in (";", "{", "}"):
            return None
        depth += (words[i] == "<") - (words[i] == ">")
        if depth == 0:
            return i
    return None


def _without_angles(words):
    """The declaration without what stands between < and >: "std::function<int()> f" shows no bracket then."""
    kept, i = [], 0
    while i < len(words):
        end = _angles(words, i) if words[i] == "<" and "operator" not in kept else None
        if end is None:
            kept.append(words[i])
        i = i + 1 if end is None else end + 1
    return kept


def _is_function(words):
    words = _without_angles(words)
    while words[:2] == ["[", "["]:
        words = words[words.index("]") + 2:]
    if words and words[0] == "template":
        words = words[1:]
    if not words or words[0] in _NO_MEMBER_FUNCTION or words[-2:] == ["=", "delete"]:
        return False
    if "operator" in words:
        return True
    if "(" not in words:
        return False
    before = words[: words.index("(")]
    return "=" not in before and "{" not in before and before[-1:] not in (["alignas"], ["decltype"])


def _is_member(words):
    """Is it a data member of its own in each object?"""
    while words[:2] == ["[", "["]:
        words = words[words.index("]") + 2:]
    return bool(words) and words[-2:] != ["=", "delete"] and words[0] not in _NO_MEMBER_FUNCTION | {"static", "template"} \
        and not _is_function(words)


def _type_of(words):
    """The words of a member's type: without its name and what it is at first."""
    for end in ("{", "="):
        words = words[: words.index(end)] if end in words else words
    return words[:-1]


def _is_class_head(words):
    """Is the brace after these words a class's? "enum class" and "struct stat f()" are none."""
    words = _without_angles(words)
    if "enum" in words or not any(key in words for key in _KEYS):
        return False
    return "(" not in words or words[words.index("(") - 1] == "alignas"


def _name_of(words):
    words = _without_angles(words)
    names = [w for w in words[words.index(next(w for w in words if w in _KEYS)) + 1:] if re.match(r"[A-Za-z_]", w)]
    return next((n for n in names if n not in ("alignas", "final")), "?")


class _Counter:
    """Walks over the tokens of one file and counts the functions of each class."""

    def __init__(self, text):
        self.tokens = tokens_of(text)
        self.found = []  # (name, line, functions, whether it is a class and no struct, members)

    def scope(self, begin, end, class_head=None):
        """Everything between two braces; counts for the class whose head this is."""
        functions, members, words, i = 0, [], [], begin
        while i < end:
            word = self.tokens[i].text
            if word in ("public", "private", "protected") and self.tokens[i + 1].text == ":":
                words, i = [], i + 2
            elif word == ";":
                members += [_type_of(words)] if _is_member(words) else []
                functions, words, i = functions + _is_function(words), [], i + 1
            elif word == "{":
                counted, words, i = self.braces(words, i)
                functions += counted
            else:
                words, i = words + [word], i + 1
        if class_head:
            self.found.append((*class_head[:2], functions, class_head[2], members))

    def braces(self, words, opening):
        """What a brace begins: (functions of the scope around it, words that stay, index of what follows)."""
        end = closing(self.tokens, opening)
        after = self.tokens[end + 1].text if end + 1 < len(self.tokens) else ""
        if _is_class_head(words):
            self.scope(opening + 1, end, (_name_of(words), self.tokens[opening].line, "class" in _without_angles(words)))
            return 0, [], end + 1
        if "namespace" in words or words[:1] == ["extern"]:
            self.scope(opening + 1, end)
            return 0, [], end + 1
        if "enum" in words or after in (";", ",", "{"):  # an initialiser; the statement goes on
            return 0, words + ["{", "}"], end + 1
        return int(_is_function(words)), [], end + 1


_THREAD_WORD = re.compile(r"\bORCA_(?:THREAD_WORD|GUARDED_BY|REQUIRES|ACQUIRES|TRIES_TO_ACQUIRE|RELEASES)\((?:[^()]|\([^()]*\))*\)")


def classes_of(text):
    """(name, line of its brace, number of functions, whether it is a class and no struct, types of members) of each class in a
    C++ text. A word about threads is no function."""
    counter = _Counter(_THREAD_WORD.sub(lambda m: "\n" * m[0].count("\n"), text))
    counter.scope(0, len(counter.tokens))
    return counter.found


def _ours(words, names):
    """Those of the names that stand in a type for themselves: not those of other namespaces, nor what is declared inside them."""
    return {word for i, word in enumerate(words) if word in names and words[i + 1: i + 2] != ["::"]
            and words[max(0, i - 2): i] not in (["std", "::"], ["idl", "::"])}


def _joints(members, classes):
    """How many functions, and references to classes, a struct joins others with."""
    return sum("function" in words or bool({"&", "*"} & set(words) and _ours(words, classes)) for words in members)


def _collaborators(name, members, classes, structs):
    """Number of collaborators of a class, and their names for people."""
    members = [words for words in members if not (PORTS | TOOLS) & set(words)]
    types = set().union(*(_ours(words, classes) for words in members if "function" not in words), set()) - {name}
    joined = {word: structs[word] for words in members for word in _ours(words, structs.keys())}
    functions = sum("function" in words for words in members)
    shown = sorted(types) + [f"{word} ({count})" for word, count in sorted(joined.items())]
    return (len(types) + sum(joined.values()) + functions,
            ", ".join(shown + ([f"{functions} functions"] if functions else [])))


def _too_many(what, where, name, count, limit, advice):
    limit = DEBTS.get((name, what), limit)
    return [f"{where}: class {name} {advice.format(count=count, limit=limit)}"] if count > limit else []


def find(tree):
    found = [(f"{path}:{line}", name, functions, is_class, members)
             for path in tree.with_suffix(".cpp", ".hpp") if path.startswith(FOLDERS)
             for name, line, functions, is_class, members in classes_of(tree.text(path))]
    classes = {name for _, name, _, is_class, _ in found if is_class}
    structs = {name: _joints(members, classes) for _, name, _, is_class, members in found if not is_class and name not in classes}
    structs = {name: count for name, count in structs.items() if count > 1}
    findings, largest, counts = [], (0, ""), {}
    for where, name, functions, is_class, members in found:
        largest = max(largest, (functions, f"{where} {name}"))
        counts[name, "functions"] = max(functions, counts.get((name, "functions"), 0))
        findings += _too_many("functions", where, name, functions, MAX_FUNCTIONS,
                              "declares {count} functions, at most {limit}; give its ideas classes of their own")
        if is_class:
            count, names = _collaborators(name, members, classes, structs)
            counts[name, "collaborators"] = max(count, counts.get((name, "collaborators"), 0))
            findings += _too_many("collaborators", where, name, count, MAX_COLLABORATORS,
                                  "works with {count} others, at most {limit}: " + names +
                                  "; find the value or the function inside")
    is_whole = hasattr(tree, "root")
    findings += [f"tests/lint/check_classes.py: DEBTS says {debt} {what} for class {name}, which has {counts.get((name, what), 0)} by now"
                 for (name, what), debt in DEBTS.items() if counts.get((name, what), 0 if is_whole else debt) < debt]
    if is_whole:
        print(f"the largest class: {largest[1]} with {largest[0]} functions")
    return findings


def _class(body, head="class A final : public B<int()>"):
    return {"src/runtime/host/run/a.hpp": f"namespace n {{\n{head} {{\n public:\n{body}}};\n}}  // namespace n\n"}


_KINDS = """  explicit A(int a) : a_{a}, b_(2) { c(); }
  ~A() noexcept(false) override;
  [[nodiscard]] int get() const { return a_; }
  [[nodiscard]] std::map<int, std::string> all() const;
  template <class T> T as(T value) { return value; }
  A& operator=(A&&) = default;
  virtual void f() = 0;
"""
_NO_FUNCTIONS = """  A(const A&) = delete;
  using Loader = std::function<int(int)>;
  friend void swap(A&, A&);
  friend class B;
  enum class Kind { one, two };
  struct Inner;
  std::function<void(int)> call_;
  std::unique_ptr<Event> event_ = executive_.make_event();
  std::atomic<const char*> hook_{name()};
  RunContext run_{executive_, [this](int a) { use(a); }, true};
  static constexpr int kSize = sizeof(int);
"""

_OTHERS = "".join(f"class C{i} {{}};\n" for i in range(9))
_OTHER_KINDS = """  C0 held_;
  const C1& referred_;
  std::unique_ptr<C2> owned_;
  std::map<int, std::optional<C3>> many_;
  C4* pointed_ = nullptr;
  C5 first_{*this, true};
  C6 last_ = C6{};
"""
_NO_OTHERS = """  A(const C7&) = delete;
  void with(const C7& other);
  std::vector<C0> more_of_one_;
  C7::Kind kind_;
  idl::C7 object_;
  static C7 shared_;
  PushServer<C8> port_;
"""


def _others(body, before=""):
    return {"sim/a.hpp": f"{_OTHERS}{before}class A {{\n public:\n{body}}};\n"}


BAD = [
    ({"sim/a.hpp": "class World {\n" + "  void f();\n" * 31 + "};\n"}, "DEBTS says 38 functions for class World, which has 31 by now"),
    (_class("  void f();\n" * 31), "src/runtime/host/run/a.hpp:2: class A declares 31 functions"),
    (_class("  void f() {\n    if (a) { g(); }\n  }\n" * 31), "class A declares 31 functions"),
    (_class(_KINDS * 5), "class A declares 35 functions"),
    (_class("  void f();\n" * 31, "template <class T>\nstruct A"), "class A declares 31 functions"),
    (_class("  struct In {\n" + "    void f();\n" * 31 + "  };\n"), "class In declares 31 functions"),
    (_class(_NO_FUNCTIONS + "  void f();\n" * 31), "class A declares 31 functions"),
    ({"src/hw/api/a.cpp": "class A {\n" + " private:\n  void f();\n public:\n  int g() const;\n" * 16 + "};\n"},
     "class A declares 32 functions"),
    ({"src/components/a.cpp": "class A {\n" + "  void f();\n" * 31 + "};\n"}, "class A declares 31 functions"),
    (_others(_OTHER_KINDS + "  C7 one_too_many_;\n"), "class A works with 8 others, at most 7: C0, C1, C2, C3, C4, C5, C6, C7"),
    (_others(_OTHER_KINDS + "  std::function<void()> say_;\n"), "works with 8 others"),
    (_others("".join(f"  std::function<void()> f{i}_;\n" for i in range(8))), "works with 8 others, at most 7: 8 functions"),
    (_others("  Levers levers_;\n", "struct Levers {\n" + "".join(f"  std::function<int(int)> f{i};\n" for i in range(8)) + "};\n"),
     "works with 8 others, at most 7: Levers (8)"),
    (_others("  Place place_;\n", "struct Place {\n" + "".join(f"  C{i}& c{i};\n" for i in range(8)) + "};\n"),
     "works with 8 others, at most 7: Place (8)"),
]
GOOD = [
    {"src/runtime/a.hpp": "class A {\n" + "  int a ORCA_GUARDED_BY(mutex_) = 0;\n" * 40 + "};\n"},
    _class("  void f();\n" * 30),
    _class(_KINDS * 4 + "  void f();\n" * 2),
    _class(_NO_FUNCTIONS + "  void f();\n" * 30),
    _class("  struct In {\n" + "    void f();\n" * 20 + "  };\n" + "  void f();\n" * 20),
    {"src/runtime/a.cpp": "void f();\n" * 40 + "enum class E { a, b };\n" + "struct stat g(int a) { return h(a); }\n" * 40},
    {"tests/unit/a.cpp": "class A {\n" + "  void f();\n" * 40 + "};\n"},
    _others(_OTHER_KINDS + _NO_OTHERS),
    _others("  Value value_;\n" + _OTHER_KINDS, "struct Value {\n  C7 held;\n  int number = 0;\n};\n"),
    {"sim/a.hpp": _OTHERS + "struct Values {\n" + "".join(f"  C{i} c{i};\n" for i in range(9)) + "};\n"},
]
