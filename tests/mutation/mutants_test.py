# SPDX-License-Identifier: GPL-3.0-or-later
"""What counts as a mutant, by example."""
import platform
import unittest

import run
from mutants import mutants_of


def changes(source):
    return [(m.kind, m.old, m.new) for m in mutants_of("a.cpp", source)]


class Mutants(unittest.TestCase):
    def test_a_comparison_gets_its_neighbour(self):
        self.assertEqual(changes("bool b = x < y;"), [("comparison", "<", "<=")])
        self.assertEqual(changes("bool b = x != y;"), [("comparison", "!=", "==")])

    def test_template_brackets_are_no_comparisons(self):
        self.assertEqual(changes("std::vector<int> v;\ntemplate <class A>\nvoid f(A a);"), [])

    def test_constants_grow_by_one_and_truths_turn_round(self):
        self.assertEqual(changes("int n = 15;"), [("constant", "15", "16")])
        self.assertEqual(changes("bool b = true;"), [("constant", "true", "false")])
        self.assertEqual(changes("int x2 = v1; double d = 1.5;"), [])

    def test_conditions_are_negated_and_joined_the_other_way(self):
        self.assertIn(("condition", "a && f(b)", "!(a && f(b))"), changes("if (a && f(b)) go();"))
        self.assertIn(("condition", "&&", "||"), changes("if (a && f(b)) go();"))

    def test_a_condition_that_declares_is_not_negated(self):
        self.assertEqual(changes("if (const auto x = find(y)) go();"), [])

    def test_a_negated_condition_or_return_keeps_its_strings(self):
        self.assertIn(("condition", 'a.starts_with("x == 1")', '!(a.starts_with("x == 1"))'),
                      changes('if (a.starts_with("x == 1")) go();'))
        self.assertIn(("return", "a.find(' ') == b", "!(a.find(' ') == b)"), changes("return a.find(' ') == b;"))

    def test_a_return_gives_the_opposite_or_nothing(self):
        self.assertEqual(changes("return list.empty();"), [("return", "list.empty()", "!(list.empty())")])
        self.assertEqual(changes("return name_;"), [("return", "name_", "{}")])

    def test_comments_strings_assertions_and_directives_stay(self):
        self.assertEqual(changes('// a < b\n/* 1 == 2 */ f("x < 5");\nassert(a < b);\n#if A == 1\nint c = R"(3 < 4)";'), [])

    def test_what_only_other_builds_compile_stays(self):
        def both(condition):
            return changes(f"#if {condition}\nint a = 7;\n#else\nint b = 5;\n#endif\nint c = 3;\n")

        self.assertEqual(both("defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)"),
                         [("constant", "5", "6"), ("constant", "3", "4")])
        self.assertEqual(both(f"defined(__{platform.machine()}__)"), [("constant", "7", "8"), ("constant", "3", "4")])
        self.assertEqual(len(both("defined(ORCA_SOMETHING)")), 3)
        self.assertEqual(len(both("!defined(__SANITIZE_ADDRESS__)")), 3)

    def test_of_several_processors_only_this_one_counts(self):
        others = [name for name in ("x86_64", "i386", "aarch64") if name != platform.machine()]
        source = f"#if defined(__{others[0]}__)\nint a = 7;\n#elif defined(__{platform.machine()}__)\nint b = 5;\n" \
                 f"#elif defined(__{others[1]}__)\nint c = 9;\n#else\nint d = 11;\n#endif\n"
        self.assertEqual(changes(source), [("constant", "5", "6")])

    def test_a_mutant_is_applied_where_it_was_found(self):
        source = "if (a < b) return true;\n"
        mutant = next(m for m in mutants_of("a.cpp", source) if m.kind == "comparison")
        self.assertEqual(mutant.applied_to(source), "if (a <= b) return true;\n")
        self.assertEqual(mutant.text(), "a.cpp:1: comparison: '<' -> '<='")

    def test_a_changed_line_leaves_the_order_of_all_others(self):
        def order(source):
            return [(m.kind, m.old, m.new) for _, m in sorted(run.shuffled(5, "a.cpp", source), key=lambda pair: pair[0])]

        before = order("int a = 11;\nint b = 12;\nint b = 12;\nbool c = a < b;\n")
        after = order("int first = 1;\nint a = 11;\nint b = 12;\nint b = 12;\nbool c = a < b;\n")
        self.assertEqual([change for change in after if change != ("constant", "1", "2")], before)

    def test_what_a_run_printed_tells_what_it_caught(self):
        printed = ("unchanged: building and running base_test\n"
                   "[1/3] caught      93 s  src/a.cpp:28: return: 'x' -> '{}'\n"
                   "[2/3] survived   588 s  src/b.cpp:2: constant: '1' -> '2'\n"
                   "[3/3] equal        0 s  src/c.cpp:3: constant: '1' -> '2'\n"
                   "survived: src/b.cpp:2: constant: '1' -> '2'\n")
        self.assertEqual(run.caught_in(printed), {"src/a.cpp:28: return: 'x' -> '{}'"})

    def test_each_excused_mutant_exists_and_has_a_reason(self):
        for line in run.EQUAL.read_text().splitlines():
            if not line.strip() or line.startswith("#"):
                continue
            excused, _, reason = line.partition(" # ")
            path = excused.split(": ")[0]
            source = (run.ROOT / path).read_text()
            texts = [run.without_line(mutant, source) for mutant in mutants_of(path, source)]
            self.assertIn(excused, texts)
            self.assertGreater(len(reason.split()), 3, excused)


if __name__ == "__main__":
    unittest.main()
