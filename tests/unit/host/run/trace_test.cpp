// SPDX-License-Identifier: GPL-3.0-or-later
// The trace hash as DESIGN 4 defines it, computed here a second time, and the lines of a trace file.
#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "run/recording/trace.hpp"
#include "run/recording/trace_hash.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

namespace {

ObjectRef command_of_goto(double direction, std::uint64_t seq) {
  auto made = head(direction, 0.3);
  made->seq(seq);
  made->origin() = "goto";
  return ObjectLoan(std::move(made)).seal();
}

// Hashes a delivery as the definition says: time in ns, component, port, seq, hash of the XCDR1 payload.
void add(TraceHash& hash, Duration time, std::string_view component, std::string_view port,
         const ObjectRef& object) {
  std::vector<std::byte> payload;
  object.type().serialize(object.get(), payload);
  hash.add_u64(static_cast<std::uint64_t>(time.count()));
  hash.add_text(component);
  hash.add_text(port);
  hash.add_u64(object.header().seq());
  TraceHash of_payload;
  of_payload.add(payload);
  hash.add_u64(of_payload.value());
}

}  // namespace

TEST_CASE("the trace hash of virtual time is that of every delivery, in order", "[host][trace]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    run_on(kind, [](Executive& executive) {
      Trace trace(executive);
      TraceHash expected;
      CHECK(trace.hash() == expected.value());
      const Duration start = executive.now().time_since_epoch();
      const ObjectRef first = command_of_goto(0.1, 1);
      const ObjectRef second = command_of_goto(0.2, 2);
      trace.delivered("fuser", "motion", first);
      trace.delivered("viewer", "in", first);  // a second reader of the same object
      sleep(executive, 50ms);
      trace.delivered("fuser", "motion", second);
      add(expected, start, "fuser", "motion", first);
      add(expected, start, "viewer", "in", first);
      add(expected, start + 50ms, "fuser", "motion", second);
      CHECK(trace.hash() == expected.value());
    });
  }
}

TEST_CASE("a trace hash takes words of eight bytes, and sees where a text ends and which signs change",
          "[host][trace]") {
  const auto of = [](const std::vector<std::uint64_t>& words) {
    TraceHash hash;
    for (const std::uint64_t word : words) hash.add_u64(word);
    return hash.value();
  };
  TraceHash text;
  text.add_text("delivered");
  CHECK(text.value() == of({9, 0x65726576696c6564, 0x64}));
  const auto of_texts = [](std::string_view first, std::string_view second) {
    TraceHash hash;
    hash.add_text(first);
    hash.add_text(second);
    return hash.value();
  };
  CHECK(of_texts("ab", "c") != of_texts("a", "bc"));
  CHECK(of_texts("a", "") != of_texts(std::string_view("a\0", 2), ""));
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  CHECK(of({7, 8, 9}) != of({7 ^ kSign, 8 ^ kSign, 9}));
  CHECK(of({0}) != of({0, 0}));
}

TEST_CASE("in steady time nothing is hashed", "[host][trace]") {
  run_on(steady_executives().front(), [](Executive& executive) {
    Trace trace(executive);
    trace.delivered("fuser", "motion", command_of_goto(0.1, 1));
    CHECK(trace.hash() == TraceHash{}.value());
  });
}

TEST_CASE("a trace file has one line for each event, with the time since the start", "[host][trace]") {
  const TempFolder folder;
  run_on(virtual_executives().front(), [&](Executive& executive) {
    Trace trace(executive);
    REQUIRE(trace.open(folder.file("trace")).ok());
    trace.link_changed("fuser.motion", "goto.MotionCmdPush", true);
    trace.state_changed("fuser", "IDLE", "CONNECT");
    sleep(executive, 1500ms);
    trace.delivered("fuser", "motion", command_of_goto(0.1, 7));
    trace.link_changed("fuser.motion", "goto.MotionCmdPush", false);
  });
  std::stringstream text;
  text << std::ifstream(folder.file("trace")).rdbuf();
  CHECK(text.str() ==
        "0.000000 connect fuser.motion goto.MotionCmdPush\n"
        "0.000000 state fuser IDLE CONNECT\n"
        "1.500000 deliver fuser motion 7 MotionCommand from goto\n"
        "1.500000 disconnect fuser.motion goto.MotionCmdPush\n");
}
