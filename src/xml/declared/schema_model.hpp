// SPDX-License-Identifier: LGPL-3.0-or-later
// What a schema says, in the terms that the languages of schemas share: xsd.cpp and rnc.cpp write it down.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "orca/xml/schema.hpp"

namespace orca::xml {

// The values of attributes that follow a rule without choices: those that match the pattern, or whole numbers in a range.
struct SchemaValue {
  std::string pattern{};  // a regular expression of XML Schema for the whole value; empty: whole numbers
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

struct SchemaAttribute {
  std::string name;
  bool required = false;
  std::string text;                 // for people
  std::vector<SchemaWord> words{};  // allowed beside the values of the type
  std::string value{};              // name of the type of values, or kAnyText; empty: only the words
};

struct SchemaChild {
  std::string name;
  std::string type;
  std::vector<std::pair<std::string, std::string>>
      unique{};  // the constraint's name, and which children of it
};

// The content of elements.
struct SchemaType {
  std::string name;
  std::string text;  // for people
  std::vector<SchemaChild> children{};
  std::vector<SchemaAttribute> attributes{};
  std::vector<std::string>
      foreign{};         // attributes for other programs, such as "xsi:noNamespaceSchemaLocation"
  bool is_open = false;  // whether it has any attributes, and the children of any content
};

struct SchemaModel {
  std::vector<SchemaChild> roots;
  std::vector<SchemaType> types;
  std::map<std::string, SchemaValue> values;  // by name
  bool has_arguments = false;                 // whether each type of values allows "${name}" too
  std::vector<std::string> others;            // children of open types of any content
};

inline constexpr const char* kAnyText = "any_text";
// The pattern of values with an argument, and the name of their type.
inline constexpr const char* kArgument = "with_argument";
inline constexpr const char* kArgumentPattern = ".*[$]\\{.*\\}.*";

// Returns whether a double holds every whole number up to this one. Other limits are not written.
bool is_exact(double value);

SchemaModel schema_model(const FileRules& file, const SchemaOptions& options);

// Return the schema in one language.
std::string xsd(const SchemaModel& model, const std::string& title);
std::string rnc(const SchemaModel& model, const std::string& title);

}  // namespace orca::xml
