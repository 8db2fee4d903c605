// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/control.hpp"

#include <catch2/catch.hpp>

#include "channel/samples.hpp"

using namespace orca;
using namespace orca::supervisor;
using namespace orca::test;

namespace {

Message without_last_byte(Message message) {
  if (!message.body.empty()) message.body.pop_back();
  return message;
}

Message with_one_byte_more(Message message) {
  message.body.push_back(std::byte{1});
  return message;
}

}  // namespace

TEST_CASE("what a client asks arrives as it was asked", "[supervisor][control]") {
  const Message message = encode(Ask{"set", {"avoid.margin", "0.3 m"}, true}, 7);
  CHECK(message.request == 7);
  const Result<Ask> ask = decode_ask(encode(Ask{"set", {"avoid.margin", "0.3 m"}, true}, 7));
  REQUIRE(ask);
  CHECK(ask->command == "set");
  CHECK(ask->words == std::vector<std::string>{"avoid.margin", "0.3 m"});
  CHECK(ask->as_json);
  CHECK(ask->most == Access::change);
  CHECK(ask->via.empty());
  const Result<Ask> for_another = decode_ask(encode(Ask{"set", {}, true, Access::observe, "page"}, 7));
  REQUIRE(for_another);
  CHECK(for_another->most == Access::observe);
  CHECK(for_another->via == "page");
}

TEST_CASE("how somebody has come is a short word, so that it forges no line of a log",
          "[supervisor][control]") {
  for (const std::string& via : {std::string("page: done\nuser root"), std::string("Page"),
                                 std::string("a b"), std::string(33, 'a')}) {
    CAPTURE(via);
    CHECK(decode_ask(encode(Ask{"ps", {}, false, Access::observe, via}, 1)).error().code == Code::data_loss);
  }
}

TEST_CASE("every answer arrives with its number, and encodes to the same bytes again",
          "[supervisor][control]") {
  for (ControlAnswer& answer : all_answers()) {
    const std::size_t kind = answer.index();
    Message message = encode(std::move(answer), 3);
    CHECK(message.request == 3);
    const std::vector<std::byte> body = message.body;
    Result<ControlAnswer> decoded = decode_answer(std::move(message));
    REQUIRE(decoded);
    CHECK(decoded->index() == kind);
    CHECK(encode(std::move(*decoded), 3).body == body);
  }
  for (LineWord& word : all_line_words()) {
    Message message = encode(std::move(word));
    const std::vector<std::byte> body = message.body;
    Result<LineWord> decoded = decode_line_word(std::move(message));
    REQUIRE(decoded);
    CHECK(encode(std::move(*decoded)).body == body);
  }
}

TEST_CASE("a word that is cut short, too long, or of another kind is refused", "[supervisor][control]") {
  CHECK(decode_ask(without_last_byte(encode(Ask{"ps", {}, false}, 1))).error().code == Code::data_loss);
  CHECK(decode_ask(with_one_byte_more(encode(Ask{"ps", {}, false}, 1))).error().code == Code::data_loss);
  CHECK(decode_ask(encode(LineWord(Offer{}))).error().code == Code::data_loss);
  CHECK(decode_answer(encode(Ask{"ps", {}, false}, 1)).error().code == Code::data_loss);
  for (ControlAnswer& answer : all_answers())
    CHECK(decode_answer(without_last_byte(encode(std::move(answer), 1))).error().code == Code::data_loss);
  for (LineWord& word : all_line_words())
    if (!std::holds_alternative<EndLine>(word))  // has no fields
      CHECK(decode_line_word(without_last_byte(encode(std::move(word)))).error().code == Code::data_loss);
}
