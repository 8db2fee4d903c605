// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "wire.hpp"

// after wire.hpp, which includes what Boost.Asio lacks
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "access.hpp"
#include "common/child_program.hpp"
#include "orca/base/result.hpp"

namespace orca::view {

/// What a page may see of a batch of simbatch, and do with it. The folder belongs to simbatch: nothing is written there.
///
/// Thread contract: the loop's thread.
class BatchDoor {
 public:
  struct Reply {
    unsigned status = 200;  ///< Of HTTP.
    std::string text;
    bool is_report = false;  ///< HTML of simbatch; otherwise JSON.
  };

  /// @param folder  of the batch.
  BatchDoor(const boost::asio::any_io_executor& loop, std::string folder)
      : loop_(loop), folder_(std::move(folder)) {}

  /// Answers `/batch/status`, `/batch/report.html` and, posted by who has the role change, `/batch/watch?run=N`, which makes the failed run of this
  /// number in the experiment again in real time, with a page of its own; the one before ends.
  boost::asio::awaitable<Reply> answer(std::string target, bool is_post, Role role);

 private:
  /// A run that is made again.
  struct Watched {
    Watched(const boost::asio::any_io_executor& loop, std::string run, apps::ChildProgram made)
        : name(std::move(run)), program(std::move(made)), output(loop, program.output().release()) {}

    std::string name;
    std::string address;  // of its page; empty: there is none yet
    std::string said;     // the end of what it has printed
    int ended = -1;       // exit status; -1: it goes on
    apps::ChildProgram program;
    boost::asio::posix::stream_descriptor output;
  };
  boost::asio::awaitable<void> refresh();
  Reply status(Role role) const;
  Reply report() const;
  Reply watch(const std::string& number);
  [[nodiscard]] nlohmann::json failed_run(const std::string& number) const;
  static boost::asio::awaitable<void> follow(std::shared_ptr<Watched> watched);

  const boost::asio::any_io_executor loop_;
  const std::string folder_;
  nlohmann::json status_ = nlohmann::json::object();  // as simbatch says it
  std::string fault_ = "nothing was read yet";        // why there is none; empty: there is one
  std::chrono::steady_clock::time_point read_{};
  bool is_reading_ = false;
  std::shared_ptr<Watched> watched_;  // null: none was asked for
};

}  // namespace orca::view
