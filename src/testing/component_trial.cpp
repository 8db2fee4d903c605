// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/testing/component_trial.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "orca/graph/loader.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/run_system.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/plugin/index.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::testing {
namespace {

constexpr const char* kSubject = "subject";
constexpr const char* kTest = "test";
constexpr const char* kTestType = "orca.testing.Test";

// What the partner's work() is about. It is not a member of Partner, because a component is constructed by its type
// alone.
struct Script {
  const std::function<void(Partner&)>& run;
  std::exception_ptr thrown;
  bool ended = false;
};
Script* g_script = nullptr;

struct ScriptInUse {
  explicit ScriptInUse(Script& script) { g_script = &script; }
  ~ScriptInUse() { g_script = nullptr; }
  ScriptInUse(const ScriptInUse&) = delete;
  ScriptInUse& operator=(const ScriptInUse&) = delete;
};

// Keeps what went wrong, for the text of an exception.
class Listener final : public host::RunListener {
 public:
  void logged(log::Level level, std::string_view who, std::string_view text) override {
    if (level < log::Level::warning) return;
    lines_ += "\n" + std::string(who) + ": " + std::string(text);
  }
  [[noreturn]] void abandon(const host::RunResult& /*result*/) override { std::abort(); }
  [[nodiscard]] const std::string& lines() const { return lines_; }

 private:
  std::string lines_;
};

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml::escaped(value) + "\"";
}

std::string subject_element(const Trial& trial) {
  std::string text = "<component" + attribute("name", kSubject) + attribute("type", trial.type) + ">";
  for (const auto& [name, value] : trial.params)
    text += "<param" + attribute("name", name) + attribute("value", value) + "/>";
  return text + "</component>";
}

// In a graph, a connection leads from the PushServer, QueryProxy or SendProxy to the other end.
std::string connection(const PortContract& port) {
  const bool from_test = (port.pattern == Pattern::push) == (port.role == Role::server);
  const std::string test = std::string(kTest) + "." + port.name;
  const std::string subject = std::string(kSubject) + "." + port.name;
  return "<connect" + attribute("from", from_test ? test : subject) +
         attribute("to", from_test ? subject : test) + "/>";
}

std::string graph_text(const Trial& trial, const Contract& test) {
  std::string text = "<graph" + attribute("name", "trial") + attribute("version", "1") +
                     attribute("ends", kTest) + ">\n" + subject_element(trial) + "\n<component" +
                     attribute("name", kTest) + attribute("type", kTestType) +
                     attribute("autonomous", "true") + "/>\n";
  for (const PortContract& port : test.ports) text += connection(port) + "\n";
  return text + "</graph>\n";
}

std::string default_folder() {
  namespace fs = std::filesystem;
  return (fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "plugins").string();
}

std::vector<std::string> folders_of(const Trial& trial) {
  return trial.plugins.empty() ? std::vector<std::string>{default_folder()} : trial.plugins;
}

host::TimedChange swap_of(const Trial& trial, const graph::Graph& graph) {
  const Result<std::string> plugin = plugin::PluginIndex(folders_of(trial)).file_of(trial.type);
  if (!plugin) throw std::runtime_error(plugin.error().text());
  const auto subject = std::ranges::find(graph.components, kSubject, &graph::ComponentNode::name);
  host::TimedChange change{"another object", trial.swap_at, {}, {{trial.type, *plugin}}};
  change.plan.exchanges = {{kSubject, trial.type, subject->params}};
  return change;
}

host::RunOptions options_of(const Trial& trial, const graph::Graph& graph) {
  host::RunOptions options;
  options.executive = {ClockKind::virtual_time, Backend::baton};
  options.seed = trial.seed;
  options.until = trial.limit;
  options.log_name = "trial";
  if (trial.swap_at > Duration{0}) options.changes = {swap_of(trial, graph)};
  return options;
}

graph::Graph load(const Trial& trial, const TypeEntry& test, host::PluginCatalogue& catalogue) {
  catalogue.add(test);
  const Result<Contract> contract = catalogue.component(kTestType, nullptr);
  if (!contract) throw std::runtime_error(contract.error().text());
  xml::Diagnostics diagnostics;
  graph::LoadOptions options;
  options.try_components = true;
  std::optional<graph::Graph> graph =
      graph::load_text(graph_text(trial, *contract), "trial", options, catalogue, diagnostics);
  if (!graph) throw std::runtime_error(trial.type + " cannot be tried:\n" + diagnostics.text());
  return std::move(*graph);
}

void refuse(const Trial& trial, const Script& script, const host::RunResult& result,
            const std::string& lines) {
  if (result.error) throw std::runtime_error(trial.type + ": " + result.error->text() + lines);
  if (!script.ended)
    throw std::runtime_error(trial.type + ": the script did not return within " +
                             xml::number_text(to_seconds(trial.limit)) + " s of virtual time" + lines);
}

}  // namespace

Outcome Partner::work() {
  try {
    // Time passes when nobody can go on: after this the component under test is connected and waits for the test.
    sleep(1ms);
    g_script->run(*this);
  } catch (const Interrupted&) {
    throw;
  } catch (...) {
    g_script->thrown = std::current_exception();
  }
  g_script->ended = true;
  return done();
}

void detail::try_component(const Trial& trial, void* (*make)(PluginHost&),
                           const std::function<void(Partner&)>& script) {
  const TypeEntry test{PluginKind::component, kTestType, make,
                       [](void* object) { delete static_cast<Component*>(object); }};
  Script running{script, {}};
  const ScriptInUse in_use(running);
  host::PluginCatalogue catalogue(plugin::PluginIndex(folders_of(trial)), ClockKind::virtual_time);
  const graph::Graph graph = load(trial, test, catalogue);
  host::StopSignal stop(EXIT_SUCCESS);
  Listener listener;
  const host::RunResult result = host::run_system(graph, catalogue, options_of(trial, graph), stop, listener);
  if (running.thrown) std::rethrow_exception(running.thrown);
  refuse(trial, running, result, listener.lines());
}

}  // namespace orca::testing
