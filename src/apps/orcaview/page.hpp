// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "session.hpp"

// after session.hpp, which includes what Boost.Asio lacks
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "orca/base/result.hpp"
#include "wish.hpp"

namespace orca::view {

/// One page that is open in a browser. It answers what the page asks; nonsense gets an error (docs/orcaview-messages.md).
///
/// Thread contract: the loop's thread.
class Page final : public Session {
 public:
  static constexpr const char* kProtocol = "orca.view.v1";

  Page(Stream stream, Role role, Desk& desk) : Session(std::move(stream), role, desk, kProtocol, "page") {}

  void system_changed(bool is_up) override;
  void time_moved() override;
  void hear(std::uint32_t id, const nlohmann::json& line) override;

 private:
  void take_text(const std::string& text) override;
  void take_bytes(const std::string& bytes) override;
  std::optional<Packet> pack(const Frame& frame) override;
  void looking(std::uint32_t id, const std::string& port, const std::string& type) override;
  void blind(std::uint32_t id, const Error& why, bool had_seen) override;
  void say_drops(std::uint64_t dropped, std::size_t waiting) override;

  void carry_out(const Wish& wish);
  void ask(const Wish& wish);
  void begin_look(const Wish& wish);
  void lay_out(const Wish& wish);
  void take_graph_file(const std::string& file, const Wish& wish);
  void say_layout(std::uint32_t id, const std::string& layout, const std::string& file);
  void offer(const Wish& wish);
  void take_outcome(std::uint32_t id, const Result<supervisor::OfferOutcome>& outcome);
  void say_types();
  void refuse(std::uint32_t id, const std::string& why);
  [[nodiscard]] std::function<std::shared_ptr<Page>()> finder();

  bool is_greeted_ = false;
};

}  // namespace orca::view
