// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "channel/fields.hpp"
#include "orca/base/contract.hpp"
#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/record.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

// A field, to or from an Archive: FieldWriter or FieldReader.

void transfer(auto& archive, std::uint64_t& value) { archive.number(value); }
void transfer(auto& archive, std::string& text) { archive.text(text); }
void transfer(auto& archive, std::vector<std::byte>& bytes) { archive.bytes(bytes); }
void transfer(auto& archive, Descriptor& descriptor) { archive.descriptor(descriptor); }

// Transfers the number of an enumerator, or of a bool.
template <class T>
void transfer_up_to(auto& archive, T& value, T last) {
  auto number = static_cast<std::uint64_t>(value);
  archive.number(number);
  archive.require(number <= static_cast<std::uint64_t>(last));
  if (number <= static_cast<std::uint64_t>(last)) value = static_cast<T>(number);
}

void transfer(auto& archive, bool& value) { transfer_up_to(archive, value, true); }
void transfer(auto& archive, log::Level& level) { transfer_up_to(archive, level, log::Level::error); }

void transfer(auto& archive, Status& status) {
  bool is_ok = status.ok();
  transfer(archive, is_ok);
  if (is_ok) return;
  Error error = status.ok() ? Error{} : status.error();
  transfer_up_to(archive, error.code, Code::internal);
  transfer(archive, error.message);
  transfer(archive, error.where);
  transfer(archive, error.param);
  status = std::move(error);
}

// Transfers a descriptor that may be missing.
void transfer_optional(auto& archive, Descriptor& descriptor) {
  bool is_there = descriptor.number() >= 0;
  transfer(archive, is_there);
  if (is_there) transfer(archive, descriptor);
}

void transfer(auto& archive, EdgeMemory& edge) {
  transfer(archive, edge.edge);
  transfer(archive, edge.memory);
  transfer(archive, edge.peer);
  transfer_optional(archive, edge.pool);
  transfer(archive, edge.peer_is_new);
}

void transfer(auto& archive, Duration& time) {
  auto number = static_cast<std::uint64_t>(time.count());
  archive.number(number);
  time = Duration(static_cast<Duration::rep>(number));
}

void transfer(auto& archive, std::uint32_t& value) {
  std::uint64_t number = value;
  archive.number(number);
  archive.require(number <= std::numeric_limits<std::uint32_t>::max());
  value = static_cast<std::uint32_t>(number);
}

void transfer(auto& archive, graph::PortRef& port) {
  transfer(archive, port.component);
  transfer(archive, port.port);
}

void transfer(auto& archive, QueuePolicy& policy) {
  transfer(archive, policy.depth);
  archive.require(policy.depth > 0);
  transfer_up_to(archive, policy.overflow, QueuePolicy::Overflow::refuse);
  transfer(archive, policy.min_interval);
  transfer(archive, policy.deadline);
  transfer(archive, policy.block_limit);
  transfer(archive, policy.drop_limit);
  transfer_up_to(archive, policy.confirm, QueuePolicy::Confirm::handled);
}

void transfer(auto& archive, graph::Edge& edge) {
  transfer(archive, edge.from);
  transfer(archive, edge.to);
  transfer_up_to(archive, edge.pattern, Pattern::send);
  transfer(archive, edge.queue);
  transfer(archive, edge.interval);
  transfer(archive, edge.late_bound);
  transfer_up_to(archive, edge.link, graph::Link::dds);
  transfer(archive, edge.choice);
}

void transfer(auto& archive, EdgeChange& change) {
  transfer(archive, change.edge);
  transfer(archive, change.makes);
  transfer_optional(archive, change.memory);
}

template <class T>
void transfer(auto& archive, std::optional<T>& value) {
  bool is_there = value.has_value();
  transfer(archive, is_there);
  if (!is_there) return value.reset();
  T content = value.value_or(T{});
  transfer(archive, content);
  value = std::move(content);
}

void transfer(auto& archive, int& value) {
  auto number = static_cast<std::uint32_t>(value);
  transfer(archive, number);
  value = static_cast<int>(number);
}

void transfer(auto& archive, std::int64_t& value) {
  auto number = static_cast<std::uint64_t>(value);
  archive.number(number);
  value = static_cast<std::int64_t>(number);
}

void transfer(auto& archive, double& value) {
  auto number = std::bit_cast<std::uint64_t>(value);
  archive.number(number);
  value = std::bit_cast<double>(number);
}

template <std::size_t index = 0>
void make_alternative(ParamValue& value, std::uint64_t wanted) {
  if constexpr (index < std::variant_size_v<ParamValue>)
    wanted == index ? void(value.emplace<index>()) : make_alternative<index + 1>(value, wanted);
}

void transfer(auto& archive, ParamValue& value) {
  std::uint64_t alternative = value.index();
  archive.number(alternative);
  archive.require(alternative < std::variant_size_v<ParamValue>);
  if (alternative != value.index()) make_alternative(value, alternative);
  std::visit([&](auto& content) { transfer(archive, content); }, value);
}

void transfer(auto& archive, ParamContract& param) {
  transfer_up_to(archive, param.type, ParamType::text_list);
  transfer_all(archive, param.name, param.unit, param.min, param.max, param.choices, param.file, param.fixed,
               param.default_value, param.text);
}

void transfer(auto& archive, Trigger& trigger) {
  transfer_up_to(archive, trigger.kind, Trigger::Kind::on_stamps);
  transfer(archive, trigger.period);
  transfer(archive, trigger.ports);
  transfer(archive, trigger.within);
}

// What a component may subscribe to by name is not transferred.
void transfer(auto& archive, graph::PortSetting& setting) {
  transfer_all(archive, setting.alias, setting.topic, setting.message);
}

void transfer(auto& archive, graph::ComponentNode& node) {
  transfer_all(archive, node.name, node.type, node.hardware, node.process, node.priority, node.autonomous,
               node.watchable, node.trigger, node.restore_last, node.may_set, node.may_suspend);
  std::vector<std::pair<std::string, graph::PortSetting>> ports(node.ports.begin(), node.ports.end());
  transfer(archive, ports);
  for (auto& [port, setting] : ports) node.ports[port] = std::move(setting);
}

void transfer(auto& archive, Cell& cell) {
  transfer(archive, cell.name);
  transfer(archive, cell.value);
  transfer_up_to(archive, cell.kind, Cell::Kind::flag);
}

void transfer(auto& archive, StateKept& kept) {
  transfer(archive, kept.component);
  transfer(archive, kept.type);
  transfer(archive, kept.version);
  transfer(archive, kept.state);
}

void transfer(auto& archive, LogLine& line) {
  transfer(archive, line.level);
  transfer(archive, line.who);
  transfer(archive, line.text);
  transfer(archive, line.time);
}

void transfer(auto& archive, Counts& counts);

template <class A, class B>
void transfer(auto& archive, std::pair<A, B>& pair) {
  transfer(archive, pair.first);
  transfer(archive, pair.second);
}

template <class T>
void transfer(auto& archive, std::vector<T>& list) {
  std::uint64_t count = list.size();
  archive.number(count);
  archive.resize(list, count);
  for (T& element : list) transfer(archive, element);
}

void transfer(auto& archive, Counts& counts) {
  transfer(archive, counts.name);
  transfer(archive, counts.numbers);
}

void transfer_all(auto& archive, auto&... fields) { (transfer(archive, fields), ...); }

// Encodes one of the words. Each has an overload of fields().
template <class Words>
Message encode_any(Words& words, std::uint64_t request) {
  return std::visit(
      [&](auto& word) {
        Message message{std::decay_t<decltype(word)>::kKind, request, {}, {}};
        FieldWriter writer(message);
        fields(writer, word);
        return message;
      },
      words);
}

inline Error wrong(const Message& message, const std::string& what) {
  return fail(Code::data_loss, "a message of kind " + std::to_string(static_cast<unsigned>(message.kind)) +
                                   " of the control channel " + what);
}

// Decodes the message into `words` if it is of the kind of Word. Returns whether it is.
template <class Word, class Words>
bool decode_as(Message& message, Words& words, bool& is_complete) {
  if (message.kind != Word::kKind) return false;
  FieldReader reader(message);
  fields(reader, words.template emplace<Word>());
  is_complete = reader.is_complete();
  return true;
}

// Decodes a message that is one of the words.
// @errors  data_loss.
template <class... Word>
Result<std::variant<Word...>> decode_any(Message& message, std::variant<Word...> words) {
  bool is_complete = false;
  if (!(decode_as<Word>(message, words, is_complete) || ...)) return wrong(message, "is not known here");
  if (!is_complete) return wrong(message, "is damaged");
  return words;
}

}  // namespace orca::supervisor
