// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/text/object_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "number.hpp"
#include "orca/idl/time.hpp"
#include "plain.hpp"

namespace orca {
namespace {

constexpr std::string_view kStamp = "stamp", kPort = "port";

// A walk over all values in an object that are neither structs nor lists, each with the name of its column.
class Walk final : public FieldVisitor {
 public:
  /// Takes a value.
  using Leaf = std::function<void(const std::string& name, const Value& value)>;
  /// Returns how many elements of a sequence have columns of their own. It may change the sequence.
  using Width = std::function<std::size_t(const std::string& name, const ListValue& list)>;

  /// @param has_stamp  whether the object's own stamp is among the values; in a table it is the first column.
  Walk(Width width, Leaf leaf, bool has_stamp = false)
      : width_(std::move(width)), leaf_(std::move(leaf)), has_stamp_(has_stamp) {}

  void walk(const ObjectType& type, void* object) { type.fields(object, *this); }

  // As in the text form, the struct that comes first in another one has no name of its own.
  void field(const FieldInfo& info, const Value& value) override {
    const auto* const part = std::get_if<StructValue>(&value.of);
    if (std::exchange(first_, false) && part != nullptr) return fields_of(*part);
    if (!has_stamp_ && name_.empty() && info.name == kStamp) return;
    const std::size_t length = name_.size();
    if (length > 0) name_ += '.';
    name_ += info.name;
    if (length == 0 && info.name == kPort) name_ += '_';
    take(value);
    name_.resize(length);
  }

 private:
  void fields_of(const StructValue& part) {
    first_ = true;
    part.fields(part.object, *this);
    first_ = false;
  }

  void take(const Value& value) {
    if (const auto* const part = std::get_if<StructValue>(&value.of)) return fields_of(*part);
    if (const auto* const list = std::get_if<ListValue>(&value.of)) return elements_of(*list);
    leaf_(name_, value);
  }

  void elements_of(const ListValue& list) {
    const bool fixed = list.resize == nullptr;
    const std::size_t width = fixed ? std::numeric_limits<std::size_t>::max() : width_(name_, list);
    const std::size_t length = name_.size();
    const std::size_t count = list.size(list.list);
    for (std::size_t i = 0; i < count; ++i) {
      name_ += i < width ? "[" + std::to_string(i) + "]" : "[rest]";
      take(list.at(list.list, i));
      name_.resize(length);
    }
  }

  const Width width_;
  const Leaf leaf_;
  const bool has_stamp_;
  std::string name_;
  bool first_ = true;
};

// Returns a visitable object. The walks over sealed objects change nothing.
void* unsealed(const ObjectRef& object) { return const_cast<void*>(object.get()); }

// Returns seconds since `zero`, exact to the nanosecond; empty for an instant that was never set.
std::string seconds_text(std::int64_t ns, TimePoint zero) {
  const std::int64_t zero_ns = zero.time_since_epoch().count();
  if (ns == 0 && zero_ns != 0) return {};
  // A component may set any instant; beyond the limits the difference wraps.
  const std::uint64_t difference = static_cast<std::uint64_t>(ns) - static_cast<std::uint64_t>(zero_ns);
  return text::instant_text(static_cast<std::int64_t>(difference));
}

// The text form leaves line breaks as they are; in a table they would end a row for simple readers.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\n' ? "\\x0a" : c == '\r' ? "\\x0d" : std::string(1, c);
  return line;
}

std::string cell_text(const Value& value, TimePoint zero) {
  if (const auto* const* instant = std::get_if<idl::TimeValue*>(&value.of))
    return seconds_text((*instant)->ns(), zero);
  // Programs that read tables know one NaN only.
  if (const auto* const* number = std::get_if<double*>(&value.of); number != nullptr && std::isnan(**number))
    return "nan";
  const std::string text = text::plain_text(value);
  return std::holds_alternative<std::string*>(value.of) ? on_one_line(text) : text;
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text.append(c == '"' ? 2 : 1, c);
  return text + "\"";
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    line += quoted(cell);
  }
  return line + "\n";
}

}  // namespace

void ObjectTable::add_type(const ObjectType& type) {
  for (const ObjectType* const each : object_types())
    if (is_a(*each, type) && std::ranges::find(types_, each) == types_.end()) types_.push_back(each);
}

void ObjectTable::make_room(const ObjectRef& object) {
  const auto widen = [this](const std::string& name, const ListValue& list) {
    std::size_t& width = widths_[name];
    return width = std::max(width, std::min(list.size(list.list), kMostElements));
  };
  Walk(widen, [](const std::string&, const Value&) {}).walk(object.type(), unsealed(object));
}

std::string ObjectTable::header() {
  add_column(std::string(kStamp));
  add_column(std::string(kPort));
  // Each sequence gets one element more than it has columns, which stands for the rest.
  const auto resize = [this](const std::string& name, const ListValue& list) {
    const std::size_t width = widths_[name];
    list.resize(list.list, width + 1);
    return width;
  };
  Walk walk(resize, [this](const std::string& name, const Value&) { add_column(name); });
  for (const ObjectType* const type : types_) walk.walk(*type, make_object(*type).get());
  return line_of(columns_);
}

void ObjectTable::add_column(const std::string& name) {
  if (column_of_.emplace(name, columns_.size()).second) columns_.push_back(name);
}

std::string ObjectTable::row(std::string_view port, const ObjectRef& object) {
  cells_.assign(columns_.size(), "");
  cells_[0] = seconds_text(object.stamp().time_since_epoch().count(), zero_);
  cells_[1] = port;
  const auto width = [this](const std::string& name, const ListValue&) {
    const auto found = widths_.find(name);
    return found == widths_.end() ? 0 : found->second;
  };
  const auto fill = [this](const std::string& name, const Value& value) {
    const auto column = column_of_.find(name);
    if (column == column_of_.end()) return;
    std::string& cell = cells_[column->second];
    if (!cell.empty()) cell += ' ';  // the rest of a sequence
    cell += cell_text(value, zero_);
  };
  Walk(width, fill).walk(object.type(), unsealed(object));
  return line_of(cells_);
}

namespace {

// Walks over an object and changes nothing in it. All elements of its lists have names.
void look_at(const ObjectType& type, const void* object, std::set<std::string>& lists, Walk::Leaf leaf) {
  const auto width = [&](const std::string& name, const ListValue& /*list*/) {
    lists.insert(name);
    return std::numeric_limits<std::size_t>::max();
  };
  Walk(width, std::move(leaf), true).walk(type, const_cast<void*>(object));
}

bool is_within(std::string_view name, std::string_view field) {
  return name.starts_with(field) &&
         (name.size() == field.size() || name[field.size()] == '.' || name[field.size()] == '[');
}

}  // namespace

std::optional<std::vector<FieldText>> field_texts(const ObjectType& type, const void* object,
                                                  std::string_view field) {
  std::set<std::string> lists;
  std::vector<FieldText> texts;
  look_at(type, object, lists, [&](const std::string& name, const Value& value) {
    if (is_within(name, field)) texts.push_back({name, cell_text(value, TimePoint{})});
  });
  if (texts.empty() && !lists.contains(std::string(field))) return std::nullopt;
  return texts;
}

std::vector<std::string> field_names(const ObjectType& type, const void* object) {
  std::set<std::string> lists;
  std::vector<std::string> names;
  look_at(type, object, lists, [&](const std::string& name, const Value&) { names.push_back(name); });
  names.insert(names.end(), lists.begin(), lists.end());
  return names;
}

std::vector<std::string> field_words(const ObjectType& type, const void* object, std::string_view field) {
  std::set<std::string> lists;
  std::vector<std::string> words;
  look_at(type, object, lists, [&](const std::string& name, const Value& value) {
    if (name != field) return;
    if (const auto* const choice = std::get_if<EnumValue>(&value.of))
      words.assign(choice->names.begin(), choice->names.end());
    if (std::holds_alternative<bool*>(value.of)) words = {"true", "false"};
  });
  return words;
}

}  // namespace orca
