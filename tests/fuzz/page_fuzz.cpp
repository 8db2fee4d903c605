// SPDX-License-Identifier: GPL-3.0-or-later
// Any message of a page is a wish or an error, any request's head is let in only by the name of this machine, and gets only a file of the
// page. Any text is a layout that can be kept and read, or none.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "access.hpp"
#include "foxglove/ros_messages.hpp"
#include "layout_file.hpp"
#include "web_files.hpp"
#include "wish.hpp"

namespace {

namespace fs = std::filesystem;

// A folder with a file of a page, and one beside it that is nobody's business.
struct Folder {
  Folder() {
    if (mkdtemp(path.data()) == nullptr) std::abort();
    fs::create_directory(path + "/web");
    write("/web/page.js");
    write("/secret.js");
  }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name) const { std::ofstream(path + name) << name; }
  std::string path = (fs::temp_directory_path() / "orca-page-fuzz-XXXXXX").string();
};

void try_files(const Folder& folder, const std::string& target) {
  const auto file = orca::view::WebFiles(folder.path + "/web").find(target);
  if (file && target.substr(0, target.find('?')) != "/page.js" && !target.starts_with("/lib/")) std::abort();
}

void try_layout(const Folder& folder, const std::string& text) {
  const std::string graph = folder.path + "/graph.xml";
  if (!orca::view::keep_layout(graph, text).ok()) return;
  const auto layout = orca::view::read_layout(graph);
  if (!layout || !orca::view::keep_layout(graph, *layout).ok()) std::abort();
  if (orca::view::read_layout(graph).value() != *layout) std::abort();
}

void try_names(const std::string& host) {
  const orca::view::Calling calling{"https", {"*.lab.org", "robot", "[fd00::7]"}};
  if (!orca::view::is_own_host(host, calling)) return;
  const std::string name = host.substr(0, host.find(':', host.starts_with('[') ? host.find(']') : 0));
  if (name.size() < std::string("robot").size()) std::abort();
  if (!orca::view::is_own_origin("https://" + host, host, calling)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::uint32_t id = 1;
  const auto wish = orca::view::read_wish(text, id);
  if (wish ? wish->id != id : wish.error().message.empty()) std::abort();
  if (wish && !(wish->rate >= 0.0 && wish->rate <= 1000.0)) std::abort();
  (void)orca::view::query_value(text, "token");
  std::string host = text;
  std::ranges::transform(host, host.begin(), [](unsigned char each) { return std::tolower(each); });
  if (orca::view::is_own_host(text) && !host.starts_with("127.0.0.1") && !host.starts_with("localhost") &&
      !host.starts_with("[::1]"))
    std::abort();
  if (orca::view::is_own_origin(text, "localhost") && !text.empty() && text != "http://localhost")
    std::abort();
  for (const char* const type : {"PoseStamped", "PoseWithCovarianceStamped", "Twist", "TwistStamped"})
    for (const char* const encoding : {"cdr", "json"}) {
      const auto message =
          orca::view::read_ros_message(std::string("geometry_msgs/msg/") + type, encoding, text);
      if (message && message->xml.empty()) std::abort();
    }
  static const Folder folder;
  try_files(folder, text);
  try_layout(folder, text);
  try_names(text);
  return 0;
}
