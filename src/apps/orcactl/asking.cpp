// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "asking.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "client.hpp"
#include "no_answer/orphans.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Record;

constexpr Duration kLimit = 30s;        // for a part of an answer: a process that is restarted is back before
constexpr Duration kEstopLimit = 5s;    // other machines are waited for for 2 s
constexpr Duration kSwapLimit = 120s;   // more than the limits of all its steps together
constexpr Duration kApplyLimit = 600s;  // several exchanges, each with its trial and probation
constexpr std::chrono::seconds kWatchInterval{1};
constexpr std::chrono::seconds kStubborn{1};
constexpr std::chrono::milliseconds kPause{10};
constexpr std::array<std::string_view, 3> kWithoutRecords{"graph", "ports", "stop"};  // in their answers

// Returns the request. The options of the command are words, as on the command line. Files are named so that the
// supervisor, which runs in another folder, finds them.
supervisor::Ask request_of(const apps::Call& call) {
  supervisor::Ask ask{std::string(call.command->name), call.words, call.has("--json")};
  for (std::size_t i = 0; i < ask.words.size() && i < call.command->arguments.size(); ++i)
    if (call.command->arguments[i].names == apps::Names::file)
      ask.words[i] = std::filesystem::absolute(ask.words[i]).lexically_normal().string();
  for (const apps::OptionSpec& option : call.command->options) {
    for (const std::string& value : call.all(option.name)) {
      ask.words.emplace_back(option.name);
      if (!value.empty()) ask.words.push_back(value);
    }
  }
  return ask;
}

// A line of the log as the deployer prints it.
std::string log_line(const Record& record) {
  char text[64];
  std::snprintf(text, sizeof text, "[%10s] %-7s ", record[0].value.c_str(), record[1].value.c_str());
  return text + printable(record[2].value) + ": " + printable(record[3].value) + "\n";
}

bool is_log_line(const Record& record) {
  return record.size() == 4 && record[0].name == "time" && record[3].name == "text";
}

// Collects what comes, to be printed as tables at the end; the log is printed as it comes.
class Printer {
 public:
  explicit Printer(const apps::Call& call) : call_(call), follows_(call.has("--follow")) {}

  void take(supervisor::ControlAnswer& answer) {
    if (const auto* const text = std::get_if<supervisor::TextAnswer>(&answer)) print(text->text);
    if (const auto* const note = std::get_if<supervisor::NoteAnswer>(&answer)) take_note(note->text);
    auto* const record = std::get_if<supervisor::RecordAnswer>(&answer);
    if (record == nullptr) return;
    if (!call_.has("--json") && is_log_line(record->record)) return print(log_line(record->record));
    if (follows_) return print(record_json(record->record));
    records_.push_back(std::move(record->record));
  }

  void finish() const {
    const bool is_json = call_.has("--json");
    if (call_.has("--watch") && !is_json) print(clear_screen());
    if (follows_ || std::ranges::find(kWithoutRecords, call_.command->name) != kWithoutRecords.end()) return;
    print(is_json ? table_json(records_) : table_text(records_, terminal_columns()));
    for (const std::string& note : notes_) print_note(note);
  }

 private:
  // A note stands below the answer, unless that has no end.
  void take_note(const std::string& text) { follows_ ? print_note(text) : notes_.push_back(text); }
  static void print_note(const std::string& text) { std::fprintf(stderr, "orcactl: %s\n", text.c_str()); }
  static std::string clear_screen() { return terminal_columns() > 0 ? "\x1b[H\x1b[2J" : "\n"; }

  const apps::Call& call_;
  const bool follows_;
  std::vector<Record> records_;
  std::vector<std::string> notes_;
};

// Returns the longest wait for a part of the answer.
Duration limit_of(const apps::Call& call) {
  if (call.has("--follow")) return kForEver;
  constexpr std::array<std::string_view, 4> kApplying{"apply", "connect", "disconnect", "move"};
  if (std::ranges::find(kApplying, call.command->name) != kApplying.end()) return kApplyLimit;
  if (call.command->name == "estop") return kEstopLimit;
  if (call.command->name != "swap") return kLimit;
  return kSwapLimit + call.duration("--probation").value_or(Duration{0}) +
         call.duration("--tryout").value_or(Duration{0});
}

bool is_cut_off(const Status& outcome) { return !outcome.ok() && outcome.error().code == Code::unavailable; }

Status ask_once(const apps::Call& call, Client& client) {
  Printer printer(call);
  const Status outcome = client.ask(
      request_of(call), [&](supervisor::ControlAnswer& answer) { printer.take(answer); }, limit_of(call));
  if (call.has("--follow") && is_cut_off(outcome)) return ok();
  if (outcome.ok()) printer.finish();
  return outcome;
}

// Asks to stop again, over a new connection, if the old one is lost: because too many want to talk to the system, or because it has
// ended. The motors may be stopped twice. Other commands may not be carried out twice.
Status ask_stubbornly(const apps::Call& call, Client& client) {
  const bool ends = call.command->name == "stop";
  const bool may_repeat = ends || call.command->name == "estop";
  Status outcome = ask_once(call, client);
  const auto limit = std::chrono::steady_clock::now() + kStubborn;
  while (may_repeat && is_cut_off(outcome) && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(kPause);
    std::variant<Client, Failure> again = Client::connect(call);
    if (const auto* const failure = std::get_if<Failure>(&again)) {
      if (ends && failure->error.code == Code::not_found) return ok();
    } else {
      outcome = ask_once(call, client = std::move(std::get<Client>(again)));
    }
  }
  return outcome;
}

void add_names(Client& client, const char* command, const char* cell, std::set<std::string>& names) {
  names.merge(names_of(client, command, cell));
}

}  // namespace

std::vector<std::string> components_with(Client& client, std::string_view port) {
  std::vector<std::string> components;
  for (const std::string& name : names_of(client, "names", "port"))
    if (name.ends_with(port)) components.push_back(name.substr(0, name.size() - port.size()));
  return components;
}

std::set<std::string> names_of(Client& client, const char* command, const char* cell) {
  std::set<std::string> names;
  const auto take = [&](supervisor::ControlAnswer& answer) {
    if (const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer))
      for (const supervisor::Cell& one : record->record)
        if (one.name == cell) names.insert(one.value);
  };
  (void)client.ask({command, {}, false}, take, kLimit);
  return names;
}

ExitCode report(const Failure& failure) {
  std::fprintf(stderr, "orcactl: %s\n", failure.error.text().c_str());
  return failure.code;
}

ExitCode ask(const apps::Call& call) {
  std::variant<Client, Failure> connected = Client::connect(call);
  if (auto* const failure = std::get_if<Failure>(&connected)) {
    const bool has_no_deployer = failure->code == ExitCode::no_deployer;
    const std::optional<ExitCode> obeyed = has_no_deployer ? order_orphans(call) : std::nullopt;
    return obeyed ? *obeyed : report(*failure);
  }
  for (;;) {
    const Status outcome = ask_stubbornly(call, std::get<Client>(connected));
    if (!outcome.ok()) return report({outcome.error()});
    if (!call.has("--watch")) return ExitCode::done;
    std::this_thread::sleep_for(kWatchInterval);
  }
}

ExitCode print_names(const apps::Call& call) {
  const std::string& kind = call.words.front();
  std::set<std::string> names;
  if (kind == "system") {
    for (const std::string& name : supervisor::running_systems().value_or({})) names.insert(name);
  } else {
    std::variant<Client, Failure> connected = Client::connect(call);
    if (auto* const failure = std::get_if<Failure>(&connected)) return failure->code;
    Client& client = std::get<Client>(connected);
    if (kind == "component" || kind == "group" || kind == "process") add_names(client, "ps", "name", names);
    if (kind == "group") add_names(client, "names", "group", names);
    if (kind == "process") add_names(client, "ps", "process", names);
    if (kind == "port") add_names(client, "names", "port", names);
    if (kind == "param") add_names(client, "names", "param", names);
  }
  if (call.has("--json")) {
    std::vector<Record> records;
    for (const std::string& name : names) records.push_back({{"name", name}});
    print(table_json(records));
    return ExitCode::done;
  }
  for (const std::string& name : names) print(name + "\n");
  return ExitCode::done;
}

}  // namespace orca::orcactl
