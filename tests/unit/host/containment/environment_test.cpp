// SPDX-License-Identifier: GPL-3.0-or-later
// The component that changes something shared by all components is named, and no other.
#include "containment/environment.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cfenv>
#include <vector>

using namespace orca;
using namespace orca::host;
using Catch::Contains;

namespace {

// The environment of this test's process, with the alarms that it raises.
class Watched {
 public:
  explicit Watched(bool strands_overlap)
      : kept_(strands_overlap, [this](const idl::Alarm& alarm) { alarms.push_back(alarm); }) {}

  std::vector<idl::Alarm> alarms;

 private:
  KeptEnvironment kept_;
};

// One hook of a component, from the call to the return.
class Turn {
 public:
  explicit Turn(const char* who, Hook hook = Hook::work) : activity_(who, hook, nullptr) {
    Environment::of_process().entering(activity_);
  }
  ~Turn() { Environment::of_process().left(activity_); }
  void wait() { Environment::of_process().leaving(activity_); }

 private:
  const Activity activity_;
};

// Runs that many laps of a component that does nothing wrong.
void work_quietly(const char* who, int laps) {
  for (int i = 0; i < laps; ++i) const Turn turn(who);
}

void open_descriptors_for_good(int count, std::vector<int>& opened) {
  for (int i = 0; i < count; ++i) opened.push_back(open("/dev/null", O_RDONLY | O_CLOEXEC));
}

void close_all(const std::vector<int>& opened) {
  for (const int fd : opened) close(fd);
}

}  // namespace

TEST_CASE("where strands take turns, the component that leaves is blamed for a change",
          "[host][environment]") {
  Watched watched(false);
  {
    const Turn good("good");
    Turn bad("bad");  // it waits in its lap while the other one works
    umask(0);
    bad.wait();
  }
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].kind() == idl::UMASK);
  CHECK(watched.alarms[0].source() == "bad");
  CHECK(watched.alarms[0].hook() == "work()");
  CHECK(watched.alarms[0].active());
  CHECK_THAT(watched.alarms[0].text(), Contains("work() has changed the umask"));
}

TEST_CASE("where strands overlap, all components in a hook are blamed for a change of the process",
          "[host][environment]") {
  Watched watched(true);
  work_quietly("idle", 2);
  {
    const Turn good("good");
    const Turn bad("bad");
    umask(0);
  }
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].source().empty());
  CHECK(watched.alarms[0].hook().empty());
  CHECK_THAT(watched.alarms[0].text(), Contains("one of bad, good has changed the umask"));
}

TEST_CASE("where strands overlap, a thread's component is blamed for a change of the thread",
          "[host][environment]") {
  Watched watched(true);
  {
    const Turn good("good");
    const Turn bad("bad");
    std::fesetround(FE_UPWARD);
  }
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].source() == "bad");
  CHECK(watched.alarms[0].kind() == idl::FLOATING_POINT);
  CHECK(std::fegetround() == FE_TONEAREST);
}

TEST_CASE(
    "all components that had a turn are blamed for a change that nobody saw; the next one is found at once",
    "[host][environment]") {
  Watched watched(false);
  work_quietly("good", 3);
  work_quietly("bad", 3);
  {
    const Turn bad("bad");
    umask(0);
  }
  work_quietly("good", 64);
  REQUIRE(watched.alarms.size() == 1);
  CHECK_THAT(watched.alarms[0].text(), Contains("one of bad, good"));
  {
    const Turn bad("bad");
    umask(0);
  }
  REQUIRE(watched.alarms.size() == 2);
  CHECK(watched.alarms[1].source() == "bad");
}

TEST_CASE("no component is blamed for a change between two hooks", "[host][environment]") {
  Watched watched(false);
  work_quietly("good", 1);
  setlocale(LC_ALL, "C.UTF-8");
  work_quietly("good", 1);
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].source().empty());
  CHECK_THAT(watched.alarms[0].text(),
             Contains("something outside of the components' hooks has changed the locale"));
  CHECK(setlocale(LC_ALL, nullptr) == std::string("C"));
}

TEST_CASE("a hardware container's strand is named as a component is", "[host][environment]") {
  Watched watched(false);
  {
    const Activity scout("scout", Hook::strand, nullptr);
    umask(0);
    Environment::of_process().leaving(scout);
  }
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].source() == "scout");
  CHECK_THAT(watched.alarms[0].text(), Contains("its strand has changed the umask"));
}

TEST_CASE("where strands overlap, a hardware container's strand is in its hook from its first turn on",
          "[host][environment]") {
  Watched watched(true);
  const Activity scout("scout", Hook::strand, nullptr);
  Environment::of_process().leaving(scout);
  {
    const Turn bad("bad");
    umask(0);
  }
  REQUIRE(watched.alarms.size() == 1);
  CHECK_THAT(watched.alarms[0].text(), Contains("one of bad, scout has changed the umask"));
}

TEST_CASE("only the component that opens 32 descriptors in its laps and closes none is blamed",
          "[host][environment]") {
  Watched watched(false);
  std::vector<int> opened;
  open_descriptors_for_good(40, opened);  // opened outside of all components
  for (int lap = 0; lap < 150; ++lap) {
    {
      const Turn bad("bad");
      if (lap >= 70) open_descriptors_for_good(1, opened);
    }
    work_quietly("good", 1);
  }
  close_all(opened);
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].kind() == idl::DESCRIPTORS);
  CHECK(watched.alarms[0].source() == "bad");
  CHECK_THAT(watched.alarms[0].text(), Contains("work() has opened 32 descriptors and not closed them: ") &&
                                           Contains("(/dev/null)") && Contains("and 24 more"));
}

TEST_CASE("a component that opens many descriptors in start() and closes them in stop() is not accused",
          "[host][environment]") {
  Watched watched(false);
  std::vector<int> opened;
  {
    const Turn start("good", Hook::start);
    open_descriptors_for_good(50, opened);
  }
  work_quietly("good", 70);
  {
    const Turn stop("good", Hook::stop);
    close_all(opened);
  }
  CHECK(watched.alarms.empty());
}

TEST_CASE("start() may open many descriptors even where many are open already", "[host][environment]") {
  Watched watched(false);
  std::vector<int> opened;
  open_descriptors_for_good(40, opened);
  work_quietly("other", 2);
  {
    const Turn start("good", Hook::start);
    open_descriptors_for_good(40, opened);
  }
  work_quietly("good", 2);
  close_all(opened);
  CHECK(watched.alarms.empty());
}

TEST_CASE("a component is not blamed for descriptors that stop() leaves open if others had a turn meanwhile",
          "[host][environment]") {
  const bool others = GENERATE(false, true);
  Watched watched(false);
  std::vector<int> opened;
  {
    Turn start("bad", Hook::start);
    open_descriptors_for_good(1, opened);
    start.wait();
    if (others) work_quietly("good", 1);
  }
  { const Turn stop("bad", Hook::stop); }
  close_all(opened);
  CHECK(watched.alarms.size() == (others ? 0 : 1));
}

TEST_CASE("what a look ahead of start() has seen holds until anybody else has had a turn",
          "[host][environment]") {
  const bool others = GENERATE(false, true);
  const bool other_opens = others && GENERATE(false, true);
  Watched watched(false);
  std::vector<int> opened;
  work_quietly("bad", 2);
  Environment::of_process().look_ahead("bad");
  { const Turn save("bad", Hook::save_state); }
  if (others) {
    const Turn turn("other");
    if (other_opens) open_descriptors_for_good(1, opened);
  }
  {
    const Turn start("bad", Hook::start);
    if (!other_opens) open_descriptors_for_good(1, opened);
  }
  { const Turn stop("bad", Hook::stop); }
  close_all(opened);
  if (other_opens) {
    CHECK(watched.alarms.empty());
  } else {
    REQUIRE(watched.alarms.size() == 1);
    CHECK_THAT(watched.alarms[0].text(), Contains("left open what start() or itself has opened"));
  }
}

TEST_CASE("a look ahead finds what was changed before, and lays it to no component that starts",
          "[host][environment]") {
  Watched watched(false);
  { const Turn turn("bad"); }
  { const Turn turn("bad"); }
  {
    const Turn third("bad");  // is not checked in full
    umask(0777);
  }
  Environment::of_process().look_ahead("good");
  { const Turn start("good", Hook::start); }
  REQUIRE(watched.alarms.size() == 1);
  CHECK(watched.alarms[0].source() == "bad");
}
