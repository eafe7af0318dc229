#include "output/journal.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "output/checksum.h"

namespace thermotwin::output {
namespace {

using Head = std::array<std::uint64_t, 2>;  // size and checksum

}  // namespace

Journal::Journal(std::filesystem::path const& path) : file_(path, LockedFile::Busy::refuse) {
  std::string const bytes = file_.contents();
  std::size_t good = 0;
  while (bytes.size() - good >= sizeof(Head)) {
    Head head;
    std::memcpy(head.data(), bytes.data() + good, sizeof head);
    if (head[0] > bytes.size() - good - sizeof head) break;
    std::string record = bytes.substr(good + sizeof head, head[0]);
    if (crc_32(record) != head[1]) break;
    good += sizeof head + record.size();
    records_.push_back(std::move(record));
  }
  if (good < bytes.size()) file_.shorten(good);
}

std::int64_t Journal::count(std::filesystem::path const& path) {
  std::error_code gone;
  std::uint64_t const size = std::filesystem::file_size(path, gone);
  std::ifstream file(path, std::ios::binary);
  std::int64_t records = 0;
  Head head;
  for (std::uint64_t at = 0; !gone && file.read(reinterpret_cast<char*>(head.data()), sizeof head); ++records) {
    at += sizeof head;
    if (head[0] > size - at) break;
    file.seekg(std::streamoff(at += head[0]));
  }
  return records;
}

void Journal::append(std::string_view record) {
  Head const head{record.size(), crc_32(record)};
  std::string bytes;
  bytes.reserve(sizeof head + record.size());
  bytes.append(reinterpret_cast<char const*>(head.data()), sizeof head).append(record);
  file_.append(bytes);
}

}  // namespace thermotwin::output
