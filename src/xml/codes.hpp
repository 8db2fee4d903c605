// SPDX-License-Identifier: LGPL-3.0-or-later
// The codes of all errors that a file can have before its content is checked. docs/errors.md explains them to
// people; a test compares the two.
#pragma once

namespace orca::xml::codes {

inline constexpr const char* kUnreadable = "G101";
inline constexpr const char* kEmpty = "G102";
inline constexpr const char* kTooLarge = "G103";
inline constexpr const char* kByteOrderMark = "G104";
inline constexpr const char* kEncoding = "G105";
inline constexpr const char* kBadByte = "G106";
inline constexpr const char* kNotXml = "G107";
inline constexpr const char* kNoRoot = "G108";
inline constexpr const char* kOutsideRoot = "G109";
inline constexpr const char* kTruncated = "G110";
inline constexpr const char* kEndTag = "G111";
inline constexpr const char* kDoctype = "G112";
inline constexpr const char* kTag = "G113";
inline constexpr const char* kAttribute = "G114";
inline constexpr const char* kLessThanInValue = "G115";
inline constexpr const char* kDuplicateAttribute = "G116";
inline constexpr const char* kEntity = "G117";
inline constexpr const char* kCharacterReference = "G118";
inline constexpr const char* kComment = "G119";
inline constexpr const char* kInstruction = "G120";
inline constexpr const char* kLimit = "G121";
inline constexpr const char* kXmlVersion = "G122";
inline constexpr const char* kReaderBug = "G129";

}  // namespace orca::xml::codes
