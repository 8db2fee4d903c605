// SPDX-License-Identifier: GPL-3.0-or-later
// Objects with bulk data (ADR 0104) by Push, Send and Query, over every link.
#include "link_kits.hpp"
#include "orca/idl/navigation.hpp"

using namespace orca;
using namespace orca::test;
using idl::Image;

namespace {

constexpr std::size_t kLarge = 300'000;  // [bytes]

struct PictureCamera : Peer {
  explicit PictureCamera(Executive& executive, const std::string& name = "camera") : Peer(executive, name) {}
  // The bytes of an image are all its number.
  Loan<Image> numbered(int number, std::size_t size = kLarge) {
    auto image = make_object<Image>();
    image->width(static_cast<std::uint32_t>(number));
    image->data().assign(size, static_cast<std::uint8_t>(number));
    return image;
  }
  PushServer<Image> out{*this, "out"};
  SendProxy<Image> sent{*this, "sent"};
  QueryProxy<Image, Image> asked{*this, "asked"};
};

struct PictureViewer : Peer {
  explicit PictureViewer(Executive& executive, const std::string& name = "viewer") : Peer(executive, name) {}
  Status on_sent(const ObjectPtr<Image>& image) {
    kept.push_back(image);
    return ok();
  }
  // Answers with twice the bytes.
  Result<Loan<Image>> on_asked(const ObjectPtr<Image>& image) {
    Loan<Image> answer = copy_value(image);
    answer->data().resize(2 * image->data().size());
    std::ranges::copy(image->data(),
                      answer->data().begin() + static_cast<std::ptrdiff_t>(image->data().size()));
    return answer;
  }
  std::vector<ObjectPtr<Image>> kept;
  PushProxy<Image> in{*this, "in"};
  SendServer<Image> sent{*this, "sent", &PictureViewer::on_sent};
  QueryServer<Image, Image> asked{*this, "asked", &PictureViewer::on_asked};
};

void check_whole(const ObjectPtr<Image>& image, int number, std::size_t size = kLarge) {
  REQUIRE(image);
  CHECK(image->width() == static_cast<std::uint32_t>(number));
  CHECK(image->data() == std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(number)));
}

template <class Kit>
void listen(Kit& kit, PictureCamera& camera, PictureViewer& viewer, const QueuePolicy& policy = {}) {
  kit.connect(camera.endpoint("out"), viewer.endpoint("in"), policy);
  viewer.in.subscribe();
  REQUIRE(eventually(kit.executive, [&] { return camera.out.subscriber_count() == 1; }));
}

}  // namespace

CONTRACT_CASE("images arrive whole and in their order, and stay as they are while others come",
              "[contract][bulk]") {
  PictureCamera camera(kit.executive);
  PictureViewer viewer(kit.executive);
  listen(kit, camera, viewer);
  std::vector<ObjectPtr<Image>> kept;
  for (int number = 1; number <= 12; ++number) {
    camera.out.push(camera.numbered(number));
    kept.push_back(viewer.in.get_update_wait_max(5s));
    check_whole(kept.back(), number);
  }
  for (int number = 1; number <= 12; ++number)
    check_whole(kept[static_cast<std::size_t>(number) - 1], number);
}

CONTRACT_CASE("an image and its sealed original are independent of each other's end", "[contract][bulk]") {
  PictureViewer viewer(kit.executive);
  ObjectPtr<Image> got;
  {
    PictureCamera camera(kit.executive);
    listen(kit, camera, viewer);
    for (int number = 1; number <= 3; ++number) {
      const ObjectPtr<Image> original = camera.numbered(number).seal();
      camera.out.push(copy_value(original));
      got = viewer.in.get_update_wait_max(5s);
      check_whole(original, number);
    }
  }
  check_whole(got, 3);
  const Loan<Image> copy = copy_value(got);
  copy->data();
  CHECK(copy->data() == got->data());
}

CONTRACT_CASE("images of any size arrive, empty ones too", "[contract][bulk]") {
  PictureCamera camera(kit.executive);
  PictureViewer viewer(kit.executive);
  listen(kit, camera, viewer);
  int number = 0;
  for (const std::size_t size : {300'000U, 0U, 16'383U, 16'384U, 16'385U, 1U, 1'000'000U, 4096U}) {
    camera.out.push(camera.numbered(++number, size));
    check_whole(viewer.in.get_update_wait_max(5s), number, size);
  }
}

CONTRACT_CASE("images are sent, asked for and answered", "[contract][bulk]") {
  PictureCamera camera(kit.executive);
  PictureViewer viewer(kit.executive);
  viewer.open();
  kit.connect(camera.endpoint("sent"), viewer.endpoint("sent"));
  kit.connect(camera.endpoint("asked"), viewer.endpoint("asked"));
  for (int number = 1; number <= 4; ++number) {
    REQUIRE(camera.sent.send(camera.numbered(number)).ok());
    REQUIRE(eventually(kit.executive, [&] { return viewer.handle_one(); }));
    check_whole(viewer.kept.back(), number);
    const auto id = camera.asked.query_request(camera.numbered(number));
    REQUIRE(id);
    REQUIRE(eventually(kit.executive, [&] { return viewer.handle_one(); }));
    const auto answer = camera.asked.query_receive_wait(*id, 5s);
    REQUIRE(answer);
    check_whole(*answer, number, 2 * kLarge);
  }
}

CONTRACT_CASE("a received image can be pushed on", "[contract][bulk]") {
  PictureCamera camera(kit.executive);
  PictureViewer viewer(kit.executive);
  PictureCamera relay(kit.executive, "relay");  // topics of DDS are named after components
  PictureViewer last(kit.executive, "last");
  listen(kit, camera, viewer);
  listen(kit, relay, last);
  for (int number = 1; number <= 4; ++number) {
    camera.out.push(camera.numbered(number));
    relay.out.push(copy_value(viewer.in.get_update_wait_max(5s)));
    check_whole(last.in.get_update_wait_max(5s), number);
  }
}
