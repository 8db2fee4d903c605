// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/replay_link.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "orca/base/input_file.hpp"
#include "orca/hw/link/byte_record.hpp"

namespace orca::hw::link {
namespace {

constexpr std::size_t kMostFile = std::size_t{256} << 20;  // [bytes]
constexpr std::size_t kMostWritten = kMostFile;            // kept for the comparison [bytes]

std::string hex_at(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  if (at >= bytes.size()) return "nothing";
  std::array<char, 4> text{};
  std::snprintf(text.data(), text.size(), "%02x", bytes[at]);
  return text.data();
}

}  // namespace

ReplayLink::ReplayLink(ReplayOptions options) : options_(std::move(options)) {}

ReplayLink::~ReplayLink() = default;

Result<Opening> ReplayLink::open() {
  if (open_) return Opening::done;
  if (const Status read = load(); !read.ok()) return read.error();
  if (played_ == sessions_.size())
    return fail(
        Code::unavailable,
        "the recording holds " + std::to_string(sessions_.size()) + " sessions, and all have been played",
        name());
  ++played_;
  open_ = true;
  start_ = options_.now();
  read_ = 0;
  written_.clear();
  agrees_ = true;
  return Opening::done;
}

Status ReplayLink::load() {
  if (loaded_) return ok();
  const Result<std::string> text = read_input_file(options_.file, kMostFile);
  if (!text) return fail(text.error().code, "cannot read the recording: " + text.error().message, name());
  const Result<std::vector<ByteRecord>> records = read_byte_log(*text);
  if (!records)
    return fail(records.error().code, records.error().message, options_.file + ", " + records.error().where);
  Duration begin{};
  for (const ByteRecord& record : *records) {
    if (record.kind == ByteRecord::Kind::open || sessions_.empty()) {
      begin = record.time;
      sessions_.emplace_back().ending = "the recording ends here";
    }
    Session& session = sessions_.back();
    session.length = record.time - begin;
    if (record.kind == ByteRecord::Kind::in) {
      session.in.insert(session.in.end(), record.bytes.begin(), record.bytes.end());
      session.pieces.push_back({session.length, session.in.size(), session.out.size()});
    } else if (record.kind == ByteRecord::Kind::out) {
      session.out.insert(session.out.end(), record.bytes.begin(), record.bytes.end());
    } else if (record.kind == ByteRecord::Kind::gone) {
      session.ending = record.text;
    }
  }
  find_rates(*text);
  loaded_ = true;
  return ok();
}

// A logged link remarks each rate that its line was set to.
void ReplayLink::find_rates(std::string_view text) {
  constexpr std::string_view kRemark = "\n# line: ";
  for (std::size_t at = text.find(kRemark); at != std::string_view::npos; at = text.find(kRemark, at)) {
    at += kRemark.size();
    std::uint32_t baud = 0;
    if (std::from_chars(text.data() + at, text.data() + text.size(), baud).ec == std::errc())
      rates_.insert(baud);
  }
  rates_.erase(0);
}

Status ReplayLink::set_line(const Line& line) {
  if (!rates_.empty() && !rates_.contains(line.baud))
    return fail(Code::invalid_argument,
                "the recorded line was not set to " + std::to_string(line.baud) + " baud", name());
  line_ = line;
  return ok();
}

double ReplayLink::byte_time() const {
  const double bits = line_.parity == Parity::none ? 10.0 : 11.0;
  return rates_.empty() ? 0.0 : bits / line_.baud;
}

void ReplayLink::close() { open_ = false; }

Result<std::size_t> ReplayLink::read(std::span<std::uint8_t> into) {
  if (!open_) return not_open(*this);
  const std::size_t count = std::min(into.size(), due() - read_);
  const auto first = session().in.begin() + static_cast<std::ptrdiff_t>(read_);
  std::copy(first, first + static_cast<std::ptrdiff_t>(count), into.begin());
  read_ += count;
  if (count > 0 || into.empty()) return count;
  if (const Status open = check_open(); !open.ok()) return open.error();
  return 0;
}

// Returns where in the session's input what has come by now ends.
std::size_t ReplayLink::due() const {
  const auto& pieces = session().pieces;
  const auto first = std::ranges::lower_bound(pieces, read_ + 1, {}, &Piece::end);
  const auto later =
      std::find_if_not(first, pieces.end(), [this](const Piece& piece) { return is_due(piece); });
  return later == first ? read_ : std::prev(later)->end;
}

// A driver that writes something else, or nothing, is not waited for.
bool ReplayLink::is_due(const Piece& piece) const {
  const Duration late = options_.now() - start_ - piece.time;
  if (late < Duration{0}) return false;
  const bool follows = !written_.empty() && agrees_;
  return !follows || written_.size() >= piece.behind || late > kMostLag;
}

Status ReplayLink::check_open() const {
  if (!open_) return not_open(*this);
  const bool over = options_.now() - start_ >= session().length;
  return over ? Status(fail(Code::unavailable, session().ending, name())) : ok();
}

Status ReplayLink::write(std::span<const std::uint8_t> bytes) {
  if (Status open = check_open(); !open.ok()) return open;
  if (Status fits = check_size(*this, bytes.size()); !fits.ok()) return fits;
  if (written_.size() + bytes.size() > kMostWritten) return takes_no_more(*this, written_.size());
  const auto& recorded = session().out;
  const std::size_t at = written_.size();
  agrees_ = agrees_ && at + bytes.size() <= recorded.size() &&
            std::equal(bytes.begin(), bytes.end(), recorded.begin() + static_cast<std::ptrdiff_t>(at));
  written_.insert(written_.end(), bytes.begin(), bytes.end());
  return ok();
}

Status ReplayLink::flush() { return check_open(); }

void ReplayLink::discard_input() {
  if (open_) read_ = due();
}

ReplayComparison ReplayLink::comparison() const {
  if (played_ == 0) return {};
  const std::vector<std::uint8_t>& recorded = session().out;
  const auto differing = std::ranges::mismatch(written_, recorded).in1;
  return {written_.size(), recorded.size(), static_cast<std::size_t>(differing - written_.begin())};
}

std::string ReplayLink::first_difference() const {
  const ReplayComparison found = comparison();
  if (found.agrees()) return {};
  return "byte " + std::to_string(found.equal) + " to the device: recorded " +
         hex_at(session().out, found.equal) + ", written " + hex_at(written_, found.equal);
}

}  // namespace orca::hw::link
