// SPDX-License-Identifier: LGPL-3.0-or-later
#include "document.hpp"

#include "orca/xml/document.hpp"

namespace orca::batch {
namespace {

using xml::escaped;

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; }
table { border-collapse: collapse; margin: 0.8rem 0; display: block; overflow-x: auto; }
th, td { border-bottom: 1px solid #ddd; padding: 0.25rem 0.7rem; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #888; white-space: nowrap; }
pre { background: #f4f4f4; padding: 0.6rem; overflow-x: auto; }
figure { margin: 1rem 0; } figcaption { color: #555; } svg { max-width: 100%; height: auto; }
)";

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells)
    text += std::string("<") + tag + ">" + escaped(cell) + "</" + tag + ">";
  return text + "</tr>\n";
}

struct HtmlWriter {
  std::string& page;
  void operator()(const Heading& block) const { page += "<h2>" + escaped(block.text) + "</h2>\n"; }
  void operator()(const Paragraph& block) const { page += "<p>" + escaped(block.text) + "</p>\n"; }
  void operator()(const Command& block) const { page += "<pre>" + escaped(block.text) + "</pre>\n"; }
  void operator()(const Figure& block) const {
    page += "<figure>\n";
    for (const Drawing& drawing : block.drawings) page += to_svg(drawing);
    page += "<figcaption>" + escaped(block.caption) + "</figcaption></figure>\n";
  }
  void operator()(const Table& block) const {
    page += "<table>\n<thead>" + html_row(block.head, "th") + "</thead>\n<tbody>\n";
    for (const std::vector<std::string>& row : block.rows) page += html_row(row, "td");
    page += "</tbody></table>\n";
  }
};

// A cell of a table may hold no line end and no bar.
std::string cell_text(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c == '\n' ? ' ' : c;
  }
  return cell;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell_text(cell) + " |";
  return text + "\n";
}

struct MarkdownWriter {
  std::string& page;
  void operator()(const Heading& block) const { page += "## " + block.text + "\n\n"; }
  void operator()(const Paragraph& block) const { page += block.text + "\n\n"; }
  void operator()(const Command& block) const { page += "```\n" + block.text + "\n```\n\n"; }
  void operator()(const Figure& block) const {
    page += "(Figure, in the HTML report: " + block.caption + ")\n\n";
  }
  void operator()(const Table& block) const {
    page += markdown_row(block.head) + markdown_row(std::vector<std::string>(block.head.size(), "---"));
    for (const std::vector<std::string>& row : block.rows) page += markdown_row(row);
    page += "\n";
  }
};

}  // namespace

std::string to_html(const Document& document) {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<title>" +
                     escaped(document.title) + "</title>\n<style>" + kStyle +
                     "</style>\n</head>\n<body>\n<h1>" + escaped(document.title) + "</h1>\n";
  for (const Block& block : document.blocks) std::visit(HtmlWriter{page}, block);
  return page + "</body>\n</html>\n";
}

std::string to_markdown(const Document& document) {
  std::string page = "# " + document.title + "\n\n";
  for (const Block& block : document.blocks) std::visit(MarkdownWriter{page}, block);
  return page;
}

}  // namespace orca::batch
