// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/control.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "channel/transfer.hpp"

namespace orca::supervisor {

Cell::Cell(std::string called, double number, int digits) : name(std::move(called)), kind(Kind::number) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, number);
  value = text;
}

namespace {

// The word stands in the audit log, of which nobody may forge a line.
bool is_short_word(const std::string& word) {
  constexpr std::size_t kLongest = 32;
  return word.size() <= kLongest &&
         std::ranges::all_of(word, [](char each) { return each >= 'a' && each <= 'z'; });
}

}  // namespace

const char* to_string(Access access) {
  switch (access) {
    case Access::none: return "none";
    case Access::observe: return "observe";
    case Access::operate: return "operate";
    case Access::change: return "change";
  }
  return "?";
}

void fields(auto& archive, Ask& m) {
  transfer_all(archive, m.command, m.words, m.as_json);
  transfer_up_to(archive, m.most, Access::change);
  transfer(archive, m.via);
  archive.require(is_short_word(m.via));
}
void fields(auto& archive, RecordAnswer& m) { transfer(archive, m.record); }
void fields(auto& archive, TextAnswer& m) { transfer(archive, m.text); }
void fields(auto& archive, NoteAnswer& m) { transfer(archive, m.text); }
void fields(auto& archive, LineAnswer& m) { transfer_all(archive, m.line, m.type, m.reply, m.ports); }
void fields(auto& archive, EndAnswer& m) { transfer(archive, m.outcome); }
void fields(auto& archive, Tapped& m) {
  transfer_all(archive, m.type, m.object, m.passed, m.created, m.size, m.lost, m.place);
}
void fields(auto& /*archive*/, EndLine& /*m*/) {}
void fields(auto& archive, LineEnded& m) { transfer(archive, m.lost); }
void fields(auto& archive, Offer& m) { transfer_all(archive, m.type, m.object); }
void fields(auto& archive, OfferOutcome& m) { transfer_all(archive, m.outcome, m.type, m.object); }

Message encode(Ask ask, std::uint64_t request) {
  std::variant<Ask> words(std::move(ask));
  return encode_any(words, request);
}
Message encode(ControlAnswer answer, std::uint64_t request) { return encode_any(answer, request); }
Message encode(LineWord word, std::uint64_t request) { return encode_any(word, request); }

Result<Ask> decode_ask(Message message) {
  Result<std::variant<Ask>> decoded = decode_any(message, std::variant<Ask>{});
  if (!decoded) return decoded.error();
  return std::get<Ask>(std::move(decoded).value());
}
Result<ControlAnswer> decode_answer(Message message) { return decode_any(message, ControlAnswer{}); }
Result<LineWord> decode_line_word(Message message) { return decode_any(message, LineWord{}); }

}  // namespace orca::supervisor
