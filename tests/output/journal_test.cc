#include "output/journal.h"

#include <gtest/gtest.h>

#include "output/error.h"
#include "tests/output/temporary_directory.h"

namespace thermotwin::output {
namespace {

using tests::contents;
using tests::put;
using Records = std::vector<std::string>;

Records const records = {"first", std::string("\0\n\xff", 3), "", std::string(10'000, 'x')};

std::filesystem::path written(tests::TemporaryDirectory const& directory) {
  Journal journal(directory / "journal");
  for (auto const& record : records) journal.append(record);
  return directory / "journal";
}

TEST(Journal, GivesBackWhatWasAppended) {
  tests::TemporaryDirectory const directory;
  Journal again(written(directory));
  EXPECT_EQ(again.take_records(), records);
  again.append("fifth");
  EXPECT_EQ(contents(directory / "journal").size(), 5 * 16 + 5 + 3 + 10'000 + 5u);
}

/// Whatever length is left of the file, whole records are read, and what is appended then is read, too.
TEST(Journal, CutAnywhereKeepsTheWholeRecordsBeforeTheCut) {
  tests::TemporaryDirectory const directory;
  auto const whole = contents(written(directory));
  for (std::size_t size : {0, 1, 15, 16, 20, 21, 22, 39, 40, 55, 56, 57, 72, 73, 5000, 10'071}) {
    put(directory / "cut", whole.substr(0, size));
    auto const counted = Journal::count(directory / "cut");
    std::size_t fit = 0, end = 0;
    while (fit < records.size() && end + 16 + records[fit].size() <= size) end += 16 + records[fit++].size();
    EXPECT_EQ(counted, fit) << size;
    Records expected(records.begin(), records.begin() + std::ptrdiff_t(fit));
    {
      Journal cut(directory / "cut");
      EXPECT_EQ(cut.take_records(), expected) << size;
      cut.append("new");
    }
    expected.emplace_back("new");
    EXPECT_EQ(Journal(directory / "cut").take_records(), expected) << size;
  }
}

TEST(Journal, DamagedRecordIsDroppedWithAllBehindIt) {
  tests::TemporaryDirectory const directory;
  auto bytes = contents(written(directory));
  bytes[16 + 5 + 16] ^= 1;  // the second record's first byte
  put(directory / "damaged", bytes);
  EXPECT_EQ(Journal(directory / "damaged").take_records(), Records{"first"});
}

TEST(Journal, IsForOneAtATime) {
  tests::TemporaryDirectory const directory;
  Journal const first(directory / "journal");
  EXPECT_THROW(Journal second(directory / "journal"), OutputError);
  EXPECT_THROW(Journal nowhere(directory / "none" / "journal"), OutputError);
}

}  // namespace
}  // namespace thermotwin::output
