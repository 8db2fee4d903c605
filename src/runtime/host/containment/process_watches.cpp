// SPDX-License-Identifier: LGPL-3.0-or-later
#include "process_watches.hpp"

#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "orca/base/text.hpp"
#include "orca/host/last_words.hpp"

namespace orca::host {
namespace {

std::string current_folder() {
  std::error_code error;
  const std::string folder = std::filesystem::current_path(error).string();
  return error ? "(removed)" : folder;
}

bool same_handler(const struct sigaction& a, const struct sigaction& b) {
  return a.sa_handler == b.sa_handler && (a.sa_flags & SA_SIGINFO) == (b.sa_flags & SA_SIGINFO);
}

std::string text_of(rlim_t limit) { return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit); }

rlimit present(int resource) {
  rlimit now{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
  return now;
}

// Names the soft limit if that has changed, else the hard one.
std::string change_of(const char* name, const rlimit& before, const rlimit& now) {
  const bool soft = before.rlim_cur != now.rlim_cur;
  return std::string("the ") + (soft ? "" : "hard ") + "limit of the " + name + " from " +
         text_of(soft ? before.rlim_cur : before.rlim_max) + " to " +
         text_of(soft ? now.rlim_cur : now.rlim_max);
}

// Restores the limit, or comes as near to it as the hard limit allows.
bool put_back(int resource, const rlimit& before, const rlimit& now) {
  const auto which = static_cast<__rlimit_resource_t>(resource);
  if (setrlimit(which, &before) == 0) return true;
  const rlimit nearest{std::min(before.rlim_cur, now.rlim_max), now.rlim_max};
  setrlimit(which, &nearest);
  return false;
}

}  // namespace

void LocaleWatch::keep() {
  reference_ = setlocale(LC_ALL, nullptr);
  global_ = std::locale();
}

std::optional<Finding> LocaleWatch::look() {
  const char* const current = setlocale(LC_ALL, nullptr);
  const bool is_same = current == reference_;
  if (is_same && std::locale() == global_) return std::nullopt;
  const std::string now(current);
  std::locale::global(global_);
  setlocale(LC_ALL, reference_.c_str());
  if (is_same) return Finding{idl::LOCALE, "changed std::locale()"};
  return Finding{idl::LOCALE, "changed the locale from \"" + reference_ + "\" to \"" + now + "\""};
}

std::optional<Finding> StandardStreamWatch::look() {
  const std::vector<std::string> changed = reference_->changes();
  if (changed.empty()) return std::nullopt;
  reference_->restore();
  return Finding{idl::REDIRECTION, "changed " + joined(changed, " and ")};
}

void SignalHandlerWatch::keep() {
  reference_ = {{SIGINT, {}}, {SIGTERM, {}}, {SIGSEGV, {}}};
  for (Handler& handler : reference_) sigaction(handler.signal, nullptr, &handler.action);
}

std::optional<Finding> SignalHandlerWatch::look() {
  std::string changed;
  for (const Handler& kept : reference_) {
    struct sigaction present {};
    sigaction(kept.signal, nullptr, &present);
    if (same_handler(present, kept.action) || LastWords::is_dying()) continue;
    sigaction(kept.signal, &kept.action, nullptr);
    changed += std::string(changed.empty() ? "SIG" : ", SIG") + sigabbrev_np(kept.signal);
  }
  if (changed.empty()) return std::nullopt;
  return Finding{idl::SIGNAL_HANDLER, "changed what happens at " + changed};
}

void TerminateWatch::keep() { reference_ = LastWords::terminate_handler(); }

std::optional<Finding> TerminateWatch::look() {
  if (std::get_terminate() == reference_) return std::nullopt;
  std::set_terminate(reference_);
  return Finding{idl::TERMINATE_HANDLER, "changed what std::terminate() does, with std::set_terminate()"};
}

void FolderWatch::keep() { reference_ = current_folder(); }

std::optional<Finding> FolderWatch::look() {
  const std::string now = current_folder();
  if (now == reference_) return std::nullopt;
  const bool back = chdir(reference_.c_str()) == 0;
  if (!back) reference_ = now;
  return Finding{idl::WORKING_FOLDER,
                 "changed the working folder to " + now + (back ? "" : ", and the way back fails")};
}

void UmaskWatch::keep() {
  reference_ = umask(0);
  umask(reference_);
}

std::optional<Finding> UmaskWatch::look() {
  if (umask(reference_) == reference_) return std::nullopt;
  return Finding{idl::UMASK, "changed the umask"};
}

void LimitWatch::keep() {
  reference_ = {{RLIMIT_AS, "memory", {}},
                {RLIMIT_CPU, "CPU time", {}},
                {RLIMIT_FSIZE, "size of files", {}},
                {RLIMIT_NOFILE, "number of descriptors", {}}};
  for (Limit& limit : reference_) limit.value = present(limit.resource);
}

std::optional<Finding> LimitWatch::look() {
  std::string changes;
  for (Limit& kept : reference_) {
    const rlimit now = present(kept.resource);
    if (now.rlim_cur == kept.value.rlim_cur && now.rlim_max == kept.value.rlim_max) continue;
    const bool back = put_back(kept.resource, kept.value, now);
    changes += (changes.empty() ? "" : ", ") + change_of(kept.name, kept.value, now) +
               (back ? "" : ", and only the superuser could put it back");
    if (!back) kept.value = present(kept.resource);
  }
  if (changes.empty()) return std::nullopt;
  return Finding{idl::RESOURCE_LIMIT, "changed " + changes};
}

std::vector<std::unique_ptr<Watch>> make_process_watches() {
  std::vector<std::unique_ptr<Watch>> all;
  all.push_back(std::make_unique<LocaleWatch>());
  all.push_back(std::make_unique<StandardStreamWatch>());
  all.push_back(std::make_unique<SignalHandlerWatch>());
  all.push_back(std::make_unique<TerminateWatch>());
  all.push_back(std::make_unique<FolderWatch>());
  all.push_back(std::make_unique<UmaskWatch>());
  all.push_back(std::make_unique<LimitWatch>());
  return all;
}

}  // namespace orca::host
