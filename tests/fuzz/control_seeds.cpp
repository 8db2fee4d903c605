// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for control_fuzz into a folder: one message of each kind, without descriptors.
#include <fstream>
#include <iostream>
#include <string>
#include <utility>

#include "channel/packets.hpp"
#include "channel/samples.hpp"

namespace {

using namespace orca::supervisor;

void write_seed(const std::string& path, Message message) {
  message.descriptors.clear();
  std::ofstream file(path, std::ios::binary);
  const auto packets = split(std::move(message));
  for (const Packet& packet : *packets) {
    const std::size_t length = packet.bytes.size();
    file.put(static_cast<char>(length & 0xFF)).put(static_cast<char>(length >> 8));
    file.write(reinterpret_cast<const char*>(packet.bytes.data()), static_cast<std::streamsize>(length));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: control_seeds FOLDER\n";
    return 2;
  }
  int number = 0;
  const auto next_path = [&] { return std::string(argv[1]) + "/message" + std::to_string(++number); };
  for (auto& order : orca::test::all_orders()) write_seed(next_path(), encode(std::move(order)));
  for (auto& report : orca::test::all_reports()) write_seed(next_path(), encode(std::move(report)));
  for (auto& answer : orca::test::all_answers()) write_seed(next_path(), encode(std::move(answer), 1));
  for (auto& word : orca::test::all_line_words()) write_seed(next_path(), encode(std::move(word)));
  write_seed(next_path(), encode(Ask{"set", {"avoid.margin", "0.3 m"}, true}, 1));
  return 0;
}
