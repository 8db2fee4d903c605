// SPDX-License-Identifier: GPL-3.0-or-later
// Anybody in the network may say anything in the name of another machine, or as a system of a team: it is ignored or believed, and
// what this machine says then can be read by others. The input is a sequence of states: what becomes of it (1 byte), how long
// nothing comes before it (1 byte), its length (2 bytes), and its CDR with the encapsulation.
#include <fastdds/rtps/common/SerializedPayload.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "bulletin/state_type.hpp"
#include "machines/clocks.hpp"
#include "machines/gathering.hpp"
#include "machines/motors_accord.hpp"
#include "machines/team_directory.hpp"
#include "machines_in_a_network.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/idl/object_type.hpp"

namespace {

using namespace orca;
using namespace orca::supervisor;
using Input = std::span<const std::uint8_t>;

constexpr std::uint64_t kRun = 7;

// What the first byte of a state asks for.
constexpr unsigned kOfTeam = 1;
constexpr unsigned kSameGraph = 2;   // else it says which
constexpr unsigned kHasHeardUs = 4;  // the first of what it has heard is this run
constexpr unsigned kAnswers = 8;     // the numbers and instants are plausible

void check(bool holds) {
  if (!holds) std::abort();
}

template <class State>
std::vector<std::byte> payload_of(const State& state) {
  std::vector<std::byte> bytes;
  object_type<State>().serialize(&state, bytes);
  return bytes;
}

// Returns what the type of the topic makes of a payload.
std::optional<StateType::Sample> sample_in(Input bytes) {
  static StateType type("a state");
  eprosima::fastrtps::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  if (!bytes.empty()) std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.length = static_cast<std::uint32_t>(bytes.size());
  StateType::Sample sample;
  if (!type.deserialize(&payload, &sample)) return std::nullopt;
  return sample;
}

// One machine of three, and one system of a team.
class Here {
 public:
  void wait(unsigned steps) { now_ += steps * 20ms; }

  void hear(unsigned flags, const StateType::Sample& sample) {
    (flags & kOfTeam) != 0 ? hear_team(sample) : hear_machine(flags, sample);
  }

  void look() {
    gathering_.look(to_steady(now_));
    directory_.look(to_steady(now_));
    (void)gathering_.take_news();
    (void)clocks_.take_news();
    (void)directory_.take_news();
    (void)gathering_.standings();
    (void)motors_.words();
    (void)motors_.take_order();
    say();
  }

 private:
  void hear_team(const StateType::Sample& sample) {
    idl::TeamState state;
    if (!object_type<idl::TeamState>().deserialize(sample, &state).ok()) return;
    directory_.hear(state, to_steady(now_));
    check(directory_.members().size() <= TeamDirectory::kMostMembers);
  }

  void hear_machine(unsigned flags, const StateType::Sample& sample) {
    idl::MachineState state;
    if (!object_type<idl::MachineState>().deserialize(sample, &state).ok()) return;
    if ((flags & kSameGraph) != 0) state.graph(gathering_.state().graph());
    if ((flags & kAnswers) != 0) answer(state);
    if ((flags & kHasHeardUs) != 0 && !state.heard().empty()) {
      state.heard().front().machine("base");
      state.heard().front().run(kRun);
    }
    if (!gathering_.hear(state, to_steady(now_))) return;
    motors_.hear(state, gathering_.state().phase() == idl::MACHINE_GATHERING);
    clocks_.hear(state, now_);
    const auto offset = clocks_.offset(state.origin(), now_);
    check(!offset || (offset->error >= Duration{0} && offset->round_trip >= Duration{0}));
    (void)clocks_.correction(state.origin());
  }

  // Makes a state one that comes next, and instants those of a clock that is some seconds off.
  void answer(idl::MachineState& state) {
    constexpr std::int64_t kAround = 10'000'000'000;
    state.seq(++seq_);
    state.creation_time().ns(now_.time_since_epoch().count() + state.creation_time().ns() % kAround);
    for (idl::MachineRun& heard : state.heard()) {
      heard.said().ns(now_.time_since_epoch().count() - std::abs(heard.said().ns() % kAround));
      heard.waited(std::abs(heard.waited() % kAround));
    }
  }

  void say() {
    idl::MachineState state = gathering_.state();
    motors_.fill(state);
    clocks_.fill(state, now_);
    idl::MachineState again;
    check(object_type<idl::MachineState>().deserialize(payload_of(state), &again).ok());
    idl::TeamState team;
    check(object_type<idl::TeamState>().deserialize(payload_of(directory_.state()), &team).ok());
  }

  // Copied, since the hash of a graph takes long.
  static const Gathering& begun() {
    static const Gathering gathering(test::chain(graph::OnLoss::go_on), "base", kRun);
    return gathering;
  }
  static graph::Team team() {
    graph::Team team;
    team.name = "lab";
    team.ports = {{"pose", "Teammate", 7, true}, {"map", "OccupancyGrid", 8, false}};
    return team;
  }

  TimePoint now_{100s};
  std::uint64_t seq_ = 0;
  Gathering gathering_{begun()};
  Clocks clocks_{"base", kRun};
  MotorsAccord motors_{"base", {"brain", "eye"}};
  TeamDirectory directory_{team(), "anna", kRun};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHead = 4;
  Input rest(data, size);
  Here here;
  while (rest.size() >= kHead) {
    const std::size_t length = std::min<std::size_t>(rest.size() - kHead, rest[2] + 256U * rest[3]);
    here.wait(rest[1]);
    if (const auto sample = sample_in(rest.subspan(kHead, length))) here.hear(rest[0], *sample);
    here.look();
    rest = rest.subspan(kHead + length);
  }
  return 0;
}
