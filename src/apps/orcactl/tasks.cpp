// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "tasks.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "asking.hpp"
#include "client.hpp"
#include "offering.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/system.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

constexpr std::string_view kShows = ".TaskStateQuery";
constexpr std::string_view kObeys = ".TaskOrderQuery";

constexpr std::array<std::pair<std::string_view, idl::TaskOrderKind>, 7> kOrders{
    {{"pause", idl::TASK_ORDER_PAUSE},
     {"resume", idl::TASK_ORDER_RESUME},
     {"skip", idl::TASK_ORDER_SKIP},
     {"end", idl::TASK_ORDER_END},
     {"begin", idl::TASK_ORDER_BEGIN},
     {"yes", idl::TASK_ORDER_YES},
     {"no", idl::TASK_ORDER_NO}}};

const char* word_for(idl::TaskStepState state) {
  switch (state) {
    case idl::STEP_RUNNING: return "now   ";
    case idl::STEP_DONE: return "done  ";
    case idl::STEP_FAILED: return "failed";
    case idl::STEP_IDLE: break;
  }
  return "-     ";
}

const char* word_for(idl::TaskPhase phase) {
  switch (phase) {
    case idl::TASK_PAUSED: return "paused";
    case idl::TASK_DONE: return "done";
    case idl::TASK_FAILED: return "failed";
    case idl::TASK_RUNNING: break;
  }
  return "on the way";
}

const char* name_of(idl::TaskStepState state) {
  switch (state) {
    case idl::STEP_RUNNING: return "running";
    case idl::STEP_DONE: return "done";
    case idl::STEP_FAILED: return "failed";
    case idl::STEP_IDLE: break;
  }
  return "idle";
}

const char* name_of(idl::TaskPhase phase) {
  switch (phase) {
    case idl::TASK_PAUSED: return "paused";
    case idl::TASK_DONE: return "done";
    case idl::TASK_FAILED: return "failed";
    case idl::TASK_RUNNING: break;
  }
  return "running";
}

Result<ObjectPtr<idl::TaskState>> fetch_task(Client& client, const std::string& component, Duration limit) {
  Result<ObjectLoan> reply =
      ask_port(client, component + std::string(kShows), make_object(object_type<idl::Ask>()), limit);
  if (!reply) return reply.error();
  ObjectPtr<idl::TaskState> task = object_cast<idl::TaskState>(std::move(*reply).seal());
  if (!task) return fail(Code::invalid_argument, component + " answers with something else than a TaskState");
  return task;
}

Status show(Client& client, const std::vector<std::string>& components, const apps::Call& call) {
  const Duration limit = call.duration("--timeout").value_or(kAnswerLimit);
  const bool as_json = call.has("--json");
  JsonWriter json;
  json.begin_array();
  for (const std::string& component : components) {
    const auto task = fetch_task(client, component, limit);
    if (!task) return task.error();
    if (as_json)
      write_task(component, **task, json);
    else
      print(component + ": " + tree_text(**task));
  }
  json.end();
  if (as_json) print(json.text());
  return ok();
}

Status order(Client& client, const std::vector<std::string>& components, const apps::Call& call) {
  const auto found = std::ranges::find(kOrders, call.words.front(), &decltype(kOrders)::value_type::first);
  if (found == kOrders.end())
    return fail(Code::invalid_argument,
                "tasks expects nothing, or pause, resume, skip, end, begin, yes or no; not " +
                    in_quotes(call.words.front()));
  const std::vector<std::string> named(call.words.begin() + 1, call.words.end());
  const std::vector<std::string>& meant = named.empty() ? components : named;
  if (meant.size() > 1)
    return fail(Code::invalid_argument, "several components have a task: " + listed(meant) +
                                            "; name one: orcactl tasks " + call.words.front() + " " +
                                            meant.front());
  auto object = make_object<idl::TaskOrder>();
  object->kind(found->second);
  const auto obeyed = ask_port(client, meant.front() + std::string(kObeys), std::move(object),
                               call.duration("--timeout").value_or(kAnswerLimit));
  return obeyed ? ok() : Status(obeyed.error());
}

}  // namespace

std::string tree_text(const idl::TaskState& task) {
  std::string text = task.name() + ", " + word_for(task.phase());
  if (!task.reason().empty()) text += "; the last failure: " + printable(task.reason());
  text += "\n";
  for (const idl::TaskStep& step : task.steps()) {
    if (step.depth() == 0) continue;
    text += std::string("  ") + word_for(step.state()) + "  " +
            std::string(2 * std::min<std::size_t>(step.depth() - 1, 50), ' ') + printable(step.text());
    if (!step.reason().empty()) text += "  (" + printable(step.reason()) + ")";
    text += "\n";
  }
  return text;
}

void write_task(const std::string& component, const idl::TaskState& task, JsonWriter& json) {
  json.begin_object();
  json.member("component", component);
  json.member("task", printable(task.name()));
  json.member("phase", name_of(task.phase()));
  json.member("reason", printable(task.reason()));
  json.key("steps").begin_array();
  for (const idl::TaskStep& step : task.steps()) {
    json.begin_object();
    json.member("depth", step.depth());
    json.member("state", name_of(step.state()));
    json.member("text", printable(step.text()));
    json.member("reason", printable(step.reason()));
    json.end();
  }
  json.end();
  json.end();
}

ExitCode handle_tasks(const apps::Call& call) {
  std::variant<Client, Failure> connected = Client::connect(call);
  if (auto* const failure = std::get_if<Failure>(&connected)) return report(*failure);
  Client& client = std::get<Client>(connected);
  const std::vector<std::string> components = components_with(client, kShows);
  if (components.empty())
    return report({fail(Code::not_found, "no component here has a task; orca.TaskTree does one")});
  const Status done = call.words.empty() ? show(client, components, call) : order(client, components, call);
  return done.ok() ? ExitCode::done : report({done.error()});
}

}  // namespace orca::orcactl
