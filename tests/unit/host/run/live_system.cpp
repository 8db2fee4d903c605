// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_system.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>

namespace orca::test {

using namespace orca::host;

namespace {

class DiaryListener final : public RunListener {
 public:
  explicit DiaryListener(Diary& diary) : diary_(diary) {}

  void logged(log::Level level, std::string_view /*who*/, std::string_view text) override {
    if (level == log::Level::debug) diary_.note(std::string(text));
  }
  [[noreturn]] void abandon(const RunResult& /*result*/) override { std::abort(); }

 private:
  Diary& diary_;
};

// A strand that runs on would use what is destroyed next: nobody could say then what went wrong.
void end(const std::vector<std::string>& stuck) {
  if (stuck.empty()) return;
  for (const std::string& name : stuck) std::cerr << "cannot be stopped: " << name << std::endl;
  std::abort();
}

}  // namespace

void LiveSystem::run(const ExecutiveOptions& executive, const std::function<void(LiveSystem&)>& body) {
  run_on(executive, [&](Executive& made) { with(made, body); });
}

void LiveSystem::with(Executive& executive, const std::function<void(LiveSystem&)>& body) {
  PluginCatalogue catalogue{plugin::PluginIndex({ORCA_BINARY_DIR "/tests/host_plugins"})};
  for (const TypeEntry* const type : own_types_) catalogue.add(*type);
  xml::Diagnostics diagnostics;
  const auto graph = graph::load_text("<graph name=\"live\" version=\"1\">" + elements_ + "</graph>",
                                      "live.xml", {}, catalogue, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(graph);
  executive_ = &executive;
  const std::unique_ptr<Event> changed = executive.make_event();  // ends before the executive does
  changed_ = changed.get();
  Trace trace(executive);
  DiaryListener listener(diary);
  Reporter reporter(executive, trace, listener, "live");
  std::atomic<std::uint64_t> missions{0};
  RunContext context{executive, trace, reporter, 1, [this] { changed_->notify(); }, missions};
  System system(*graph, context, [] { return false; });
  system_ = &system;
  graph_ = &*graph;
  context_ = &context;
  catalogue_ = &catalogue;
  const Status built = system.build(catalogue);
  INFO((built.ok() ? "" : built.error().text()));
  REQUIRE(built.ok());
  REQUIRE(system.bring_up(*changed_, soon()).ok());
  system.open_gates();
  body(*this);
  end(system.take_down(soon()));
}

std::vector<std::string> LiveSystem::news() {
  const std::vector<std::string> all = diary.lines();
  std::vector<std::string> result(all.begin() + static_cast<std::ptrdiff_t>(read_), all.end());
  read_ = all.size();
  return result;
}

}  // namespace orca::test
