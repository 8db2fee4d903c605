// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_rules.hpp"

#include <array>

#include "codes.hpp"
#include "orca/robot_file/values.hpp"
#include "orca/sim/event.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

using xml::ElementRule;

constexpr ValueRule kSeed = whole(0.0, ValueRule::kUnlimited);
constexpr ValueRule kCount = whole(0.0, 1e6);  // Generators allow fewer, and report that themselves.
constexpr std::array<std::string_view, 4> kSides{"south", "north", "west", "east"};
constexpr std::array<std::string_view, 2> kLoops{"back", "round"};
constexpr std::array<std::string_view, 2> kLeaves{"swings", "slides"};
constexpr std::array<std::string_view, 2> kDoorStates{"shut", "open"};
constexpr std::array<std::string_view, 1> kContacts{"front"};
constexpr std::array<std::string_view, 5> kGeneratorKinds{"barn", "u_trap", "narrow_doors", "corridor",
                                                          "office"};

constexpr ValueRule kSurface = one_of(kFinishes);

constexpr std::array kWorld{required("name", kName), required("version", kText), optional("text", kText),
                            optional("base", kText)};
constexpr std::array kWall{optional("name", kName),     required("from", kText),
                           required("to", kText),       optional("thickness", kLength),
                           optional("height", kLength), optional("surface", kSurface)};
constexpr std::array kDoor{required("at", kLength), required("width", kLength)};
constexpr std::array kRoomDoor{required("side", one_of(kSides)), required("at", kLength),
                               required("width", kLength)};
constexpr std::array kBox{
    optional("name", kName),     required("x", kCoordinate),        required("y", kCoordinate),
    optional("yaw", kAngle),     required("length", kLength),       required("width", kLength),
    optional("height", kLength), optional("bottom", kLengthOrZero), optional("comes", kTime),
    optional("goes", kTime),     optional("surface", kSurface)};
constexpr std::array kCylinder{
    optional("name", kName),     required("x", kCoordinate),  required("y", kCoordinate),
    required("radius", kLength), optional("height", kLength), optional("bottom", kLengthOrZero),
    optional("comes", kTime),    optional("goes", kTime),     optional("surface", kSurface)};
constexpr std::array kPolygon{optional("name", kName), required("points", kText), optional("height", kLength),
                              optional("bottom", kLengthOrZero), optional("surface", kSurface)};
constexpr std::array kBitmap{optional("name", kName), required("file", kText), optional("width", kLength),
                             optional("resolution", kLength), optional("height", kLength)};
constexpr std::array kMesh{optional("name", kName),        required("file", kText),
                           required("x", kCoordinate),     required("y", kCoordinate),
                           optional("z", kCoordinate),     optional("yaw", kAngle),
                           optional("scale", positive(""))};
constexpr std::array kPlace{required("name", kName), required("x", kCoordinate), required("y", kCoordinate),
                            optional("yaw", kAngle)};
// The attributes of all kinds; generator_reader.cpp defines which kind has which.
constexpr std::array kGenerate{required("kind", one_of(kGeneratorKinds)),
                               optional("seed", kSeed),
                               optional("radius", kLength),
                               optional("fill", kText),
                               optional("rounds", kCount),
                               optional("width", kLength),
                               optional("depth", kLength),
                               optional("beside", kLength),
                               optional("door", kLength),
                               optional("walls", kCount),
                               optional("spacing", kLength),
                               optional("legs", kCount),
                               optional("shortest", kLength),
                               optional("longest", kLength),
                               optional("rooms", kCount),
                               optional("corridor", kLength),
                               optional("furniture", kCount)};
constexpr std::array kWalker{required("name", kName),
                             required("track", kText),
                             optional("speed", positive("m/s")),
                             optional("radius", kLength),
                             optional("height", kLength),
                             optional("loop", one_of(kLoops)),
                             optional("pause", kTime),
                             optional("start", kTime),
                             optional("seed", kSeed),
                             optional("stops", kLengthOrZero),
                             optional("yields", not_negative("", 1.0)),
                             optional("legs", kLengthOrZero),
                             optional("colour", kText)};

constexpr std::array kItem{required("name", kName), required("x", kCoordinate), required("y", kCoordinate),
                           required("radius", positive("m", 2.0)), required("height", positive("m", 2.0))};
constexpr std::array kSill{optional("name", kName), required("from", kText), required("to", kText),
                           required("height", positive("m", 0.1))};
constexpr std::array kWet{
    optional("name", kName), required("points", kText),
    optional("slip", {.form = ValueRule::Form::number, .unit = "", .min = 1.0, .max = 100.0}),
    optional("grip", positive("", 1.0))};

constexpr std::array kMove{required("of", kName), required("at", kTime), required("x", kCoordinate),
                           required("y", kCoordinate), optional("yaw", kAngle)};
constexpr std::array kKidnap{required("robot", kText),   required("at", kTime),
                             optional("latest", kTime),  optional("x", kCoordinate),
                             optional("y", kCoordinate), optional("yaw", kAngle),
                             optional("away", kLength)};
constexpr std::array kOutage{required("robot", kText), required("sensor", one_of(kSensorKinds)),
                             required("at", kTime), optional("until", kTime), optional("device", kName)};

constexpr std::array kDrain{required("robot", kText), required("at", kTime),
                            required("to", not_negative("", 1.0))};
constexpr std::array kCharger{required("place", kName), required("reach", positive("m", 10.0)),
                              optional("touch", one_of(kContacts))};

constexpr std::array kLeaf{
    required("name", kName),           required("from", kText),     required("to", kText),
    optional("kind", one_of(kLeaves)), optional("swing", kAngle),   optional("starts", one_of(kDoorStates)),
    optional("thickness", kLength),    optional("height", kLength), optional("closes_after", kTime)};
constexpr std::array kTurn{required("of", kName), required("at", kTime), optional("latest", kTime)};

constexpr ElementRule kDoorRule{.name = "door", .attributes = kDoor};
constexpr ElementRule kRoomDoorRule{.name = "door", .attributes = kRoomDoor};
constexpr std::array kInWall{&kDoorRule};
constexpr std::array kInRoom{&kRoomDoorRule};

}  // namespace

constexpr ElementRule kWallRule{.name = "wall", .attributes = kWall, .children = kInWall};
constexpr ElementRule kRoomRule{.name = "room", .attributes = kWall, .children = kInRoom};
constexpr ElementRule kBoxRule{.name = "box", .attributes = kBox};
constexpr ElementRule kCylinderRule{.name = "cylinder", .attributes = kCylinder};
constexpr ElementRule kPolygonRule{.name = "polygon", .attributes = kPolygon};
constexpr ElementRule kBitmapRule{.name = "bitmap", .attributes = kBitmap};
constexpr ElementRule kMeshRule{.name = "mesh", .attributes = kMesh};
constexpr ElementRule kPlaceRule{.name = "place", .attributes = kPlace};
constexpr ElementRule kGenerateRule{.name = "generate", .attributes = kGenerate};
constexpr ElementRule kWalkerRule{.name = "walker", .attributes = kWalker};
constexpr ElementRule kItemRule{.name = "item", .attributes = kItem};
constexpr ElementRule kSillRule{.name = "sill", .attributes = kSill};
constexpr ElementRule kWetRule{.name = "wet", .attributes = kWet};
constexpr ElementRule kMoveRule{.name = "move", .attributes = kMove};
constexpr ElementRule kKidnapRule{.name = "kidnap", .attributes = kKidnap};
constexpr ElementRule kOutageRule{.name = "outage", .attributes = kOutage};
constexpr ElementRule kDrainRule{.name = "drain", .attributes = kDrain};
constexpr ElementRule kChargerRule{.name = "charger", .attributes = kCharger};
constexpr ElementRule kLeafRule{.name = "leaf", .attributes = kLeaf};
constexpr ElementRule kOpenRule{.name = "open", .attributes = kTurn};
constexpr ElementRule kShutRule{.name = "shut", .attributes = kTurn};

namespace {

constexpr std::array kInWorld{
    &kWallRule,   &kRoomRule,     &kBoxRule,    &kCylinderRule, &kPolygonRule, &kBitmapRule, &kMeshRule,
    &kPlaceRule,  &kGenerateRule, &kWalkerRule, &kItemRule,     &kSillRule,    &kWetRule,    &kMoveRule,
    &kKidnapRule, &kOutageRule,   &kDrainRule,  &kChargerRule,  &kLeafRule,    &kOpenRule,   &kShutRule};

}  // namespace

constexpr ElementRule kWorldRule{.name = "world", .attributes = kWorld, .children = kInWorld};

namespace {

constexpr std::array kWorldElements{&kWorldRule,    &kWallRule,    &kRoomRule,   &kDoorRule,  &kBoxRule,
                                    &kCylinderRule, &kPolygonRule, &kBitmapRule, &kMeshRule,  &kPlaceRule,
                                    &kGenerateRule, &kWalkerRule,  &kItemRule,   &kSillRule,  &kWetRule,
                                    &kMoveRule,     &kKidnapRule,  &kOutageRule, &kDrainRule, &kChargerRule,
                                    &kLeafRule,     &kOpenRule,    &kShutRule};

}  // namespace

constexpr xml::FileRules kWorldFile{"a world",
                                    kWorldElements,
                                    {.unknown_element = world_codes::kUnknownElement,
                                     .unknown_attribute = world_codes::kUnknownAttribute,
                                     .missing_attribute = world_codes::kMissing,
                                     .stray_text = world_codes::kStrayText,
                                     .bad_value = world_codes::kBadValue}};

}  // namespace orca::sim::detail
