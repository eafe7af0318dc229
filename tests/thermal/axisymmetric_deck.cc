#include "tests/thermal/axisymmetric_deck.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

#include "twin/calculix.h"

namespace thermotwin::thermal {
namespace {

/// The n-th table under a title of the .dat file: node → last column.
std::map<int, double> table(std::string const& printed, std::string const& title, int which) {
  std::istringstream lines(printed);
  std::map<int, double> values;
  int seen = -1;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" for set ") != std::string::npos) {
      bool const ours = line.find(title) != std::string::npos;
      if (ours) ++seen;
      if (ours || seen == which) {
        if (seen > which) break;
        if (!ours) break;
      }
      continue;
    }
    int node = 0;
    double value = 0.0, last = 0.0;
    std::istringstream words(line);
    if (seen != which || !(words >> node)) continue;
    while (words >> value) last = value;
    values[node] = last;
  }
  return values;
}

}  // namespace

AxisymmetricDeck::AxisymmetricDeck(std::vector<double> radii, std::vector<double> heights)
    : radii_(std::move(radii)), heights_(std::move(heights)), layers_(heights_.size() - 1) {}

void AxisymmetricDeck::fill(int from, int to, Material const& material) {
  for (int b = from; b < to; ++b) layers_[std::size_t(b)] = material;
}

template <class Visit>
void AxisymmetricDeck::for_elements(Face face, double low, double high, Visit visit) const {
  int const nr = int(radii_.size()) - 1, nz = int(heights_.size()) - 1;
  bool const end = face == Face::low || face == Face::high;
  auto const& along = end ? radii_ : heights_;
  for (int k = 0; k < (end ? nr : nz); ++k) {
    double const middle = 0.5 * (along[std::size_t(k)] + along[std::size_t(k) + 1]);
    if (middle < low || middle > high) continue;
    int const a = end ? k : face == Face::outer ? nr - 1 : 0, b = !end ? k : face == Face::high ? nz - 1 : 0;
    visit(1 + a + nr * b);
  }
}

void AxisymmetricDeck::add_film(Face face, double low, double high, double coefficient, double sink) {
  for_elements(face, low, high,
               [&](int e) { films_ += fmt::format("{},F{},{:.9g},{:.9g}\n", e, int(face), sink, coefficient); });
}

void AxisymmetricDeck::add_flux(Face face, double low, double high, double flux) {
  for_elements(face, low, high, [&](int e) { fluxes_ += fmt::format("{},S{},{:.9g}\n", e, int(face), flux); });
}

void AxisymmetricDeck::hold(Face face, double temperature) {
  int const j = face == Face::low ? 0 : 2 * (int(heights_.size()) - 1);
  for (int i = 0; i < 2 * int(radii_.size()) - 1; ++i) held_ += fmt::format("{},11,11,{:.9g}\n", id(i, j), temperature);
}

int AxisymmetricDeck::node(double radius, double height) const {
  auto const nearest = [](std::vector<double> const& edges, double x) {
    return int(std::min_element(edges.begin(), edges.end(),
                                [&](double a, double b) { return std::abs(a - x) < std::abs(b - x); }) -
               edges.begin());
  };
  return id(2 * nearest(radii_, radius), 2 * nearest(heights_, height));
}

std::string AxisymmetricDeck::model(std::vector<int> const& nodes) const {
  int const nr = int(radii_.size()) - 1, nz = int(heights_.size()) - 1;
  auto const at = [](std::vector<double> const& edges, int i) {
    auto const k = std::size_t(i / 2);
    return i % 2 == 0 ? edges[k] : 0.5 * (edges[k] + edges[k + 1]);
  };
  std::string text = "*NODE,NSET=ALL\n";
  for (int j = 0; j <= 2 * nz; ++j)
    for (int i = 0; i <= 2 * nr; ++i)
      if (i % 2 == 0 || j % 2 == 0)
        text += fmt::format("{},{:.12g},{:.12g},0.\n", id(i, j), at(radii_, i), at(heights_, j));
  for (int b = 0; b < nz; ++b) {
    text += fmt::format("*ELEMENT,TYPE=CAX8,ELSET=LAYER{}\n", b);
    for (int a = 0; a < nr; ++a) {
      int const i = 2 * a, j = 2 * b;
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", 1 + a + nr * b, id(i, j), id(i + 2, j), id(i + 2, j + 2),
                          id(i, j + 2), id(i + 1, j), id(i + 2, j + 1), id(i + 1, j + 2), id(i, j + 1));
    }
    auto const& m = layers_[std::size_t(b)];
    text += fmt::format(
        "*MATERIAL,NAME=M{0}\n*CONDUCTIVITY\n{1:.9g}\n*DENSITY\n{2:.9g}\n*SPECIFIC HEAT\n{3:.9g}\n"
        "*ELASTIC\n{4:.9g},{5:.9g}\n*EXPANSION,ZERO=0.\n{6:.9g}\n*SOLID SECTION,ELSET=LAYER{0},MATERIAL=M{0}\n",
        b, m.conductivity, m.density, m.specific_heat, m.youngs_modulus, m.poisson_ratio, m.expansion);
  }
  text += fmt::format("*NSET,NSET=ASKED\n{}\n", fmt::join(nodes, ",\n"));
  text += "*INITIAL CONDITIONS,TYPE=TEMPERATURE\nALL,0.\n";
  if (supported_) {
    text += "*BOUNDARY\n";
    for (int i = 0; i <= 2 * nr; ++i) text += fmt::format("{},2,2\n", id(i, 0));
  }
  return text;
}

std::string AxisymmetricDeck::loads() const {
  std::string text;
  if (!held_.empty()) text += "*BOUNDARY\n" + held_;
  if (!films_.empty()) text += "*FILM\n" + films_;
  if (!fluxes_.empty() || source_ != 0.0) text += "*DFLUX\n" + fluxes_;
  int const elements = int((radii_.size() - 1) * (heights_.size() - 1));
  for (int e = 1; source_ != 0.0 && e <= elements; ++e) text += fmt::format("{},BF,{:.9g}\n", e, source_);
  return text;
}

AxisymmetricDeck::State AxisymmetricDeck::steady(std::vector<int> const& nodes) const {
  std::string const procedure =
      supported_ ? "*UNCOUPLED TEMPERATURE-DISPLACEMENT,STEADY STATE\n" : "*HEAT TRANSFER,STEADY STATE\n";
  std::string const wanted = supported_ ? "NT\n*NODE PRINT,NSET=ASKED\nU\n" : "NT\n";
  auto const printed = twin::run_calculix(model(nodes) + "*STEP\n" + procedure + loads() + "*NODE PRINT,NSET=ASKED\n" +
                                          wanted + "*END STEP\n");
  State state;
  state.theta = table(printed, "temperatures", 0);
  if (supported_) {
    std::istringstream lines(printed.substr(printed.find("displacements")));
    for (std::string line; std::getline(lines, line);) {
      int node = 0;
      double u[3];
      if (std::istringstream words(line); words >> node >> u[0] >> u[1] >> u[2]) state.growth[node] = u[1];
    }
  }
  return state;
}

std::vector<std::map<int, double>> AxisymmetricDeck::transient(std::vector<int> const& nodes, double step,
                                                               std::vector<double> const& times) const {
  std::string deck = model(nodes);
  double before = 0.0;
  for (double time : times) {
    deck += fmt::format("*STEP,INC=1000000\n*HEAT TRANSFER,DIRECT\n{:.9g},{:.9g}\n", step, time - before);
    if (before == 0.0) deck += loads();
    deck += "*NODE PRINT,NSET=ASKED,FREQUENCY=1000000\nNT\n*END STEP\n";
    before = time;
  }
  auto const printed = twin::run_calculix(deck);
  std::vector<std::map<int, double>> history;
  for (std::size_t k = 0; k < times.size(); ++k) history.push_back(table(printed, "temperatures", int(k)));
  return history;
}

}  // namespace thermotwin::thermal
