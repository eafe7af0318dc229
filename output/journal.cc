#include "output/journal.h"

#include <cstdint>
#include <cstring>
#include <fmt/core.h>
#include <fstream>
#include <optional>
#include <sstream>

#include "output/checksum.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

constexpr std::string_view mark_bytes = "\x8Athtwjr\n";  ///< in no text, as that of PNG

struct Head {
  std::uint64_t mark, size, checksum;
};

std::uint64_t mark() {
  std::uint64_t number;
  std::memcpy(&number, mark_bytes.data(), sizeof number);
  return number;
}

std::optional<std::string_view> record_at(std::string_view bytes, std::size_t at) {
  Head head;
  if (bytes.size() - at < sizeof head) return std::nullopt;
  std::memcpy(&head, bytes.data() + at, sizeof head);
  bytes.remove_prefix(at + sizeof head);
  if (head.mark != mark() || head.size > bytes.size()) return std::nullopt;
  auto const record = bytes.substr(0, head.size);
  return crc_32(record) == head.checksum ? std::optional(record) : std::nullopt;
}

/// Of what lies behind the last record that can be read: only one that was cut short is nobody's loss.
void require_torn(std::string_view bytes, std::size_t good, std::filesystem::path const& path) {
  if (good == 0 && !bytes.starts_with(mark_bytes.substr(0, bytes.size())))
    throw thermal::InputError(
        fmt::format("'{}' does not begin as a journal of this program; it is left as it is", path.string()));
  for (auto at = bytes.find(mark_bytes, good + 1); at != bytes.npos; at = bytes.find(mark_bytes, at + 1))
    if (record_at(bytes, at))
      throw thermal::InputError(fmt::format(
          "'{}' is damaged at byte {}, with whole records behind; it is left as it is, and what it holds is "
          "made again when you delete it",
          path.string(), good));
}

struct Readable {
  std::vector<std::string> records;
  std::size_t size = 0;  ///< of the file, up to their end
};

Readable readable(std::string_view bytes, std::filesystem::path const& path) {
  Readable result;
  while (auto const record = record_at(bytes, result.size)) {
    result.records.emplace_back(*record);
    result.size += sizeof(Head) + record->size();
  }
  require_torn(bytes, result.size, path);
  return result;
}

}  // namespace

Journal::Journal(std::filesystem::path const& path) : file_(path, LockedFile::Busy::refuse) {
  std::string const bytes = file_.contents();
  auto [records, size] = readable(bytes, path);
  if (size < bytes.size()) file_.shorten(size);
  records_ = std::move(records);
}

std::vector<std::string> Journal::read(std::filesystem::path const& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return readable(bytes.view(), path).records;
}

std::int64_t Journal::count(std::filesystem::path const& path) {
  std::error_code gone;
  std::uint64_t const size = std::filesystem::file_size(path, gone);
  std::ifstream file(path, std::ios::binary);
  std::int64_t records = 0;
  Head head;
  for (std::uint64_t at = 0; !gone && file.read(reinterpret_cast<char*>(&head), sizeof head); ++records) {
    at += sizeof head;
    if (head.mark != mark() || head.size > size - at) break;
    file.seekg(std::streamoff(at += head.size));
  }
  return records;
}

void Journal::append(std::string_view record) {
  Head const head{mark(), record.size(), crc_32(record)};
  std::string bytes;
  bytes.reserve(sizeof head + record.size());
  bytes.append(reinterpret_cast<char const*>(&head), sizeof head).append(record);
  file_.append(bytes);
}

}  // namespace thermotwin::output
