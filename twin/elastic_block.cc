#include "twin/elastic_block.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/fingerprint.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

Eigen::AlignedBox3d extent_of(thermal::Site const& face) {
  Eigen::AlignedBox3d box;
  for (auto const& contact : face.contacts) box.extend(contact.box);
  return box;
}

std::string text_of(Eigen::Vector3d const& v) {
  auto const rounded = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };
  return fmt::format("{:.9g} {:.9g} {:.9g}", rounded(v[0]), rounded(v[1]), rounded(v[2]));
}

std::string text_of(thermal::Body const& body, thermal::Site const& face) {
  auto const box = extent_of(face);
  return text_of(box.min() - body.origin) + " to " + text_of(box.max() - body.origin);
}

}  // namespace

ElasticBlock elastic_block(thermal::Body const& body, double poisson_ratio, std::string const& fixed,
                           std::string const& loaded) {
  if (body.shape != thermal::Body::Shape::block)
    throw InputError(fmt::format("'{}' is no block; influence weights are for blocks", body.name));
  if (body.nodes() < 2) throw InputError(fmt::format("'{}' is a single cell; influence weights need two", body.name));
  if (!(poisson_ratio >= 0.0 && poisson_ratio < 0.5))
    throw InputError(
        fmt::format("'{}': the Poisson ratio is {}; it must be from 0 to below 0.5", body.name, poisson_ratio));
  auto const face = [&](std::string const& text) {
    auto site = site_of(body, body.name + "." + text);
    if (!(site.area() > 0.0)) throw InputError(fmt::format("'{}' on '{}' has no area", text, body.name));
    return site;
  };
  ElasticBlock block{body, poisson_ratio, face(fixed), face(loaded)};
  if (centre_of(block.fixed).isApprox(centre_of(block.loaded)))
    throw InputError(fmt::format("'{}' is held and loaded at the same place, '{}'", body.name, fixed));
  return block;
}

Eigen::Vector3d centre_of(thermal::Site const& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (auto const& contact : face.contacts) sum += contact.share * contact.box.center();
  return sum;
}

Eigen::Matrix3d second_moment(thermal::Site const& face) {
  Eigen::Vector3d const centre = centre_of(face);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (auto const& contact : face.contacts) {
    Eigen::Vector3d const r = contact.box.center() - centre, size = contact.box.sizes();
    squares += contact.area * (r * r.transpose());
    squares.diagonal() += contact.area / 12.0 * size.cwiseAbs2();
  }
  return squares.trace() * Eigen::Matrix3d::Identity() - squares;
}

Load unit_load(ElasticBlock const& block, Eigen::Vector3d const& direction, Eigen::Vector3d const& point,
               bool rotation) {
  Load load = Load::Zero();
  if (rotation) {
    load.tail<3>() = direction;
    return load;
  }
  Eigen::Vector3d const moment = (point - centre_of(block.loaded)).cross(direction);
  load.head<3>() = direction;
  load.tail<3>() = moment.unaryExpr([](double m) { return std::abs(m) < 1e-9 ? 0.0 : m; });
  return load;
}

std::string solution_key(ElasticBlock const& block, int load) {
  auto const& body = block.body;
  Eigen::Vector3d const size(body.edges[0].back(), body.edges[1].back(), body.edges[2].back());
  auto const text = fmt::format("elastic block {} in {} x {} x {} cells, Poisson {:.9g}, held {}, loaded {}, {}",
                                text_of(size), body.count(0), body.count(1), body.count(2), block.poisson_ratio,
                                text_of(body, block.fixed), text_of(body, block.loaded), unit_loads[std::size_t(load)]);
  Fingerprint print;
  print.add(text);
  return print.text();
}

}  // namespace thermotwin::twin
