// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "algorithm.hpp"
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::ObjectPtr;
using orca::PushEdge;
using orca::Status;
using orca::fuse::Wish;

/// Fuses the wishes of the behaviours that a client list names into one crisp command (thesis 11.1). Which
/// behaviours may be named is what the graph connects to `motion`.
class MotionCommandFuser final : public orca::Component {
 public:
  explicit MotionCommandFuser(orca::ComponentHost& host) : Component(host) { lap_on("motion"); }

 private:
  Status on_client_list(const ObjectPtr<orca::idl::ClientList>& list) {
    for (const std::string& name : list->clients())
      if (!names_an_edge(name))
        return orca::fail(orca::Code::not_found, "no behaviour \"" + name + "\" is connected to " +
                                                     motion_.endpoint().path() +
                                                     "; connected are: " + connected_names());
    for (const auto& edge : motion_.edges()) {
      const bool listed = std::any_of(list->clients().begin(), list->clients().end(),
                                      [&](const std::string& name) { return is_called(*edge, name); });
      listed ? edge->subscribe() : edge->unsubscribe();
    }
    stay_active(!list->clients().empty());
    return orca::ok();
  }

  // For every wish that comes, all are fused with their latest (the second policy of thesis 7.4).
  orca::Outcome work() override {
    std::vector<Wish>& wishes = wishes_;
    wishes.clear();
    for (const auto& edge : motion_.edges())
      if (edge->subscribed())
        collect(orca::PushProxyArray<orca::idl::MotionCommand>::take_latest(*edge), wishes);
    send(orca::fuse::fuse_weighted(wishes, *steer_gain_));
    return orca::again();
  }

  // Nobody is listened to any more: the robot must not go on with the last command.
  void stop() override { send(std::nullopt); }

  void collect(const ObjectPtr<orca::idl::MotionCommand>& command, std::vector<Wish>& wishes) const {
    if (!command || command->kind() == orca::idl::DONTCARE) return;
    if (orca::to_seconds(now() - orca::to_time_point(command->creation_time())) > *max_age_) return;
    if (command->kind() == orca::idl::FULLSTOP) {
      wishes.push_back({Wish::Kind::full_stop});
    } else if (command->steering() == orca::idl::BY_DIRECTION) {
      wishes.push_back({Wish::Kind::direction, command->direction(), command->speed(), command->weight()});
    } else {
      wishes.push_back({Wish::Kind::turn_rate, command->turn_rate(), command->speed(), command->weight()});
    }
  }

  void send(const std::optional<Wish>& fused) {
    Status sent;
    if (!fused || fused->kind == Wish::Kind::full_stop) {
      sent = base_.send(orca::full_stop());
    } else if (fused->kind == Wish::Kind::direction) {
      sent = base_.send(orca::head(fused->value, fused->speed, fused->weight));
    } else {
      sent = base_.send(orca::turn(fused->value, fused->speed, fused->weight));
    }
    if (!sent.ok() && !refused_) log_warning("the base refuses commands: " + sent.error().text());
    refused_ = !sent.ok();
  }

  // Whether the edge comes from the behaviour or port `name`, seen from the fuser's own context or from the
  // top: a Command beside it in a sub-graph "left" says "goto" for "left/goto".
  [[nodiscard]] bool is_called(const PushEdge& edge, const std::string& name) const {
    const std::string path = edge.source_path();
    const std::string behaviour = path.substr(0, path.rfind('.'));
    const std::string here = this->name().substr(0, this->name().rfind('/') + 1) + name;
    return path == here || behaviour == here || path == name || behaviour == name;
  }

  [[nodiscard]] bool names_an_edge(const std::string& name) const {
    return std::any_of(motion_.edges().begin(), motion_.edges().end(),
                       [&](const auto& edge) { return is_called(*edge, name); });
  }

  [[nodiscard]] std::string connected_names() const {
    std::string names;
    for (const auto& edge : motion_.edges()) names += (names.empty() ? "" : ", ") + edge->source_path();
    return names.empty() ? "none" : names;
  }

  orca::PushProxyArray<orca::idl::MotionCommand> motion_{
      *this,
      "motion",
      {.text = "Wishes of the behaviours that may be named in a client list.", .optional = true}};
  orca::SendServer<orca::idl::ClientList> clients_{*this,
                                                   "ClientListSend",
                                                   &MotionCommandFuser::on_client_list,
                                                   {.text = "Which behaviours to listen to from now on."}};
  orca::SendProxy<orca::idl::MotionCommand> base_{*this, "base", {.text = "Where the fused command goes."}};

  orca::Param<double> max_age_{
      *this, "max_age", 0.5, {.unit = "s", .min = 0.0, .text = "Older wishes are disregarded."}};
  orca::Param<double> steer_gain_{
      *this,
      "steer_gain",
      1.0,
      {.unit = "1/s", .min = 0.0, .text = "Turn rate per radian when directions and rates are mixed."}};

  std::vector<Wish> wishes_;
  bool refused_ = false;
};

}  // namespace

ORCA_COMPONENT(MotionCommandFuser, "orca.MotionCommandFuser")
