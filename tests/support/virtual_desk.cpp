// SPDX-License-Identifier: GPL-3.0-or-later
#include "virtual_desk.hpp"

#include <signal.h>
#include <unistd.h>
#include <csignal>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <regex>
#include <stdexcept>
#include <thread>

#include "deployer/exit_code.hpp"
#include "deployer/options.hpp"
#include "orca/component.hpp"
#include "orca/graph/loader.hpp"
#include "orca/hardware.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/run_system.hpp"
#include "orca/idl/time.hpp"
#include "temp_folder.hpp"

namespace orca::test {
namespace {

constexpr Duration kStep = 1ms;
constexpr Duration kLeave = 100ms;  // in which devices hear the last words of drivers

// Takes down what the deployer would have written.
class Writer final : public host::RunListener {
 public:
  void started(TimePoint now) override { start_ = now; }
  void arrived(const idl::Arrived& arrived) override {
    char line[120];
    std::snprintf(line, sizeof line, "arrived %s %.3f %.3f %.2f\n", arrived.name().c_str(), arrived.x(),
                  arrived.y(), to_seconds(to_time_point(arrived.stamp()) - start_));
    run.out += line;
  }
  void goal_failed(const idl::GoalFailed& failed) override {
    run.out += "failed " + failed.name() + " " + failed.reason() + "\n";
  }
  void alarm(const idl::Alarm& alarm) override {
    run.err += alarm.source() + ": alarm " + kind_text(alarm) + ": " + alarm.text() + "\n";
  }
  void logged(log::Level /*level*/, std::string_view who, std::string_view text) override {
    run.err += std::string(who) + ": " + std::string(text) + "\n";
  }
  [[noreturn]] void abandon(const host::RunResult& result) override {
    std::fprintf(stderr, "a strand does not end: %s\n", result.error ? result.error->text().c_str() : "");
    std::abort();
  }

  Run run;

 private:
  TimePoint start_{};
};

}  // namespace

// The hardware beside the system, in whose task devices go on and the script runs. One at a time.
class BenchRun final : public hw::HardwareContainer {
 public:
  struct Given {
    const std::function<void()>& script;
    host::StopSignal& stop;
    Writer& writer;
    BenchRun* running = nullptr;
    TimePoint now{};  // of the last step
    std::exception_ptr thrown{};
    hw::HardwareSeat* seat = nullptr;
    std::function<Status()> job{};  // for the operator
    std::optional<Status> done{};   // what it has returned
  };
  static Given* given;

  using HardwareContainer::HardwareContainer;

  // Lets the time of one step pass.
  void wait() {
    pause_->wait_until(host().now() + kStep);
    if (ends_) throw Interrupted{};
    given->now = host().now();
  }

  // What the last words of drivers say comes when no strand runs any more.
  static void go_on_until(TimePoint end) {
    for (; given->now < end; given->now += kStep) bench().step();
  }

 private:
  std::vector<HardwareFault> prepare() override { return {}; }
  [[nodiscard]] idl::Robot description() const override { return {}; }
  Status poll() override { return ok(); }
  [[nodiscard]] TimePoint next_poll() const override { return kForever; }
  Status drive(const hw::DriveSetpoint&) override { return ok(); }

  Status open() override {
    given->running = this;
    pause_ = host().executive().make_event();
    task_ = host().executive().spawn({"bench", 0}, [this] { run(); });
    return ok();
  }
  void close() override {
    ends_ = true;
    if (task_ == nullptr) return;
    pause_->notify();
    (void)task_->join_until(kForever);
  }

  static void run() {
    try {
      if (given->script) given->script(), Bench::stop();
      for (;;) bench().sleep(1h);
    } catch (const Interrupted&) {
    } catch (...) {
      given->thrown = std::current_exception();
      Bench::stop();
    }
  }

  std::unique_ptr<Event> pause_;
  std::unique_ptr<Task> task_;
  bool ends_ = false;
};

BenchRun::Given* BenchRun::given = nullptr;

namespace {

// The component beside the server of the hardware, which does what the script wishes of components.
class Operator final : public Component {
 public:
  explicit Operator(ComponentHost& host)
      : Component(host), seat_(static_cast<hw::HardwareSeat*>(host.hardware())) {
    lap_every(kStep);
  }

  SendProxy<idl::MotionCommand> motion{*this, "motion", {.optional = true}};
  SendProxy<idl::HolonomicVelocity> velocity{*this, "velocity", {.optional = true}};
  static Operator* working;

 private:
  Status start() override {
    working = this;
    BenchRun::given->seat = seat_;
    return ok();
  }
  Outcome work() override {
    if (const auto job = std::exchange(BenchRun::given->job, nullptr)) BenchRun::given->done = job();
    return again();
  }

  hw::HardwareSeat* const seat_;
};

Operator* Operator::working = nullptr;

// Returns the graph with the bench in it, and the operator if some component has hardware.
std::string with_bench(std::string text) {
  std::string more = R"(<hardware name="test_bench" type="orca.test.Bench"/>)";
  std::smatch found;
  if (std::regex_search(text, found, std::regex(R"(\shardware="[^"]*")")))
    more +=
        R"(<component name="test_operator" type="orca.test.Operator" autonomous="true")" + found.str() + "/>";
  return text.insert(text.rfind("</graph>"), more);
}

}  // namespace

Bench& bench() {
  static Bench only;
  return only;
}

TimePoint Bench::now() const { return BenchRun::given != nullptr ? BenchRun::given->now : TimePoint{}; }

void Bench::step() {
  std::erase_if(devices_, [this](const Device& device) { return !device(now()); });
}

void Bench::sleep(Duration time) {
  for (const TimePoint end = saturating_add(now(), time); now() < end; step())
    BenchRun::given->running->wait();
}

bool Bench::until(const std::function<bool()>& condition, Duration limit) {
  for (const TimePoint end = now() + limit; !condition();) {
    if (now() >= end) return false;
    sleep(kStep);
  }
  return true;
}

bool Bench::until_log(const std::string& text, Duration limit) {
  return until([&] { return log().find(text) != std::string::npos; }, limit);
}

std::string Bench::log() const { return BenchRun::given->writer.run.err; }

Status Bench::in_operator(std::function<Status()> job) {
  BenchRun::Given& given = *BenchRun::given;
  given.job = std::move(job);
  (void)until([&] { return given.done.has_value(); }, 1h);
  return std::exchange(given.done, std::nullopt).value();
}

Status Bench::send(const idl::MotionCommand& command) {
  return in_operator([command] { return Operator::working->motion.send(command); });
}

Status Bench::send(const idl::HolonomicVelocity& command) {
  return in_operator([command] { return Operator::working->velocity.send(command); });
}

hw::HardwareSeat& Bench::seat() {
  (void)until([] { return BenchRun::given->seat != nullptr; });
  return *BenchRun::given->seat;
}

// Time stands still until the signal has been handled, so the run ends at the same moment each time.
void Bench::stop() {
  kill(getpid(), SIGINT);
  while (!BenchRun::given->stop.requested()) std::this_thread::sleep_for(100us);
}

Run run_virtual(const Words& words, const std::function<void()>& script) {
  const deployer::Options options = deployer::parse_options(words + virtual_clock());
  if (options.problems.has_errors()) throw std::runtime_error(options.problems.text());
  namespace fs = std::filesystem;
  host::PluginCatalogue catalogue(
      plugin::PluginIndex({fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "plugins"}),
      ClockKind::virtual_time);
  static const TypeEntry kBench{
      PluginKind::hardware, "orca.test.Bench",
      [](PluginHost& host) -> void* {
        return static_cast<hw::HardwareContainer*>(new BenchRun(static_cast<hw::HardwareHost&>(host)));
      },
      [](void* object) { delete static_cast<hw::HardwareContainer*>(object); }};
  static const TypeEntry kOperator{PluginKind::component, "orca.test.Operator",
                                   detail::create<Operator, Component, ComponentHost>,
                                   detail::destroy<Component>};
  catalogue.add(kBench);
  catalogue.add(kOperator);
  xml::Diagnostics diagnostics;
  graph::LoadOptions load{options.profiles, options.settings};
  load.any_link = true;
  const auto graph =
      graph::load_text(with_bench(read_text(options.file)), options.file, load, catalogue, diagnostics);
  Writer writer;
  writer.run.err = diagnostics.text();
  writer.run.ended = true;
  if (!graph) {
    writer.run.ending.exit_code = static_cast<int>(deployer::ExitCode::bad_input);
    return writer.run;
  }
  host::StopSignal stop(EXIT_SUCCESS);
  BenchRun::Given given{script, stop, writer};
  BenchRun::given = &given;
  const host::RunResult result = host::run_system(*graph, catalogue, options.run, stop, writer);
  BenchRun::go_on_until(given.now + kLeave);
  BenchRun::given = nullptr;
  if (given.thrown) std::rethrow_exception(given.thrown);
  if (result.error) writer.run.err += result.error->text() + "\n";
  writer.run.ending.exit_code = static_cast<int>(deployer::exit_code_of(result.outcome));
  return writer.run;
}

}  // namespace orca::test
