// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for mcap_fuzz into a folder: a recording, whole and cut off.
#include <fstream>
#include <iostream>
#include <string>

#include "memory_output.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: mcap_seeds FOLDER\n";
    return 2;
  }
  orca::test::Memory memory;
  {
    orca::recording::Writer writer(orca::test::to(memory), "ros2", "orca");
    (void)writer.note({"orca.run", {{"seed", "1"}}});
    (void)writer.attach({1, 2, "graph.xml", "text/xml", {}});
    orca::test::write_numbers(writer, 60);
  }
  for (const std::size_t size : {memory.bytes.size(), memory.bytes.size() / 2})
    std::ofstream(std::string(argv[1]) + "/recording" + std::to_string(size), std::ios::binary)
        .write(reinterpret_cast<const char*>(memory.bytes.data()), static_cast<std::streamsize>(size));
  return 0;
}
