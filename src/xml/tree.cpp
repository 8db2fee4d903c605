// SPDX-License-Identifier: LGPL-3.0-or-later
#include "tree.hpp"

#include <tinyxml2.h>

#include "codes.hpp"

namespace orca::xml {

class TreeBuilder {
 public:
  TreeBuilder(const Scan& scan, const std::string& file) : scan_(scan), file_(file) {}

  // Returns false as soon as tinyxml2 and the scanner saw different things.
  bool build(const tinyxml2::XMLElement& from, Element& to) {
    if (next_ == scan_.elements.size()) return false;
    const ElementMark& mark = scan_.elements[next_++];
    to.name_ = from.Name();
    to.position_ = position(mark.begin);
    to.text_position_ = position(mark.text);
    return attributes(from, mark, to) && content(from, to);
  }
  [[nodiscard]] bool complete() const { return next_ == scan_.elements.size(); }

 private:
  bool attributes(const tinyxml2::XMLElement& from, const ElementMark& mark, Element& to) {
    auto next = mark.attributes.begin();
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next(), ++next) {
      if (next == mark.attributes.end()) return false;
      to.attributes_.push_back(
          {a->Name(), a->Value(), position(next->name), position(next->value), next->intact});
    }
    return next == mark.attributes.end();
  }

  bool content(const tinyxml2::XMLElement& from, Element& to) {
    for (const auto* node = from.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (const auto* text = node->ToText()) to.text_ += text->Value();
      const auto* element = node->ToElement();
      if (element != nullptr && !build(*element, to.children_.emplace_back())) return false;
    }
    return true;
  }

  [[nodiscard]] Position position(Mark mark) const { return {file_, mark.line, mark.column}; }

  const Scan& scan_;
  const std::string& file_;
  std::size_t next_ = 0;
};

namespace {

std::string without(const std::vector<Range>& ranges, std::string_view text) {
  std::string result(text);
  for (const Range& range : ranges) result.replace(range.offset, range.size, range.size, ' ');
  return result;
}

}  // namespace

std::optional<Document> build_tree(std::string_view text, const Scan& scan, const std::string& file,
                                   Diagnostics& out) {
  tinyxml2::XMLDocument tree;
  Document document;
  TreeBuilder builder(scan, file);
  const std::string unique = without(scan.repeated, text);
  tree.Parse(unique.data(), unique.size());
  const auto* root = tree.RootElement();
  const bool built =
      !tree.Error() && root != nullptr && builder.build(*root, document.root) && builder.complete();
  if (built) return document;
  const int line = tree.Error() ? tree.ErrorLineNum() : 1;
  out.error(codes::kReaderBug, {file, line, 1},
            "Orca's two readers do not agree about this file; this is a bug in Orca, please report it with "
            "the file");
  return std::nullopt;
}

}  // namespace orca::xml
