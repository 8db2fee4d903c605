// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "orca/base/text.hpp"
#include "orca/xml/values.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

constexpr std::array kStrategies{Strategy::one_for_one, Strategy::rest_for_one, Strategy::one_for_all};
constexpr std::array kRestarts{Restart::permanent, Restart::transient, Restart::temporary};

// Sets `choice` to the one that the attribute names, if it does.
template <class Choices, class Choice>
void read_choice(const Node& node, const char* name, const Choices& choices, Choice& choice, Report& report) {
  const auto text = read_attribute<std::string>(node, name, report);
  for (const Choice one : choices)
    if (text == to_string(one)) choice = one;
}

void read_time(const Node& node, const char* name, Duration& time, Report& report) {
  if (const auto seconds = read_attribute<double>(node, name, report)) time = from_seconds(*seconds);
}

std::optional<int> read_int(const Node& node, const char* name, Report& report) {
  const auto value = read_attribute<std::int64_t>(node, name, report);
  return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

// A reader for one process. Each process needs a new one.
class ProcessReader {
 public:
  ProcessReader(const Node& node, const Model& model, Report& report)
      : node_(node), model_(model), report_(report) {}

  CheckedProcess read() {
    ProcessNode& value = checked_.value;
    value.name = node_.value("name");
    value.position = node_.position;
    check_name(node_, "name", report_);
    if (read_attribute<std::string>(node_, "executor", report_) == "fiber") value.executor = Backend::fiber;
    read_time(node_, "spin", value.spin, report_);
    read_time(node_, "hang_limit", value.hang_limit, report_);
    read_time(node_, "delay", value.delay, report_);
    value.priority = read_int(node_, "priority", report_);
    value.cores = static_cast<std::uint32_t>(read_int(node_, "cores", report_).value_or(0));
    value.lock_memory = read_attribute<bool>(node_, "lock_memory", report_).value_or(false);
    if (const auto bytes = read_attribute<double>(node_, "memory", report_))
      value.memory = static_cast<std::uint64_t>(std::llround(*bytes));
    read_choice(node_, "restart", kRestarts, value.restart, report_);
    read_demand();
    read_processors();
    read_machine();
    return std::move(checked_);
  }

 private:
  void read_demand() {
    constexpr Duration kIdleTime = std::chrono::seconds(10);
    ProcessNode& value = checked_.value;
    const auto start = read_attribute<std::string>(node_, "start", report_);
    value.on_demand = start == "on_demand";
    const bool warm = read_attribute<std::string>(node_, "stay", report_) == "warm";
    const auto idle_time = read_attribute<double>(node_, "idle_time", report_);
    if (start == "at_once" || node_.find("start") == nullptr) return check_never_idle();
    if (value.on_demand && !warm) value.idle_time = idle_time ? from_seconds(*idle_time) : kIdleTime;
  }

  void check_never_idle() {
    for (const char* name : {"stay", "idle_time"})
      if (node_.find(name) != nullptr)
        report_.error(codes::kLoading, node_.place(name),
                      node_.title() + ": " + name +
                          " is for a process with start=\"on_demand\"; without that it runs all the time");
  }

  void read_processors() {
    const Text* text = node_.known("processors");
    if (text == nullptr) return;
    std::vector<int>& processors = checked_.value.processors;
    for (const std::string& part : split_names(text->value)) {
      const auto number = read_processor(part, text->position);
      if (!number) return;
      if (std::ranges::find(processors, *number) == processors.end()) processors.push_back(*number);
    }
  }

  std::optional<int> read_processor(const std::string& part, const xml::Position& place) {
    static constexpr xml::ValueRule kNumber{.form = xml::ValueRule::Form::integer, .min = 0, .max = 1023};
    xml::ValueFault fault;
    if (const auto number = xml::read_integer(part, kNumber, fault)) return static_cast<int>(*number);
    report_.error(xml::code_of(fault.kind, graph_rules().codes), place,
                  node_.title() + ": processors: " + fault.message);
    return std::nullopt;
  }

  void read_machine() {
    const Text* name = node_.find("machine");
    checked_.placed = false;
    if (name != nullptr && !name->known) return;
    if (name == nullptr || name->value.empty()) {
      checked_.placed = model_.machines.empty();
      if (!checked_.placed) report_no_machine();
    } else if (std::ranges::find(model_.machine_names, name->value) != model_.machine_names.end()) {
      checked_.value.machine = name->value;
      checked_.placed = true;
    } else {
      report_unknown(node_, *name, codes::kUnknownMachine, "machine", model_.machine_names, "", model_,
                     report_);
    }
  }

  void report_no_machine() {
    report_.error(
        codes::kNoMachine, node_.place("machine"),
        node_.title() + " names no machine; add machine=\"NAME\", one of: " + listed(model_.machine_names));
  }

  const Node& node_;
  const Model& model_;
  Report& report_;
  CheckedProcess checked_;
};

bool is_word_of_host_name(const std::string& word) {
  return !word.empty() && word.size() <= 63 && word.front() != '-' && word.back() != '-' &&
         std::ranges::all_of(word, [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
         });
}

// Returns whether a text may be a host name: words of letters, digits and '-', joined by dots (RFC 1123). What looks like an
// IPv4 address is none.
bool may_be_host_name(const std::string& text) {
  if (text.size() > 253 || text.back() == '.' || text.find_first_not_of("0123456789.") == std::string::npos)
    return false;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, '.');)
    if (!is_word_of_host_name(word)) return false;
  return true;
}

bool may_be_address(const std::string& text) {
  in6_addr bytes{};
  return inet_pton(AF_INET, text.c_str(), &bytes) == 1 || inet_pton(AF_INET6, text.c_str(), &bytes) == 1 ||
         may_be_host_name(text);
}

void check_network(const Node& node, Report& report) {
  const Text* const address = node.known("address");
  if (address != nullptr && !address->value.empty() && !may_be_address(address->value))
    report.error(codes::kBadValue, address->position,
                 node.title() + ": address: " + in_quotes(address->value) +
                     " is neither an IP address nor a host name; write one, as in address=\"10.0.0.2\", or "
                     "leave it out");
  const Text* const interface = node.known("interface");
  constexpr std::size_t kMost = 15;  // characters that Linux allows
  if (interface != nullptr &&
      (interface->value.size() > kMost || interface->value.find_first_of("/ \t\n:") != std::string::npos))
    report.error(
        codes::kBadValue, interface->position,
        node.title() + ": interface: " + in_quotes(interface->value) +
            " is no name of a network interface, such as wlan0; \"ip link\" shows those of a machine");
}

MachineNode read_machine(const Node& node, Report& report) {
  MachineNode machine;
  machine.name = node.value("name");
  machine.address = node.value("address");
  machine.interface = node.value("interface");
  machine.position = node.position;
  check_name(node, "name", report);
  check_network(node, report);
  if (read_attribute<std::string>(node, "on_loss", report) == "go_on") machine.on_loss = OnLoss::go_on;
  read_time(node, "loss_limit", machine.loss_limit, report);
  read_time(node, "delay", machine.delay, report);
  return machine;
}

}  // namespace

Supervision read_supervision(const Node& root, Report& report) {
  Supervision supervision;
  read_choice(root, "strategy", kStrategies, supervision.strategy, report);
  if (const auto restarts = read_int(root, "restarts", report)) supervision.restarts = *restarts;
  read_time(root, "within", supervision.within, report);
  if (read_attribute<std::string>(root, "on_supervisor_loss", report) == "continue")
    supervision.on_supervisor_loss = OnLoss::go_on;
  read_time(root, "adoption_wait", supervision.adoption_wait, report);
  read_time(root, "machine_wait", supervision.machine_wait, report);
  return supervision;
}

void check_machines(const std::vector<Node>& nodes, Model& model, Report& report) {
  for (const Node& node : nodes) {
    model.machines.push_back(read_machine(node, report));
    const std::string& name = model.machines.back().name;
    if (!name.empty() && !node.duplicate) model.machine_names.push_back(name);
  }
  model.implicit_main.placed = nodes.empty();
}

void check_processes(const std::vector<Node>& nodes, Model& model, Report& report) {
  for (const Node& node : nodes) {
    const bool by_name = !node.value("name").empty() && !node.duplicate;
    model.add(ProcessReader(node, model, report).read(), by_name);
  }
}

}  // namespace orca::graph
