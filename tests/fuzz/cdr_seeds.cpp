// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for cdr_fuzz into a folder: for each object type the default object, and one whose lists have
// one element each.
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "orca/idl/object.hpp"

namespace {

// Gives every list one element and every text some characters, down to the last struct.
class Filler final : public orca::FieldVisitor {
 public:
  void field(const orca::FieldInfo& /*info*/, const orca::Value& value) override { fill(value); }

 private:
  void fill(const orca::Value& value) {
    if (const auto* const text = std::get_if<std::string*>(&value.of)) **text = "text";
    if (const auto* const inner = std::get_if<orca::StructValue>(&value.of))
      inner->fields(inner->object, *this);
    if (const auto* const list = std::get_if<orca::ListValue>(&value.of)) fill(*list);
  }
  void fill(const orca::ListValue& list) {
    if (list.resize != nullptr) list.resize(list.list, 1);
    for (std::size_t i = 0; i < list.size(list.list); ++i) fill(list.at(list.list, i));
  }
};

void write_seed(const std::string& path, std::size_t index, const orca::ObjectLoan& object) {
  std::vector<std::byte> payload;
  object.type().serialize(object.get(), payload);
  std::ofstream file(path, std::ios::binary);
  file.put(static_cast<char>(index));
  file.write(reinterpret_cast<const char*>(payload.data()), static_cast<std::streamsize>(payload.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: cdr_seeds FOLDER\n";
    return 2;
  }
  const auto types = orca::object_types();
  for (std::size_t i = 0; i < types.size(); ++i) {
    orca::ObjectLoan object = orca::make_object(*types[i]);
    const std::string path = std::string(argv[1]) + "/" + std::string(types[i]->name);
    write_seed(path + ".default", i, object);
    Filler filler;
    types[i]->fields(object.get(), filler);
    write_seed(path + ".filled", i, object);
  }
  return 0;
}
