#pragma once

#include <vector>

namespace thermotwin::scenarios {

/// How a signal goes from one breakpoint to the next: held, or along a straight line.
enum class Interpolation { step, linear };

/// One number over time, given at breakpoints. Before the first it has the first value, after the last the last one.
class Signal {
 public:
  explicit Signal(double constant = 0.0);
  /// Times strictly increasing, one value for each.
  Signal(std::vector<double> times, std::vector<double> values, Interpolation interpolation);

  /// Value at time t; where it jumps, the limit from the right.
  [[nodiscard]] double at(double t) const;

  /// ∫ value dt from 0 to t.
  [[nodiscard]] double integral(double t) const;

  /// Times at which the value jumps. A linear signal never does.
  [[nodiscard]] std::vector<double> jumps() const;

  /// Breakpoints of a linear signal between which it is straight, within a twentieth of all that it goes through or
  /// 3e-4 of its largest value (0.09 K of air), whichever is more; its ends are among them.
  [[nodiscard]] std::vector<double> bends() const;

  /// 1 in the intervals between breakpoints where the value is not zero throughout, 0 elsewhere.
  [[nodiscard]] Signal running() const;

  /// The breakpoint from which the present piece lasts, not before 0.
  [[nodiscard]] double piece_start(double t) const;

  /// The largest value, without its sign.
  [[nodiscard]] double largest_magnitude() const;

  /// This signal with every value multiplied.
  [[nodiscard]] Signal scaled(double factor) const;
  /// This signal with every value made positive.
  [[nodiscard]] Signal magnitude() const;
  /// This signal held at another value from one time until another.
  [[nodiscard]] Signal with_piece(double from, double to, double value) const;

  [[nodiscard]] Interpolation interpolation() const { return interpolation_; }
  [[nodiscard]] std::vector<double> const& times() const { return times_; }
  [[nodiscard]] std::vector<double> const& values() const { return values_; }

 private:
  [[nodiscard]] std::size_t piece(double t) const;
  [[nodiscard]] double since_first(double t) const;
  [[nodiscard]] double area(std::size_t piece, double t) const;

  std::vector<double> times_;
  std::vector<double> values_;
  Interpolation interpolation_ = Interpolation::step;
  std::vector<double> areas_;  ///< integral from the first breakpoint to each
};

/// A block of a programme: a value held for a duration [s].
struct Block {
  double duration;
  double value;
};

/// The blocks one after another from time 0, `cycles` times over, then `afterwards`; nothing is laid out beyond
/// `until`.
Signal schedule(std::vector<Block> const& blocks, int cycles, double afterwards, double until);

}  // namespace thermotwin::scenarios
