// SPDX-License-Identifier: GPL-3.0-or-later
// Faults that only real plugins, worlds and robots show. Like approval_test.cpp, with the plugins of the
// build. In the approved texts PLUGINS is the folder of this test's plugins, SHIPPED that of Orca's, SOURCE
// the top of the tree.
#include <catch2/catch.hpp>

#include <fstream>

#include "approval.hpp"
#include "orca/host/catalogue.hpp"
#include "temp_folder.hpp"

namespace fs = std::filesystem;
using namespace orca;
using namespace orca::host;
using namespace orca::plugin;
using namespace orca::test;

namespace {

const fs::path kGraphs = fs::path(ORCA_SOURCE_DIR) / "tests/data/graphs";
const std::string kShipped = ORCA_BINARY_DIR "/plugins";

// Writes the folder of broken plugins, each with the list that says which types it should hold.
void lay_out_plugins(const TempFolder& folder) {
  const auto add = [&](const std::string& name, const std::string& types, const std::string& built) {
    static_cast<void>(folder.write(name + ".types", types));
    if (!built.empty()) fs::create_symlink(ORCA_BINARY_DIR "/tests/" + built, folder.file(name + ".so"));
  };
  add("gone", "component test.Gone\n", "");
  add("no_manifest", "component test.NoManifest\n", "unit_plugins/bad/bad_no_manifest.so");
  add("abi_version", "component test.AbiVersion\n", "unit_plugins/bad/bad_abi_newer.so");
  add("layout", "component test.Layout\n", "unit_plugins/bad/bad_layout.so");
  add("manifest_size", "component test.ManifestSize\n", "unit_plugins/bad/bad_manifest_size.so");
  add("undefined", "component test.Undefined\n", "unit_plugins/bad/bad_undefined_symbol.so");
  add("avoid", "component test.Forgotten\nhardware test.hw.Forgotten\n", "plugins/avoid.so");
  add("throws", "component test.ThrowsInConstructor\ncomponent test.ThrowsIntInConstructor\n",
      "plugins/test_components.so");
  add("text", "component test.Text\n", "");
  add("empty", "component test.Empty\n", "");
  static_cast<void>(folder.write("text.so", std::string(5000, 'x')));
  static_cast<void>(folder.write("empty.so", ""));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string errors_of(const fs::path& path, const graph::LoadOptions& options) {
  PluginCatalogue catalogue{PluginIndex({kShipped})};
  xml::Diagnostics diagnostics;
  CHECK_FALSE(graph::load_file(path.string(), options, catalogue, diagnostics).has_value());
  std::string said = replaced(diagnostics.text(), path.parent_path().string() + "/", "");
  said = replaced(said, kShipped, "SHIPPED");
  return replaced(said, ORCA_SOURCE_DIR, "SOURCE");
}

}  // namespace

TEST_CASE("each graph with a broken plugin, world or robot gives its approved errors", "[graph][approval]") {
  const TempFolder plugins;
  lay_out_plugins(plugins);
  const std::string folder = plugins.path().string();
  for (const fs::path& path : files_in(kGraphs / "plugins", ".xml"))
    check_approved(approved_text_of(path),
                   replaced(errors_of(path, {.settings = {"plugins=" + folder}}), folder, "PLUGINS"));
}

TEST_CASE("a graph that is checked again reads its files again, unless it was forgotten for a next one",
          "[graph]") {
  const TempFolder folder;
  const std::string office = std::string(ORCA_SOURCE_DIR) + "/sim/worlds/office.xml";
  const std::string world = folder.file("office.xml");
  PluginCatalogue catalogue{PluginIndex({kShipped})};
  const auto is_faultless = [&] {
    xml::Diagnostics diagnostics;
    // The simulator reads the world, and the configure() of a server of places.
    const graph::LoadOptions options{
        .profiles = {"sim", "odometry"}, .settings = {"world=" + world}, .try_components = true};
    return graph::load_file(ORCA_SOURCE_DIR "/graphs/scout_goto.xml", options, catalogue, diagnostics)
        .has_value();
  };
  fs::copy_file(office, world);
  CHECK(is_faultless());
  catalogue.forget_graph();
  std::ofstream(world) << "no world";
  CHECK(is_faultless());  // the world is as it was for the graph before
  CHECK_FALSE(is_faultless());
}

#if !defined(__SANITIZE_THREAD__)  // nothing is tried out then
TEST_CASE("each graph that only configure() can judge gives its approved errors, all of them at their places",
          "[graph][approval]") {
  const fs::path folder = kGraphs / "configure";
  CHECK(files_in(folder, ".xml").size() >= 20);
  for (const fs::path& path : files_in(folder, ".xml")) {
    graph::LoadOptions options{.try_components = true};
    if (bytes_of(path).find("${misbehaving}") != std::string::npos)
      options.settings.push_back("misbehaving=" ORCA_BINARY_DIR "/tests/plugins");
    check_approved(approved_text_of(path), errors_of(path, options));
  }
}
#endif
