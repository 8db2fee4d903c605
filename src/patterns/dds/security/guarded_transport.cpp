// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <span>
#include <utility>

#include "introductions.hpp"
#include "orca/dds/gate.hpp"

namespace orca::dds {
namespace {

namespace fd = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::LocatorsIterator;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::SenderResource;

// A transport whose packets pass a gate.
class GuardedTransport final : public rtps::ChainingTransport {
 public:
  GuardedTransport(const rtps::ChainingTransportDescriptor& descriptor, std::shared_ptr<Gate> gate)
      : ChainingTransport(descriptor), descriptor_(descriptor), gate_(std::move(gate)) {}

  rtps::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  bool send(SenderResource* below, const octet* bytes, std::uint32_t size, LocatorsIterator* begin,
            LocatorsIterator* end, const std::chrono::steady_clock::time_point& timeout) override {
    return !gate_->lets_out() || below->send(bytes, size, begin, end, timeout);
  }

  void receive(rtps::TransportReceiverInterface* next, const octet* bytes, std::uint32_t size,
               const Locator_t& here, const Locator_t& sender) override {
    const std::span packet(bytes, size);
    if (gate_->lets_in(packet, sender)) introductions_.pass(packet, *next, here, sender);
  }

 private:
  struct Descriptor final : rtps::ChainingTransportDescriptor {
    explicit Descriptor(const ChainingTransportDescriptor& other) : ChainingTransportDescriptor(other) {}
    [[nodiscard]] rtps::TransportInterface* create_transport() const override { return nullptr; }
  };

  Descriptor descriptor_;
  Introductions introductions_;
  const std::shared_ptr<Gate> gate_;
};

struct GuardedDescriptor final : rtps::ChainingTransportDescriptor {
  GuardedDescriptor(std::shared_ptr<rtps::TransportDescriptorInterface> below, std::shared_ptr<Gate> its_gate)
      : ChainingTransportDescriptor(std::move(below)), gate(std::move(its_gate)) {}
  [[nodiscard]] rtps::TransportInterface* create_transport() const override {
    return new GuardedTransport(*this, gate);
  }
  const std::shared_ptr<Gate> gate;
};

}  // namespace

void secure(fd::DomainParticipantQos& qos, const std::shared_ptr<Gate>& gate) {
  const keys::KeyRing keys = gate->keys();
  for (const auto& [name, value] : keys.properties()) qos.properties().properties().emplace_back(name, value);
  for (auto& transport : qos.transport().user_transports)
    transport = std::make_shared<GuardedDescriptor>(transport, gate);
}

}  // namespace orca::dds
