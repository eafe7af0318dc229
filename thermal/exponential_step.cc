#include "thermal/exponential_step.h"

#include <algorithm>

namespace thermotwin::thermal {
namespace {

constexpr double slow = 0.05;  // −z up to which the series of φ₃ ends after seven terms

}  // namespace

void ExponentialFactors::set(Eigen::VectorXd const& rate, double h) {
  auto const n = rate.size();
  for (auto* factor : {&decay, &phi1, &phi2, &phi3}) factor->resize(n);
  auto const first_fast = std::lower_bound(rate.begin(), rate.end(), slow / h) - rate.begin();

  auto const z = -h * rate.head(first_fast).array();
  phi3.head(first_fast) =
      1.0 / 6 + z * (1.0 / 24 + z * (1.0 / 120 + z * (1.0 / 720 + z * (1.0 / 5040 + z * (1.0 / 40320 + z / 362880)))));
  phi2.head(first_fast) = 0.5 + z * phi3.head(first_fast);
  phi1.head(first_fast) = 1.0 + z * phi2.head(first_fast);
  decay.head(first_fast) = 1.0 + z * phi1.head(first_fast);

  auto const fast = n - first_fast;
  auto const x = h * rate.tail(fast).array();
  decay.tail(fast) = (-x).exp();
  phi1.tail(fast) = (1.0 - decay.tail(fast)) / x;
  phi2.tail(fast) = (1.0 - phi1.tail(fast)) / x;
  phi3.tail(fast) = (0.5 - phi2.tail(fast)) / x;
}

ExponentialStep::ExponentialStep(Eigen::VectorXd const& rate, Rest rest) : rate_(&rate), rest_(std::move(rest)) {}

void ExponentialStep::restart(double t, Eigen::VectorXd const& state) {
  t_ = t;
  state_ = state;
  rest_(t_, state_, first_);
}

void ExponentialStep::attempt(double h) {
  h_ = h;
  half_.set(*rate_, 0.5 * h);
  full_.set(*rate_, h);
  auto const& u = state_.array();
  auto const& n0 = first_.array();
  Eigen::ArrayXd const free = full_.decay * u;
  Eigen::ArrayXd const halfway = half_.decay * u + 0.5 * h * half_.phi1 * n0;

  stage_ = halfway;
  rest_(t_ + 0.5 * h, stage_, middle_);
  stage_ = halfway + h * half_.phi2 * (middle_.array() - n0);
  rest_(t_ + 0.5 * h, stage_, second_middle_);
  stage_ = free + h * full_.phi1 * n0 + 2.0 * h * full_.phi2 * (second_middle_.array() - n0);
  rest_(t_ + h, stage_, last_);

  result_ = free + h * ((full_.phi1 - 3.0 * full_.phi2 + 4.0 * full_.phi3) * n0 +
                        (2.0 * full_.phi2 - 4.0 * full_.phi3) * (middle_.array() + second_middle_.array()) +
                        (4.0 * full_.phi3 - full_.phi2) * last_.array());
  rest_(t_ + h, result_, next_);
  error_ = h * (4.0 * full_.phi3 - full_.phi2) * (last_.array() - next_.array());
}

void ExponentialStep::accept() {
  t_ += h_;
  state_.swap(result_);
  first_.swap(next_);
}

void ExponentialStep::interpolate(double theta, Eigen::VectorXd& result) {
  part_.set(*rate_, theta);
  // N(s) = N₀ + a s/h + b (s/h)²; ∫₀^θ e^{−Λ(θ−s)} s^k ds = k! θ^{k+1} φ_{k+1}.
  double const x = theta / h_;
  auto const n0 = first_.array(), n1 = second_middle_.array(), n2 = next_.array();
  result = part_.decay * state_.array() + theta * (part_.phi1 * n0 + x * part_.phi2 * (4.0 * n1 - 3.0 * n0 - n2) +
                                                   2.0 * x * x * part_.phi3 * (2.0 * n0 - 4.0 * n1 + 2.0 * n2));
}

}  // namespace thermotwin::thermal
