#include "output/report_page.h"

#include <bit>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <zlib.h>

namespace thermotwin::output {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads numbers as they lie in memory");

/// The page without data, as output/web/build.mjs made it: too long for a C++ text.
// clang-format off
__asm__(".section .rodata\n"
        "thermotwin_page_begin: .incbin \"" THERMOTWIN_PAGE "\"\n"
        "thermotwin_page_end: .previous\n");
// clang-format on
extern "C" char const thermotwin_page_begin[], thermotwin_page_end[];

/// What the page forbids itself (page.html), to which a served one adds where it comes from.
constexpr std::string_view policy = "default-src 'none'";

/// Data go where the mark is.
std::pair<std::string_view, std::string_view> shell() {
  constexpr std::string_view mark = "<!--data-->";
  std::string_view const page(thermotwin_page_begin, std::size_t(thermotwin_page_end - thermotwin_page_begin));
  auto const at = page.find(mark);
  return {page.substr(0, at), page.substr(at + mark.size())};
}

std::string deflated(std::string const& bytes) {
  auto size = compressBound(uLong(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<Bytef const*>(bytes.data()),
                uLong(bytes.size()), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("the page's numbers could not be compressed");
  packed.resize(size);
  return packed;
}

std::string base64(std::string bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<char const*, 6, 8>>;
  std::size_t const padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  std::string text(Digits(bytes.data()), Digits(bytes.data() + bytes.size()));
  text.replace(text.size() - padding, padding, padding, '=');
  return text;
}

/// Inside a script element nothing may look like its end.
std::string for_script(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

ReportPage::ReportPage(std::string title, std::string version)
    : title_(std::move(title)), version_(std::move(version)) {}

Json ReportPage::place(std::string_view type, void const* data, std::size_t bytes, std::vector<Eigen::Index> shape) {
  Json reference = {{"type", type}, {"at", numbers_.size()}, {"shape", std::move(shape)}};
  numbers_.append(static_cast<char const*>(data), bytes);
  numbers_.append((8 - numbers_.size() % 8) % 8, '\0');
  return reference;
}

Json ReportPage::add_numbers(Eigen::Ref<Eigen::MatrixXd const> const& values) {
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> const single = values.cast<float>();
  return place("f32", single.data(), std::size_t(single.size()) * sizeof(float), {single.rows(), single.cols()});
}

Json ReportPage::add_whole_numbers(std::vector<int> const& values) {
  std::vector<std::int32_t> const whole(values.begin(), values.end());
  return place("i32", whole.data(), whole.size() * sizeof(std::int32_t), {Eigen::Index(whole.size())});
}

Json ReportPage::add_quantised(Eigen::MatrixXd const& columns) {
  constexpr double most = 32767.0;
  std::vector<std::int16_t> whole;
  std::vector<double> scales;
  for (auto const& column : columns.colwise()) {
    double const largest = column.size() > 0 ? column.cwiseAbs().maxCoeff() : 0.0;
    double const scale = largest > 0.0 ? largest / most : 1.0;
    scales.push_back(scale);
    for (double const value : column) whole.push_back(std::int16_t(std::lround(value / scale)));
  }
  Json reference = place("i16", whole.data(), whole.size() * sizeof(std::int16_t), {columns.cols(), columns.rows()});
  reference["scales"] = scales;
  return reference;
}

void ReportPage::add_section(std::string_view kind, Json const& section) {
  Json whole = {{"kind", kind}};
  whole.update(section);
  sections_.push_back(whole.dump());
}

std::string ReportPage::document() const {
  return fmt::format(R"({{"title":{},"version":{},"bytes":{},"revision":{},"sections":[{}]}})", Json(title_).dump(),
                     Json(version_).dump(), numbers_.size(), revision_, fmt::join(sections_, ","));
}

std::string ReportPage::packed_numbers() const { return base64(deflated(numbers_)); }

std::string ReportPage::html() const {
  auto const [before, after] = shell();
  std::string head(before);
  if (revision_ > 0) head.insert(head.find(policy) + policy.size(), "; connect-src 'self'");
  return fmt::format(
      "{}<script type=\"application/json\" id=\"document\">{}</script>\n"
      "<script type=\"text/plain\" id=\"numbers\">{}</script>\n{}",
      head, for_script(document()), packed_numbers(), after);
}

std::string ReportPage::news() const {
  return fmt::format(R"({{"document":{},"numbers":"{}"}})", document(), packed_numbers());
}

}  // namespace thermotwin::output
