// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "tapping.hpp"

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "asking.hpp"
#include "client.hpp"
#include "figures.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/text/object_xml.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Channel;
using supervisor::Tapped;
using Clock = std::chrono::steady_clock;

constexpr Duration kSecond = 1s;

// Waits for the next object.
// @return nothing if the limit [s] has passed.
Result<std::optional<Tapped>> next(Channel& line, Duration limit) {
  Result<supervisor::Message> message = line.wait_for_message(limit);
  if (!message && message.error().code == Code::deadline_exceeded) return std::optional<Tapped>{};
  if (!message) return fail(Code::unavailable, "the process of the port has ended");
  Result<supervisor::LineWord> word = supervisor::decode_line_word(std::move(message).value());
  if (!word) return word.error();
  auto* const passed = std::get_if<Tapped>(&*word);
  if (passed == nullptr) return fail(Code::data_loss, "the process has sent something else than an object");
  return std::optional(std::move(*passed));
}

Result<std::string> text_of(const Tapped& passed, bool as_json) {
  const ObjectType* const type = find_object_type(passed.type);
  if (type == nullptr)
    return fail(Code::data_loss, "objects of the type " + passed.type + " are not known here");
  ObjectLoan object = make_object(*type);
  if (const Status read = type->deserialize(passed.object, object.get()); !read.ok()) return read.error();
  const std::string xml = to_xml(*type, object.get());
  if (!as_json) return xml + "\n";
  constexpr double kNanoseconds = 1e9;
  return record_json({{"passed", static_cast<double>(passed.passed) / kNanoseconds, 6},
                      {"created", static_cast<double>(passed.created) / kNanoseconds, 6},
                      {"type", passed.type},
                      {"bytes", passed.size},
                      {"left_out", passed.lost},
                      {"xml", xml}});
}

Status echo(Channel& line, const Call& call) {
  std::uint64_t lost = 0;
  for (std::uint64_t left = call.count("--count").value_or(UINT64_MAX); left > 0; --left) {
    Result<std::optional<Tapped>> passed = next(line, kForEver);
    if (!passed) return passed.error();
    if (!*passed) continue;
    if ((*passed)->lost > lost)
      std::fprintf(stderr, "orcactl: %llu objects were left out here\n",
                   static_cast<unsigned long long>((*passed)->lost - std::exchange(lost, (*passed)->lost)));
    const Result<std::string> text = text_of(**passed, call.json);
    if (!text) return text.error();
    print(*text);
  }
  return ok();
}

// Collects figures for a span of time [s].
Status collect(Channel& line, Duration span, PassedFigures& figures) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(span);
  for (;;) {
    const auto left = std::chrono::duration_cast<Duration>(end - Clock::now());
    if (left <= Duration{0}) return ok();
    Result<std::optional<Tapped>> passed = next(line, left);
    if (!passed) return passed.error();
    if (*passed) figures.add(**passed);
  }
}

Status measure(Channel& line, const Call& call) {
  const std::optional<Duration> whole = call.duration("--for");
  const Duration span = whole.value_or(kSecond);
  PassedFigures figures;
  for (bool is_first = true;; is_first = false) {
    if (Status collected = collect(line, span, figures); !collected.ok()) return collected;
    const supervisor::Record record =
        call.command->name == "hz" ? figures.take_rate(to_seconds(span)) : figures.take_ages();
    if (call.json) {
      print(record_json(record));
    } else {
      const std::string table = table_text({&record, 1}, 0);
      print(is_first ? table : table.substr(table.find('\n') + 1));
    }
    if (whole) return ok();
  }
}

}  // namespace

ExitCode tap(const Call& call) {
  std::variant<Client, Failure> connected = Client::connect(call.system);
  if (auto* const failure = std::get_if<Failure>(&connected)) return report(*failure);
  const bool echoes = call.command->name == "echo";
  std::vector<std::string> options{"--tap"};
  if (echoes) options.emplace_back("--objects");
  Result<supervisor::LineAnswer> opened = std::get<Client>(connected).open_line(call.words.front(), options);
  if (!opened) return report({opened.error()});
  Channel line(std::move(opened->line));
  const Status done = echoes ? echo(line, call) : measure(line, call);
  return done.ok() ? ExitCode::done : report({done.error()});
}

}  // namespace orca::orcactl
