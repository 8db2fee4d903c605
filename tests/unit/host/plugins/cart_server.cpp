// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/hw/server.hpp"

namespace {

/// A base server that says when it is started and stopped.
class CartServer final : public orca::hw::HardwareServer {
 public:
  explicit CartServer(orca::ComponentHost& host) : HardwareServer(host, orca::hw::Source::sensor) {
    offer_motion();
  }

 private:
  orca::Status start() override {
    log_debug("server start");
    return HardwareServer::start();
  }
  void stop() override {
    log_debug("server stop");
    HardwareServer::stop();
  }
};

}  // namespace

ORCA_COMPONENT(CartServer, "test.CartServer")
