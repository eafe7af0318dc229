#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace thermotwin::output {

using Json = nlohmann::ordered_json;

/// A page for people, in one file: opens from disk, asks nothing of any network.
///
/// It carries a document (JSON) and numbers. The document is `{"title", "version", "sections": [{"kind", …}]}`; the
/// page draws each section by its kind (output/web/src/sections). Where the document has numbers it holds what
/// `add_numbers` gave back; the numbers themselves stand one after the other in one stream, deflated and base64 in the
/// file.
class ReportPage {
 public:
  ReportPage(std::string title, std::string version);

  /// {"type": "f32", "at": byte, "shape": [rows, columns]}; a matrix row by row. NaN: missing.
  Json add_numbers(Eigen::Ref<Eigen::MatrixXd const> const& values);
  Json add_whole_numbers(std::vector<int> const& values);

  /// Each column as whole numbers of 16 bits with a scale of its own: {"type": "i16", …, "scales": [per column]},
  /// value = scale · number, to 1/65534 of the column's span about 0. Stored column by column: shape is [columns,
  /// rows].
  Json add_quantised(Eigen::MatrixXd const& columns);

  /// The kind names the drawer.
  void add_section(std::string_view kind, Json const& section);

  /// In place of the first title, once it is known what the page shows.
  void set_title(std::string title) { title_ = std::move(title); }

  /// For a page that a program serves and renews: from this revision on it asks `document?after=REVISION` for news, and
  /// may connect to where it comes from, to nothing else. 0: it stands for itself.
  void set_revision(std::uint64_t revision) { revision_ = revision; }

  [[nodiscard]] std::string html() const;

  /// What a page in a browser asks for to draw itself anew: {"document": …, "numbers": base64}.
  [[nodiscard]] std::string news() const;

 private:
  [[nodiscard]] std::string document() const;
  [[nodiscard]] std::string packed_numbers() const;
  Json place(std::string_view type, void const* data, std::size_t bytes, std::vector<Eigen::Index> shape);

  std::string title_, version_;
  std::string numbers_;
  std::vector<std::string> sections_;
  std::uint64_t revision_ = 0;
};

}  // namespace thermotwin::output
