// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/idl/object.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca {

/// Returns the text form of an object: one XML element on one line, named after its type (docs/objects.md).
/// Plain values are attributes, structs are elements inside. Numbers are in the units of the IDL file.
/// from_xml() gives back an equal object, each number bit for bit.
/// @thread  any; the object must not change meanwhile.
[[nodiscard]] std::string to_xml(const ObjectType& type, const void* object);

/// @pre  object
[[nodiscard]] std::string to_xml(const ObjectRef& object);

/// Reads the text form, as to_xml() or a person wrote it. A field that is not mentioned keeps its default (0,
/// false, empty, the first enumerator). Quantities may have units: `reach_angle="20 deg"`.
///
/// @param text         UTF-8, at most 16 MB.
/// @param file_name    name of the source, for the positions of the errors.
/// @param diagnostics  receives every error of the text with its position: G1xx for XML that is not
///                     well-formed, T0xx for its content (docs/errors.md).
/// @param expected     the type that the object must have or extend; null: any.
/// @return the object, or nothing if this text has an error.
/// @thread  any.
[[nodiscard]] std::optional<ObjectLoan> from_xml(std::string_view text, const std::string& file_name,
                                                 xml::Diagnostics& diagnostics,
                                                 const ObjectType* expected = nullptr);

}  // namespace orca
