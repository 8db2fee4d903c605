// SPDX-License-Identifier: GPL-3.0-or-later
// Each watch finds the one kind of change that it is for, puts it back, and reports it once.
#include <catch2/catch.hpp>

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cfenv>
#include <clocale>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <locale>
#include <memory>
#include <sstream>

#include "containment/process_watches.hpp"
#include "containment/thread_watches.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using Catch::Contains;

namespace {

template <class Kind>
std::unique_ptr<Watch> watch() {
  auto made = std::make_unique<Kind>();
  made->keep();
  return made;
}

void block_usr1() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void lower_soft_limit() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = 64;
  setrlimit(RLIMIT_NOFILE, &limit);
}

// Runs `body` in a copy of the process, because its effects cannot be undone.
bool holds_in_copy(const std::function<bool()>& body) {
  const pid_t copy = fork();
  if (copy == 0) _exit(body() ? 0 : 1);
  int status = 1;
  waitpid(copy, &status, 0);
  return status == 0;
}

}  // namespace

TEST_CASE("a watch finds its kind of change, puts it back, and finds nothing more", "[host][watches]") {
  struct Case {
    std::unique_ptr<Watch> watch;
    std::function<void()> deed;
    AlarmKind kind;
    std::string text;
  };
  std::vector<Case> cases;
  cases.push_back({watch<FloatingPointWatch>(), [] { std::fesetround(FE_UPWARD); }, idl::FLOATING_POINT,
                   "changed how numbers are rounded"});
  cases.push_back({watch<ThreadLocaleWatch>(), [] { uselocale(newlocale(LC_ALL_MASK, "C", nullptr)); },
                   idl::LOCALE, "given its thread a locale of its own"});
  cases.push_back({watch<LocaleWatch>(), [] { std::setlocale(LC_ALL, "C.UTF-8"); }, idl::LOCALE,
                   R"(changed the locale from "C" to "C.UTF-8")"});
  cases.push_back({watch<LocaleWatch>(),
                   [] { std::locale::global(std::locale(std::locale(), new std::numpunct<char>)); },
                   idl::LOCALE, "changed std::locale()"});
  static std::stringbuf own;
  cases.push_back({watch<StandardStreamWatch>(),
                   [] {
                     std::cout.rdbuf(&own);
                     std::cerr.tie(nullptr);
                   },
                   idl::REDIRECTION, "changed the buffer of std::cout and the stream tied to std::cerr"});
  cases.push_back({watch<SignalMaskWatch>(), block_usr1, idl::SIGNAL_MASK, "blocked SIGUSR1"});
  cases.push_back({watch<SignalHandlerWatch>(), [] { signal(SIGTERM, SIG_IGN), signal(SIGINT, SIG_IGN); },
                   idl::SIGNAL_HANDLER, "changed what happens at SIGINT, SIGTERM"});
  cases.push_back({watch<TerminateWatch>(), [] { std::set_terminate([] { _exit(0); }); },
                   idl::TERMINATE_HANDLER, "changed what std::terminate() does"});
  cases.push_back({watch<FolderWatch>(), [] { (void)!chdir("/"); }, idl::WORKING_FOLDER,
                   "changed the working folder to /"});
  cases.push_back({watch<UmaskWatch>(), [] { umask(0); }, idl::UMASK, "changed the umask"});
  cases.push_back({watch<LimitWatch>(), lower_soft_limit, idl::RESOURCE_LIMIT,
                   "changed the limit of the number of descriptors from "});
  for (const Case& c : cases) {
    CAPTURE(c.text);
    CHECK_FALSE(c.watch->look());
    c.deed();
    const auto found = c.watch->look();
    REQUIRE(found);
    CHECK(found->kind == c.kind);
    CHECK_THAT(found->deed, Contains(c.text));
    CHECK_FALSE(c.watch->look());
  }
}

TEST_CASE("a limit that cannot be put back is reported once, and then counts as it is", "[host][watches]") {
  CHECK(holds_in_copy([] {
    const rlimit before{1000, 1000};
    setrlimit(RLIMIT_CPU, &before);
    if (geteuid() == 0 && setgid(65534) == 0 && setuid(65534) != 0) return false;
    const auto limits = watch<LimitWatch>();
    const rlimit lowered{500, 500};
    setrlimit(RLIMIT_CPU, &lowered);
    const auto found = limits->look();
    return found &&
           found->deed ==
               "changed the limit of the CPU time from 1000 to 500, and only the superuser could "
               "put it back" &&
           !limits->look();
  }));
}

TEST_CASE("a hard limit alone is watched, too", "[host][watches]") {
  CHECK(holds_in_copy([] {
    const rlimit before{100, 1000};
    setrlimit(RLIMIT_CPU, &before);
    const auto limits = watch<LimitWatch>();
    const rlimit lowered{100, 500};
    setrlimit(RLIMIT_CPU, &lowered);
    const auto found = limits->look();
    return found && found->deed.starts_with("changed the hard limit of the CPU time from 1000 to 500") &&
           !limits->look();
  }));
}

TEST_CASE("a working folder that is gone is reported once", "[host][watches]") {
  CHECK(holds_in_copy([] {
    const test::TempFolder folder;
    std::filesystem::create_directory(folder.file("home"));
    if (chdir(folder.file("home").c_str()) != 0) return false;
    const auto watched = watch<FolderWatch>();
    std::filesystem::remove(folder.file("home"));
    if (chdir("/") != 0) return false;
    const auto found = watched->look();
    return found && found->deed == "changed the working folder to /, and the way back fails" &&
           !watched->look();
  }));
}
