// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/vocabulary.hpp"

#include <type_traits>

#include "channel/fields.hpp"

namespace orca::supervisor {
namespace {

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

void transfer(auto& archive, EdgeMemory& edge) {
  transfer(archive, edge.edge);
  transfer(archive, edge.memory);
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

// The fields of each order and each report.

void fields(auto& archive, Setup& m) {
  transfer_all(archive, m.process, m.graph, m.options, m.run_page, m.edges);
}
void fields(auto& /*archive*/, Build& /*m*/) {}
void fields(auto& /*archive*/, OpenHardware& /*m*/) {}
void fields(auto& archive, Configure& m) { transfer(archive, m.component); }
void fields(auto& /*archive*/, OpenGates& /*m*/) {}
void fields(auto& /*archive*/, TakeDown& /*m*/) {}
void fields(auto& archive, StopMotors& m) { transfer(archive, m.reason); }
void fields(auto& archive, Suspend& m) { transfer(archive, m.component); }
void fields(auto& archive, Resume& m) { transfer(archive, m.component); }
void fields(auto& archive, SetParams& m) { transfer_all(archive, m.component, m.values); }
void fields(auto& archive, RenewEdge& m) { transfer(archive, m.edge); }
void fields(auto& archive, CutEdge& m) { transfer_all(archive, m.edge, m.reason); }
void fields(auto& archive, TellAlarm& m) { transfer_all(archive, m.process, m.object); }
void fields(auto& archive, ForgetAlarm& m) { transfer_all(archive, m.kind, m.source, m.process); }

void fields(auto& archive, Answer& m) { transfer(archive, m.outcome); }
void fields(auto& archive, Built& m) { transfer(archive, m.robots); }
void fields(auto& archive, StateChange& m) {
  transfer_all(archive, m.component, m.state, m.failure, m.has_worked, m.has_failed, m.ended_badly);
}
void fields(auto& archive, RestChange& m) { transfer(archive, m.at_rest); }
template <Kind kind>
void fields(auto& archive, ObjectReport<kind>& m) {
  transfer(archive, m.object);
}
void fields(auto& archive, Logged& m) { transfer_all(archive, m.level, m.who, m.text); }
void fields(auto& archive, LastWordsReport& m) { transfer(archive, m.text); }
void fields(auto& archive, Tally& m) { transfer_all(archive, m.edges, m.clients, m.servers, m.ways); }
void fields(auto& archive, OutputFailed& m) { transfer(archive, m.outcome); }
void fields(auto& archive, Glance& m) { transfer_all(archive, m.unwell, m.goals); }
void fields(auto& archive, Prompting& m) { transfer(archive, m.begins); }

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

Error wrong(const Message& message, const std::string& what) {
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

template <class... Word>
Result<std::variant<Word...>> decode_any(Message& message, std::variant<Word...> words) {
  bool is_complete = false;
  if (!(decode_as<Word>(message, words, is_complete) || ...)) return wrong(message, "is not known here");
  if (!is_complete) return wrong(message, "is damaged");
  return words;
}

}  // namespace

Message encode(Order order, std::uint64_t request) { return encode_any(order, request); }
Message encode(Report report, std::uint64_t request) { return encode_any(report, request); }

Result<Order> decode_order(Message message) { return decode_any(message, Order{}); }
Result<Report> decode_report(Message message) { return decode_any(message, Report{}); }

}  // namespace orca::supervisor
