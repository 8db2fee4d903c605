// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cctype>
#include <map>
#include <string>
#include <string_view>

#include "document.hpp"

namespace orca::batch {
namespace {

// Returns a heading as a part of a file's name: "Times and speeds" is "times-and-speeds".
std::string name_part(const std::string& heading) {
  std::string name;
  for (const char c : heading) {
    const bool stays = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (stays) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!stays && !name.empty() && name.back() != '-') name += '-';
  }
  return name;
}

std::string tex_text(const std::string& text) {
  static const std::map<char, std::string> special{{'\\', "\\textbackslash{}"},  {'~', "\\textasciitilde{}"},
                                                   {'^', "\\textasciicircum{}"}, {'<', "\\textless{}"},
                                                   {'>', "\\textgreater{}"},     {'|', "\\textbar{}"},
                                                   {'"', "\\textquotedbl{}"},    {'\n', " "}};
  std::string tex;
  for (const char c : text) {
    const auto found = special.find(c);
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) tex += '\\';
    tex += found == special.end() ? std::string(1, c) : found->second;
  }
  return tex;
}

std::string tex_row(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += (&cell == &cells.front() ? "" : " & ") + tex_text(cell);
  return row + " \\\\\n";
}

// Returns a table that needs no package but that of its font: \textquotedbl is in T1.
std::string to_tex(const Table& table) {
  std::string text = "\\begin{tabular}{" + std::string(table.head.size(), 'l') + "}\n\\hline\n" +
                     tex_row(table.head) + "\\hline\n";
  for (const std::vector<std::string>& row : table.rows) text += tex_row(row);
  return text + "\\hline\n\\end{tabular}\n";
}

// Takes the blocks of a document, and makes a file of each drawing and table.
class Files {
 public:
  void operator()(const Heading& block) { section_ = name_part(block.text); }
  void operator()(const Table& block) { all[next("tables/") + ".tex"] = to_tex(block); }
  void operator()(const Figure& block) {
    for (const Drawing& drawing : block.drawings) {
      const std::string name = next("figures/");
      all[name + ".svg"] = to_svg(drawing, block.caption);
      if (std::string pdf = to_pdf(drawing, block.caption); !pdf.empty()) all[name + ".pdf"] = std::move(pdf);
    }
  }
  void operator()(const Paragraph& /*block*/) {}
  void operator()(const Command& /*block*/) {}

  std::map<std::string, std::string> all{};

 private:
  // Returns the name of the next file of this section, without its end.
  std::string next(const std::string& folder) {
    const std::string name = folder + section_ + "-";
    return name + std::to_string(++counts_[name]);
  }

  std::string section_ = "experiment";
  std::map<std::string, int> counts_{};
};

}  // namespace

std::map<std::string, std::string> to_files(const Document& document) {
  Files files;
  for (const Block& block : document.blocks) std::visit(files, block);
  return std::move(files.all);
}

}  // namespace orca::batch
