# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions and files are small, by the figures in CONTRIBUTING.md: for C++ and, by length alone, for Python."""
import ast

from cpp_functions import Function, functions_of

P90_LINES, P99_LINES, MAX_LINES = 22, 60, 60
MAX_COMPLEXITY = 15
MAX_FILE_LINES = 450
WORST_SHOWN = 10


def _python_functions(text):
    """Measures length in lines; complexity is not counted."""
    nodes = [n for n in ast.walk(ast.parse(text)) if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef))]
    return [Function(n.name, n.lineno, n.end_lineno - n.lineno + 1, 1) for n in nodes]


def measured(tree):
    """Yields (path, Function) of every function in the tree."""
    for path in tree.with_suffix(".cpp", ".hpp", ".h"):
        yield from ((path, f) for f in functions_of(tree.text(path)))
    for path in tree.with_suffix(".py"):
        yield from ((path, f) for f in _python_functions(tree.text(path)))


def percentile(lengths, share):
    """Returns the smallest length that at least this share of the functions does not exceed."""
    ordered = sorted(lengths)
    return ordered[max(0, -(-len(ordered) * share // 100) - 1)] if ordered else 0


def _print_figures(functions):
    lengths = [f.length for _, f in functions]
    print(f"{len(functions)} functions, lines: median {percentile(lengths, 50)}, p90 {percentile(lengths, 90)}, "
          f"p99 {percentile(lengths, 99)}, max {max(lengths, default=0)}; the longest:")
    for path, f in sorted(functions, key=lambda pf: (-pf[1].length, pf[0]))[:WORST_SHOWN]:
        print(f"  {f.length:4} lines, complexity {f.complexity:2}  {path}:{f.line} {f.name}")


def _faults_of_one(path, f):
    if f.length > MAX_LINES:
        yield f"{path}:{f.line}: {f.name} has {f.length} lines, at most {MAX_LINES}; move parts of it to functions"
    if f.complexity > MAX_COMPLEXITY:
        yield f"{path}:{f.line}: {f.name} has complexity {f.complexity}, at most {MAX_COMPLEXITY}"


def _faults_of_all(functions):
    lengths = [f.length for _, f in functions]
    for share, limit in ((90, P90_LINES), (99, P99_LINES)):
        if percentile(lengths, share) > limit:
            yield f"all: {share} % of the functions should have at most {limit} lines; p{share} is {percentile(lengths, share)}"


def _faults_of_files(tree):
    for path in tree.with_suffix(".cpp", ".hpp", ".h", ".py", ".idl", ".cmake", "CMakeLists.txt", "dev"):
        lines = tree.text(path).count("\n")
        if lines > MAX_FILE_LINES:
            yield f"{path}:1: {lines} lines, at most {MAX_FILE_LINES}; split it by subject"


def find(tree):
    functions = list(measured(tree))
    if hasattr(tree, "root"):
        _print_figures(functions)
    findings = [fault for path, f in functions for fault in _faults_of_one(path, f)]
    return findings + list(_faults_of_all(functions)) + list(_faults_of_files(tree))


def _cpp(lines, head="int f(int a)"):
    return head + " {\n" + "  a++;\n" * lines + "  return a;\n}\n"


_CLASS = "namespace n {{\ntemplate <class T>\nclass C : public D {{\n public:\n  C() : a_{{1}}, b_(2) {{\n{}  }}\n  int a_{{0}};\n}};\n}}\n"
_QUOTES = 'const char* a = "{";\nconst char b = \'}\';\nauto c = R"({{{)";  // {{{\n'

BAD = [
    ({"a.cpp": _cpp(60)}, "a.cpp:1: f has 63 lines"),
    ({"a.cpp": _QUOTES + _cpp(60)}, "a.cpp:4: f has 63 lines"),
    ({"a.hpp": _CLASS.format("a_++;\n" * 70)}, "a.hpp:5: C has 72 lines"),
    ({"a_test.cpp": _cpp(70, 'TEST_CASE("a title", "[tag]")')}, "TEST_CASE has 73 lines"),
    ({"a.cpp": _cpp(61, "auto A::b(std::vector<int> a) const -> std::optional<int>")}, "A::b has 64 lines"),
    ({"a.cpp": _cpp(61, "[[nodiscard]] inline bool C::g() const noexcept")}, "C::g has 64 lines"),
    ({"a.cpp": _cpp(61, "struct stat A::h(int a)")}, "A::h has 64 lines"),
    ({"a.cpp": _cpp(61, "bool operator==(const A& a, const A& b)")}, "operator== has 64 lines"),
    ({"a.cpp": "int f(int a) {\n" + "  if (a && a > 1) a++;\n" * 8 + "}\n"}, "f has complexity 17"),
    ({"a.cpp": _cpp(23) * 5}, "p90 is 26"),
    ({"a.py": "def f():\n" + "    a = 1\n" * 61}, "a.py:1: f has 62 lines"),
    ({"a.hpp": "int a;\n" * 451}, "451 lines"),
]
GOOD = [
    {"a.cpp": _cpp(10) + "// comment\n" * 100 + _cpp(10, "int g(int a)")},
    {"a.cpp": "const std::map<int, int> kTable = {\n" + "    {1, 2},\n" * 100 + "};\n"},
    {"a.cpp": "enum class E {\n" + "  a,\n" * 100 + "};\nclass A final {\n" + "  int a();\n" * 100 + "};\n"},
    {"a.cpp": "int f() {\n" + "  // why\n\n" * 100 + "  return 1'000'000;\n}\n"},
    {"a.cpp": "#define M(x) \\\n  {{{ x\n" + "int a;\n" * 70},
]
