// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/logged_link.hpp"

#include <array>
#include <utility>

namespace orca::hw::link {

using Kind = ByteRecord::Kind;

LoggedLink::LoggedLink(std::unique_ptr<ByteLink> link, std::unique_ptr<ByteLog> log)
    : link_(std::move(link)), log_(std::move(log)) {}

LoggedLink::~LoggedLink() { LoggedLink::close(); }

Result<Opening> LoggedLink::open() {
  Result<Opening> opened = link_->open();
  if (!opened) {
    log_->remark("cannot open: " + opened.error().text());
  } else if (*opened == Opening::done && !std::exchange(open_, true)) {
    gone_ = false;
    log_->note(Kind::open);
  }
  return opened;
}

void LoggedLink::close() {
  link_->close();
  if (std::exchange(open_, false)) log_->note(Kind::close);
}

Result<std::size_t> LoggedLink::read(std::span<std::uint8_t> into) {
  Result<std::size_t> count = link_->read(into);
  if (!count) {
    note_failure(count.error());
  } else if (*count > 0) {
    log_->note(Kind::in, into.first(*count));
  }
  return count;
}

Status LoggedLink::write(std::span<const std::uint8_t> bytes) {
  Status written = link_->write(bytes);
  if (!written.ok()) {
    note_failure(written.error());
  } else if (!bytes.empty()) {
    log_->note(Kind::out, bytes);
  }
  return written;
}

Status LoggedLink::flush() {
  Status sent = link_->flush();
  if (!sent.ok()) note_failure(sent.error());
  return sent;
}

// What is discarded often shows what is wrong, so the log has it.
void LoggedLink::discard_input() {
  constexpr int kMostReads = 64;
  std::array<std::uint8_t, 1024> bytes{};
  for (int i = 0; i < kMostReads; ++i) {
    const Result<std::size_t> count = link_->read(bytes);
    if (!count || *count == 0) break;
    log_->note(Kind::dropped, std::span(bytes).first(*count));
  }
  link_->discard_input();
}

void LoggedLink::discard_output() {
  if (link_->pending() > 0)
    log_->remark(std::to_string(link_->pending()) + " bytes that were to go out were discarded");
  link_->discard_output();
}

Status LoggedLink::set_line(const Line& line) {
  Status set = link_->set_line(line);
  log_->remark((set.ok() ? "line: " : "no line: ") + std::to_string(line.baud) +
               (line.parity == Parity::even ? " baud 8E1" : " baud 8N1"));
  return set;
}

Status LoggedLink::set_dtr(bool raised) {
  log_->remark(raised ? "DTR raised" : "DTR lowered");
  return link_->set_dtr(raised);
}

void LoggedLink::note_failure(const Error& error) {
  if (!open_ || gone_) return;
  if (error.code != Code::unavailable && error.code != Code::data_loss) {
    log_->remark(error.message);
    return;
  }
  gone_ = true;
  log_->note(Kind::gone, error.message);
}

}  // namespace orca::hw::link
