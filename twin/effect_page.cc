#include "twin/effect_page.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <vector>

namespace thermotwin::twin {
namespace {

constexpr std::size_t page_width = 100;

/// Columns that a UTF-8 text takes.
std::size_t width(std::string_view text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(std::string_view text, std::size_t columns) {
  std::size_t const used = width(text);
  return std::string(text) + std::string(used < columns ? columns - used : 0, ' ');
}

/// The text in lines that start at column `indent`, where the first line continues what stands there already.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string lines;
  std::size_t column = indent;
  bool line_begins = true;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t const end = std::min(text.find(' ', begin), text.size());
    std::string_view const word = text.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    if (!line_begins && column + 1 + width(word) > page_width) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
      line_begins = true;
    }
    lines += (line_begins ? "" : " ") + std::string(word);
    column += width(word) + (line_begins ? 0 : 1);
    line_begins = false;
  }
  return lines + "\n";
}

std::string entry(std::string_view title, std::string_view text) {
  constexpr std::size_t indent = 12;
  return padded(title, indent) + wrapped(text, indent);
}

/// The default as people read it: an angle of 15 degrees in radians has 16 digits.
std::string initial(FieldRecord const& field) {
  constexpr std::size_t readable = 10;
  bool const long_number = field.kind == "number" && field.initial.size() > readable;
  return long_number ? fmt::format("{:.4g}", std::stod(field.initial)) : field.initial;
}

/// "default 1 W/K, plausible 0.2 W/K to 5 W/K"
std::string given(FieldRecord const& field) {
  std::string text = field.initial == "required" ? "required" : "";
  if (text.empty() && !field.initial.empty()) text = "default " + initial(field);
  if (text.empty() && field.nested.empty()) text = "may be absent";
  if (!field.range.empty()) text += ", plausible " + field.range;
  return text;
}

std::size_t longest_key(std::vector<FieldRecord> const& fields) {
  std::size_t longest = 0;
  for (auto const& field : fields) longest = std::max(longest, width(field.key));
  return longest;
}

/// Two lines for each field: what it is and what it may be; what it means.
std::string field_lines(std::vector<FieldRecord> const& fields, std::size_t indent) {
  std::size_t const second = indent + longest_key(fields) + 2;
  std::string text;
  for (auto const& field : fields) {
    auto const facts = given(field);
    text += padded(std::string(indent, ' ') + field.key, second);
    text += wrapped(field.kind + (facts.empty() ? "" : "; " + facts), second);
    text += std::string(second, ' ') + wrapped(field.description, second);
    if (!field.nested.empty()) text += field_lines(field.nested, indent + 4);
  }
  return text;
}

/// A cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string result;
  for (char const c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string field_rows(std::vector<FieldRecord> const& fields, std::string const& prefix) {
  std::string text;
  for (auto const& field : fields) {
    text += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", prefix, field.key, cell(field.kind), cell(initial(field)),
                        cell(field.range), cell(field.description));
    if (!field.nested.empty()) text += field_rows(field.nested, prefix + field.key + ".");
  }
  return text;
}

/// ", with while_on machine.on or while_on coolant.on": the variants of a trial.
std::string variants(Trial const& trial) {
  std::vector<std::string> all;
  for (auto const& shape : trial.shapes) {
    std::vector<std::string> keys;
    for (auto const& [key, text] : shape) keys.push_back(key + " " + text);
    all.push_back(keys.empty() ? "its defaults" : fmt::format("{}", fmt::join(keys, " and ")));
  }
  return all.empty() ? "" : fmt::format(", with {}", fmt::join(all, " or "));
}

std::string when(Trial const& trial) {
  return trial.if_changes.empty() ? "" : fmt::format(", where {} changes", trial.if_changes);
}

/// "conductance up to 5 W/K at shaft; conductance up to 5 W/K at ring"
std::string tried(Effect const& effect) {
  std::vector<std::string> lines;
  for (auto const& trial : effect.trials) {
    auto const text = [&](std::string const& key, double value) {
      auto const field =
          std::find_if(effect.parameters.begin(), effect.parameters.end(), [&](auto const& f) { return f.key == key; });
      return thermal::format_quantity(value, field->dimension);
    };
    std::string sites, along;
    for (auto const& [key, factor] : trial.proportional)
      along += fmt::format(" with {} {}", key, text(key, factor * trial.largest));
    for (auto const& site : trial.sites) sites += (sites.empty() ? " at every " : " by ") + site.kind;
    std::string const from = trial.ordinary > 0.0 ? "beyond " + text(trial.amplitude, trial.ordinary) + " " : "";
    lines.push_back(fmt::format("{} {}up to {}{}{}{}{}", trial.amplitude, from, trial.either_sign ? "± " : "",
                                text(trial.amplitude, trial.largest), along, sites, variants(trial) + when(trial)));
  }
  return fmt::format("{}", fmt::join(lines, "; "));
}

/// Titles and texts of an effect, those that it has, in the order in which people read them.
std::vector<std::pair<std::string, std::string>> texts(Effect const& effect) {
  std::vector<std::pair<std::string, std::string>> all = {
      {"Equation", effect.equation},
      {"Changes", effect.changes},
      {"Sites", effect.sites},
      {"Signature", effect.signature},
      {"Looks like", fmt::format("{}", fmt::join(effect.confusable, ", "))},
      {"Told apart", effect.separated_by},
      {"Tried", tried(effect)},
      {"Number", fmt::format("{}", fmt::join(effect.numbers, ", "))},
      {"Source", effect.source}};
  std::erase_if(all, [](auto const& entry) { return entry.second.empty(); });
  return all;
}

std::string effect_section(Effect const& effect) {
  std::string list;
  for (auto const& [title, text] : texts(effect)) list += fmt::format("- {}: {}\n", title, text);
  return fmt::format(
      "\n## {}\n\n{}.\n\n{}\n"
      "| parameter | kind | default | plausible | meaning |\n|---|---|---|---|---|\n{}",
      effect.name, effect.meaning, list, field_rows(effect.parameters, ""));
}

}  // namespace

std::string effect_page(Effect const& effect) {
  std::string page = wrapped(effect.name + ": " + effect.meaning, 0) + "\n";
  for (auto const& [title, text] : texts(effect)) page += entry(title, text);
  return page + fmt::format("\nParameters of [[{}]]:\n\n", effect.name) + field_lines(effect.parameters, 2);
}

std::string effect_list() {
  std::size_t longest = 0;
  for (auto const& effect : effect_catalogue()) longest = std::max(longest, width(effect.name));
  std::string text;
  for (auto const& effect : effect_catalogue())
    text += padded(effect.name, longest + 2) + wrapped(effect.meaning, longest + 2);
  return text;
}

std::string effects_markdown() {
  std::string text =
      "# The effect catalogue\n\n"
      "Written by `thermotwin effects --markdown` from the records that the simulator reads; do not edit.\n"
      "A table of an effect's name in a machine file, `[[film]]`, adds the effect to the machine.\n\n"
      "| effect | meaning | changes |\n|---|---|---|\n";
  for (auto const& effect : effect_catalogue())
    text += fmt::format("| [{0}](#{0}) | {1} | {2} |\n", effect.name, cell(effect.meaning), cell(effect.changes));
  for (auto const& effect : effect_catalogue()) text += effect_section(effect);
  return text;
}

std::string table_page(TableRecord const& table) {
  return wrapped(table.name + ": " + table.meaning, 0) + "\n" + field_lines(table.fields, 2);
}

}  // namespace thermotwin::twin
