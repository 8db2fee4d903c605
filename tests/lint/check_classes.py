# SPDX-License-Identifier: GPL-3.0-or-later
"""A class that needs more than 30 functions is several ideas: the runtime's classes and those of the hardware API.

Counted is what a class declares: constructors, destructor, functions and operators, with and without a body; neither what
is deleted, nor what it inherits, nor the functions of the classes inside it, which are counted for themselves.
"""
import re

from cpp_functions import closing, tokens_of

FOLDERS = ("src/runtime/", "src/hw/api/")
MAX_FUNCTIONS = 30
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
        self.found = []  # (name, line, functions)

    def scope(self, begin, end, class_head=None):
        """Everything between two braces; counts for the class whose head this is."""
        functions, words, i = 0, [], begin
        while i < end:
            word = self.tokens[i].text
            if word in ("public", "private", "protected") and self.tokens[i + 1].text == ":":
                words, i = [], i + 2
            elif word == ";":
                functions, words, i = functions + _is_function(words), [], i + 1
            elif word == "{":
                counted, words, i = self.braces(words, i)
                functions += counted
            else:
                words, i = words + [word], i + 1
        if class_head:
            self.found.append((*class_head, functions))

    def braces(self, words, opening):
        """What a brace begins: (functions of the scope around it, words that stay, index of what follows)."""
        end = closing(self.tokens, opening)
        after = self.tokens[end + 1].text if end + 1 < len(self.tokens) else ""
        if _is_class_head(words):
            self.scope(opening + 1, end, (_name_of(words), self.tokens[opening].line))
            return 0, [], end + 1
        if "namespace" in words or words[:1] == ["extern"]:
            self.scope(opening + 1, end)
            return 0, [], end + 1
        if "enum" in words or after in (";", ",", "{"):  # an initialiser; the statement goes on
            return 0, words + ["{", "}"], end + 1
        return int(_is_function(words)), [], end + 1


def classes_of(text):
    """(name, line of its brace, number of functions) of each class in a C++ text."""
    counter = _Counter(text)
    counter.scope(0, len(counter.tokens))
    return counter.found


def find(tree):
    findings, largest = [], (0, "")
    for path in tree.with_suffix(".cpp", ".hpp"):
        if not path.startswith(FOLDERS):
            continue
        for name, line, functions in classes_of(tree.text(path)):
            largest = max(largest, (functions, f"{path}:{line} {name}"))
            if functions > MAX_FUNCTIONS:
                findings.append(f"{path}:{line}: class {name} declares {functions} functions, at most {MAX_FUNCTIONS}; "
                                "give its ideas classes of their own")
    if hasattr(tree, "root"):
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

BAD = [
    (_class("  void f();\n" * 31), "src/runtime/host/run/a.hpp:2: class A declares 31 functions"),
    (_class("  void f() {\n    if (a) { g(); }\n  }\n" * 31), "class A declares 31 functions"),
    (_class(_KINDS * 5), "class A declares 35 functions"),
    (_class("  void f();\n" * 31, "template <class T>\nstruct A"), "class A declares 31 functions"),
    (_class("  struct In {\n" + "    void f();\n" * 31 + "  };\n"), "class In declares 31 functions"),
    (_class(_NO_FUNCTIONS + "  void f();\n" * 31), "class A declares 31 functions"),
    ({"src/hw/api/a.cpp": "class A {\n" + " private:\n  void f();\n public:\n  int g() const;\n" * 16 + "};\n"},
     "class A declares 32 functions"),
]
GOOD = [
    _class("  void f();\n" * 30),
    _class(_KINDS * 4 + "  void f();\n" * 2),
    _class(_NO_FUNCTIONS * 10 + "  void f();\n" * 30),
    _class("  struct In {\n" + "    void f();\n" * 20 + "  };\n" + "  void f();\n" * 20),
    {"src/runtime/a.cpp": "void f();\n" * 40 + "enum class E { a, b };\n" + "struct stat g(int a) { return h(a); }\n" * 40},
    {"src/components/a.cpp": "class A {\n" + "  void f();\n" * 40 + "};\n"},
]
