// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/host/catalogue.hpp"
#include "packet_line.hpp"

namespace orca::guest {

/// A component type whose code is in another program. A plain value.
struct GuestType {
  std::string type;   ///< "my.Avoid"
  Trigger trigger{};  ///< Unless the graph sets another one.
  std::vector<PortContract> ports{};
  std::vector<ParamContract> params{};
};

/// Reads a packet about a type: "type", or "port" or "param" of the type before.
/// @errors  invalid_argument with what is wrong with the type.
[[nodiscard]] Status read_declaration(const Packet& packet, std::vector<GuestType>& types);

/// The component types of the program at the other end of a line, which calls their code guest. One object exists at a time.
///
/// Thread contract: one thread, before the run.
class GuestTypes {
 public:
  /// The most types that a program may have.
  static constexpr std::size_t kMost = 32;

  /// Takes the program's types, and answers with the layouts of all objects.
  /// @errors  invalid_argument if a type is wrong, or the program is of another version of Orca; the program is told.
  [[nodiscard]] static Result<std::unique_ptr<GuestTypes>> receive(Descriptor socket);
  ~GuestTypes();
  GuestTypes(const GuestTypes&) = delete;
  GuestTypes& operator=(const GuestTypes&) = delete;

  /// Adds the types to a catalogue, which this object must outlive.
  void add_to(host::PluginCatalogue& catalogue) const;

 private:
  GuestTypes(PacketLine line, std::vector<GuestType> types);

  PacketLine line_;
  const std::vector<GuestType> types_;
  std::vector<TypeEntry> entries_;
};

}  // namespace orca::guest
