// SPDX-License-Identifier: GPL-3.0-or-later
// Secured participants, with Fast DDS: who is heard, who is not, and from when on.
#include <catch2/catch.hpp>

#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dds/backend/participant.hpp"
#include "dds_links.hpp"
#include "orca/base/log.hpp"
#include "orca/keys/authority.hpp"
#include "orca/keys/key_ring.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::dds;
using namespace orca::test;
using namespace std::chrono_literals;

namespace {

using Clock = std::chrono::system_clock;

constexpr const char* kTopic = "orca/secured/base/motion";
const keys::Permit kWriter{"", "writer", {kTopic}, {}};
const keys::Permit kReader{"", "reader", {}, {kTopic}};

keys::Validity for_a(std::chrono::seconds time) { return {Clock::now() - 1h, Clock::now() + time}; }

// A folder with keys as orcactl makes them.
class Keys {
 public:
  explicit Keys(std::chrono::seconds life = 1h) {
    const Status made = keys::make_keys(system(), {kWriter, kReader}, for_a(life));
    if (!made.ok()) throw std::runtime_error(made.error().text());
  }
  [[nodiscard]] std::string system() const { return folder_.file("keys"); }
  [[nodiscard]] std::string machine() const { return system() + "/this-machine"; }

 private:
  const TempFolder folder_;
};

Result<std::unique_ptr<Participant>> open(const std::string& process, const std::string& keys) {
  DdsOptions options;
  options.graph = "secured";
  options.process = process;
  options.domain = dds_test_domain();
  options.keys = keys;
  return Participant::open(options);
}

TopicOptions topic() { return {kTopic, "orca::dds::Message", 16}; }

// A reader of the topic that knows what it has heard, and from which participants.
class Listener {
 public:
  explicit Listener(Participant& participant) {
    auto made = participant.make_reader(topic(), [this](const Sample& sample) {
      const std::lock_guard lock(mutex_);
      from_.push_back(sample.origin);
    });
    if (!made) throw std::runtime_error(made.error().text());
    reader_ = std::move(made).value();
  }
  [[nodiscard]] std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return from_.size();
  }
  [[nodiscard]] Origin last() const {
    const std::lock_guard lock(mutex_);
    return from_.back();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Origin> from_;
  std::unique_ptr<TopicReader> reader_;
};

// Writes until the listener has heard something new. Returns whether it has, within the time.
bool is_heard(TopicWriter& writer, const Listener& listener, std::chrono::milliseconds time) {
  const std::size_t before = listener.count();
  const auto limit = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < limit) {
    writer.write(std::vector<std::byte>(8));
    std::this_thread::sleep_for(10ms);
    if (listener.count() > before) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("processes with keys of one authority hear each other, and know each other's names",
          "[patterns][dds][security]") {
  const Keys keys;
  auto reader = open("reader", keys.machine());
  REQUIRE(reader);
  const Listener listener(**reader);
  auto writer = open("writer", keys.machine());
  REQUIRE(writer);
  auto out = (*writer)->make_writer(topic());
  REQUIRE(out);
  const auto began = std::chrono::steady_clock::now();
  REQUIRE(is_heard(**out, listener, 10s));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  WARN("heard after " << took.count() << " s");
  CHECK((*reader)->may_speak_for(listener.last(), "writer"));
  CHECK_FALSE((*reader)->may_speak_for(listener.last(), "reader"));
}
