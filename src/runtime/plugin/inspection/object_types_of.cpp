// SPDX-License-Identifier: LGPL-3.0-or-later
#include "object_types_of.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include "orca/base/hash.hpp"
#include "orca/base/layout.hpp"
#include "orca/idl/object_library.hpp"
#include "orca/idl/object_type.hpp"
#include "plugin_layouts.hpp"

namespace orca::plugin {
namespace {

// A type that a symbol refers to, and the hash of the layout that the symbol's user was built with.
struct Reference {
  std::string name;
  std::uint64_t hash = 0;
};

// A reader of the beginning of a mangled name.
class Mangled {
 public:
  explicit Mangled(std::string_view symbol) : left_(symbol) {}

  bool take(std::string_view text) {
    if (!left_.starts_with(text)) return false;
    left_.remove_prefix(text.size());
    return true;
  }

  /// Reads "5Point"; empty if there is no such thing.
  std::string_view word() {
    const auto length = number();
    if (!length || *length > left_.size()) return {};
    const std::string_view text = left_.substr(0, *length);
    left_.remove_prefix(*length);
    return text;
  }

  std::optional<std::uint64_t> number() {
    std::uint64_t value = 0;
    const auto read = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    if (read.ec != std::errc()) return std::nullopt;
    left_.remove_prefix(static_cast<std::size_t>(read.ptr - left_.data()));
    return value;
  }

 private:
  std::string_view left_;
};

// Returns what orca::detail::FUNCTION<TYPE, HASH>() refers to; `function` is its name as it is mangled. TYPE is orca::idl::NAME or
// MODULE::NAME.
std::optional<Reference> reference_to(std::string_view symbol, std::string_view function) {
  Mangled rest(symbol);
  if (!rest.take("_ZN4orca6detail") || !rest.take(function) || !rest.take("IN")) return std::nullopt;
  Reference found;
  if (!rest.take("S_3idl")) {
    found.name = rest.word();
    if (found.name.empty()) return std::nullopt;
    found.name += '.';
  }
  const std::string_view word = rest.word();
  if (word.empty() || !rest.take("ELm")) return std::nullopt;
  found.name += word;
  const auto hash = rest.number();
  if (!hash) return std::nullopt;
  found.hash = *hash;
  return found;
}

std::string_view layout_of(const ElfFile& library, const std::string& type) {
  for (const std::string_view layout : layouts_in(library))
    if (name_in(layout) == type) return layout;
  return {};
}

std::string unknown(const std::string& name) {
  if (name.find('.') == std::string::npos)
    return "uses the object type " + name + ", which this Orca does not have; build it again with this Orca";
  return "uses the object type " + name +
         ", whose library is not loaded: it must lie beside the plugin, as orca_generate_idl() puts it, or "
         "in "
         "a plugin folder";
}

std::string changed(const ElfFile& library, const TypeId& here) {
  const std::string_view there = layout_of(library, here.name);
  const bool is_own = here.name.find('.') == std::string::npos;
  const std::string difference =
      there.empty() || there == here.layout
          ? ""
          : ": " + layout_difference(there, here.layout,
                                     {"in the plugin", is_own ? "in this Orca" : "in the library"});
  return "was built for another layout of the object type " + here.name + difference +
         (is_own ? "; build it again with this Orca"
                 : "; build it again with the library of that type, and start the system again if it has the "
                   "former one in memory");
}

std::vector<std::string> part_faults(const ElfFile& library) {
  std::vector<std::string> faults;
  for (const ElfSymbol& symbol : library.symbols()) {
    const auto used = symbol.defined ? std::nullopt : reference_to(symbol.name, "11part_layout");
    if (!used) continue;
    const std::string_view here = detail::part_layout(used->name);
    Fnv1a hash;
    hash.add_text(here);
    if (here.empty())
      faults.push_back("has types with " + used->name +
                       " of Orca in them, which this Orca does not have; build it again with this Orca");
    else if (hash.value() != used->hash)
      faults.push_back("was built for another layout of " + used->name +
                       ", which its types extend or hold; build it again with this Orca");
  }
  return faults;
}

}  // namespace

TypeId known_type(const std::string& name) {
  const ObjectType* const type = find_object_type(name);
  return type != nullptr ? type_id(*type) : TypeId{};
}

std::string_view name_in(std::string_view layout) { return layout.substr(0, layout.find_first_of(":{")); }

std::vector<std::string_view> layouts_in(const ElfFile& library) {
  std::vector<std::string_view> found;
  const auto section = library.section("orca_layouts");
  if (!section) return found;
  std::string_view layouts(reinterpret_cast<const char*>(section->data()), section->size());
  while (!layouts.empty()) {
    const std::string_view one = layouts.substr(0, layouts.find('\0'));
    if (!one.empty()) found.push_back(one);
    layouts.remove_prefix(std::min(layouts.size(), one.size() + 1));
  }
  return found;
}

std::vector<std::string> type_faults(const ElfFile& library, const KnownType& known) {
  std::vector<std::string> faults;
  for (const ElfSymbol& symbol : library.symbols()) {
    const auto used = symbol.defined ? std::nullopt : reference_to(symbol.name, "14object_type_of");
    if (!used) continue;
    const TypeId here = known(used->name);
    if (here.name.empty())
      faults.push_back(unknown(used->name));
    else if (here.hash != used->hash)
      faults.push_back(changed(library, here));
  }
  return faults;
}

std::vector<std::string> object_library_faults(const ElfFile& library, const KnownType& known) {
  const auto is_mark = [](const ElfSymbol& one) { return one.defined && one.name == kObjectLibrary; };
  if (std::ranges::none_of(library.symbols(), is_mark) || layouts_in(library).empty())
    return {"is no library of object types: it exports no " + std::string(kObjectLibrary) +
            "; build it with orca_generate_idl()"};
  const auto section = library.section("orca_plugin_layouts");
  const std::string_view theirs =
      section ? std::string_view(reinterpret_cast<const char*>(section->data()), section->size()) : "";
  std::vector<std::string> faults;
  if (std::optional<std::string> fault = layout_fault(theirs, std::nullopt, our_layouts()))
    faults.push_back(*std::move(fault));
  for (std::string& fault : part_faults(library)) faults.push_back(std::move(fault));
  for (std::string& fault : type_faults(library, known)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace orca::plugin
