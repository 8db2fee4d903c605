// SPDX-License-Identifier: GPL-3.0-or-later
// The copy of a plugin's file that is loaded in its place.
#include "orca/plugin/image.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "places.hpp"
#include "temp_folder.hpp"

using namespace orca;
using orca::plugin::PluginImage;
using orca::test::read_text;
using orca::test::TempFolder;

namespace {

Code refusal_of(const std::string& file) {
  const Result<PluginImage> copied = PluginImage::copy(file);
  REQUIRE_FALSE(copied);
  CHECK(copied.error().where == file);
  return copied.error().code;
}

}  // namespace

TEST_CASE("an image has the bytes of its file, whatever becomes of the file, and nobody can change them",
          "[plugin][image]") {
  const TempFolder folder;
  const std::string bytes = "begin" + std::string(3'000'000, 'x') + "end";
  const std::string file = folder.write("some.so", bytes);
  Result<PluginImage> image = PluginImage::copy(file);
  REQUIRE(image);
  (void)folder.write("some.so", "another");
  CHECK(read_text(image->path()) == bytes);
  CHECK(image->origin() == file);
  const Descriptor taken = std::move(*image).take_bytes();
  CHECK(write(taken.number(), "y", 1) < 0);
  CHECK(ftruncate(taken.number(), 0) != 0);
  CHECK(ftruncate(taken.number(), 4'000'000) != 0);
}

TEST_CASE("each image has a name of its own, which contains that of its file", "[plugin][image]") {
  const TempFolder folder;
  const std::string file = folder.write("some.so", "bytes");
  const Result<PluginImage> first = PluginImage::copy(file), second = PluginImage::copy(file);
  REQUIRE(first);
  REQUIRE(second);
  CHECK_THAT(first->mapped_name(), Catch::Contains("orca:some.so#"));
  CHECK(first->mapped_name() != second->mapped_name());
  const std::string long_name(250, 'n');
  CHECK(PluginImage::copy(folder.write(long_name, "bytes")));
}

TEST_CASE("a file that is not there, is none, or cannot be read has no image", "[plugin][image]") {
  const TempFolder folder;
  CHECK(refusal_of(folder.file("none.so")) == Code::not_found);
  CHECK(refusal_of(folder.path().string()) == Code::not_found);
  const std::string pipe = folder.file("pipe");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(refusal_of(pipe) == Code::not_found);
  CHECK(refusal_of(folder.write("file", "") + "/below.so") == Code::unavailable);
  CHECK(refusal_of("/proc/self/mem") == Code::unavailable);  // nothing is mapped where it begins
}

TEST_CASE("a file that others can write is neither loaded nor copied", "[plugin][image]") {
  const TempFolder folder;
  const std::string file = folder.write("open.so", read_text(orca::test::kExample));
  REQUIRE(chmod(file.c_str(), 0755) == 0);
  CHECK(plugin::PluginLibrary::load(file));
  REQUIRE(chmod(file.c_str(), 0757) == 0);
  CHECK(refusal_of(file) == Code::failed_precondition);
  const Error refused = orca::test::refusal(file);
  CHECK(refused.where == file);
  CHECK_THAT(refused.message, Catch::Contains("is not loaded: " + file + " can be written to by everybody") &&
                                  Catch::Contains("run: chmod go-w "));
}
