// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorded_run.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

#include "executives.hpp"

namespace orca::test {

using namespace orca::host;

namespace {

class RunKeeper final : public RunListener {
 public:
  explicit RunKeeper(RecordedRun& record) : record_(record) {}

  void started(TimePoint /*now*/) override { record_.heard.emplace_back("started"); }
  void built(const RunView& view) override {
    record_.heard.emplace_back("built");
    record_.first_glance = view.look();
  }
  void arrived(const idl::Arrived& arrived) override { record_.heard.push_back("arrived " + arrived.name()); }
  void goal_failed(const idl::GoalFailed& failed) override {
    record_.heard.push_back("failed " + failed.name() + ": " + failed.reason());
  }
  void contact(const idl::Contact& contact) override {
    record_.heard.push_back("contact " + contact.robot());
  }
  void alarm(const idl::Alarm& alarm) override {
    record_.heard.push_back("alarm " + kind_text(alarm));
    record_.alarms.push_back(alarm);
  }
  void logged(log::Level level, std::string_view who, std::string_view text) override {
    if (level == log::Level::info) record_.infos.push_back(std::string(who) + ": " + std::string(text));
    if (level == log::Level::warning) record_.warnings.push_back(std::string(who) + ": " + std::string(text));
  }
  void ended(const RunResult& /*result*/) override { record_.heard.emplace_back("ended"); }
  [[noreturn]] void abandon(const RunResult& /*result*/) override { std::abort(); }

 private:
  RecordedRun& record_;
};

}  // namespace

RecordedRun record_run(const std::string& attributes, const std::string& elements,
                       const RunOptions& options) {
  StopSignal stop(EXIT_SUCCESS);
  PluginCatalogue catalogue{plugin::PluginIndex(
      {ORCA_BINARY_DIR "/tests/host_plugins", ORCA_BINARY_DIR "/tests/plugins", ORCA_BINARY_DIR "/plugins"})};
  xml::Diagnostics diagnostics;
  const auto graph =
      graph::load_text("<graph name=\"recorded\" version=\"1\" " + attributes + ">" + elements + "</graph>",
                       "recorded.xml", {}, catalogue, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(graph);
  RecordedRun record;
  RunKeeper recorder(record);
  record.result = run_system(*graph, catalogue, options, stop, recorder);
  return record;
}

RunOptions virtual_run() {
  RunOptions options;
  options.executive = virtual_executives().front();
  return options;
}

}  // namespace orca::test
