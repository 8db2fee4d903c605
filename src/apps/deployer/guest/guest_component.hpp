// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "guest_types.hpp"
#include "orca/component.hpp"
#include "packet_line.hpp"

namespace orca::guest {

/// A component whose code is in another program: a lap asks that program and waits for its answer, and everything that the lap does
/// with ports is done here. In virtual time nothing else happens while it waits, so that a run repeats.
///
/// Thread contract: as Component.
class GuestComponent final : public Component {
 public:
  /// @param type, line  outlive the object.
  GuestComponent(ComponentHost& host, const GuestType& type, PacketLine& line);
  ~GuestComponent() override;

 private:
  struct Ports;

  Status start() override;
  Outcome work() override;
  void stop() override;
  Status params_changed() override;

  void declare_ports();
  void declare_port_of(const PortContract& port);
  void declare_params();
  // Calls a hook of the program's object, and returns its last word.
  Packet call(const std::string& hook, const Packet& more = {});
  Packet await_end();
  [[nodiscard]] Packet params() const;

  // What others send to the program's object, and ask it.
  Status take(const std::string& port, const ObjectRef& object);
  Result<ObjectLoan> reply(const PortContract& port, const ObjectRef& question);

  // What the program asks for in a lap.
  Packet answer(const Packet& wish);
  Packet get(const std::string& port, const std::string& how, const std::string& seconds);
  Packet push(const std::string& port, const Packet& object);
  Packet send(const std::string& port, const Packet& object);
  Packet query(const std::string& port, const Packet& object, const std::string& seconds);
  Packet log(const std::string& level, const std::string& text) const;

  const GuestType& type_;
  PacketLine& line_;
  std::unique_ptr<Ports> ports_;
  std::map<std::string, ParamValue> params_;
  bool locked_ = false;  // the graph's values are not there yet
};

}  // namespace orca::guest
