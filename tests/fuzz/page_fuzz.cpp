// SPDX-License-Identifier: GPL-3.0-or-later
// Any message of a page is a wish or an error, and any request's head is let in only by the name of this machine.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "access.hpp"
#include "foxglove/ros_messages.hpp"
#include "wish.hpp"

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
  return 0;
}
