// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "orca/text/object_xml.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "plain.hpp"

namespace orca {
namespace {

namespace codes = text::codes;
using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// A reader that fills one struct from an element, and reports what the element has and the struct has not.
class ElementReader final : public FieldVisitor {
 public:
  ElementReader(const xml::Element& element, xml::Diagnostics& diagnostics)
      : element_(element), diagnostics_(diagnostics) {}

  void read(const StructValue& part) {
    part.fields(part.object, *this);
    for (const xml::Attribute& attribute : element_.attributes()) judge(attribute);
    for (const xml::Element& child : element_.children()) judge(child);
    if (xml::trimmed(element_.text()).empty()) return;
    report(codes::kStrayText, element_.text_position(),
           "text between tags is not read; a value is written as an attribute, name=\"value\"");
  }

  void field(const FieldInfo& info, const Value& value) override {
    const bool first = !info.header && std::exchange(first_, false);
    const auto* part = std::get_if<StructValue>(&value.of);
    if (first && part != nullptr) {
      first_ = true;
      inlined_.emplace_back(info.name);
      part->fields(part->object, *this);
    } else if (text::is_attribute(value)) {
      attributes_.emplace_back(info.name);
      read_attribute(info, value);
    } else {
      elements_.emplace_back(info.name);
      read_elements(info, value);
    }
  }

 private:
  void report(const char* code, const xml::Position& position, const std::string& message) {
    diagnostics_.error(code, position, "<" + element_.name() + ">: " + message);
  }

  void read_attribute(const FieldInfo& info, const Value& value) {
    const xml::Attribute* attribute = element_.attribute(info.name);
    if (attribute == nullptr || !attribute->intact) return;
    const text::Verdict wrong = text::read_plain(attribute->value, info.unit, value);
    if (wrong) report(wrong->code, attribute->value_position, std::string(info.name) + ": " + wrong->message);
  }

  [[nodiscard]] std::vector<const xml::Element*> children_named(std::string_view name) const {
    std::vector<const xml::Element*> found;
    for (const xml::Element& child : element_.children())
      if (child.name() == name) found.push_back(&child);
    return found;
  }

  void read_elements(const FieldInfo& info, const Value& value) {
    const std::vector<const xml::Element*> children = children_named(info.name);
    const auto* list = std::get_if<ListValue>(&value.of);
    if (list != nullptr && list->resize != nullptr) list->resize(list->list, children.size());
    const std::size_t places = list == nullptr ? 1 : list->size(list->list);
    for (std::size_t i = 0; i < std::min(children.size(), places); ++i) {
      const Value place = list == nullptr ? value : list->at(list->list, i);
      ElementReader(*children[i], diagnostics_).read(text::as_struct(place));
    }
    check_count(info.name, children, places);
  }

  void check_count(std::string_view name, const std::vector<const xml::Element*>& children,
                   std::size_t places) {
    if (children.empty() || children.size() == places) return;
    const xml::Element& culprit = *children[std::min(places, children.size() - 1)];
    report(codes::kCount, culprit.position(),
           "<" + std::string(name) + "> is written " + std::to_string(places) +
               (places == 1 ? " time" : " times") + " or not at all, found " +
               std::to_string(children.size()));
  }

  void judge(const xml::Attribute& attribute) {
    if (contains(attributes_, attribute.name)) return;
    if (contains(elements_, attribute.name)) {
      return report(codes::kWrongForm, attribute.position,
                    in_quotes(attribute.name) + " has parts: write it as an element inside, <" +
                        attribute.name + " .../>");
    }
    unknown(attribute.name, attribute.position);
  }

  void judge(const xml::Element& child) {
    if (contains(elements_, child.name())) return;
    if (contains(attributes_, child.name())) {
      return report(
          codes::kWrongForm, child.position(),
          in_quotes(child.name()) + " is one value: write it as an attribute, " + child.name() + "=\"...\"");
    }
    if (contains(inlined_, child.name())) {
      return report(
          codes::kWrongForm, child.position(),
          "what belongs to " + in_quotes(child.name()) + " is written on <" + element_.name() + "> itself");
    }
    unknown(child.name(), child.position());
  }

  void unknown(const std::string& name, const xml::Position& position) {
    // The error would not be shown, and hints take time.
    if (diagnostics_.error_count() > xml::Diagnostics::kKept) return;
    Names all = attributes_;
    all.insert(all.end(), elements_.begin(), elements_.end());
    report(codes::kUnknownField, position,
           "there is no " + in_quotes(name) + "; there are: " + listed(all) +
               xml::did_you_mean(xml::nearest_name(name, all)));
  }

  const xml::Element& element_;
  xml::Diagnostics& diagnostics_;
  bool first_ = true;
  Names attributes_;
  Names elements_;
  Names inlined_;
};

Names all_type_names() {
  Names names;
  for (const ObjectType* type : object_types()) names.emplace_back(type->name);
  return names;
}

// Returns the type that the root element names, or null with an error if it may not stand here.
const ObjectType* type_of(const xml::Element& root, const ObjectType* expected,
                          xml::Diagnostics& diagnostics) {
  const ObjectType* found = find_object_type(root.name());
  if (found != nullptr && (expected == nullptr || is_a(*found, *expected))) return found;
  std::string message = "<" + root.name() + ">: ";
  if (expected != nullptr) {
    message += "a <" + std::string(expected->name) + "> is expected here";
  } else {
    const Names names = all_type_names();
    message += "there is no such object type; there are: " + listed(names) +
               xml::did_you_mean(xml::nearest_name(root.name(), names));
  }
  diagnostics.error(codes::kWrongType, root.position(), message);
  return nullptr;
}

}  // namespace

std::optional<ObjectLoan> from_xml(std::string_view text, const std::string& file_name,
                                   xml::Diagnostics& diagnostics, const ObjectType* expected) {
  const std::size_t errors_before = diagnostics.error_count();
  const std::optional<xml::Document> document = xml::read_text(text, file_name, diagnostics);
  if (!document) return std::nullopt;
  const ObjectType* type = type_of(document->root, expected, diagnostics);
  if (type == nullptr) return std::nullopt;
  ObjectLoan object = make_object(*type);
  ElementReader(document->root, diagnostics).read({type->name, object.get(), type->fields});
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return object;
}

}  // namespace orca
