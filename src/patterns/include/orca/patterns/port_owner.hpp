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

/// A handler of sent objects; an error is counted and logged.
using SendHandler = std::function<Status(const ObjectRef&)>;
/// A handler that answers a question.
using QueryHandler = std::function<Result<ObjectLoan>(const ObjectRef&)>;

/// The properties that an author may give a port in its declaration.
struct PortOptions {
  std::string text{};     ///< One sentence for people.
  bool optional = false;  ///< A proxy that may stay unconnected.
  /// Marks a PushProxy whose subscription the component makes itself. Otherwise the subscription lasts as
  /// long as the component works.
  bool manual = false;
  /// Objects kept per edge (Push) or waiting to be handled (Send and Query servers); 0: the pattern's
  /// default.
  std::uint32_t depth = 0;
  /// Base period of a PushServer [s], if it is known beforehand; PushServer::start() may change it.
  Duration period{0};
  /// Marks a PushServer at which a device's strand pushes, not the component's: no edge may make it wait.
  bool from_device = false;
  /// A SendServer's: when an object counts as sent, unless the graph says otherwise for an edge. With `handled` the handler's error
  /// is the sender's.
  QueuePolicy::Confirm confirm = QueuePolicy::Confirm::accepted;
};

/// A port as declared by a member of a component.
struct PortDeclaration {
  PortContract contract;
  bool manual = false;
  /// The place where the handle keeps the address of its endpoint; the host fills it before configure().
  Endpoint** slot = nullptr;
  SendHandler on_object;    ///< Send servers only.
  QueryHandler on_request;  ///< Query servers only.
};

/// The owner of ports: a component.
///
/// Thread contract: the thread that constructs it.
class PortOwner {
 public:
  /// May throw, because a plugin author's destructor may throw; the runtime contains it.
  virtual ~PortOwner() noexcept(false) = default;
  /// @pre  called from the owner's constructor.
  virtual void declare_port(PortDeclaration declaration) = 0;
};

/// Builds a declaration from an author's properties.
[[nodiscard]] PortDeclaration make_declaration(std::string name, Pattern pattern, Role role, TypeId type,
                                               const PortOptions& options);

}  // namespace orca
