// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <cstdio>
#include <string>

#include "asking.hpp"
#include "call.hpp"
#include "common/output.hpp"
#include "exit_code.hpp"
#include "manual.hpp"
#include "offering.hpp"
#include "orca/base/exhaustion.hpp"
#include "tapping.hpp"

namespace {

using namespace orca::orcactl;

ExitCode show(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return ExitCode::done;
}

ExitCode show_completion(const std::string& shell) {
  const std::string script = completion_script(shell);
  if (!script.empty()) return show(script);
  return report(
      {orca::fail(orca::Code::invalid_argument, "completion is there for bash and zsh, not for " + shell),
       ExitCode::usage});
}

ExitCode carry_out(const Call& call) {
  if (call.help) return show(call.command == nullptr ? help_text() : help_text(*call.command));
  switch (call.command->way) {
    case Way::ask: return ask(call);
    case Way::tap: return tap(call);
    case Way::offer: return offer(call);
    case Way::names: return print_names(call);
    case Way::completion: return show_completion(call.words.front());
    case Way::manual: return show(man_page(ORCA_VERSION));
  }
  return ExitCode::usage;
}

// Lack of memory, threads or descriptors is a refusal like others.
ExitCode carry_out_contained(const Call& call) {
  const orca::Result<ExitCode> code =
      orca::contain_exhaustion([&]() -> orca::Result<ExitCode> { return carry_out(call); });
  return code ? *code : report({code.error()});
}

}  // namespace

int main(int argc, char** argv) {
  const orca::Result<Call> call = parse_call({argv + 1, argv + argc});
  const ExitCode code = call ? carry_out_contained(*call) : report({call.error(), ExitCode::usage});
  const bool lost = !orca::apps::output_has_arrived();
  return static_cast<int>(code == ExitCode::done && lost ? ExitCode::refused : code);
}
