// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "peer.hpp"

namespace orca::test {

/// A peer with a port of each pattern and role. Its servers take everything.
struct AllPorts : Peer {
  AllPorts(Executive& executive, const std::string& name) : Peer(executive, name) {}
  Status on_command(const ObjectPtr<idl::MotionCommand>& /*command*/) { return ok(); }
  Result<Loan<idl::MotionCommand>> on_ask(const ObjectPtr<idl::Ask>& /*ask*/) { return full_stop(); }

  PushServer<idl::MotionCommand> out{*this, "out"};
  PushProxy<idl::MotionCommand> in{*this, "in"};
  SendProxy<idl::MotionCommand> sender{*this, "sender"};
  SendServer<idl::MotionCommand> taker{*this, "taker", &AllPorts::on_command};
  QueryProxy<idl::Ask, idl::MotionCommand> question{*this, "question"};
  QueryServer<idl::Ask, idl::MotionCommand> answerer{*this, "answerer", &AllPorts::on_ask};
};

/// Returns the host's side of a port.
template <class Port>
[[nodiscard]] Port& port(const Peer& peer, const std::string& name) {
  return static_cast<Port&>(peer.endpoint(name));
}

}  // namespace orca::test
