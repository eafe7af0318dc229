#include "twin/diagnosis/amended_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "output/atomic_file.h"
#include "twin/file/output_path.h"
#include "twin/file/text_file.h"
#include "twin/file/value.h"
#include "twin/influence_file.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

constexpr int comment_column = 40;

/// As a TOML value: numbers, true, false and lists as they are, everything else in quotes.
std::string as_toml(std::string const& text) {
  if (text == "true" || text == "false" || text.starts_with('[')) return text;
  char* end = nullptr;
  static_cast<void>(std::strtod(text.c_str(), &end));
  if (!text.empty() && *end == '\0' && text.find_first_not_of("+-.0123456789eE") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string line_of(AddedKey const& key) {
  std::string const value = key.key == "name" ? '"' + key.text + '"' : as_toml(key.text);
  std::string line = fmt::format("{} = {}", key.key, value);
  if (!key.comment.empty()) line = fmt::format("{:<{}}# {}", line + ' ', comment_column, key.comment);
  return line;
}

std::string newline_of(std::string_view text) { return text.find("\r\n") == text.npos ? "\n" : "\r\n"; }

/// Walks through a TOML text by the places that a parser tells.
class TomlText {
 public:
  explicit TomlText(std::string_view text) : text_(text) {
    lines_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') lines_.push_back(i + 1);
  }

  /// Offset of a place; columns count characters, of which some take several bytes.
  [[nodiscard]] std::size_t offset(Location const& where) const {
    std::size_t at = lines_[std::size_t(where.line) - 1];
    for (int column = 1; column < where.column; ++column) do {
        ++at;
      } while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U);
    return at;
  }

  /// Where the line ends, its line break left out.
  [[nodiscard]] std::size_t end_of_line(std::size_t at) const {
    std::size_t end = std::min(text_.find('\n', at), text_.size());
    if (end > at && text_[end - 1] == '\r') --end;
    return end;
  }

  /// Where the value ends that begins here.
  [[nodiscard]] std::size_t end_of_value(std::size_t at) const {
    if (text_[at] == '"' || text_[at] == '\'') return end_of_string(at);
    if (text_[at] == '[' || text_[at] == '{') return end_of_bracket(at);
    std::size_t end = std::min(text_.find_first_of(",]}#\r\n", at), text_.size());
    while (end > at && (text_[end - 1] == ' ' || text_[end - 1] == '\t')) --end;
    return end;
  }

 private:
  [[nodiscard]] std::size_t end_of_string(std::size_t at) const {
    char const quote = text_[at];
    std::string const three(3, quote);
    bool const many_lines = text_.substr(at, 3) == three;
    for (std::size_t i = at + (many_lines ? 3 : 1); i < text_.size(); ++i) {
      if (quote == '"' && text_[i] == '\\')
        ++i;
      else if (many_lines ? text_.substr(i, 3) == three : text_[i] == quote)
        return i + (many_lines ? 3 : 1);
    }
    return text_.size();
  }

  [[nodiscard]] std::size_t end_of_bracket(std::size_t at) const {
    int depth = 0;
    for (std::size_t i = at; i < text_.size(); ++i) {
      char const c = text_[i];
      if (c == '#') i = end_of_line(i);
      if (c == '"' || c == '\'') i = end_of_string(i) - 1;
      depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
      if (depth == 0) return i + 1;
    }
    return text_.size();
  }

  std::string_view text_;
  std::vector<std::size_t> lines_;
};

std::string as_comment(std::string_view text, std::string const& newline) {
  std::string result;
  for (std::size_t from = 0; from < text.size();) {
    std::size_t const end = std::min(text.find('\n', from), text.size());
    result += fmt::format("# {}{}", text.substr(from, end - from), newline);
    from = end + 1;
  }
  return result;
}

/// A piece of the text that becomes another; an empty one is an insertion.
struct Edit {
  std::size_t length = 0;
  std::string text;
};

/// What was written there, without quotes.
std::string old_text(Value const& value) {
  return value.is_text() ? std::get<std::string>(value.content) : value.text();
}

class Editor {
 public:
  explicit Editor(std::string_view text) : text_(text), places_(text), document_(parse_toml(text, "machine file")) {}

  void change(ChangedValue const& change) {
    auto const [table, key] = find_parameter(document_, change.path);
    if (Value const* value = table->find(key))
      replace(*value, change);
    else
      add(*table, key, change);
  }

  [[nodiscard]] std::string result() {
    for (auto const& [at, comment] : comments_) {
      auto& edit = edits_[at];
      edit.text = "  # " + comment + edit.text;
    }
    std::string text(text_);
    for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit)
      text.replace(edit->first, edit->second.length, edit->second.text);
    return text;
  }

 private:
  void replace(Value const& value, ChangedValue const& change) {
    std::size_t const begin = places_.offset(value.where), end = places_.end_of_value(begin);
    edits_[begin] = {end - begin, as_toml(change.text)};
    remark(end, fmt::format("was {}{}{}", old_text(value), change.comment.empty() ? "" : "; ", change.comment));
  }

  /// Behind the first key of its table: on a line of its own, or within the braces.
  void add(Value const& table, std::string const& key, ChangedValue const& change) {
    auto const& first = std::get<Value::Table>(table.content).front();
    std::size_t const value = places_.offset(first.value.where), end = places_.end_of_value(value);
    std::string const said = change.comment.empty() ? "" : "  # " + change.comment;
    if (text_[places_.offset(table.where)] == '{') {
      std::size_t const close = places_.end_of_value(places_.offset(table.where));
      std::size_t last = close - 1;
      while (text_[last - 1] == ' ') --last;
      edits_[last].text += fmt::format(", {} = {}", key, as_toml(change.text));
      remark(close, fmt::format("{}: {}", key, change.comment.empty() ? "added" : change.comment));
    } else {
      edits_[places_.end_of_line(end)].text +=
          fmt::format("{}{} = {}{}", newline_of(text_), key, as_toml(change.text), said);
    }
  }

  void remark(std::size_t at, std::string const& said) {
    auto& comment = comments_[places_.end_of_line(at)];
    comment += (comment.empty() ? "" : ", ") + said;
  }

  std::string_view text_;
  TomlText places_;
  Value document_;
  std::map<std::size_t, Edit> edits_;            ///< by offset
  std::map<std::size_t, std::string> comments_;  ///< by offset of the line's end
};

}  // namespace

std::string amended_text(std::string_view text, std::vector<AddedTable> const& tables) {
  std::string const newline = newline_of(text);
  std::string result(text);
  if (!result.empty() && !result.ends_with('\n')) result += newline;
  for (auto const& table : tables) {
    result += newline + as_comment(table.comment, newline);
    result += "[[" + table.effect + "]]" + newline;
    for (auto const& key : table.keys) result += line_of(key) + newline;
  }
  static_cast<void>(parse_toml(result, "amended machine file"));
  return result;
}

std::string with_values(std::string_view text, std::vector<ChangedValue> const& changes) {
  Editor editor(text);
  for (auto const& change : changes) editor.change(change);
  std::string result = editor.result();
  static_cast<void>(parse_toml(result, "amended machine file"));
  return result;
}

std::string with_last_words(std::string_view text, std::string_view comment) {
  std::string const newline = newline_of(text);
  return amended_text(text, {}) + newline + as_comment(comment, newline);
}

void write_amended(fs::path const& machine_file, fs::path const& path, std::string_view text) {
  refuse_to_overwrite(path, machine_file, {});
  auto const from = weights_file(machine_file), to = weights_file(path);
  if (fs::exists(from) && !fs::exists(to)) output::write_atomically(to, text_of_file(from));
  output::write_atomically(path, text);
}

}  // namespace thermotwin::twin
