// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/byte_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "log_writer.hpp"
#include "orca/base/files/open_output.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/text.hpp"

namespace orca::hw::link {
namespace {

constexpr std::size_t kRoomForLastLine = 200;  // [bytes]

}  // namespace

Result<std::unique_ptr<ByteLog>> ByteLog::create(ByteLogOptions options, const std::string& about) {
  if (has_been_read(options.path))
    return fail(Code::invalid_argument,
                "the byte log would overwrite a file that is read here; give it a name of its own",
                options.path);
  // A pipe that nobody reads must not hold the strand.
  Result<OpenOutput> opened = open_output(options.path, O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666);
  if (!opened)
    return fail(Code::unavailable, "cannot write the byte log: " + opened.error().message, options.path);
  if (ftruncate(opened->file.number(), 0) != 0 && errno != EINVAL)  // a pipe has nothing to cut off
    return fail(Code::unavailable, "cannot write the byte log: " + std::string(std::strerror(errno)),
                options.path);
  auto writer = std::make_unique<LogWriter>(std::move(opened->file), options.path);
  std::unique_ptr<ByteLog> log(new ByteLog(std::move(options), std::move(writer)));
  log->write(std::string(kByteLogTitle) + "\n");
  log->remark(about);
  return log;
}

ByteLog::ByteLog(ByteLogOptions options, std::unique_ptr<LogWriter> writer)
    : options_(std::move(options)), start_(options_.now()), writer_(std::move(writer)) {}

ByteLog::~ByteLog() = default;

void ByteLog::note(ByteRecord::Kind kind, std::span<const std::uint8_t> bytes) {
  if (is_writing()) write(to_lines({age(), kind, {bytes.begin(), bytes.end()}, {}}));
}

void ByteLog::note(ByteRecord::Kind kind, std::string text) {
  if (is_writing()) write(to_lines({age(), kind, {}, std::move(text)}));
}

void ByteLog::remark(const std::string& text) { write("# " + printable(text) + "\n"); }

bool ByteLog::is_writing() const { return !full_ && writer_->is_writing(); }

// A clock that is set back must not make the log unreadable.
Duration ByteLog::age() { return newest_ = std::max(newest_, options_.now() - start_); }

void ByteLog::write(const std::string& lines) {
  if (!is_writing()) return;
  full_ = size_ + lines.size() + kRoomForLastLine > options_.most_bytes;
  if (full_) {
    writer_->add(to_lines({age(),
                           ByteRecord::Kind::full,
                           {},
                           "the log has reached its limit of " + std::to_string(options_.most_bytes) +
                               " bytes; what came later is not in it"}));
    return;
  }
  size_ += lines.size();
  writer_->add(lines);
}

}  // namespace orca::hw::link
