#include "twin/room_air.h"

#include "twin/machine.h"

namespace thermotwin::twin {

Eigen::VectorXd heights_of_nodes(Machine const& machine) {
  Eigen::VectorXd heights = Eigen::VectorXd::Zero(machine.network().nodes());
  for (auto const& body : machine.geometry)
    for (std::size_t i = 0; i < body.cells.size(); ++i)
      heights[Eigen::Index(body.first_node) + Eigen::Index(i)] = centre(body.cells[i]).dot(machine.up);
  return heights;
}

}  // namespace thermotwin::twin
