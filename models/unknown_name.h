#pragma once

#include <span>
#include <string>
#include <string_view>

namespace thermotwin::models {

/// What an error says of a name that a catalogue does not have: "no selection method 'oredered_ratio'; did you mean
/// 'ordered_ratio'? Known: …", with every name; the question only when at most a third of the letters differ.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<std::string_view const> known);

}  // namespace thermotwin::models
