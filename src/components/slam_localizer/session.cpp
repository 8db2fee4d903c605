// SPDX-License-Identifier: LGPL-3.0-or-later
#include "session.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "orca/component/state.hpp"

namespace orca::slam {
namespace {

const StateTag kTag{"orca.SlamLocalizer session", 1};

Error with_way_out(Error error, const std::string& path) {
  if (error.where.empty()) error.where = path;
  error.message += "; put an older copy in its place (" + path +
                   ".old is the last one), or name another file to begin a new map";
  return error;
}

}  // namespace

Status Session::open(const std::string& path) {
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  // Said without writing anything, so that a check of the graph can say it too.
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return fail(Code::unavailable, "cannot be written: its folder: " + std::string(std::strerror(errno)),
                path);
  file_.emplace(path, "slam_session", true);
  const auto bytes = file_->read();
  if (!bytes) return with_way_out(bytes.error(), path);
  if (!*bytes) return ok();
  nav::SlamMemory memory;
  StateReader reader(kTag, **bytes);
  (void)reader.read(memory);
  if (Status read = reader.finish(); !read.ok()) return with_way_out(read.error(), path);
  if (Status sound = nav::check(memory); !sound.ok()) return with_way_out(sound.error(), path);
  written_ = memory.nodes.size();
  if (written_ > 0) before_ = std::move(memory);
  return ok();
}

std::optional<nav::SlamMemory> Session::take() { return std::exchange(before_, std::nullopt); }

Status Session::keep(const nav::Slam& slam, TimePoint now) {
  if (!since_) since_ = now;
  if (now - *since_ < kPeriod) return ok();
  since_ = now;
  return close(slam);
}

Status Session::close(const nav::Slam& slam) {
  const std::size_t count = slam.nodes().size();
  if (!file_ || count == written_) return ok();
  StateWriter writer;
  writer.write(slam.memory());
  const Status done = file_->write(writer.bytes());
  if (done.ok()) written_ = count;
  return std::exchange(fails_, !done.ok()) ? ok() : done;
}

}  // namespace orca::slam
