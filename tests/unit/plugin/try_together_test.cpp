// SPDX-License-Identifier: GPL-3.0-or-later
// Several plugins in one trial, as those of a graph.
#include <pthread.h>

#include "places.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

int g_copies = 0;

// Returns how often this process was copied.
int copies() {
  [[maybe_unused]] static const int counts = pthread_atfork(
      nullptr, [] { ++g_copies; }, nullptr);
  return g_copies;
}

// A folder of plugins that nobody has tried out yet, from which they find Orca's libraries as from where they were built.
class FreshPlugins {
 public:
  FreshPlugins() {
    fs::create_directories(plugins_);
    for (fs::path above = plugins_; above != folder_.path();) {
      above = above.parent_path();
      fs::create_directory_symlink(ORCA_BINARY_DIR "/lib", above / "lib");
    }
  }
  // Returns the copy of a plugin, under a name.
  [[nodiscard]] std::string copy(const std::string& plugin, const std::string& name) const {
    const std::string file = (plugins_ / name).string();
    fs::copy_file(plugin, file, fs::copy_options::overwrite_existing);
    return file;
  }

 private:
  TempFolder folder_;
  fs::path plugins_ = folder_.path() / "as/deep/as/theirs";
};

const std::string kBad = test_plugin("bad/bad_static_crashes");

}  // namespace

TEST_CASE("plugins are tried out together in one copy of the process", "[plugin][together]") {
  const FreshPlugins fresh;
  std::vector<std::string> files;
  for (const std::string name : {"goto.so", "command.so", "motion_command_fuser.so"})
    files.push_back(fresh.copy(kShipped + "/" + name, name));
  const int before = copies();
  try_together(files);
  CHECK(copies() == before + 1);
  for (const std::string& file : files) CHECK_FALSE(loaded(file)->types().empty());
  try_together(files);
  CHECK(copies() == before + 1);
}

TEST_CASE("what does not survive a trial of several is tried alone, and blamed alone", "[plugin][together]") {
  const FreshPlugins fresh;
  const std::string good = fresh.copy(kShipped + "/goto.so", "good.so");
  const std::string bad = fresh.copy(kBad, "bad.so");
  try_together({bad, good, test_plugin("none"), test_plugin("bad/bad_no_manifest")});
  CHECK_FALSE(loaded(good)->types().empty());
  CHECK_THAT(refusal(bad).text(),
             Contains(bad) && Contains("static initialisation") && Contains("when it was tried out"));
}

TEST_CASE("a plugin that was written again after its trial is tried again", "[plugin][together]") {
  const FreshPlugins fresh;
  const std::string file = fresh.copy(kShipped + "/goto.so", "changing.so");
  try_together({file, fresh.copy(kShipped + "/command.so", "other.so")});
  (void)fresh.copy(kBad, "changing.so");
  CHECK_THAT(refusal(file).text(), Contains("when it was tried out"));
}
