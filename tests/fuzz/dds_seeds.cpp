// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for dds_fuzz into a folder: for each port what an honest peer says, with some time and a stranger in between.
#include <cstddef>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "dds/backend/message.hpp"
#include "frames/frame.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"

namespace {

using namespace orca;
using namespace orca::frames;
using Bytes = std::vector<std::byte>;

constexpr unsigned kPorts = 6;

void add(std::ofstream& file, int piece, const Bytes& bytes) {
  file.put(static_cast<char>(piece)).put(static_cast<char>(bytes.size()));
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Bytes numbers(const std::vector<std::uint64_t>& all) {
  Bytes bytes;
  for (const std::uint64_t number : all) dds::append(bytes, number);
  return bytes;
}

void add_frame(std::ofstream& file, FrameKind kind, const std::vector<std::uint64_t>& with,
               const ObjectRef& object = {}) {
  constexpr int kFrame = 1;
  Frame frame(kind, 1);
  for (const std::uint64_t number : with) frame.add(number);
  if (object) frame.add(object);
  Bytes bytes;
  frame.append_to(bytes);
  add(file, kFrame, bytes);
}

void write_seed(const std::string& path, unsigned port) {
  constexpr int kParcel = 0, kMessage = 2, kStranger = 3, kObject = 4, kTime = 5, kAnotherPeer = 6, kRate = 7;
  std::ofstream file(path, std::ios::binary);
  file.put(static_cast<char>(port));
  const ObjectRef command(full_stop().seal());
  const ObjectRef ask(make_object<idl::Ask>().seal());
  Bytes encoded = numbers({0, 0, 1, 1, 0});
  command.type().serialize(command.get(), encoded);
  for (int session = 0; session < 2; ++session) {
    add(file, kRate, numbers({5}));
    add_frame(file, FrameKind::attach, {1'000'000, 2});
    add_frame(file, FrameKind::granted, {1'000'000, 1, 1'000'000});
    add_frame(file, FrameKind::object, {3}, command);
    add_frame(file, FrameKind::taken, {1});
    add_frame(file, FrameKind::offer, {1}, port == 4 ? ask : command);
    add_frame(file, FrameKind::withdraw, {});
    add_frame(file, FrameKind::answer, {3, 0});
    add(file, kParcel, numbers({3}));
    add(file, kParcel, numbers({4, 1, 1, 1}));
    add(file, kObject, encoded);
    add(file, kMessage, numbers({0, 2, 1, 7, 1, 1}));
    add(file, kStranger, dds::encode({9, 5, 1, 1, 0, {}}));
    add(file, kTime, numbers({20}));
    add(file, kAnotherPeer, {});
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: dds_seeds FOLDER\n";
    return 2;
  }
  for (unsigned port = 0; port < kPorts; ++port)
    write_seed(std::string(argv[1]) + "/" + std::to_string(port), port);
  return 0;
}
