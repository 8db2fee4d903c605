// SPDX-License-Identifier: LGPL-3.0-or-later
#include "assembly.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "arguments.hpp"
#include "codes.hpp"
#include "files.hpp"
#include "naming.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/text.hpp"
#include "prefix.hpp"
#include "structure.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

// A file that includes itself is a cycle; a chain of different files this long is a mistake as well.
constexpr std::size_t kDeepest = 50;
constexpr const char* kSystem = "system";  // an argument that each file has: the name of the whole

class Assembler {
 public:
  Assembler(const FileReader& read, Report& report, xml::Diagnostics& diagnostics)
      : files_(read, diagnostics), report_(report) {}

  // @param name  of the system, in place of the document's; empty: that.
  std::optional<Assembly> run(const xml::Document& document, const std::vector<std::string>& settings,
                              const std::string& name) {
    if (const xml::Attribute* const own = document.root.attribute("name")) system_ = *own;
    if (!name.empty()) system_.value = name;
    chain_.push_back(std::filesystem::path(document.root.position().file).lexically_normal().string());
    CommandLine line = read_command_line(settings, report_);
    Arguments arguments(line, budget_, report_);
    predefine(arguments);
    auto structure = read_structure(document, arguments, report_);
    if (!structure) return std::nullopt;
    result_.parameters = std::move(line.parameters);
    result_.graph = take(std::move(*structure), "");
    return std::move(result_);
  }

 private:
  // Returns the content of a file, with everything that it brings in, under a prefix.
  Node take(Structure structure, const std::string& prefix) {
    collect_plugin_folders(structure.graph);
    for (const std::string& name : structure.excused) result_.excused.insert(prefix + name);
    result_.names_incomplete |= structure.names_incomplete;
    expand(structure.graph);
    return std::move(structure.graph);
  }

  // A name that is made of arguments is not known yet.
  void predefine(Arguments& arguments) const {
    if (system_.value.find('$') == std::string::npos) arguments.predefine(kSystem, system_);
  }

  void expand(Node& parent) {
    std::vector<Node> children;
    for (Node& child : parent.children) {
      if (child.is("profile")) expand(child);
      if (brings_file(*child.rule)) {
        for (Node& brought : bring(child)) children.push_back(std::move(brought));
      } else {
        child.origin = origin_;
        children.push_back(std::move(child));
      }
    }
    parent.children = std::move(children);
  }

  std::vector<Node> bring(const Node& node) {
    const bool use = node.is("use");
    if (use) check_name(node, "prefix", report_);
    const Text* name = node.known(file_attribute(*node.rule));
    const Text* prefix = node.known("prefix");
    const xml::Document* document = name == nullptr ? nullptr : open(node, *name);
    if (document == nullptr || (use && prefix == nullptr)) return leave_out();
    const std::string context = use && !prefix->value.empty() ? prefix->value + "/" : "";
    if (use && name_fault(prefix->value)) report_.tolerate(context);
    result_.origins.push_back({node.position, origin_, node.rule});
    const Origin* const outer = std::exchange(origin_, &result_.origins.back());
    chain_.push_back(document->root.position().file);
    std::vector<Node> brought = content(*document, node, context);
    chain_.pop_back();
    origin_ = outer;
    return brought;
  }

  // Returns no nodes, after a report; the missing content causes no further errors.
  std::vector<Node> leave_out() {
    result_.names_incomplete = true;
    result_.files_missing = true;
    return {};
  }

  std::vector<Node> content(const xml::Document& document, const Node& bringer, const std::string& context) {
    Arguments arguments(bringer, budget_, report_);
    predefine(arguments);
    auto structure = read_structure(document, arguments, report_);
    if (!structure) return leave_out();
    prefixes_.push_back(prefixes_.empty() ? context : prefixes_.back() + context);
    Node graph = take(std::move(*structure), prefixes_.back());
    prefixes_.pop_back();
    if (!context.empty())
      for (Node& child : graph.children) put_prefix(child, context);
    return std::move(graph.children);
  }

  // Returns null after a report, or if there has been one.
  const xml::Document* open(const Node& node, const Text& name) {
    if (name.value.empty()) return refuse_empty(node, name);
    const std::string path = shown_path(name);
    if (std::ranges::find(chain_, path) != chain_.end()) return report_cycle(name, path);
    if (chain_.size() == kDeepest) return refuse(codes::kExpansion, node, name, "more than 50 files deep");
    if (!budget_.take_file(node.position, report_)) return nullptr;
    const Files::File& file = files_.open(path);
    if (!file.unreadable.empty())
      return refuse(codes::kCannotInclude, node, name, file.unreadable + hint_at_own_file(path));
    if (!file.document || !budget_.take_elements(file.elements, node.position, report_)) return nullptr;
    report_.share(path);
    return &*file.document;
  }

  // Returns the path as positions in the file show it, relative to the same folder as the first file's name.
  static std::string shown_path(const Text& name) {
    const auto folder = std::filesystem::path(name.named_in).parent_path();
    return (folder / name.value).lexically_normal().string();
  }

  const xml::Document* refuse(const char* code, const Node& node, const Text& name,
                              const std::string& reason) {
    const std::string chain = origin_ == nullptr ? "" : " (this file is included at " + origin_->text() + ")";
    report_.error(code, name.position,
                  "<" + std::string(node.rule->name) + "> cannot read " + in_quotes(shown_path(name)) + ": " +
                      reason + chain);
    return nullptr;
  }

  const xml::Document* refuse_empty(const Node& node, const Text& name) {
    const std::string attribute = file_attribute(*node.rule);
    report_.error(codes::kCannotInclude, name.position,
                  "<" + std::string(node.rule->name) + ">: " + attribute +
                      " is empty; name a graph file, as in " + attribute + "=\"behaviours.xml\"");
    return nullptr;
  }

  const xml::Document* report_cycle(const Text& name, const std::string& path) {
    std::string circle;
    for (auto file = std::ranges::find(chain_, path); file != chain_.end(); ++file) circle += *file + " -> ";
    report_.error(codes::kIncludeCycle, name.position,
                  "files include each other in a circle: " + circle + path + "; take one of these out");
    return nullptr;
  }

  void collect_plugin_folders(const Node& graph) {
    const Text* plugins = graph.known("plugins");
    if (plugins == nullptr) return;
    for (const std::string& part : split_list(plugins->value)) {
      if (part.empty()) continue;
      const std::string folder = resolved_path(part, *plugins);
      if (std::ranges::find(result_.plugin_folders, folder) == result_.plugin_folders.end())
        result_.plugin_folders.push_back(folder);
    }
  }

  Files files_;
  Report& report_;
  Budget budget_;
  Assembly result_;
  xml::Attribute system_;           // the name of the whole
  std::vector<std::string> chain_;  // the files that are open now, the outermost first
  std::vector<std::string>
      prefixes_;                    // prefixes of the open files except the first; each contains those before
  const Origin* origin_ = nullptr;  // the way by which the innermost file came in
};

}  // namespace

std::optional<Assembly> assemble(const xml::Document& document, const LoadOptions& options,
                                 const FileReader& read, Report& report, xml::Diagnostics& diagnostics) {
  return Assembler(read, report, diagnostics).run(document, options.settings, options.name);
}

}  // namespace orca::graph
