#include "thermal/material.h"

#include <algorithm>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::thermal {
namespace {

Material renamed(Material material, std::string name) {
  material.name = std::move(name);
  return material;
}

std::vector<Material> all_materials() {
  // name, k, b_k, density, c, b_c, expansion, E, Poisson, emissivity, meaning
  Material const structural{"S235", 54.0, 0.0, 7850.0, 475.0, 0.0, 11.8e-6, 210e9, 0.30, 0.9, "structural steel"};
  Material const grey_iron{"GJL-250", 47.5, 0.0, 7250.0, 500.0, 0.0, 10.5e-6, 120e9, 0.26, 0.9, "grey cast iron"};
  Material const ductile_iron{"GJS-400", 34.0, 0.0, 7175.0, 508.0, 0.0, 11.8e-6, 170e9, 0.275, 0.9, "ductile iron"};
  return {
      {"42CrMo4", 42.0, 0.0, 7830.0, 470.0, 0.0, 11.8e-6, 210e9, 0.29, 0.25, "steel of shafts, spindles"},
      {"C45", 48.0, 0.0, 7850.0, 480.0, 0.0, 11.5e-6, 210e9, 0.29, 0.25, "carbon steel"},
      structural,
      renamed(structural, "S355"),
      {"100Cr6", 33.0, -5e-4, 7840.0, 461.0, 1e-3, 12.1e-6, 208e9, 0.30, 0.2, "rolling bearing steel"},
      {"Si3N4", 27.5, 0.0, 3200.0, 750.0, 0.0, 3.1e-6, 310e9, 0.27, 0.9, "silicon nitride, of balls"},
      grey_iron,
      renamed(grey_iron, "GJL-300"),
      ductile_iron,
      renamed(ductile_iron, "GJS-500"),
      renamed(ductile_iron, "GJS-600"),
      {"AlMgSi", 165.0, 0.0, 2700.0, 930.0, 0.0, 23.3e-6, 70e9, 0.33, 0.08, "aluminium alloy"},
      {"AlMgSi anodised", 165.0, 0.0, 2700.0, 930.0, 0.0, 23.3e-6, 70e9, 0.33, 0.85, "aluminium alloy"},
      {"copper winding transverse", 1.0, 0.0, 4500.0, 420.0, 0.0, 17e-6, 0.0, 0.0, 0.8, "of a motor, across wires"},
      {"copper winding axial", 180.0, 0.0, 4500.0, 420.0, 0.0, 17e-6, 0.0, 0.0, 0.8, "of a motor, along wires"},
      {"electrical steel in-plane", 27.5, 0.0, 7650.0, 460.0, 0.0, 12e-6, 200e9, 0.29, 0.3, "of a motor, along sheets"},
      {"electrical steel axial", 3.0, 0.0, 7650.0, 460.0, 0.0, 12e-6, 200e9, 0.29, 0.3, "of a motor, across sheets"},
      {"mineral casting", 1.65, 0.0, 2375.0, 900.0, 0.0, 13e-6, 38e9, 0.25, 0.9, "polymer concrete, of beds"},
      {"granite", 3.15, 0.0, 2900.0, 800.0, 0.0, 6.5e-6, 65e9, 0.25, 0.9},
      {"concrete", 1.6, 0.0, 2400.0, 900.0, 0.0, 11e-6, 30e9, 0.20, 0.9},
      {"CFRP transverse", 3.0, 0.0, 1550.0, 900.0, 0.0, 1e-6, 120e9, 0.30, 0.85, "carbon fibre, across it"},
      {"CFRP axial", 40.0, 0.0, 1550.0, 900.0, 0.0, 1e-6, 120e9, 0.30, 0.85, "carbon fibre, along it"},
      {"Invar 36", 12.0, 0.0, 8100.0, 515.0, 0.0, 1.6e-6, 141e9, 0.29, 0.25, "nickel steel, hardly grows"},
      {"glass scale", 1.0, 0.0, 2500.0, 800.0, 0.0, 8e-6, 70e9, 0.22, 0.9},
      {"Zerodur scale", 1.46, 0.0, 2530.0, 800.0, 0.0, 0.0, 90e9, 0.24, 0.9, "glass ceramic, no growth"},
      {"steel scale", 48.0, 0.0, 7850.0, 480.0, 0.0, 10.75e-6, 210e9, 0.29, 0.25},
      {"lithium grease", 0.145, 0.0, 925.0, 2000.0, 0.0, 0.0, 0.0, 0.0, 0.9},
  };
}

std::vector<Material> const& materials() {
  static std::vector<Material> const all = all_materials();
  return all;
}

}  // namespace

Material const& material(std::string_view name) {
  auto const& all = materials();
  auto const found =
      std::find_if(all.begin(), all.end(), [&](auto const& m) { return edit_distance(m.name, name) == 0; });
  if (found != all.end()) return *found;
  throw InputError("unknown material '" + std::string(name) + "'; " +
                   did_you_mean(name, material_names(), [](auto const& known) { return material(known).meaning; }));
}

std::vector<std::string> const& material_names() {
  static std::vector<std::string> const names = [] {
    std::vector<std::string> all;
    for (auto const& m : materials()) all.push_back(m.name);
    return all;
  }();
  return names;
}

}  // namespace thermotwin::thermal
