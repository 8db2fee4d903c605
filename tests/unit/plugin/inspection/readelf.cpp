// SPDX-License-Identifier: GPL-3.0-or-later
#include "readelf.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace orca::test {
namespace {

std::string output_of(const std::string& command) {
  const auto close = [](FILE* pipe) { return pclose(pipe); };
  std::unique_ptr<FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0;)
    text.append(buffer.data(), count);
  if (pclose(pipe.release()) != 0) throw std::runtime_error("failed: " + command);
  return text;
}

// Calls `take` with the words of each line.
template <class Take>
void for_each_line(const std::string& text, Take&& take) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> all;
    for (std::string word; words >> word;) all.push_back(word);
    take(line, all);
  }
}

std::uint64_t hexadecimal(const std::string& text) { return std::stoull(text, nullptr, 16); }

// Words between the columns: "[VARIANT_PCS]", or "<OS specific>: 10" for what has no name unless the system is GNU.
bool is_remark(const std::string& word) {
  return word.starts_with('[') || word == "<OS" || word == "specific>:";
}

std::string between_brackets(const std::string& line) {
  const auto start = line.find('[') + 1;
  return line.substr(start, line.rfind(']') - start);
}

// Returns the library that each version belongs to, by the version's number.
std::map<std::string, std::string> libraries_of_versions(const std::string& readelf) {
  std::map<std::string, std::string> libraries;
  std::string library;
  for_each_line(output_of(readelf), [&](const std::string& /*line*/, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
      if (words[i] == "File:") library = words[i + 1];
      if (words[i] == "Version:" && words.size() > 3 && words[1] == "Name:")
        libraries[words[i + 1]] = library;
    }
  });
  return libraries;
}

// "NUMBER: ADDRESS SIZE TYPE BINDING VISIBILITY SECTION NAME[@VERSION] [(VERSION'S NUMBER)]"
Readelf::Symbol symbol_of(const std::vector<std::string>& words,
                          const std::map<std::string, std::string>& libraries) {
  const bool defined = words[6] != "UND";
  const auto at = words[7].find('@');
  const std::string binding = words[4] == "10" ? "UNIQUE" : words[4];
  Readelf::Symbol symbol{
      words[7].substr(0, at), binding, defined, defined ? hexadecimal(words[1]) : 0, {}, {}};
  if (defined || at == std::string::npos) return symbol;
  symbol.version = words[7].substr(at + 1);
  symbol.version_of = libraries.at(words.at(8).substr(1, words[8].size() - 2));
  return symbol;
}

// "... Build ID: DIGITS"
void take_build_id(const std::vector<std::string>& words, std::string& build_id) {
  for (std::size_t i = 0; i + 2 < words.size(); ++i)
    if (words[i] == "Build" && words[i + 1] == "ID:") build_id = words[i + 2];
}

// "[NUMBER] NAME TYPE ADDRESS OFFSET SIZE ..."
void add_section(std::string line, std::map<std::string, Readelf::Section>& sections) {
  std::istringstream words(line.substr(line.find(']') + 1));
  std::string name, type, address, offset, size;
  words >> name >> type >> address >> offset >> size;
  sections.try_emplace(name, Readelf::Section{hexadecimal(offset), hexadecimal(size), type != "NOBITS"});
}

}  // namespace

Readelf::Readelf(const std::string& path) {
  const auto command = [&](const std::string& options) {
    return "LC_ALL=C " ORCA_READELF " --wide " + options + " '" + path + "'";
  };
  for_each_line(output_of(command("--dynamic")), [&](const std::string& line, const auto& words) {
    if (words.size() < 2) return;
    if (words[1] == "(NEEDED)") needed.push_back(between_brackets(line));
    if (words[1] == "(RUNPATH)" || words[1] == "(RPATH)") search_path = between_brackets(line);
  });
  for_each_line(output_of(command("--notes")),
                [&](const std::string& /*line*/, const auto& words) { take_build_id(words, build_id); });
  const auto libraries = libraries_of_versions(command("--version-info"));
  for_each_line(output_of(command("--dyn-syms")), [&](const std::string& /*line*/, auto words) {
    std::erase_if(words, is_remark);
    if (words.size() < 8 || words[0] == "Num:" || words[4] == "LOCAL") return;
    symbols.push_back(symbol_of(words, libraries));
  });
  for_each_line(output_of(command("--sections")), [&](const std::string& line, const auto& words) {
    const bool is_entry = line.starts_with("  [") && words[0] != "[Nr]";
    if (is_entry && words[1] != "0]") add_section(line, sections);  // the first one means "no section"
  });
  for_each_line(output_of(command("--segments")), [&](const std::string& /*line*/, const auto& words) {
    if (words.size() > 6 && words[0] == "LOAD")
      segments.emplace_back(hexadecimal(words[1]), hexadecimal(words[2]), hexadecimal(words[4]));
  });
}

std::string line_of(const Readelf::Symbol& symbol) {
  std::ostringstream line;
  line << symbol.name << ' ' << symbol.binding << (symbol.defined ? " at " : " needed ") << std::hex
       << symbol.address;
  if (!symbol.version.empty()) line << " version " << symbol.version << " of " << symbol.version_of;
  return line.str();
}

}  // namespace orca::test
