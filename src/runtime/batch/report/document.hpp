// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "drawing.hpp"

namespace orca::batch {

/// A report as a list of blocks, which becomes a page of HTML or of Markdown. Texts are plain: whoever writes the page escapes
/// them. Plain values.
struct Heading {
  std::string text;
};
struct Paragraph {
  std::string text;
};
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
/// Drawings with a caption, for instance a legend and a map; a page of Markdown has only the caption.
struct Figure {
  std::vector<Drawing> drawings;
  std::string caption;
};
/// A command to type.
struct Command {
  std::string text;
};
using Block = std::variant<Heading, Paragraph, Table, Figure, Command>;

struct Document {
  std::string title;
  std::vector<Block> blocks;

  template <class Kind>
  void add(Kind block) {
    blocks.emplace_back(std::move(block));
  }
};

/// Returns one self-contained page, which is well-formed XML too.
[[nodiscard]] std::string to_html(const Document& document);
[[nodiscard]] std::string to_markdown(const Document& document);
/// Returns each drawing as an SVG and a PDF file with its caption as the description, and each table as a LaTeX file with a plain tabular.
/// The names have the section's heading and a number: "figures/times-and-speeds-1.svg", "tables/success-1.tex".
[[nodiscard]] std::map<std::string, std::string> to_files(const Document& document);

}  // namespace orca::batch
