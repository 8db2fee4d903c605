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
#include "following.hpp"
#include "object_learning.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/text/object_table.hpp"
#include "orca/text/object_xml.hpp"
#include "orca/xml/names.hpp"
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
  Result<Tapped> passed = tapped(std::move(message).value());
  if (!passed) return passed.error();
  return std::optional(std::move(*passed));
}

// Returns the values of a field of an object, with a blank between those of a list.
Result<std::string> field_of(const ObjectType& type, const void* object, const std::string& field) {
  const auto texts = field_texts(type, object, field);
  if (!texts) {
    const std::vector<std::string> names = field_names(type, object);
    const auto nearest = xml::nearest_name(field, names);
    return fail(Code::not_found, std::string(type.name) + " has no field " + in_quotes(field) +
                                     (nearest ? xml::did_you_mean(nearest) : "; it has: " + listed(names)));
  }
  std::string line;
  for (const FieldText& one : *texts) line += (line.empty() ? "" : " ") + one.text;
  return line;
}

Result<std::string> text_of(const Tapped& passed, const apps::Call& call) {
  const Result<ObjectRef> object = object_of(passed);
  if (!object) return object.error();
  const std::optional<std::string> field = call.text("--field");
  const Result<std::string> shown = field ? field_of(object->type(), object->get(), *field)
                                          : Result<std::string>(to_xml(object->type(), object->get()));
  if (!shown) return shown.error();
  if (!call.has("--json")) return *shown + "\n";
  constexpr double kNanoseconds = 1e9;
  return record_json({{"passed", static_cast<double>(passed.passed) / kNanoseconds, 6},
                      {"created", static_cast<double>(passed.created) / kNanoseconds, 6},
                      {"type", passed.type},
                      {"bytes", passed.size},
                      {"left_out", passed.lost},
                      {field ? "value" : "xml", *shown}});
}

Status echo(Channel& line, const apps::Call& call) {
  const std::optional<Duration> whole = call.duration("--for");
  const auto begin = Clock::now();
  std::uint64_t lost = 0;
  std::uint64_t seen = 0;
  for (const std::uint64_t most = call.count("--count").value_or(UINT64_MAX); seen < most; ++seen) {
    const auto left = whole ? *whole - std::chrono::duration_cast<Duration>(Clock::now() - begin) : kForEver;
    if (left <= Duration{0}) break;
    Result<std::optional<Tapped>> passed = next(line, left);
    if (!passed) return passed.error();
    if (!*passed) break;
    if ((*passed)->lost > lost)
      std::fprintf(stderr, "orcactl: %llu objects were left out here\n",
                   static_cast<unsigned long long>((*passed)->lost - std::exchange(lost, (*passed)->lost)));
    const Result<std::string> text = text_of(**passed, call);
    if (!text) return text.error();
    print(*text);
  }
  if (seen == 0)
    std::fprintf(stderr,
                 "orcactl: nothing has passed %s in this time; a component that nobody uses works for "
                 "whoever looks only "
                 "with watchable=\"true\" in the graph\n",
                 call.words.front().c_str());
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

Status measure(Channel& line, const apps::Call& call) {
  const std::optional<Duration> whole = call.duration("--for");
  const Duration span = whole.value_or(kSecond);
  PassedFigures figures;
  for (bool is_first = true;; is_first = false) {
    if (Status collected = collect(line, span, figures); !collected.ok()) return collected;
    const supervisor::Record record =
        call.command->name == "hz" ? figures.take_rate(to_seconds(span)) : figures.take_ages();
    if (call.has("--json")) {
      print(record_json(record));
    } else {
      const std::string table = table_text({&record, 1}, 0);
      print(is_first ? table : table.substr(table.find('\n') + 1));
    }
    if (whole) return ok();
  }
}

// latency looks at one port, or from one to another.
Status names_ports(const apps::Call& call) {
  const std::string command(call.command->name);
  if (call.has("--from") != call.has("--to"))
    return fail(Code::invalid_argument, command + " needs --from PORT and --to PORT together");
  if (call.words.empty() && !call.has("--from"))
    return fail(Code::invalid_argument, command + " needs PORT, or --from PORT and --to PORT");
  if (!call.words.empty() && call.has("--from"))
    return fail(Code::invalid_argument, command + " takes PORT, or --from PORT and --to PORT, not both");
  return ok();
}

}  // namespace

Result<Tapped> tapped(supervisor::Message message) {
  Result<supervisor::LineWord> word = supervisor::decode_line_word(std::move(message));
  if (!word) return word.error();
  auto* const passed = std::get_if<Tapped>(&*word);
  if (passed == nullptr) return fail(Code::data_loss, "the process has sent something else than an object");
  return std::move(*passed);
}

Result<ObjectRef> object_of(const Tapped& passed) {
  const ObjectType* const type = find_object_type(passed.type);
  if (type == nullptr)
    return fail(Code::data_loss,
                "objects of the type " + passed.type +
                    " are not known here; orcactl objects shows which libraries the system has");
  ObjectLoan object = make_object(*type);
  if (const Status read = type->deserialize(passed.object, object.get()); !read.ok()) return read.error();
  return std::move(object).seal();
}

ExitCode tap(const apps::Call& call) {
  if (const Status named = names_ports(call); !named.ok()) return report({named.error(), ExitCode::usage});
  std::variant<Client, Failure> connected = Client::connect(call);
  if (auto* const failure = std::get_if<Failure>(&connected)) return report(*failure);
  if (call.has("--from")) {
    learn_objects(call);
    const Status done = follow(std::get<Client>(connected), call);
    return done.ok() ? ExitCode::done : report({done.error()});
  }
  const bool echoes = call.command->name == "echo";
  if (echoes) learn_objects(call);
  std::vector<std::string> options{"--tap"};
  if (echoes) options.emplace_back("--objects");
  Result<supervisor::LineAnswer> opened = std::get<Client>(connected).open_line(call.words.front(), options);
  if (!opened) return report({opened.error()});
  Channel line(std::move(opened->line));
  const Status done = echoes ? echo(line, call) : measure(line, call);
  return done.ok() ? ExitCode::done : report({done.error()});
}

}  // namespace orca::orcactl
