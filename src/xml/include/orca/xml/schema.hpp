// SPDX-License-Identifier: LGPL-3.0-or-later
// Schemas for editors, made from the rules by which files are read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/xml/rules.hpp"

namespace orca::xml {

/// A word that an attribute may have, and what it means.
struct SchemaWord {
  std::string word;
  std::string text;  ///< For people; lines are kept.
};

/// Words of an attribute that are known only when the schema is written, such as the types of the plugins.
struct Vocabulary {
  std::string_view element;
  std::string_view parent;  ///< The attribute of `element` within this element only; empty: within any.
  std::string_view attribute;
  std::vector<SchemaWord> words;
  bool only = true;  ///< Whether other values are errors; otherwise what the rule allows is allowed too.
};

/// Children of an element that must differ in their attribute "name".
struct UniqueNames {
  std::string_view element;
  std::string_view children;
};

/// Everything that a schema says beside the rules.
struct SchemaOptions {
  std::string title;           ///< For the comment on top, for example "Orca's system graphs".
  bool has_arguments = false;  ///< Whether any value may hold "${name}".
  std::vector<Vocabulary> vocabularies{};
  std::vector<UniqueNames> unique{};
  std::vector<std::string_view>
      others{};  ///< Further elements of the root, of any content; the root has any attributes then.
};

/// The languages of schemas: XML Schema 1.0, and RELAX NG in its compact syntax, which is that of Emacs.
enum class SchemaLanguage { xsd, rnc };

/// Returns the schema of a kind of file. It refuses no file that the reader takes, but it is less strict: numbers have their
/// units checked, whole numbers also their range, and nothing is compared with other files. An attribute with a rule for a
/// number may hold several, since some are lists. RELAX NG cannot say that names must differ.
///
/// Thread contract: pure function.
[[nodiscard]] std::string schema(const FileRules& file, const SchemaOptions& options,
                                 SchemaLanguage language = SchemaLanguage::xsd);

}  // namespace orca::xml
