// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "component_bench.hpp"
#include "fake_scout.hpp"
#include "orca/hw/server.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/local/local_links.hpp"

namespace orca::test {

/// A RobotBaseServer without its description.
class Base final : public hw::HardwareServer {
 public:
  explicit Base(ComponentHost& host) : HardwareServer(host, hw::Source::sensor) { offer_motion(); }
};

/// Uses a base through all of its interfaces.
struct Client : Peer {
  explicit Client(Executive& executive, const std::string& name = "client") : Peer(executive, name) {}
  PushProxy<idl::Odometry> odometry{*this, "odometry"};
  PushProxy<idl::SonarRangeReadings> sonar{*this, "sonar"};
  QueryProxy<idl::AskReading, idl::Odometry> ask_odometry{*this, "ask_odometry"};
  QueryProxy<idl::AskReading, idl::SonarRangeReadings> ask_sonar{*this, "ask_sonar"};
  SendProxy<idl::MotionCommand> motion{*this, "motion"};
  SendProxy<idl::HolonomicVelocity> velocity{*this, "velocity"};
  SendProxy<idl::TurretCommand> turret{*this, "turret"};
};

/// A scout, a server around it, a client connected to all five interfaces; server and scout run.
struct ScoutBase {
  explicit ScoutBase(Executive& used, std::map<std::string, std::function<Status()>> trouble = {},
                     const hw::DriveLimits& limits = kScoutLimits, bool has_turret = false)
      : executive(used),
        robot(used, std::move(trouble), limits, has_turret),
        seat(robot.scout),
        bench(used, "base", &seat),
        server(bench),
        client(used) {
    connect("OdometryPush", "odometry");
    connect("SonarRangeReadingsPush", "sonar");
    connect("ask_odometry", "OdometryQuery");
    connect("ask_sonar", "SonarRangeReadingsQuery");
    connect("motion", "MotionCommandSend");
    CHECK(server.configure().ok());
    bench.peer().open();
  }

  /// Starts the server's strand.
  void run() {
    service = std::make_unique<Script>(bench.peer(), [this] { bench.run(server); });
  }

  ~ScoutBase() {
    service.reset();
    robot.end();  // before the server's strand, which the scout wakes, is gone
  }

  /// Connects a proxy of the client with a port of the server, whichever way the pattern goes.
  void connect(const std::string& from, const std::string& to) {
    const bool pushed = from.ends_with("Push");
    Endpoint& first = pushed ? bench.peer().endpoint(from) : client.endpoint(from);
    Endpoint& second = pushed ? client.endpoint(to) : bench.peer().endpoint(to);
    CHECK(LocalLinks().connect(first, second).ok());
  }

  [[nodiscard]] bool gets(hw::HardwareState state) { return robot.gets(state); }

  Executive& executive;
  RunningScout robot;
  hw::HardwareSeat seat;
  ComponentBench bench;
  Base server;
  Client client;
  std::unique_ptr<Script> service;
};

}  // namespace orca::test
