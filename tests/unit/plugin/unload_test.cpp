// SPDX-License-Identifier: GPL-3.0-or-later
// Plugins are loaded, described, unloaded, and proved gone: a plugin that stays in memory would run stale
// code after a swap.
#include <dlfcn.h>
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <locale>

#include "orca/base/log.hpp"
#include "orca/hw/container.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/plugin/loaded_plugins.hpp"
#include "places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;

namespace {

// Returns what the contract of one type says; hardware is not prepared for it.
Contract contract_of(const TypeEntry& type, const std::string& library) {
  if (type.kind == PluginKind::hardware) return describe_hardware(type, library, "test").value()->contract();
  return describe_component(type, library, nullptr).value();
}

void describe_all(const std::string& path) {
  const auto library = loaded(path);
  CHECK(is_mapped(path));
  CHECK_FALSE(library->types().empty());
  for (const TypeEntry* type : library->types()) CHECK(contract_of(*type, path).type == type->type);
}

// Unmaps within the scope and removes the file at its end.
struct Copy {
  explicit Copy(const std::string& name)
      : path(kForTests + "/copy_of_" + std::filesystem::path(name).filename().string() + ".so") {
    std::filesystem::copy_file(test_plugin(name), path, std::filesystem::copy_options::overwrite_existing);
  }
  ~Copy() { std::filesystem::remove(path); }
  std::string path;
};

// Loads an image of a plugin, constructs its types and unloads it; returns the type's name, empty if it could not be loaded.
std::string type_in_image_of(const std::string& path) {
  Result<PluginImage> image = PluginImage::copy(path);
  if (!image) return {};
  const auto library = PluginLibrary::load(std::move(image).value());
  if (!library) return {};
  (void)contract_of(*(*library)->types().front(), path);
  return (*library)->types().front()->type;
}

// Returns what a function says in a copy of this process: what stays in memory there is in no other test's way.
template <class Question>
bool holds_in_a_copy(const Question& question) {
  const pid_t copy = fork();
  if (copy == 0) {
    try {
      _exit(question() ? 0 : 1);
    } catch (...) {  // a failed assertion; the other tests are not to run on in the copy
      _exit(2);
    }
  }
  int status = 0;
  return copy > 0 && waitpid(copy, &status, 0) == copy && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("every shipped plugin is loaded, described, unloaded and gone, twice", "[plugin][unload]") {
  const auto plugins = plugins_in(kShipped);
  CHECK(plugins.size() >= 6);
  for (const std::string& path : plugins) {
    CAPTURE(path);
    for (int round = 0; round < 2; ++round) {
      describe_all(path);
      CHECK_FALSE(is_mapped(path));
    }
  }
}

TEST_CASE("every shipped type says in words what its ports and parameters are for", "[plugin][describe]") {
  for (const std::string& path : plugins_in(kShipped)) {
    const auto library = loaded(path);
    for (const TypeEntry* type : library->types()) {
      const Contract contract = contract_of(*type, path);
      for (const PortContract& port : contract.ports) {
        CAPTURE(contract.type, port.name);
        CHECK_FALSE(port.text.empty());
      }
      for (const ParamContract& param : contract.params) {
        CAPTURE(contract.type, param.name);
        CHECK_FALSE(param.text.empty());
      }
    }
  }
}

TEST_CASE("a plugin full of template, inline and local statics and with make_shared is gone after unloading",
          "[plugin][unload]") {
  const std::string path = test_plugin("test_statics");
  describe_all(path);
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("the same plugin built without the recipe would stay in memory, and is_mapped sees it",
          "[plugin][unload]") {
  const std::string path = test_plugin("bad/bad_pinned");
  CHECK(holds_in_a_copy([&] {
    void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    return handle != nullptr && dlclose(handle) == 0 && is_mapped(path);
  }));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin whose file is mapped to be read, as sanitizers do, is gone all the same",
          "[plugin][unload]") {
  const std::string path = test_plugin("test_statics");
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  constexpr std::size_t kPage = 4096;
  void* const view = mmap(nullptr, kPage, PROT_READ, MAP_PRIVATE, file, 0);
  REQUIRE(view != MAP_FAILED);
  describe_all(path);
  CHECK_FALSE(is_mapped(path));
  munmap(view, kPage);
  close(file);
}

TEST_CASE("a plugin whose thread still runs stays in memory instead of crashing it", "[plugin][unload]") {
  const std::string path = test_plugin("test_thread_left");
  CHECK(holds_in_a_copy([&] {
    describe_all(path);
    return is_mapped(path);
  }));
}

TEST_CASE("a plugin that stays in memory is not taken for another one that is loaded after it",
          "[plugin][unload]") {
  const std::string staying = GENERATE("test_thread_left", "staying/test_stays");
  CAPTURE(staying);
  const std::string type = staying == "staying/test_stays" ? "test.Stays" : "test.ThreadLeft";
  CHECK(holds_in_a_copy([&] {
    for (int round = 0; round < 3; ++round)
      if (type_in_image_of(test_plugin(staying)) != type ||
          type_in_image_of(test_plugin("test_statics")) != "test.Statics")
        return false;
    return true;
  }));
}

TEST_CASE("a plugin that stays in memory is not taken for what its file holds later", "[plugin][unload]") {
  const Copy copy("staying/test_stays");
  CHECK(holds_in_a_copy([&] {
    if (!PluginLibrary::load(copy.path) || !is_mapped(copy.path)) return false;
    std::filesystem::remove(copy.path);
    std::filesystem::copy_file(test_plugin("test_statics"), copy.path);
    const auto library = PluginLibrary::load(copy.path);
    return library && std::string((*library)->types().front()->type) == "test.Statics" &&
           (*library)->path() == copy.path;
  }));
}

TEST_CASE("a plugin whose static initialisation changes folder and umask is told so, and both are put back",
          "[plugin][load]") {
  const auto folder = std::filesystem::current_path();
  const mode_t mask = umask(022);
  std::vector<std::string> said;
  {
    const log::Listener listener([&](const log::Line& line) { said.emplace_back(line.text); });
    CHECK(loaded(test_plugin("test_rude"))->types().size() == 1);
  }
  CHECK(std::filesystem::current_path() == folder);
  CHECK(umask(mask) == 022);
  REQUIRE(said.size() == 1);
  CHECK_THAT(said.front(), Catch::Contains("has changed the working folder and the umask"));
}

TEST_CASE("standard streams that a plugin gives buffers, a tied stream and a locale of its own are put back",
          "[plugin][unload]") {
  auto* const buffer = std::cout.rdbuf();
  const auto* const tied = std::cin.tie();
  std::vector<std::string> said;
  {
    const log::Listener listener([&](const log::Line& line) { said.emplace_back(line.text); });
    const auto library = loaded(test_plugin("test_rude_streams"));
    CHECK(std::cout.rdbuf() == buffer);
    (void)contract_of(*library->types().front(), library->path());
    CHECK(std::cerr.getloc() != std::locale());
    CHECK(std::cin.tie() != tied);
  }
  CHECK(std::cerr.getloc() == std::locale());
  CHECK(std::cin.tie() == tied);
  CHECK_FALSE(is_mapped(test_plugin("test_rude_streams")));
  REQUIRE(said.size() == 2);
  CHECK_THAT(said[0], Catch::Contains("its static initialisation has changed the buffer of std::cout"));
  CHECK_THAT(said[1], Catch::Contains("the stream tied to std::cin and the locale of std::cerr"));
}

TEST_CASE("a plugin by whose code or data the process would be entered stays in memory, and is told by what",
          "[plugin][unload]") {
  CHECK(holds_in_a_copy([] {
    std::string why;
    auto library = loaded(test_plugin("staying/test_entered"));
    library->on_pinned([&](const std::string& reason) { why = reason; });
    (void)contract_of(*library->types().front(), library->path());
    library.reset();
    for (const char* const way : {"the handler of SIGUSR2", "std::set_new_handler()",
                                  "the environment variable ORCA_TEST_ENTERED", "the buffer of stdout"})
      if (why.find(way) == std::string::npos) return false;
    return raise(SIGUSR2) == 0 && getenv("ORCA_TEST_ENTERED") != nullptr && std::fputs("text", stdout) >= 0;
  }));
}

TEST_CASE("an address leads to the plugin that it lies in, as long as that is loaded", "[plugin][unload]") {
  const void* inside = nullptr;
  {
    const auto library = loaded(test_plugin("test_statics"));
    inside = library->types().front();
    REQUIRE(plugin_at(inside) != nullptr);
    CHECK(plugin_at(inside) == test_plugin("test_statics"));
    CHECK(plugin_at(&inside) == nullptr);
  }
  CHECK(plugin_at(inside) == nullptr);
}

TEST_CASE("a plugin that uses spdlog and Eigen is gone after unloading, and the host's spdlog lives on",
          "[plugin][unload]") {
  const std::string path = test_plugin("test_libraries");
  describe_all(path);
  CHECK_FALSE(is_mapped(path));
  CHECK(spdlog::default_logger() != nullptr);
}

TEST_CASE("two copies of a plugin have their own statics, and each is unloaded by itself",
          "[plugin][unload]") {
  const Copy copy("test_statics");
  const std::string original = test_plugin("test_statics");
  {
    const auto first = loaded(original);
    {
      const auto second = loaded(copy.path);
      CHECK(first->types().front() != second->types().front());
      CHECK(is_mapped(copy.path));
    }
    CHECK_FALSE(is_mapped(copy.path));
    CHECK(is_mapped(original));
  }
  CHECK_FALSE(is_mapped(original));
}

TEST_CASE("a mapped plugin is found even if its file has been removed or exchanged", "[plugin][unload]") {
  const Copy copy("test_statics");
  const auto library = loaded(copy.path);
  std::filesystem::remove(copy.path);
  CHECK(is_mapped(copy.path));
  std::filesystem::copy_file(test_plugin("test_statics"), copy.path);
  CHECK(is_mapped(copy.path));
}

TEST_CASE("only the whole path counts: a file of the same name elsewhere is not mapped", "[plugin][unload]") {
  const auto library = loaded(test_plugin("test_statics"));
  CHECK_FALSE(is_mapped("/test_statics.so"));
  CHECK_FALSE(is_mapped("/tests/unit_plugins/test_statics.so"));
  CHECK_FALSE(is_mapped(kForTests + "/test_static.so"));
}

TEST_CASE("a path may be relative to the working folder, also without a slash", "[plugin][unload]") {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(kForTests);
  const auto library = PluginLibrary::load("test_statics.so");
  const bool mapped = is_mapped("test_statics.so");
  std::filesystem::current_path(before);
  CHECK(library.has_value());
  CHECK(mapped);
  CHECK(is_mapped(test_plugin("test_statics")));
}
