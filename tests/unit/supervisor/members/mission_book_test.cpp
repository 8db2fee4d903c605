// SPDX-License-Identifier: GPL-3.0-or-later
#include "members/mission_book.hpp"

#include <catch2/catch.hpp>

#include "orca/idl/time.hpp"

using namespace orca;
using namespace orca::supervisor;
using Catch::Contains;

namespace {

constexpr TimePoint kStartOfRun{100s};

// The client at the other end of a reply.
class Reader {
 public:
  Reader() {
    SocketPair pair = std::move(make_socket_pair()).value();
    server_ = std::make_shared<Channel>(std::move(pair.supervisor));
    client_.emplace(std::move(pair.host));
  }
  // Returns the values of all records of an answer.
  template <class Show>
  std::vector<std::string> lines(const Show& show) {
    {
      Reply reply(server_, 1, false);
      show(reply);
    }
    std::vector<std::string> lines;
    for (;;) {
      ControlAnswer answer =
          std::move(decode_answer(std::move(client_->wait_for_message(1s)).value())).value();
      const auto* const record = std::get_if<RecordAnswer>(&answer);
      if (record == nullptr) return lines;
      std::string line;
      for (const Cell& cell : record->record) line += cell.value + "|";
      lines.push_back(line);
    }
  }

 private:
  std::shared_ptr<Channel> server_;
  std::optional<Channel> client_;
};

std::uint64_t nanoseconds(TimePoint time) {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

}  // namespace

TEST_CASE("a mission is told in the order of its times, whoever has reported first",
          "[supervisor][missions]") {
  MissionBook book(kStartOfRun);
  idl::Arrived arrived;
  arrived.mission(3);
  arrived.origin("goto");
  arrived.name("kitchen");
  arrived.creation_time(to_time_value(kStartOfRun + 9s));
  arrived.cause().origin("localizer");
  arrived.cause().port("pose");
  arrived.cause().seq(17);
  book.note(arrived);
  book.note(MissionStep{3, nanoseconds(kStartOfRun + 1s), "command.goto", "GoalPoint", 1, "", "", 0});
  book.note(MissionStep{0, nanoseconds(kStartOfRun + 1s), "fuser.base", "MotionCommand", 1, "", "", 0});
  Reader reader;
  CHECK(reader.lines([&](Reply& reply) { book.show(reply); }) ==
        std::vector<std::string>{"3|1.000|2|9.000|arrived kitchen|"});
  CHECK(reader.lines([&](Reply& reply) { CHECK(book.show(3, reply).ok()); }) ==
        std::vector<std::string>{"1.000|command.goto|sends|GoalPoint 1||",
                                 "9.000|goto|arrived|kitchen|localizer.pose 17|"});
}

TEST_CASE("a mission that nobody knows is an error", "[supervisor][missions]") {
  const MissionBook book(kStartOfRun);
  Reply reply({}, 1, false);
  CHECK(book.show(5, reply).error().code == Code::not_found);
}

TEST_CASE("endless missions and endless events take no endless memory", "[supervisor][missions]") {
  MissionBook book(kStartOfRun);
  for (std::uint64_t mission = 1; mission <= MissionBook::kMostMissions + 5; ++mission)
    for (std::uint64_t i = 0; i < MissionBook::kMostEvents + 3; ++i)
      book.note(
          MissionStep{mission, nanoseconds(kStartOfRun) + i, "command.goto", "GoalPoint", i, "", "", 0});
  Reader reader;
  const auto lines = reader.lines([&](Reply& reply) { book.show(reply); });
  CHECK(lines.size() == MissionBook::kMostMissions);
  CHECK_THAT(lines.front(), Contains("|503|"));
  CHECK(lines.front().starts_with("6|"));
}
