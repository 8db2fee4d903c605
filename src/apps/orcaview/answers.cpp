// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "answers.hpp"

#include <utility>

namespace orca::view {

using nlohmann::json;

json json_of(const supervisor::Record& record) {
  json object = json::object();
  for (const supervisor::Cell& cell : record) {
    switch (cell.kind) {
      case supervisor::Cell::Kind::text: object[cell.name] = cell.value; break;
      case supervisor::Cell::Kind::flag: object[cell.name] = cell.value == "true"; break;
      case supervisor::Cell::Kind::number: {
        json number = json::parse(cell.value, nullptr, false);  // "", "inf" and "nan" are none
        object[cell.name] = number.is_number() ? std::move(number) : json(nullptr);
        break;
      }
    }
  }
  return object;
}

std::string text_of(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

json read_json(const std::string& text) {
  constexpr int kDeepest = 16;
  bool is_too_deep = false;
  json message = json::parse(
      text,
      [&](int depth, json::parse_event_t, json&) {
        is_too_deep = is_too_deep || depth > kDeepest;
        return !is_too_deep;  // deeper values are dropped as they come
      },
      false);
  return is_too_deep ? json(json::value_t::discarded) : message;
}

AnswerInParts::AnswerInParts(std::uint64_t id)
    : answer_({{"op", "answer"}, {"id", id}, {"records", json::array()}, {"notes", json::array()}}) {}

void AnswerInParts::take(const supervisor::ControlAnswer& answer) {
  if (const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer))
    answer_["records"].push_back(json_of(record->record));
  if (const auto* const text = std::get_if<supervisor::TextAnswer>(&answer)) text_ += text->text;
  if (const auto* const note = std::get_if<supervisor::NoteAnswer>(&answer))
    answer_["notes"].push_back(note->text);
}

json AnswerInParts::finish(const Status& outcome) {
  answer_["ok"] = outcome.ok();
  answer_["error"] = outcome.ok() ? "" : outcome.error().text();
  answer_["text"] = text_;
  return std::move(answer_);
}

}  // namespace orca::view
