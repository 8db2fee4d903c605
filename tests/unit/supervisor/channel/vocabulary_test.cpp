// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/vocabulary.hpp"

#include <catch2/catch.hpp>

#include "open_descriptors.hpp"
#include "samples.hpp"

using namespace orca;
using namespace orca::supervisor;
using namespace orca::test;

namespace {

template <class Words>
Result<Words> decode(Message message) {
  if constexpr (std::is_same_v<Words, Order>) {
    return decode_order(std::move(message));
  } else {
    return decode_report(std::move(message));
  }
}

Message copy_of(const Message& message, std::size_t descriptors) {
  Message copy{message.kind, message.request, message.body, {}};
  for (std::size_t i = 0; i < descriptors; ++i) copy.descriptors.push_back(null_device());
  return copy;
}
Message copy_of(const Message& message) { return copy_of(message, message.descriptors.size()); }

// Decoding and encoding again gives the same message.
template <class Words>
void check_round_trip(Words words) {
  const std::size_t index = words.index();
  const Message message = encode(std::move(words), 9);
  INFO("kind " << static_cast<int>(message.kind));
  CHECK(message.request == 9);
  auto decoded = decode<Words>(copy_of(message));
  REQUIRE(decoded);
  CHECK(decoded->index() == index);
  const Message again = encode(std::move(*decoded), 9);
  CHECK(again.kind == message.kind);
  CHECK(again.body == message.body);
  CHECK(again.descriptors.size() == message.descriptors.size());
}

// What is cut off, added or changed is an error or another value of the same kind, never anything worse.
template <class Words>
void check_damage(Words words) {
  const Message message = encode(std::move(words));
  INFO("kind " << static_cast<int>(message.kind));
  for (std::size_t size = 0; size < message.body.size(); ++size) {
    Message cut = copy_of(message);
    cut.body.resize(size);
    CHECK(decode<Words>(std::move(cut)).error().code == Code::data_loss);
  }
  Message longer = copy_of(message);
  longer.body.push_back(std::byte{0});
  CHECK(decode<Words>(std::move(longer)).error().code == Code::data_loss);
  CHECK_FALSE(decode<Words>(copy_of(message, message.descriptors.size() + 1)));
  if (!message.descriptors.empty())
    CHECK_FALSE(decode<Words>(copy_of(message, message.descriptors.size() - 1)));
  for (std::size_t at = 0; at < message.body.size(); ++at)
    for (const int value : {0, 1, 127, 128, 255}) {
      Message changed = copy_of(message);
      changed.body[at] = static_cast<std::byte>(value);
      const auto decoded = decode<Words>(std::move(changed));
      CHECK((decoded || decoded.error().code == Code::data_loss));
    }
}

}  // namespace

TEST_CASE("Each order and each report is read as it was written", "[supervisor][vocabulary]") {
  for (auto& order : all_orders()) check_round_trip(std::move(order));
  for (auto& report : all_reports()) check_round_trip(std::move(report));
}

TEST_CASE("The samples of this test leave out no kind", "[supervisor][vocabulary]") {
  std::set<std::size_t> orders, reports;
  for (const auto& order : all_orders()) orders.insert(order.index());
  for (const auto& report : all_reports()) reports.insert(report.index());
  CHECK(orders.size() == std::variant_size_v<Order>);
  CHECK(reports.size() == std::variant_size_v<Report>);
}

TEST_CASE("Fields keep their values", "[supervisor][vocabulary]") {
  const auto decoded = decode_order(encode(setup()));
  REQUIRE(decoded);
  const auto& read = std::get<Setup>(*decoded);
  CHECK(read.process == "base");
  CHECK(read.graph == "<graph/>");
  CHECK(read.options == Pairs{{"seed", "7"}, {"profile", "sim"}});
  CHECK(read.run_page);
  REQUIRE(read.edges.size() == 2);
  CHECK(read.edges[0].pool);
  CHECK(read.edges[1].edge == "b.out to c.in");
  CHECK(read.edges[1].peer == "arm");
  CHECK_FALSE(read.edges[1].pool);
  CHECK(read.pool);
  CHECK(read.doorbells == std::vector<std::string>{"a", "b", "c"});

  const auto rewiring = decode_order(encode(rewire()));
  REQUIRE(rewiring);
  const auto& changes = std::get<Rewire>(*rewiring).changes;
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].edge == rewire().changes[0].edge);
  CHECK(changes[0].makes);
  CHECK(changes[0].memory);
  CHECK(changes[1].edge == rewire().changes[1].edge);
  CHECK_FALSE(changes[1].makes);
  CHECK_FALSE(changes[1].memory);

  const auto arrival = decode_order(encode(newcomer()));
  REQUIRE(arrival);
  const auto& added = std::get<AddComponent>(*arrival);
  CHECK(added.node == newcomer().node);
  CHECK(added.values == newcomer().values);
  CHECK(added.doorbell == 9);

  const auto answer = decode_report(encode(Answer{fail(Code::deadline_exceeded, "too late", "a.xml:1:2")}));
  REQUIRE(answer);
  const Error error = std::get<Answer>(*answer).outcome.error();
  CHECK(error.code == Code::deadline_exceeded);
  CHECK(error.text() == "a.xml:1:2: too late");

  const auto change = decode_report(encode(StateChange{"avoid", 6, "no echo", true, false, true}));
  REQUIRE(change);
  const auto& state = std::get<StateChange>(*change);
  CHECK(state.component == "avoid");
  CHECK(state.state == 6);
  CHECK(state.failure == "no echo");
  CHECK(state.has_worked);
  CHECK_FALSE(state.has_failed);
  CHECK(state.ended_badly);
}

TEST_CASE("Damaged messages are refused", "[supervisor][vocabulary]") {
  const std::size_t before = open_descriptors();
  for (auto& order : all_orders()) check_damage(std::move(order));
  for (auto& report : all_reports()) check_damage(std::move(report));
  CHECK(open_descriptors() == before);
}

TEST_CASE("A host process gives no orders, and the supervisor sends no reports", "[supervisor][vocabulary]") {
  CHECK(decode_order(encode(Answer{})).error().message ==
        "a message of kind 101 of the control channel is not known here");
  CHECK(decode_report(encode(Build{})).error().code == Code::data_loss);
  CHECK(decode_report(Message{}).error().code == Code::data_loss);
}

TEST_CASE("An impossible level of a log line is refused", "[supervisor][vocabulary]") {
  Message line = encode(Logged{log::Level::error, "a", "b"});
  CHECK(decode_report(copy_of(line)));
  line.body[0] = static_cast<std::byte>(log::Level::off);
  CHECK_FALSE(decode_report(std::move(line)));
}
