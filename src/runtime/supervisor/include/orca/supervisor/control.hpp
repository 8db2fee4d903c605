// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/message.hpp"
#include "orca/supervisor/record.hpp"
#include "orca/supervisor/role.hpp"

namespace orca::supervisor {

/// What an operator's program, such as orcactl, and the supervisor say to each other over the system's socket
/// (orca/supervisor/control_socket.hpp). A client asks; any number of answers with the number of its request follow, the
/// last of which is an EndAnswer.

/// Asks the supervisor to do something, or to show something.
struct Ask {
  static constexpr Kind kKind = Kind::ask;
  std::string command;             ///< As on the command line: "ps".
  std::vector<std::string> words;  ///< What follows it, options included.
  bool as_json = false;            ///< Texts are wanted as JSON.
  Access most =
      Access::change;  ///< The most that counts, for a program that asks for somebody whom it serves.
  std::string via{};   ///< How that one has come, up to 32 small letters: "page"; empty: it asks for itself.
};

/// A line of a table.
struct RecordAnswer {
  static constexpr Kind kKind = Kind::record_answer;
  Record record;
};
/// A text as it is to be printed.
struct TextAnswer {
  static constexpr Kind kKind = Kind::text_answer;
  std::string text;
};
/// Something that a person should know of the answer, and that is no part of it.
struct NoteAnswer {
  static constexpr Kind kKind = Kind::note_answer;
  std::string text;
};
/// A line to ports of one process: see below. Whoever asks for several ports gets a line for each process that has some of
/// them, and that takes orders at present. The supervisor itself carries no objects.
struct LineAnswer {
  static constexpr Kind kKind = Kind::line_answer;
  Descriptor line;                   ///< A socket, as of make_socket_pair().
  std::string type;                  ///< Of the objects at the first port.
  std::string reply;                 ///< Of the replies of a QueryServer; empty: there are none.
  std::vector<std::string> ports{};  ///< "component.port": those of the line, in the order of Tapped::place.
};
/// The end of the answer.
struct EndAnswer {
  static constexpr Kind kKind = Kind::end_answer;
  Status outcome;
};
using ControlAnswer = std::variant<RecordAnswer, TextAnswer, LineAnswer, EndAnswer, NoteAnswer>;

/// What a client and the host process of some ports say to each other over a line.

/// An object that has passed a port.
struct Tapped {
  static constexpr Kind kKind = Kind::tapped;
  std::string type;               ///< Its IDL name.
  std::vector<std::byte> object;  ///< XCDR1; empty if the client wants only the times.
  std::uint64_t passed = 0;       ///< When it passed [ns of the run's clock].
  std::uint64_t created = 0;      ///< Its creation_time [ns of the run's clock].
  std::uint64_t size = 0;  ///< [bytes] of the whole object as XCDR1; 0 if the client wants only the times.
  std::uint64_t lost =
      0;  ///< Objects of the port that the line had no room for, from its beginning until now.
  std::uint64_t place = 0;  ///< Of the port among those of the line.
};
/// Asks for the end of a line: all that has passed until now is sent, then LineEnded.
struct EndLine {
  static constexpr Kind kKind = Kind::end_line;
};
/// The end of a line. It also comes without being asked for if the process ends and the line has a bound of its own.
struct LineEnded {
  static constexpr Kind kKind = Kind::line_ended;
  std::vector<std::uint64_t> lost;  ///< Objects of each port that the line had no room for.
};
/// An object for a SendServer, or a question for a QueryServer. Not at a line that taps: it is cut off.
struct Offer {
  static constexpr Kind kKind = Kind::offer;
  std::string type;
  std::vector<std::byte> object;  ///< XCDR1.
};
/// What has become of an offer.
struct OfferOutcome {
  static constexpr Kind kKind = Kind::offer_outcome;
  Status outcome;
  std::string type;               ///< Of the reply; empty: there is none.
  std::vector<std::byte> object;  ///< The reply, XCDR1.
};
using LineWord = std::variant<Tapped, Offer, OfferOutcome, EndLine, LineEnded>;

/// Encode a word.
/// @param request  number of the request, which its answers repeat.
/// @thread  any.
[[nodiscard]] Message encode(Ask ask, std::uint64_t request);
[[nodiscard]] Message encode(ControlAnswer answer, std::uint64_t request);
[[nodiscard]] Message encode(LineWord word, std::uint64_t request = 0);

/// Decode a word. The sender is not trusted.
/// @errors  data_loss if it is no such word, if a field is missing or impossible, or if something is left over.
/// @thread  any.
[[nodiscard]] Result<Ask> decode_ask(Message message);
[[nodiscard]] Result<ControlAnswer> decode_answer(Message message);
[[nodiscard]] Result<LineWord> decode_line_word(Message message);

}  // namespace orca::supervisor
