// SPDX-License-Identifier: GPL-3.0-or-later
// What the edges of a port share: the topic that it writes to, and the topic that it reads.
#include <catch2/catch.hpp>

#include <bit>
#include <map>

#include "orca/idl/motion.hpp"
#include "played_peer.hpp"

using namespace orca;
using namespace orca::dds;
using namespace orca::test;

namespace {

constexpr std::size_t kQueueLimit = std::size_t{4} << 20;

ObjectRef any_command() { return ObjectRef(head(0.5, 2.0).seal()); }

// A topic whose samples the test makes.
class PlayedTopic final : public Participant {
 public:
  Result<std::shared_ptr<TopicWriter>> make_writer(const TopicOptions& /*topic*/) override {
    return fail(Code::unavailable, "nobody writes here");
  }
  Result<std::unique_ptr<TopicReader>> make_reader(const TopicOptions& topic, Received received) override {
    if (topic.name == "refused") return fail(Code::unavailable, "no such topic");
    received_ = std::move(received);
    return std::make_unique<TopicReader>();
  }
  void come(std::byte origin, std::uint64_t sequence) const {
    received_({std::vector<std::byte>(kHeadroom), {}, Origin{origin}, sequence});
  }

 private:
  Received received_;
};

// Notes how many samples were missed before each one.
struct MissedNotes final : SampleSink {
  void take_sample(Sample sample, std::uint64_t missed) override { before[sample.sequence] = missed; }
  std::map<std::uint64_t, std::uint64_t> before;
};

}  // namespace

TEST_CASE("62 edges of a port share its topic, each under a bit of its own", "[patterns][dds]") {
  Outbox outbox([] {});
  Publication publication(outbox, std::make_shared<NotedTopic>());
  std::uint64_t all = 0;
  for (int i = 0; i < 62; ++i) {
    const auto bit = publication.reserve();
    REQUIRE(bit);
    CHECK(std::has_single_bit(*bit));
    CHECK((all & *bit) == 0);
    all |= *bit;
  }
  CHECK(all == (std::uint64_t{1} << 62) - 1);
  CHECK_FALSE(publication.reserve());
  publication.release(std::uint64_t{1} << 40);
  CHECK(publication.reserve() == std::uint64_t{1} << 40);
}

TEST_CASE("an object is written to the topic once, for all edges that are due", "[patterns][dds]") {
  const auto topic = std::make_shared<NotedTopic>();
  const ObjectRef first = any_command();
  const ObjectRef second = any_command();
  {
    Outbox outbox([] {});
    Publication publication(outbox, topic);
    publication.flush();  // there is nothing yet
    CHECK(publication.add(first, 1));
    CHECK(publication.add(first, 4));
    CHECK(publication.begin_epoch() == 1);
    CHECK(publication.add(second, 2));  // writes the first
    publication.flush();
    publication.flush();
  }
  const auto written = topic->objects();
  REQUIRE(written.size() == 2);
  CHECK(written[0].object == first);
  CHECK(written[0].label.edges == 5);
  CHECK(written[0].label.layout_hash == first.type().layout_hash);
  CHECK(written[0].size == first.type().write(first.get(), {}));
  CHECK(written[1].object == second);
  CHECK(written[1].label.edges == 2);
  CHECK(written[1].label.epoch == 1);
  CHECK(topic->queued == 0);
}

TEST_CASE("a topic refuses a new object while 4 MiB wait to be written", "[patterns][dds]") {
  const auto topic = std::make_shared<NotedTopic>();
  Outbox outbox([] {});
  Publication publication(outbox, topic);
  topic->queued = kQueueLimit - 1;
  const ObjectRef object = any_command();
  CHECK(publication.add(object, 1));
  topic->queued = kQueueLimit;
  CHECK(publication.add(object, 2));  // it has room already
  publication.flush();
  topic->queued = kQueueLimit;
  CHECK_FALSE(publication.add(any_command(), 1));
}

TEST_CASE("samples that the topic has lost are counted from the numbers of one writer", "[patterns][dds]") {
  PlayedTopic topic;
  Subscription subscription;
  REQUIRE(subscription.open(topic, {"t", "T", 1}).ok());
  MissedNotes notes;
  subscription.add(notes);
  topic.come(std::byte{1}, 10);  // the first one: nobody knows what was before
  topic.come(std::byte{1}, 11);
  topic.come(std::byte{1}, 14);
  topic.come(std::byte{3}, 20);  // another writer
  topic.come(std::byte{3}, 22);
  topic.come(std::byte{1}, 30);
  CHECK(notes.before ==
        std::map<std::uint64_t, std::uint64_t>{{10, 0}, {11, 0}, {14, 2}, {20, 0}, {22, 1}, {30, 0}});
  topic.come(std::byte{1}, 29);  // a number that goes back is no loss
  CHECK(notes.before.at(29) == 0);
}

TEST_CASE("every sample goes to each edge that reads the topic, until the edge has gone", "[patterns][dds]") {
  PlayedTopic topic;
  Subscription subscription;
  REQUIRE(subscription.open(topic, {"t", "T", 1}).ok());
  MissedNotes first, second;
  topic.come(std::byte{1}, 1);  // nobody is there
  subscription.add(first);
  subscription.add(second);
  topic.come(std::byte{1}, 2);
  subscription.remove(first);
  topic.come(std::byte{1}, 3);
  CHECK(first.before.size() == 1);
  CHECK(second.before.size() == 2);
}

TEST_CASE("a topic that cannot be read is an error", "[patterns][dds]") {
  PlayedTopic topic;
  Subscription subscription;
  const Status opened = subscription.open(topic, {"refused", "T", 1});
  REQUIRE_FALSE(opened.ok());
  CHECK(opened.error().message == "no such topic");
}
