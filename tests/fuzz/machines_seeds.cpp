// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for machines_fuzz into a folder: what other machines and systems of a team say from the start to the end.
#include <cstddef>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "machines/gathering.hpp"
#include "machines_in_a_network.hpp"
#include "orca/idl/machines.hpp"
#include "orca/idl/object_type.hpp"

namespace {

using namespace orca;

constexpr int kMachine = 14;  // the flags of machines_fuzz
constexpr int kTeam = 1;

template <class State>
void add(std::ofstream& file, int flags, int steps, const State& state) {
  std::vector<std::byte> bytes;
  object_type<State>().serialize(&state, bytes);
  const std::size_t length = bytes.size() + 4;
  file.put(static_cast<char>(flags)).put(static_cast<char>(steps));
  file.put(static_cast<char>(length % 256)).put(static_cast<char>(length / 256));
  file.write("\0\1\0\0", 4);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

idl::MachineState state_of(const std::string& machine, idl::MachinePhase phase) {
  idl::MachineState state;
  state.origin(machine);
  state.run(5);
  state.phase(phase);
  state.configured(2);
  state.heard().resize(2);
  state.heard()[0].said().ns(1'000'000);
  state.heard()[0].waited(500'000);
  state.heard()[1].machine("eye");
  if (phase == idl::MACHINE_ENDED) {
    state.end(idl::MACHINE_FAILED);
    state.why("its base has failed");
  }
  return state;
}

void write_machines(const std::string& path, bool holds) {
  std::ofstream file(path, std::ios::binary);
  for (const idl::MachinePhase phase : {idl::MACHINE_GATHERING, idl::MACHINE_BUILDING, idl::MACHINE_READY,
                                        idl::MACHINE_WORKING, idl::MACHINE_ENDED})
    for (const char* const machine : {"brain", "eye"}) {
      idl::MachineState state = state_of(machine, phase);
      state.motors_order(holds ? 3 : 0);
      state.motors_held(holds);
      add(file, kMachine, 10, state);
    }
}

void write_team(const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  for (const std::string name : {"bert", "anna", "carl"})
    for (const bool leaves : {false, true}) {
      idl::TeamState state;
      state.origin(name);
      state.run(leaves ? 5 : 6);
      state.leaves(leaves);
      state.offers().resize(1);
      state.offers()[0].name("pose");
      state.offers()[0].type("Teammate");
      state.offers()[0].hash(leaves ? 7 : 9);
      add(file, kTeam, 30, state);
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: machines_seeds FOLDER\n";
    return 2;
  }
  const std::string folder = argv[1];
  write_machines(folder + "/run", false);
  write_machines(folder + "/stop", true);
  write_team(folder + "/team");
  return 0;
}
