// SPDX-License-Identifier: LGPL-3.0-or-later
#include "participant_qos.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/log/Log.hpp>

#include <algorithm>
#include <memory>

#include "orca/dds/gate.hpp"

namespace orca::dds {
namespace {

namespace fd = eprosima::fastdds::dds;
namespace fastrtps = eprosima::fastrtps;

constexpr std::uint32_t kParticipants = 20;        // that are looked for at an address
constexpr std::uint32_t kSocketBuffer = 4U << 20;  // [bytes]; the system may give less

fastrtps::Duration_t seconds(double time) { return fastrtps::Duration_t(static_cast<long double>(time)); }

// Writes what Fast DDS complains about to the log. Errors and lost peers report by themselves what matters.
class LogConsumer final : public fd::LogConsumer {
 public:
  void Consume(const fd::Log::Entry& entry) override { log_complaint(entry.context.category, entry.message); }
};

template <class Qos>
void keep_last(Qos& qos, std::int32_t depth) {
  qos.reliability().kind = fd::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = fd::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fd::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
  qos.resource_limits().max_samples = depth;
  qos.resource_limits().max_instances = 1;
  qos.resource_limits().max_samples_per_instance = depth;
  qos.resource_limits().allocated_samples = 1;
  qos.endpoint().history_memory_policy = fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

}  // namespace

void prepare_library() {
  fd::Log::ClearConsumers();
  fd::Log::RegisterConsumer(std::make_unique<LogConsumer>());
  fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = fastrtps::INTRAPROCESS_OFF;  // a writer would run the readers' callbacks
  fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

fd::DomainParticipantQos participant_qos(const DdsOptions& options) {
  fd::DomainParticipantQos qos;
  qos.name(options.graph + "/" + options.process);
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  if (!options.address.empty()) udp->interfaceWhiteList = {options.address};
  udp->maxInitialPeersRange = kParticipants;
  udp->sendBufferSize = kSocketBuffer;
  udp->receiveBufferSize = kSocketBuffer;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp};
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = seconds(2.0);
  discovery.leaseDuration_announcementperiod = seconds(0.5);
  discovery.initial_announcements = {20, seconds(0.05)};
  for (const std::string& other : options.others) {
    fastrtps::rtps::Locator_t locator;
    fastrtps::rtps::IPLocator::setIPv4(locator, other);
    qos.wire_protocol().builtin.initialPeersList.push_back(locator);
  }
  return qos;
}

fd::DataWriterQos writer_qos(const TopicOptions& options) {
  fd::DataWriterQos qos;
  keep_last(qos, options.depth);
  auto& times = qos.reliable_writer_qos().times;
  times.initialHeartbeatDelay = seconds(std::min(0.005, to_seconds(options.reminder)));
  times.heartbeatPeriod = seconds(to_seconds(options.reminder));
  times.nackResponseDelay = seconds(0.0);
  // Zero, the default, lets each write wake the thread of events.
  times.nackSupressionDuration = seconds(0.001);
  return qos;
}

fd::DataReaderQos reader_qos(std::int32_t depth) {
  fd::DataReaderQos qos;
  keep_last(qos, depth);
  auto& times = qos.reliable_reader_qos().times;
  times.initialAcknackDelay = seconds(0.005);
  times.heartbeatResponseDelay = seconds(0.005);
  return qos;
}

}  // namespace orca::dds
