// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for cdr_fuzz into a folder: for each object type the default object, and one whose lists have
// one element each.
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "filled_object.hpp"

namespace {

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
    const std::string path = std::string(argv[1]) + "/" + std::string(types[i]->name);
    write_seed(path + ".default", i, orca::make_object(*types[i]));
    write_seed(path + ".filled", i, orca::test::filled_object(*types[i]));
  }
  return 0;
}
