// SPDX-License-Identifier: GPL-3.0-or-later
// Secured participants, with Fast DDS: who is heard, who is not, and from when on.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "dds/backend/participant.hpp"
#include "dds_links.hpp"
#include "forged_keys.hpp"
#include "orca/base/log.hpp"
#include "orca/keys/authority.hpp"
#include "orca/keys/key_ring.hpp"
#include "temp_folder.hpp"

using Catch::Contains;
using namespace orca;
using namespace orca::dds;
using namespace orca::test;
using namespace std::chrono_literals;

namespace {

using WallClock = std::chrono::system_clock;

constexpr const char* kTopic = "orca/secured/base/motion";
const keys::Permit kWriter{"", "writer", {kTopic}, {}};
const keys::Permit kReader{"", "reader", {}, {kTopic}};

keys::Validity for_a(std::chrono::seconds time) { return {WallClock::now() - 1h, WallClock::now() + time}; }

// A folder with keys as orcactl makes them.
class Keys {
 public:
  explicit Keys(std::chrono::seconds life = 1h) {
    const Status made = keys::make_keys(system(), {kWriter, kReader}, for_a(life));
    if (!made.ok()) throw std::runtime_error(made.error().text());
  }
  [[nodiscard]] std::string system() const { return folder_.file("keys"); }
  [[nodiscard]] std::string machine() const { return system() + "/this-machine"; }
  [[nodiscard]] std::string file(const std::string& name) const { return machine() + "/" + name; }
  // Returns the process with the lowest mark.
  [[nodiscard]] std::string first() const {
    return keys::KeyRing::open(machine(), "writer", std::time(nullptr))
        .value()
        .known()
        .begin()
        ->second.process;
  }
  // A folder of keys that another authority has issued, with the names of these.
  [[nodiscard]] std::string forged() const { return folder_.file("forged"); }
  void forge(const std::string& process) const { forge_keys(machine(), process, forged()); }
  // Changes what a signed file says.
  void spoil(const std::string& name, const std::string& word) const {
    std::string text = read_text(file(name));
    const std::size_t at = text.find(word);
    REQUIRE(at != std::string::npos);
    text[at] = static_cast<char>(text[at] + 1);
    std::ofstream(file(name)) << text;
  }

  // What a thief has: the keys as they are now.
  class Copy {
   public:
    explicit Copy(const Keys& keys) {
      std::filesystem::copy(keys.machine(), machine());
      std::filesystem::permissions(machine(), std::filesystem::perms::owner_all);
    }
    [[nodiscard]] std::string machine() const { return folder_.file("copy"); }

   private:
    const TempFolder folder_;
  };

 private:
  const TempFolder folder_;
};

// What the log of this process says while the object lives.
class HeardLog {
 public:
  // Waits for it, since Fast DDS writes its log by a thread.
  [[nodiscard]] bool says(const std::string& text) const {
    for (int i = 0; i < 200 && !has(text); ++i) std::this_thread::sleep_for(10ms);
    const std::lock_guard lock(mutex_);
    UNSCOPED_INFO("the log: " << lines_);
    return lines_.find(text) != std::string::npos;
  }

 private:
  [[nodiscard]] bool has(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    return lines_.find(text) != std::string::npos;
  }

  mutable std::mutex mutex_;
  std::string lines_;
  const log::Listener listener_{[this](const log::Line& line) {
    const std::lock_guard lock(mutex_);
    lines_ += std::string(line.text) + "\n";
  }};
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

template <class T>
T must(Result<T> made) {
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

// A reader of the topic that knows what it has heard, and from which participants.
class Listener {
 public:
  explicit Listener(Participant& participant) {
    reader_ = must(participant.make_reader(topic(), [this](const Sample& sample) {
      const std::lock_guard lock(mutex_);
      from_.push_back(sample.origin);
    }));
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

// A process that hears what is written to the topic, and one that writes it.
struct Reading {
  explicit Reading(const std::string& keys) : process(must(open("reader", keys))), heard(*process) {}
  std::unique_ptr<Participant> process;
  Listener heard;
};
struct Writing {
  explicit Writing(const std::string& keys)
      : process(must(open("writer", keys))), out(must(process->make_writer(topic()))) {}
  std::unique_ptr<Participant> process;
  std::shared_ptr<TopicWriter> out;
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
  const Reading reader(keys.machine());
  const Writing writer(keys.machine());
  REQUIRE(is_heard(*writer.out, reader.heard, 10s));
  CHECK(reader.process->may_speak_for(reader.heard.last(), "writer"));
  CHECK_FALSE(reader.process->may_speak_for(reader.heard.last(), "reader"));
}

TEST_CASE("a plain participant neither hears nor is heard, and the log says so",
          "[patterns][dds][security]") {
  const Keys keys;
  const HeardLog log;
  const Reading reader(keys.machine());
  const Writing writer(keys.machine());
  auto stranger = open("stranger", "");
  REQUIRE(stranger);
  const Listener eavesdropper(**stranger);
  CHECK(is_heard(*writer.out, reader.heard, 10s));
  CHECK(eavesdropper.count() == 0);
  auto forged = (*stranger)->make_writer(topic());
  REQUIRE(forged);
  std::this_thread::sleep_for(100ms);
  CHECK_FALSE(is_heard(**forged, reader.heard, 1s));
  CHECK(log.says("what 127.0.0.1 says over DDS is dropped: it has no certificate of this system"));
}

TEST_CASE("a process of another system is not heard", "[patterns][dds][security]") {
  const Keys keys;
  const Keys others;
  const HeardLog log;
  const Reading reader(keys.machine());
  const Writing writer(others.machine());
  CHECK_FALSE(is_heard(*writer.out, reader.heard, 1s));
  CHECK(log.says("it has no certificate of this system"));
}

TEST_CASE("who claims the very name of a process with the certificate of another authority cannot prove it",
          "[patterns][dds][security]") {
  // Of two participants, that with the lower mark begins. Who does not begin may as well not answer.
  std::optional<Keys> keys;
  do keys.emplace();
  while (keys->first() != "writer");
  const HeardLog log;
  const Reading reader(keys->machine());
  keys->forge("writer");
  const Writing writer(keys->forged());
  CHECK_FALSE(is_heard(*writer.out, reader.heard, 2s));
  CHECK(log.says("it cannot prove to be process writer"));
}

TEST_CASE("keys that prove nothing are refused with what to do", "[patterns][dds][security]") {
  const Keys keys;
  const auto refusal = [&] {
    const auto made = open("writer", keys.machine());
    REQUIRE_FALSE(made);
    return made.error().message;
  };
  SECTION("none") {
    const auto made = open("nobody", keys.machine());
    REQUIRE_FALSE(made);
    CHECK_THAT(made.error().message, Contains("nobody.pem: No such file") && Contains("orcactl keys"));
  }
  SECTION("readable by others") {
    REQUIRE(chmod(keys.file("writer.key").c_str(), 0640) == 0);
    CHECK_THAT(refusal(), Contains("writer.key can be used by others") && Contains("chmod 0600"));
  }
  SECTION("in a folder of all") {
    REQUIRE(chmod(keys.machine().c_str(), 0755) == 0);
    CHECK_THAT(refusal(), Contains("chmod 0700"));
  }
  SECTION("of another process") {
    std::filesystem::copy_file(keys.file("reader.key"), keys.file("writer.key"),
                               std::filesystem::copy_options::overwrite_existing);
    CHECK_THAT(refusal(), Contains("writer.key does not belong to the certificate beside it"));
  }
  SECTION("of another authority") {
    const Keys others;
    std::filesystem::copy_file(others.file("authority.pem"), keys.file("authority.pem"),
                               std::filesystem::copy_options::overwrite_existing);
    CHECK_THAT(refusal(), Contains("was issued by another authority"));
  }
  SECTION("with changed permissions") {
    std::filesystem::copy_file(keys.file("governance.p7s"), keys.file("writer.permissions.p7s"),
                               std::filesystem::copy_options::overwrite_existing);
    CHECK_FALSE(open("writer", keys.machine()));
    keys.spoil("governance.p7s", "ENCRYPT");
    CHECK_THAT(refusal(), Contains("governance.p7s: its signature is not the authority's"));
  }
  SECTION("expired") {
    const Keys old(1s);
    std::this_thread::sleep_for(2100ms);
    const auto made = open("writer", old.machine());
    REQUIRE_FALSE(made);
    CHECK_THAT(made.error().message, Contains("expired"));
  }
  SECTION("revoked") {
    REQUIRE(keys::revoke_keys(keys.system(), "writer", {}, for_a(1h)));
    CHECK_THAT(refusal(), Contains("its certificate was revoked"));
  }
}

TEST_CASE("a process may write and read its own topics only", "[patterns][dds][security]") {
  const Keys keys;
  const HeardLog log;
  auto reader = open("reader", keys.machine());
  REQUIRE(reader);
  const auto out = (*reader)->make_writer(topic());
  REQUIRE_FALSE(out);
  CHECK_THAT(out.error().message, Contains("no writer for orca/secured/base/motion") && Contains("--renew"));
  CHECK(log.says("Fast DDS says: "));
  auto writer = open("writer", keys.machine());
  REQUIRE(writer);
  CHECK_FALSE((*writer)->make_reader(topic(), [](const Sample&) {}));
  CHECK_FALSE((*writer)->make_writer({"orca/secured/base/other", "orca::dds::Message", 16}));
}

TEST_CASE("a revoked process is not heard any more, a second after its neighbours have the new list",
          "[patterns][dds][security]") {
  const Keys keys;
  const HeardLog log;
  const Reading reader(keys.machine());
  const Keys::Copy stolen(keys);  // its owner does not know of the new list
  const Writing writer(stolen.machine());
  REQUIRE(is_heard(*writer.out, reader.heard, 10s));
  REQUIRE(keys::revoke_keys(keys.system(), "writer", {kWriter}, for_a(1h)));
  reader.process->look_after_keys(WallClock::now() + 1s);
  CHECK_FALSE(is_heard(*writer.out, reader.heard, 500ms));
  CHECK(log.says("says over DDS is dropped: the certificate of process writer was revoked"));
  const Writing successor(keys.machine());
  CHECK(is_heard(*successor.out, reader.heard, 10s));
}

TEST_CASE("a process whose certificate expires while it runs is cut off", "[patterns][dds][security]") {
  const Keys keys(24h);
  REQUIRE(keys::renew_keys(keys.system(), {kWriter}, for_a(1h)).ok());
  const HeardLog log;
  const Reading reader(keys.machine());
  const Writing writer(keys.machine());
  REQUIRE(is_heard(*writer.out, reader.heard, 10s));
  CHECK(log.says("the certificate of this process expires in 0 days"));
  SECTION("by itself") {
    writer.process->look_after_keys(WallClock::now() + 2h);
    CHECK_FALSE(is_heard(*writer.out, reader.heard, 300ms));
    CHECK(log.says("this process is cut off from DDS: its certificate has expired"));
  }
  SECTION("by its neighbours, if it does not do so itself") {
    reader.process->look_after_keys(WallClock::now() + 2h);
    CHECK_FALSE(is_heard(*writer.out, reader.heard, 300ms));
    CHECK(log.says("the certificate of process writer has expired"));
  }
}

TEST_CASE("a damaged or older list of certificates does not take the place of the one in use",
          "[patterns][dds][security]") {
  const Keys keys;
  const HeardLog log;
  const std::string old_list = read_text(keys.file("certificates.p7s"));
  REQUIRE(keys::revoke_keys(keys.system(), "writer", {kWriter}, for_a(1h)));
  auto reader = open("reader", keys.machine());
  REQUIRE(reader);
  SECTION("damaged") {
    keys.spoil("certificates.p7s", "valid");
    (*reader)->look_after_keys(WallClock::now() + 1s);
    CHECK(log.says("certificates.p7s: its signature is not the authority's"));
    CHECK(log.says("the list of certificates stays as it was"));
  }
  SECTION("older") {
    std::ofstream(keys.file("certificates.p7s")) << old_list;
    (*reader)->look_after_keys(WallClock::now() + 1s);
    CHECK(log.says("certificates.p7s is older than the list that this process has"));
  }
}
