// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <utility>

#include "orca/text/object_xml.hpp"
#include "orca/xml/document.hpp"
#include "plain.hpp"

namespace orca {
namespace {

// A writer of one struct as an element.
class ElementWriter final : public FieldVisitor {
 public:
  enum class Place { outermost, inside };

  explicit ElementWriter(Place place) : place_(place) {}

  [[nodiscard]] std::string write(std::string_view name, const StructValue& part) {
    part.fields(part.object, *this);
    const std::string start = "<" + std::string(name) + attributes_;
    if (children_.empty()) return start + "/>";
    return start + ">" + children_ + "</" + std::string(name) + ">";
  }

  void field(const FieldInfo& info, const Value& value) override {
    const bool first = !info.header && std::exchange(first_, false);
    const auto* part = std::get_if<StructValue>(&value.of);
    if (first && part != nullptr) {
      first_ = true;
      part->fields(part->object, *this);
    } else if (!is_left_out(info, value)) {
      text::is_attribute(value) ? attribute(info.name, value) : elements(info.name, value);
    }
  }

 private:
  // Only the outermost object carries a time stamp.
  [[nodiscard]] bool is_left_out(const FieldInfo& info, const Value& value) const {
    const bool composed = !text::is_attribute(value) || std::holds_alternative<ListValue>(value.of);
    const bool unstamped = info.header && place_ == Place::inside;
    return (composed || unstamped) && text::is_default(value);
  }

  void attribute(std::string_view name, const Value& value) {
    attributes_ += " " + std::string(name) + "=\"" + xml::escaped(text::plain_text(value)) + "\"";
  }

  void elements(std::string_view name, const Value& value) {
    const auto* list = std::get_if<ListValue>(&value.of);
    if (list == nullptr) return element(name, std::get<StructValue>(value.of));
    for (std::size_t i = 0; i < list->size(list->list); ++i) {
      element(name, text::as_struct(list->at(list->list, i)));
    }
  }

  void element(std::string_view name, const StructValue& part) {
    children_ += ElementWriter(Place::inside).write(name, part);
  }

  Place place_;
  bool first_ = true;
  std::string attributes_;
  std::string children_;
};

}  // namespace

std::string to_xml(const ObjectType& type, const void* object) {
  // Values are seen through references that could change them, but the writer does not change them.
  const StructValue whole{.type = type.name, .object = const_cast<void*>(object), .fields = type.fields};
  return ElementWriter(ElementWriter::Place::outermost).write(type.name, whole);
}

std::string to_xml(const ObjectRef& object) { return to_xml(object.type(), object.get()); }

}  // namespace orca
