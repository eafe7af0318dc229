#pragma once

#include <stdexcept>
#include <string>

namespace thermotwin::thermal {

/// The user described something that cannot be: a negative conductance, a body with no path to anything.
/// Carries the sentence for the user; callers that know a file and a line put them in front.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The integrator gave up; says where the trouble is: the worst nodes and their inputs at that time.
class IntegrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace thermotwin::thermal
