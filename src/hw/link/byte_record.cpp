// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/byte_record.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "orca/base/text.hpp"

namespace orca::hw::link {
namespace {

using Kind = ByteRecord::Kind;

struct Word {
  std::string_view name;
  Kind kind;
  enum Rest { nothing, bytes, text } rest;
};

constexpr std::array<Word, 7> kWords{{{"open", Kind::open, Word::nothing},
                                      {"in", Kind::in, Word::bytes},
                                      {"dropped", Kind::dropped, Word::bytes},
                                      {"out", Kind::out, Word::bytes},
                                      {"gone", Kind::gone, Word::text},
                                      {"close", Kind::close, Word::nothing},
                                      {"full", Kind::full, Word::text}}};
constexpr std::size_t kBytesPerLine = 32;
constexpr std::size_t kDecimals = 6;
constexpr std::size_t kMostSecondDigits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<unsigned> hex_digit(char c) {
  if (is_digit(c)) return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return std::nullopt;
}

// Takes the text up to the next space off the front, and the spaces behind it.
std::string_view take_field(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view field = line.substr(0, end);
  line.remove_prefix(std::min(line.find_first_not_of(' ', end), line.size()));
  return field;
}

std::optional<std::int64_t> read_number(std::string_view digits) {
  std::int64_t value = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

std::optional<Duration> read_time(std::string_view field) {
  const std::size_t point = field.find('.');
  if (point == 0 || point > kMostSecondDigits || field.size() != point + 1 + kDecimals) return std::nullopt;
  const auto whole = read_number(field.substr(0, point));
  const auto micros = read_number(field.substr(point + 1));
  if (!whole || !micros) return std::nullopt;
  return std::chrono::seconds(*whole) + std::chrono::microseconds(*micros);
}

Status read_bytes(std::string_view rest, std::vector<std::uint8_t>& bytes) {
  while (!rest.empty()) {
    const std::string_view field = take_field(rest);
    const auto high = hex_digit(field.front());
    const auto low = field.size() == 2 ? hex_digit(field.back()) : std::nullopt;
    if (!high || !low)
      return fail(Code::invalid_argument, in_quotes(field) + " is no byte; write two hexadecimal digits");
    bytes.push_back(static_cast<std::uint8_t>(*high * 16 + *low));
  }
  if (bytes.empty()) return fail(Code::invalid_argument, "there are no bytes behind the word");
  return ok();
}

Error unknown_word(std::string_view word) {
  std::vector<std::string> known;
  for (const Word& each : kWords) known.emplace_back(each.name);
  return fail(Code::invalid_argument,
              in_quotes(word) + " is no word of a byte log; words are " + listed(known));
}

Result<ByteRecord> read_record(std::string_view line) {
  ByteRecord record;
  const std::string_view when = take_field(line);
  const std::optional<Duration> time = read_time(when);
  if (!time)
    return fail(Code::invalid_argument,
                in_quotes(when) + " is no time; write seconds with six decimals, such as 0.014871");
  record.time = *time;
  const std::string_view name = take_field(line);
  const auto* const word = std::ranges::find(kWords, name, &Word::name);
  if (word == kWords.end()) return unknown_word(name);
  record.kind = word->kind;
  if (word->rest == Word::text) record.text = line;
  if (word->rest == Word::nothing && !line.empty())
    return fail(Code::invalid_argument,
                in_quotes(line) + " stands behind \"" + std::string(name) + "\", where nothing belongs");
  if (word->rest == Word::bytes)
    if (const Status read = read_bytes(line, record.bytes); !read.ok()) return read.error();
  return record;
}

// What must hold between a record and those before it.
Status check_order(const ByteRecord& record, const std::vector<ByteRecord>& before) {
  if (before.empty()) return ok();
  if (record.time < before.back().time)
    return fail(Code::invalid_argument, "the time is earlier than that of the line before");
  if (before.back().kind == Kind::full)
    return fail(Code::invalid_argument, "a line follows \"full\", which is the last one");
  return ok();
}

std::string head_of(const ByteRecord& record, std::string_view name) {
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(record.time).count();
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%lld.%06lld %-4.*s", static_cast<long long>(micros / 1'000'000),
                static_cast<long long>(micros % 1'000'000), static_cast<int>(name.size()), name.data());
  return text.data();
}

std::string in_hex(std::uint8_t byte) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  return {' ', kDigits[byte >> 4U], kDigits[byte & 0x0FU]};
}

}  // namespace

std::string to_lines(const ByteRecord& record) {
  const auto* const word = std::ranges::find(kWords, record.kind, &Word::kind);
  std::string head = head_of(record, word->name);
  if (word->rest == Word::nothing) return head.substr(0, head.find_last_not_of(' ') + 1) + "\n";
  if (word->rest == Word::text) return head + " " + printable(record.text) + "\n";
  std::string lines;
  for (std::size_t i = 0; i < record.bytes.size(); ++i) {
    if (i % kBytesPerLine == 0) lines += (i == 0 ? "" : "\n") + head;
    lines += in_hex(record.bytes[i]);
  }
  return lines + "\n";
}

Result<std::vector<ByteRecord>> read_byte_log(std::string_view text) {
  std::vector<ByteRecord> records;
  for (std::size_t number = 1; text.find('\n') != std::string_view::npos; ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() + 1);
    const std::string where = "line " + std::to_string(number);
    if (number == 1 && line != kByteLogTitle)
      return fail(Code::invalid_argument,
                  "this is no byte log, which begins with \"" + std::string(kByteLogTitle) + "\"", where);
    if (line.empty() || line.front() == '#') continue;
    Result<ByteRecord> record = read_record(line);
    const Status fits = record ? check_order(*record, records) : Status(record.error());
    if (!fits.ok()) return fail(fits.error().code, fits.error().message, where);
    records.push_back(std::move(*record));
  }
  if (records.empty() && !text.empty())
    return fail(Code::invalid_argument, "this is no byte log: not one whole line with an event is in it");
  return records;
}

}  // namespace orca::hw::link
