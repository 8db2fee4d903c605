// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "asking.hpp"
#include "bag.hpp"
#include "calibration/calibrate.hpp"
#include "commands.hpp"
#include "common/manual.hpp"
#include "common/output.hpp"
#include "exit_code.hpp"
#include "going.hpp"
#include "importing/import.hpp"
#include "keys/keys.hpp"
#include "map_saving.hpp"
#include "offering.hpp"
#include "orca/base/exhaustion.hpp"
#include "recording.hpp"
#include "tapping/tapping.hpp"
#include "tasks.hpp"
#include "template_folder.hpp"

namespace {

using namespace orca::orcactl;
namespace apps = orca::apps;

ExitCode carry_out(const apps::Call& call) {
  using Way = ExitCode (*)(const apps::Call&);
  static const std::map<std::string_view, Way> ways{{"echo", tap},           {"hz", tap},
                                                    {"latency", tap},        {"send", offer},
                                                    {"query", offer},        {"names", print_names},
                                                    {"record", record},      {"bag", handle_bag},
                                                    {"map", handle_map},     {"calibrate", calibrate},
                                                    {"tasks", handle_tasks}, {"go", handle_go},
                                                    {"new", handle_new},     {"import", import_file},
                                                    {"keys", handle_keys}};
  static const std::set<std::string_view> text_only{"import", "keys", "map", "new", "record"};
  if (call.has("--json") && text_only.contains(call.command->name))
    return report({orca::fail(orca::Code::invalid_argument,
                              std::string(call.command->name) + " writes no JSON, leave out --json"),
                   ExitCode::usage});
  const auto way = ways.find(call.command->name);
  return way == ways.end() ? ask(call) : way->second(call);
}

// Lack of memory, threads or descriptors is a refusal like others.
ExitCode carry_out_contained(const apps::Call& call) {
  const orca::Result<ExitCode> code =
      orca::contain_exhaustion([&]() -> orca::Result<ExitCode> { return carry_out(call); });
  return code ? *code : report({code.error()});
}

ExitCode act(const std::vector<std::string>& words) {
  const apps::Call call = apps::parse(program(), words);
  if (!call.problems.empty())
    return report({orca::fail(orca::Code::invalid_argument, call.problems.front().message), ExitCode::usage});
  const std::optional<std::string> answer = apps::answer(program(), call);
  if (!answer) return carry_out_contained(call);
  std::fputs(answer->c_str(), stdout);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  const ExitCode code = act({argv + 1, argv + argc});
  const bool lost = !orca::apps::output_has_arrived();
  return static_cast<int>(code == ExitCode::done && lost ? ExitCode::refused : code);
}
