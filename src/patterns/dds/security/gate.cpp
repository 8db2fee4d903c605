// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/dds/gate.hpp"

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>

#include <cstring>
#include <utility>

#include "orca/base/files/key_folder.hpp"
#include "orca/base/log.hpp"

namespace orca::dds {
namespace {

constexpr const char* kLogName = "security";
constexpr std::size_t kHeader = 20;        // [bytes] of an RTPS packet (DDSI-RTPS 2.3, 9.4.4)
constexpr std::size_t kPrefix = 8;         // [bytes] where the sender's GUID begins
constexpr std::size_t kMostRefused = 200;  // lines of the log
constexpr std::int64_t kDay = 86'400;      // [s]
constexpr std::int64_t kAhead = 14 * kDay;

std::int64_t seconds_of(std::chrono::system_clock::time_point now) {
  return std::chrono::duration_cast<std::chrono::seconds>(now.time_since_epoch()).count();
}

keys::Mark mark_in(std::span<const std::byte> guid) {
  keys::Mark mark{};
  std::memcpy(mark.data(), guid.data(), mark.size());
  return mark;
}

std::string name_of(const keys::Certificate& certificate) {
  return certificate.process == kPeersKeys ? "the process that speaks for machine " + certificate.machine
                                           : "process " + certificate.process;
}

}  // namespace

Result<std::shared_ptr<Gate>> Gate::open(const std::string& keys, const std::string& process) {
  const auto now = std::chrono::system_clock::now();
  Result<keys::KeyRing> ring = keys::KeyRing::open(keys, process, seconds_of(now));
  if (!ring) return ring.error();
  const std::shared_ptr<Gate> gate(new Gate(std::move(ring).value()));
  gate->look(now);
  return gate;
}

bool Gate::lets_in(std::span<const std::uint8_t> packet, const eprosima::fastrtps::rtps::Locator_t& sender) {
  if (is_closed_.load(std::memory_order_relaxed)) return false;
  if (packet.size() < kHeader) return false;
  const keys::Mark mark = mark_in(std::as_bytes(packet.subspan(kPrefix)));
  const MutexLock lock(mutex_);
  const std::string fault = fault_of(mark);
  const auto address = [&sender] { return eprosima::fastrtps::rtps::IPLocator::ip_to_string(sender); };
  if (!fault.empty()) refuse(address(), fault);
  // It is passed on: whoever could guess the head of a cipher would otherwise keep the true packet away.
  if (fault.empty() && repeats_.has_come(packet))
    warn_once(address() + " repeats what " + name_of(ring_.known().at(mark)) +
              " has said over DDS: somebody has recorded it, or the network brings it by two ways; nothing "
              "is taken twice");
  return fault.empty();
}

std::string Gate::fault_of(const keys::Mark& mark) const {
  const auto sender = ring_.known().find(mark);
  if (sender == ring_.known().end()) return "it has no certificate of this system";
  if (sender->second.revoked) return "the certificate of " + name_of(sender->second) + " was revoked";
  if (sender->second.not_after < now_)
    return "the certificate of " + name_of(sender->second) + " has expired";
  return {};
}

void Gate::refuse(const std::string& sender, const std::string& why) {
  warn_once("what " + sender + " says over DDS is dropped: " + why);
}

// Each text once: a stranger would otherwise fill the log.
void Gate::warn_once(const std::string& text) {
  if (warned_of_.size() >= kMostRefused || !warned_of_.insert(text).second) return;
  log::warning(kLogName, text);
  if (warned_of_.size() == kMostRefused) log::warning(kLogName, "further senders are dropped without a word");
}

std::optional<keys::Certificate> Gate::certificate_of(std::span<const std::byte> guid) const {
  const MutexLock lock(mutex_);
  const auto known = ring_.known().find(mark_in(guid));
  return known == ring_.known().end() ? std::nullopt : std::optional(known->second);
}

void Gate::look(std::chrono::system_clock::time_point now) {
  const MutexLock lock(mutex_);
  if (seconds_of(now) == now_) return;
  now_ = seconds_of(now);
  read_list();
  watch_end();
}

void Gate::read_list() {
  const Result<bool> news = ring_.look();
  if (!news)
    log::warning(kLogName, news.error().message + "; the list of certificates stays as it was");
  else if (*news)
    log::info(kLogName, "there is a new list of certificates");
}

void Gate::watch_end() {
  if (!lets_out()) return;
  const std::int64_t left = ring_.own().not_after - now_;
  if (const std::string fault = ring_.fault(now_); !fault.empty()) {
    is_closed_ = true;
    return log::error(kLogName,
                      "this process is cut off from DDS: " + fault +
                          "; make new keys with orcactl keys GRAPH --renew, copy this machine's folder, "
                          "and start the process again");
  }
  if (left > kAhead || now_ - warned_ < kDay) return;
  warned_ = now_;
  log::warning(kLogName, "the certificate of this process expires in " + std::to_string(left / kDay) +
                             " days, which cuts it off from DDS; orcactl keys GRAPH --renew makes new ones");
}

void Gate::onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* /*participant*/,
                                       eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) {
  using Info = eprosima::fastrtps::rtps::ParticipantAuthenticationInfo;
  if (info.status != Info::UNAUTHORIZED_PARTICIPANT) return;
  const MutexLock lock(mutex_);
  const auto known = ring_.known().find(mark_in(std::as_bytes(std::span(info.guid.guidPrefix.value))));
  refuse("a participant", "it cannot prove to be " +
                              (known == ring_.known().end() ? "of this system" : name_of(known->second)));
}

}  // namespace orca::dds
