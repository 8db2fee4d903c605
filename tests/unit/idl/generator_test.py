# SPDX-License-Identifier: GPL-3.0-or-later
"""What the IDL generator accepts, refuses, and takes for the same type."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, sys.argv.pop(1))

from emit_cpp import classes_header, library_source, reflection_header, type_table, types_header, types_list  # noqa: E402
from generate import check_library, own_files  # noqa: E402
from idl_model import IdlError, layout_hash  # noqa: E402
from idl_parser import load_files  # noqa: E402

STRUCT = """
/// Where it is.
struct Spot {
  double x;  ///< [m] forward
  long n;    ///< how many
};
"""
ENUM = "/// A choice.\nenum Kind {\n  RED,\n  BLUE\n};\n"


def idl(body: str, name: str = "test", includes: str = "") -> str:
    guard = f"ORCA_{name.upper()}_IDL"
    return (f"// SPDX\n#ifndef {guard}\n#define {guard}\n{includes}"
            f"module orca {{ module idl {{\n{body}\n}}; }};\n#endif\n")


def load(**texts: str):
    """Parses the files name.idl with these texts; the first one is asked for."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in texts.items():
            (Path(folder) / f"{name}.idl").write_text(text)
        return load_files([Path(folder) / f"{next(iter(texts))}.idl"])


def parse(body: str):
    return load(test=idl(body))[-1]


def hash_of(body: str) -> int:
    return layout_hash(parse(body).structs[-1].layout)


class Refusals(unittest.TestCase):
    def refuses(self, body: str, *expected: str):
        self.refuses_text(idl(body), *expected)

    def refuses_text(self, text: str, *expected: str):
        with self.assertRaises(IdlError) as caught:
            load(test=text)
        for part in expected:
            self.assertIn(part, str(caught.exception))

    def field(self, line: str) -> str:
        return f"/// Text.\nstruct Spot {{\n{line}\n}};"

    def test_a_misspelt_type_is_named_with_its_line_and_the_nearest_one(self):
        self.refuses(self.field("duoble x;  ///< [m] forward"), "test.idl:7: unknown type 'duoble'; did you mean 'double'?")

    def test_what_is_not_supported_comes_with_the_remedy(self):
        self.refuses(self.field("float x;  ///< [m]"), "'float' is not supported: use double")
        self.refuses(self.field("@optional double x;  ///< [m]"), "annotations and block comments are not supported")
        self.refuses(self.field("sequence<boolean> x;  ///< text"), "use sequence<octet>")
        self.refuses(self.field("sequence<double, 3> x;  ///< [m]"), "write sequence<T>")
        self.refuses(self.field("sequence<sequence<double> > x;  ///< [m]"), "put the inner one into a struct")
        self.refuses(self.field("sequence<double> x[3];  ///< [m]"), "put the sequence into a struct")
        self.refuses("/// Text.\ntypedef double Angle;", "expected 'enum' or 'struct': write the type out")

    def test_bulk_data_is_a_sequence_of_octets_or_numbers(self):
        self.refuses(self.field("/// @bulk\noctet x[3];  ///< text"), "test.idl:8: @bulk is for a sequence of octets or numbers only")
        self.refuses(self.field("/// @bulk\nsequence<string> x;  ///< text"), "@bulk is for a sequence of octets or numbers only")
        self.refuses(self.field("/// Text.\nlong x;  ///< text"), "before it only @bulk may stand")

    def test_a_number_needs_its_unit(self):
        self.refuses(self.field("double x;  ///< forward"), "test.idl:7: the number 'x' needs its unit")
        self.refuses(self.field("double x;"), "the number 'x' needs its unit")

    def test_types_and_fields_need_their_comment(self):
        self.refuses("struct Spot {\n  long n;  ///< how many\n};", "this struct needs a '///' comment")
        self.refuses(self.field("long n;"), "the field 'n' needs a '///<' comment")

    def test_names_follow_the_style(self):
        self.refuses(self.field("double reachRadius;  ///< [m]"), "'reachRadius': the name of a field is written in snake_case")
        self.refuses(STRUCT.replace("Spot", "spot"), "written in PascalCase")
        self.refuses(ENUM.replace("RED", "Red"), "written in CAPITALS")

    def test_names_that_cpp_does_not_let_anybody_use_are_refused(self):
        self.refuses(self.field("double class;  ///< [m]"), "test.idl:7: 'class' cannot be the name of a field: it means something else in C++")
        self.refuses(self.field("long stdout;  ///< text"), "'stdout' cannot be the name of a field")
        self.refuses(ENUM.replace("RED", "EOF"), "'EOF' cannot be the name of an enumerator")
        self.refuses(ENUM.replace("BLUE", "SIGTERM"), "'SIGTERM' cannot be the name of an enumerator")
        self.refuses(STRUCT.replace("Spot", "NULL"), "'NULL' cannot be the name of a struct")

    def test_a_name_is_used_once(self):
        self.refuses(STRUCT + STRUCT, "'Spot' is declared already")
        self.refuses(STRUCT + "/// More.\nstruct More : Spot {\n  long x;  ///< again\n};", "has a field 'x' already, of its own or inherited")
        self.refuses(ENUM + ENUM.replace("Kind", "Other"), "'RED' is an enumerator of Kind already")
        self.refuses(ENUM.replace("BLUE", "RED"), "'RED' is an enumerator of Kind already")

    def test_empty_types_and_arrays_are_refused(self):
        self.refuses("/// Text.\nstruct Nothing {\n};", "needs a field of its own")
        self.refuses("/// Text.\nenum Nothing {\n};", "has no enumerators")
        self.refuses(self.field("double x[0];  ///< [m]"), "expected the number of elements, at least 1")
        self.refuses(self.field("double x[100001];  ///< [m]"), "an array has at most 100,000 elements", "write sequence<T>")

    def test_only_a_struct_is_inherited(self):
        self.refuses(ENUM + "/// More.\nstruct More : Kind {\n  long x;  ///< text\n};", "'Kind' is no struct")

    def test_broken_syntax_is_named_with_its_line(self):
        self.refuses(self.field("long n  ///< how many"), "found '///< how many', expected ';'")
        self.refuses("/// A choice.\nenum Kind {\n  RED\n  BLUE\n};", "test.idl:8: found 'BLUE', expected ',' or '}'")
        self.refuses_text(idl(STRUCT).replace("#endif", ""), "nothing may follow")
        self.refuses_text(idl(STRUCT)[:90], "the end of the file")
        self.refuses_text(idl(STRUCT).replace("ORCA_TEST_IDL", "TEST"), "must start with its include guard")
        self.refuses(STRUCT + "$", "unexpected character '$'")

    def test_an_include_that_is_missing_or_goes_round_is_named(self):
        with self.assertRaisesRegex(IdlError, "test.idl:4: there is no file 'gone.idl'"):
            load(test=idl(STRUCT, includes='#include "gone.idl"\n'))
        with self.assertRaisesRegex(IdlError, "a.idl -> b.idl -> a.idl"):
            load(a=idl(STRUCT, "a", '#include "b.idl"\n'), b=idl(ENUM, "b", '#include "a.idl"\n'))


class TypeHash(unittest.TestCase):
    def test_it_is_stable(self):
        self.assertEqual(parse(STRUCT).structs[0].layout, "Spot{x:double {m},n:int32}")
        self.assertEqual(f"{hash_of(STRUCT):016x}", "1bb341b65c06df17")

    def test_comments_and_spaces_do_not_change_it(self):
        self.assertEqual(hash_of(STRUCT), hash_of(STRUCT.replace("forward", "to the front").replace("  ", "    ")))

    def test_every_difference_between_fields_changes_it(self):
        changes = {
            "name": ("double x", "double y"),
            "type": ("long n", "long long n"),
            "sign": ("long n", "unsigned long n"),
            "unit": ("[m]", "[rad]"),
            "array": ("double x;", "double x[2];"),
            "sequence": ("double x", "sequence<double> x"),
            "type name": ("Spot", "Place"),
        }
        hashes = {hash_of(STRUCT)}
        for before, after in changes.values():
            hashes.add(hash_of(STRUCT.replace(before, after)))
        self.assertEqual(len(hashes), 1 + len(changes))

    def test_order_additional_and_missing_fields_change_it(self):
        first, second = "  double x;  ///< [m] forward\n", "  long n;    ///< how many\n"
        third = "  boolean b;  ///< whether\n"
        bodies = (first + second, second + first, first, second, first + second + third)
        hashes = {hash_of(f"/// Text.\nstruct Spot {{\n{body}}};") for body in bodies}
        self.assertEqual(len(hashes), len(bodies))

    def test_nested_structs_enumerators_and_inherited_fields_belong_to_it(self):
        outer = "/// Text.\nstruct Outer : Spot {\n  Kind kind;  ///< which\n  Spot spot;  ///< where\n};"
        whole = STRUCT + ENUM + outer
        variants = (whole, whole.replace("RED", "GREEN"), whole.replace("BLUE", "BLUE,\n  WHITE"),
                    whole.replace("long n", "octet n"), whole.replace("Kind", "Sort"))
        self.assertEqual(len({hash_of(v) for v in variants}), len(variants))
        self.assertEqual(
            parse(whole).structs[-1].layout,
            "Outer{x:double {m},n:int32,kind:Kind(RED,BLUE),spot:Spot{x:double {m},n:int32}}")


class Parents(unittest.TestCase):
    ROOT = STRUCT.replace("Spot", "OrcaObject")
    FAMILY = ROOT + ("/// A.\nstruct Goal : OrcaObject {\n  string s;  ///< text\n};"
                     "/// B.\nstruct Door : Goal {\n  long w;  ///< text\n};")

    def test_the_parent_belongs_to_the_layout_of_an_object(self):
        goal, door = parse(self.FAMILY).structs[1:]
        self.assertEqual(goal.layout, "Goal{x:double {m},n:int32,s:string}")
        self.assertEqual(door.layout, "Door:Goal{x:double {m},n:int32,s:string,w:int32}")

    def test_a_part_that_is_no_object_has_no_parent(self):
        more = parse(STRUCT + "/// M.\nstruct More : Spot {\n  long w;  ///< text\n};").structs[1]
        self.assertIsNone(more.parent)
        self.assertEqual(more.layout, "More{x:double {m},n:int32,w:int32}")

    def test_the_table_of_types_names_the_parents(self):
        table = type_table([parse(self.FAMILY)])
        self.assertIn("&type_of_Goal, pool_of_Door);", table)
        self.assertIn("nullptr, pool_of_Goal);", table)


class Travelling(unittest.TestCase):
    ROOT = STRUCT.replace("Spot", "OrcaObject")
    PLACE = "/// A place.\n/// @travels\nstruct Place {\n  double w;  ///< [m] text\n};"
    FAMILY = ROOT + PLACE + ("/// M.\n/// @travels\nstruct More : Place {\n  long h;  ///< text\n};"
                             "/// H.\nstruct Holder : OrcaObject {\n  More more;  ///< text\n};")

    def refuses(self, body: str, expected: str):
        with self.assertRaises(IdlError) as caught:
            parse(body)
        self.assertIn(expected, str(caught.exception))

    def test_a_marked_struct_has_the_header_as_an_object_and_none_as_a_part(self):
        place, more, holder = parse(self.FAMILY).structs[1:]
        self.assertEqual(place.text, "A place.")
        self.assertEqual(place.layout, "Place{w:double {m}}")
        self.assertEqual(place.object_layout, "Place{x:double {m},n:int32,w:double {m}}")
        self.assertEqual(more.object_layout, "More:Place{x:double {m},n:int32,w:double {m},h:int32}")
        self.assertEqual(holder.object_layout, "Holder{x:double {m},n:int32,more:More{w:double {m},h:int32}}")

    def test_it_is_an_object_type_with_its_parent(self):
        table = type_table([parse(self.FAMILY)])
        self.assertIn("make_object_type<ObjectOf<idl::Place>>(", table)
        self.assertIn("&type_of_Place, pool_of_More);", table)

    def test_a_mark_that_makes_no_sense_is_refused(self):
        self.refuses(self.PLACE, "@travels needs OrcaObject")
        self.refuses(self.ROOT + "/// P.\n/// @travels\nstruct P : OrcaObject {\n  long w;  ///< text\n};",
                     "P derives from OrcaObject and travels without @travels")
        self.refuses(self.ROOT + STRUCT + "/// P.\n/// @travels\nstruct P : Spot {\n  long w;  ///< text\n};",
                     "P can travel only if Spot does: mark that with @travels too")
        self.refuses(self.ROOT + "/// P.\n/// @travels\nstruct P {\n  long n;  ///< text\n};",
                     "'n' is a field of OrcaObject, which P gets where it travels")


class TextForm(unittest.TestCase):
    def test_a_name_that_would_be_twice_on_an_element_is_refused(self):
        clash = STRUCT + "/// T.\nstruct Top {\n  Spot spot;  ///< where\n  long n;  ///< text\n};"
        with self.assertRaises(IdlError) as caught:
            parse(clash)
        self.assertIn("'n' would be twice on an element of Top", str(caught.exception))
        parse(clash.replace("  Spot spot;  ///< where\n  long n;  ///< text\n", "  long n;  ///< text\n  Spot spot;  ///< where\n"))


class Output(unittest.TestCase):
    def test_a_file_and_what_it_includes_come_once_and_in_order(self):
        files = load(top=idl("/// T.\nstruct Top {\n  Spot s;  ///< where\n  Kind k;  ///< which\n};", "top",
                             '#include "spot.idl"\n#include "kind.idl"\n'),
                     spot=idl(STRUCT, "spot", '#include "kind.idl"\n'), kind=idl(ENUM, "kind"))
        self.assertEqual([f.name for f in files], ["kind.idl", "spot.idl", "top.idl"])

    def test_reflection_visits_inherited_fields_first(self):
        header = reflection_header(parse(STRUCT + "/// T.\nstruct Top : Spot {\n  string s;  ///< text\n};"))
        top = header[header.index("Reflection<idl::Top>"):]
        self.assertLess(top.index("Reflection<idl::Spot>::fields("), top.index('FieldInfo{"s", ""}, object.s()'))

    def test_only_what_derives_from_orca_object_is_an_object_type(self):
        root = STRUCT.replace("Spot", "OrcaObject")
        table = type_table([parse(root + "/// T.\nstruct Top : OrcaObject {\n  string s;  ///< text\n};"
                                  + "/// P.\nstruct Part {\n  string s;  ///< text\n};")])
        self.assertIn("object_type_of<idl::Top, 0x", table)
        self.assertNotIn("type_of_Part", table)
        self.assertNotIn("object_type_of<idl::OrcaObject,", table)


OWN = """#ifndef light_IDL
#define light_IDL
#include "orca.idl"
module my {
/// Where it is.
struct Lit {
  orca::idl::Spot spot;  ///< where
};
/// What is seen.
struct Light : orca::idl::OrcaObject {
  Lit lit;  ///< what
};
/// A kind of it.
struct Sun : Light {
  long spots;  ///< how many
};
};
#endif
"""
ORCA = STRUCT + "/// Header.\nstruct OrcaObject {\n  long seq;  ///< number\n};\n"


class TypesOfOthers(unittest.TestCase):
    """Files with a module of their own, which may use Orca's."""

    def files(self, *texts: str, also: str = ""):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("orca", "own"):
                (Path(folder) / name).mkdir()
            (Path(folder) / "orca/orca.idl").write_text(idl(ORCA, "orca"))
            paths = [Path(folder) / f"own/light{n or ''}.idl" for n in range(len(texts))]
            for path, text in zip(paths, texts):
                path.write_text(text)
            if also:
                (Path(folder) / "own/also.idl").write_text(also)
            files = own_files(paths, Path(folder) / "orca")
            check_library(files)
            return files

    def refuses(self, text: str, expected: str, *more: str, also: str = ""):
        with self.assertRaises(IdlError) as caught:
            self.files(text, *more, also=also)
        self.assertIn(expected, str(caught.exception))

    def test_a_name_begins_with_the_module_in_texts_and_is_scoped_in_cpp(self):
        file = self.files(OWN)[0]
        self.assertEqual([s.name for s in file.structs], ["my.Lit", "my.Light", "my.Sun"])
        self.assertEqual(file.structs[-1].object_layout, "my.Sun:my.Light{seq:int32,lit:my.Lit{spot:Spot{x:double {m},n:int32}},spots:int32}")
        self.assertIn("struct Reflection<::my::Light>", reflection_header(file))
        self.assertIn("object_type<::my::Light>()", types_header(file))
        self.assertEqual(types_list([file]), "object my.Light What is seen.\nobject my.Sun A kind of it.\n")

    def test_the_library_refers_to_what_it_uses_of_orcas_types(self):
        source = library_source(self.files(OWN))
        self.assertIn("part_layout<idl::OrcaObject, 0x", source)
        self.assertIn("part_layout<idl::Spot, 0x", source)
        self.assertIn("add_object_types(kTypes)", source)

    def test_orcas_types_are_named_with_their_module(self):
        self.refuses(OWN.replace("orca::idl::Spot", "Spot"), "light.idl:7: unknown type 'Spot'; did you mean 'orca::idl::Spot'?")
        self.refuses(OWN.replace("orca::idl::Spot", "orca::idl::Spott"), "did you mean 'orca::idl::Spot'?")

    def test_a_library_has_one_module_of_its_own(self):
        other = OWN.replace("module my", "module your").replace("light_IDL", "light1_IDL")
        self.refuses(OWN, "light1.idl:1: it declares module your, and light.idl module my", other)
        self.refuses(OWN.replace("module my", "module std"), "'std' cannot be a module")
        self.refuses(idl(STRUCT, "light"), "light.idl:1: module orca is for Orca's own types")

    def test_files_must_be_given_and_have_names_of_their_own(self):
        self.refuses(OWN.replace("orca.idl", "none.idl"), "light.idl:3: there is no file 'none.idl' beside this one, or among Orca's")
        extra = OWN.replace("light_IDL", "also_IDL").replace("Li", "Ni").replace("Sun", "Moon")
        self.refuses(OWN.replace("orca.idl", "also.idl"), "also.idl:1: it is included, but not among the FILES", also=extra)

    def test_a_library_without_an_object_type_is_none(self):
        self.refuses(OWN.replace(" : orca::idl::OrcaObject", ""), "no struct derives from orca::idl::OrcaObject")

    def test_letters_that_are_no_ascii_are_named_with_their_line(self):
        self.refuses(OWN.replace("where\n", "w\u00e4re\n"), "light.idl:7: the byte 0xc3 is no ASCII")


class BulkData(unittest.TestCase):
    MARKED = "/// Text.\nstruct Picture {\n  /// @bulk\n  sequence<octet> data;  ///< bytes\n};"
    HOLDER = MARKED + "\n/// Text.\nstruct Album {\n  sequence<Picture> pictures;  ///< text\n};"

    def test_the_mark_changes_the_class_and_not_the_type(self):
        self.assertEqual(hash_of(self.MARKED), hash_of(self.MARKED.replace("  /// @bulk\n", "")))
        self.assertIn("const ::orca::Bulk<std::uint8_t>& data() const", classes_header(parse(self.MARKED)))
        self.assertIn("std::vector<std::uint8_t> m_data{};", classes_header(parse(self.MARKED.replace("  /// @bulk\n", ""))))

    def test_whoever_holds_bulk_data_has_some(self):
        self.assertEqual([s.has_bulk for s in parse(self.HOLDER).structs], [True, True])
        self.assertIn("has_bulk = true", reflection_header(parse(self.HOLDER)))
        self.assertIn("has_bulk = false", reflection_header(parse(STRUCT)))


class Classes(unittest.TestCase):
    def test_numbers_are_returned_by_value_and_all_else_by_reference(self):
        text = classes_header(parse(ENUM + STRUCT + "/// Text.\nstruct Box : Spot {\n  Kind kind;  ///< text\n  string name;  ///< text\n"
                                    "  double side[3];  ///< [m]\n  sequence<Spot> spots;  ///< text\n};"))
        for part in ("enum Kind : std::uint32_t { RED, BLUE };", "class Box : public ::orca::idl::Spot {", "double x() const", "double& x()",
                     "void x(double value)", "::orca::idl::Kind kind() const", "const std::string& name() const", "void name(std::string&& value)",
                     "const std::array<double, 3>& side() const", "std::vector<::orca::idl::Spot>& spots()",
                     "bool operator==(const Box&) const = default;"):
            self.assertIn(part, text)


if __name__ == "__main__":
    unittest.main()
