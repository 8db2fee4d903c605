// SPDX-License-Identifier: GPL-3.0-or-later
// Signals at random moments of all phases, with all executors and both clocks: exit status 0 within 3 s, robot at rest.
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"
#include "trace_file.hpp"

using namespace orca::test;

namespace {

constexpr double kEndLimit = 3.0 * (kSanitized ? 10.0 : 1.0);  // [s]
constexpr double kSlow = kSanitized ? 10.0 : 1.0;

// One run and the moment of its signal.
struct Shot {
  Words words;
  double instant = 0.0;  // [s]
  int signal = 0;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  [[nodiscard]] double between(double least, double most) {
    return least + (most - least) * static_cast<double>(random_()) / static_cast<double>(std::mt19937::max());
  }
  template <class T>
  [[nodiscard]] const T& one_of(const std::vector<T>& choices) {
    return choices[random_() % choices.size()];
  }

 private:
  std::mt19937 random_;
};

Words executor_and_clock(Dice& dice) {
  static const std::vector<Words> kAll{{"--executor", "thread"},
                                       {"--executor", "fiber"},
                                       {"--executor", "baton"},
                                       {"--clock", "virtual", "--executor", "fiber"},
                                       {"--clock", "virtual", "--executor", "baton"}};
  static const std::vector<Words> kForThreadSanitizer{kAll[0], kAll[2], kAll[4]};
  return dice.one_of(kThreadSanitizer ? kForThreadSanitizer : kAll);
}

// Half of the moments lie in the start, some in the middle of the drive, the rest around the end of the run.
Shot draw(Dice& dice, const std::string& trace) {
  static const std::vector<int> kSignals{SIGINT, SIGTERM, SIGHUP};
  Shot shot{Words{source_file("graphs/scout_goto.xml"), "--trace", trace} + executor_and_clock(dice), 0.0,
            dice.one_of(kSignals)};
  const double phase = dice.between(0.0, 1.0);
  if (phase < 0.5) {
    shot.instant = dice.between(0.0, 0.2);
  } else if (phase < 0.7) {
    shot.instant = dice.between(0.2, 1.0);
  } else {
    const double until = dice.between(0.0, 0.2);
    shot.words = shot.words + Words{"--until", std::to_string(until) + " s"};
    shot.instant = until + dice.between(0.05, 0.2);
  }
  shot.instant *= kSlow;
  return shot;
}

bool at_rest(const std::string& trace_file) {
  if (!std::filesystem::exists(trace_file)) return true;  // nothing had been started
  const TraceFile trace(trace_file);
  const std::string state = trace.state_before("scout");
  return (state.empty() || state == "Closed") && trace.open_connections().empty();
}

// A signal may come before main() or after the run: then the system ends the process, or there is none any more.
bool comes_too_early(const Shot& shot, const Run& run) {
  return run.ending.signal == shot.signal && run.out.empty() && run.err.empty();
}

void fire(const Shot& shot, const std::string& trace) {
  CAPTURE(shot.words, shot.instant, shot.signal);
  std::filesystem::remove(trace);
  Subprocess program(deployer(shot.words));
  std::this_thread::sleep_for(Seconds(shot.instant));
  program.send(shot.signal);
  const auto sent = std::chrono::steady_clock::now();
  const Run run = finish(program, Seconds(20));
  const Seconds took = std::chrono::steady_clock::now() - sent;
  INFO(run.err);
  CHECK(run.ended);
  CHECK((run.exit_code() == 0 || comes_too_early(shot, run)));
  CHECK(took < Seconds(kEndLimit));
  CHECK(at_rest(trace));
  CHECK_FALSE(program.group_lives());
}

void storm(int shots) {
  constexpr unsigned kSeed = 20041114;
  for (const int signal : {SIGHUP, SIGINT}) ::signal(signal, SIG_DFL);  // whatever started the test ignores
  Dice dice(kSeed);
  const TempFolder folder;
  const std::string trace = folder.file("trace");
  for (int i = 0; i < shots; ++i) {
    CAPTURE(kSeed, i);
    fire(draw(dice, trace), trace);
  }
}

}  // namespace

TEST_CASE("60 signals at random moments: exit status 0 within 3 s, robot at rest, nothing left behind",
          "[system][signals]") {
  storm(60);
}

TEST_CASE("2,000 signals at random moments: exit status 0 within 3 s, robot at rest, nothing left behind",
          "[.][slow]") {
  storm(2000);
}

TEST_CASE("a run that ends in its first milliseconds ends well, with any executor", "[system][signals]") {
  for (const std::string executor : {"thread", "fiber", "baton"}) {
    if (executor == "fiber" && kThreadSanitizer) continue;
    for (const std::string until : {"1 ns", "1 us", "100 us", "1 ms", "3 ms", "10 ms"}) {
      CAPTURE(executor, until);
      const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--executor", executor, "--until",
                                    until, "--log", "warning"},
                                   Seconds(10));
      INFO(run.err);
      CHECK(run.exit_code() == 0);
      CHECK(run.err.empty());
    }
  }
}
