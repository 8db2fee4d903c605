// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <signal.h>
#include <sys/resource.h>
#include <sys/types.h>

#include <exception>
#include <locale>
#include <memory>
#include <string>
#include <vector>

#include "orca/plugin/standard_streams.hpp"
#include "watch.hpp"

namespace orca::host {

/// A watch over the locale of the process, of C and of C++. A look costs some ten nanoseconds.
class LocaleWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  std::string reference_;
  std::locale global_;
};

/// A watch over what std::cout and the other standard streams of C++ have: see plugin::StandardStreams.
class StandardStreamWatch final : public Watch {
 public:
  void keep() override { reference_ = std::make_unique<plugin::StandardStreams>(); }
  std::optional<Finding> look() override;

 private:
  std::unique_ptr<plugin::StandardStreams> reference_;
};

/// A watch over the handling of SIGINT, SIGTERM and SIGSEGV.
class SignalHandlerWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  struct Handler {
    int signal;
    struct sigaction action;
  };
  std::vector<Handler> reference_;
};

/// A watch over what std::terminate() does: with another handler a crash could end the process in silence, or with
/// the exit status 0. A look costs a few nanoseconds.
class TerminateWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  std::terminate_handler reference_ = nullptr;
};

/// A watch over the working folder.
class FolderWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  std::string reference_;
};

/// A watch over the umask: the permissions that new files do not get.
class UmaskWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  mode_t reference_ = 0;
};

/// A watch over the soft and hard limits of memory, CPU time, file size and number of descriptors.
class LimitWatch final : public Watch {
 public:
  void keep() override;
  std::optional<Finding> look() override;

 private:
  struct Limit {
    int resource;
    const char* name;
    rlimit value;
  };
  std::vector<Limit> reference_;
};

/// Makes one of each of these watches.
[[nodiscard]] std::vector<std::unique_ptr<Watch>> make_process_watches();

}  // namespace orca::host
