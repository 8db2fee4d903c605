// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"

namespace orca {

class Endpoint;

/// Handles an object that was sent; an error is counted and logged.
using SendHandler = std::function<Status(const ObjectRef&)>;
/// Answers a question.
using QueryHandler = std::function<Result<ObjectLoan>(const ObjectRef&)>;

/// The properties that an author may give a port when declaring it.
struct PortOptions {
  std::string text{};     ///< One sentence for people.
  bool optional = false;  ///< A proxy that may stay unconnected.
  /// A PushProxy whose subscription the component makes itself; otherwise it lasts as long as the component
  /// works.
  bool manual = false;
  /// Objects kept per edge (Push) or waiting to be handled (Send and Query servers); 0: the pattern's
  /// default.
  std::uint32_t depth = 0;
  /// Base period of a PushServer [s], where it is known beforehand; PushServer::start() may change it.
  Duration period{0};
  /// A PushServer at which a device's strand pushes, not the component's: no edge may make it wait.
  bool from_device = false;
};

/// A port as a member of a component declares it.
struct PortDeclaration {
  PortContract contract;
  bool manual = false;
  /// Where the handle keeps the address of its endpoint; filled by the host before configure().
  Endpoint** slot = nullptr;
  SendHandler on_object;    ///< Send servers only.
  QueryHandler on_request;  ///< Query servers only.
};

/// The owner of ports: a component.
///
/// Thread contract: the thread that constructs it.
class PortOwner {
 public:
  /// May throw, because an author's destructor may: the runtime contains it.
  virtual ~PortOwner() noexcept(false) = default;
  /// @pre  called from the owner's constructor.
  virtual void declare_port(PortDeclaration declaration) = 0;
};

/// Builds a declaration from an author's words.
[[nodiscard]] PortDeclaration make_declaration(std::string name, Pattern pattern, Role role, TypeId type,
                                               const PortOptions& options);

}  // namespace orca
