#include "scenarios/sampled.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenarios/noisy_record.h"
#include "thermal/error.h"

namespace thermotwin::scenarios {
namespace {

constexpr double same_block = 0.02;           // of the largest magnitude
constexpr double deviations = 5.0;            // of the noise
constexpr double most_noise = 0.1;            // of the largest magnitude
constexpr double staircase = 1.7;             // times what neighbours differ by; of a random walk √2
constexpr double surely_still = 0.002;        // of the largest magnitude
constexpr double least_of_motion = 3.0;       // times the noise of neighbours
constexpr double deviation_of_median = 1.05;  // σ = 1.4826/√2 · median |Δ| of white noise
constexpr double regular = 0.25;  // of the usual interval, by which those of a record of samples differ from it

struct Course {
  std::vector<double> times, values;
};

Course finite_part(SampledInput const& input) {
  Course course;
  for (std::size_t i = 0; i < input.times.size(); ++i) {
    if (!std::isfinite(input.values[i])) continue;
    course.times.push_back(input.times[i]);
    course.values.push_back(input.values[i]);
  }
  if (course.times.empty()) throw thermal::InputError("input '" + input.name + "' has no value at all");
  return course;
}

double median(std::vector<double> values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of samples that are so many apart and not zero: at rest a programme repeats itself, however noisy its record.
double median_step(std::vector<double> const& values, std::size_t apart = 1) {
  std::vector<double> steps;
  for (std::size_t i = apart; i < values.size(); ++i)
    if (values[i] != 0.0 && values[i - apart] != 0.0) steps.push_back(std::abs(values[i] - values[i - apart]));
  return steps.empty() ? 0.0 : median(std::move(steps));
}

/// How it goes from one sample to the next: it is taken at its word then.
bool is_stated(SampledInput const& input) { return input.interpolation != "automatic"; }

bool is_held(SampledInput const& input, std::vector<double> const& values) {
  if (is_stated(input)) return input.interpolation == "step";
  if (is_temperature(input) || input.unit == "s" || input.name.ends_with(".position") ||
      input.name.ends_with(".revolutions") || input.name.starts_with("clock."))
    return false;
  auto const dimension = thermal::dimension_of(input.unit);
  return dimension == thermal::dimension::angular_speed || dimension == thermal::dimension::speed ||
         dimension == thermal::dimension::dimensionless || median_step(values) == 0.0;
}

double largest_magnitude(std::vector<double> const& values) {
  double largest = 0.0;
  for (double const value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Noise about zero, rather than a slow motion: it changes its sign, or comes close to zero.
bool is_about_zero(std::vector<double> const& values) {
  auto const [least, most] = std::minmax_element(values.begin(), values.end());
  if (values.size() < 2 || *least * *most <= 0.0) return true;
  return std::min(std::abs(*least), std::abs(*most)) <= least_of_motion * median_step(values);
}

/// The value of a block of samples that differ by noise only.
double held(std::vector<double> const& values, double mean, double largest) {
  double const share = std::abs(mean) / largest;
  bool const still = share < surely_still || (share < same_block && is_about_zero(values));
  return still ? 0.0 : mean;
}

std::vector<std::size_t> changed_rows(std::vector<double> const& values) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] != values[i - 1]) rows.push_back(i);
  return rows;
}

/// What neighbours differ by is what the programme does, not noise: noise is small, and two samples that are two apart
/// differ by as much of it as neighbours do; those of a staircase differ by twice as much. Nor does noise come at times
/// of its own. Where nothing changed says nothing: a list may repeat its last row from time to time.
bool is_list_of_changes(Course const& samples) {
  auto values = samples.values;
  values.erase(std::unique(values.begin(), values.end()), values.end());
  double const step = median_step(values), largest = largest_magnitude(values);
  if (step <= same_block * largest) return false;
  return step > most_noise * largest || median_step(values, 2) > staircase * step ||
         are_written_at_changes(samples.times, changed_rows(samples.values));
}

/// By how much samples of one block may differ; 0: none does, and each value is taken at its word.
double tolerance_of(Course const& samples) {
  double const step = is_list_of_changes(samples) ? 0.0 : median_step(samples.values);
  if (step == 0.0) return 0.0;
  return std::max(same_block * largest_magnitude(samples.values), deviations * deviation_of_median * step);
}

/// Samples that differ by noise only become one breakpoint with their mean.
Course blocks(Course const& samples) {
  double const largest = largest_magnitude(samples.values), tolerance = tolerance_of(samples);
  Course result;
  std::vector<double> block;
  double mean = 0.0;
  auto const end_block = [&] {
    if (!block.empty()) result.values.push_back(tolerance > 0.0 ? held(block, mean, largest) : block.front());
    block.clear();
  };
  for (std::size_t i = 0; i < samples.times.size(); ++i) {
    double const value = samples.values[i];
    double const reference = tolerance > 0.0 || block.empty() ? mean : block.front();
    if (block.empty() || std::abs(value - reference) > tolerance) {
      end_block();
      result.times.push_back(samples.times[i]);
      mean = 0.0;
    }
    block.push_back(value);
    mean += (value - mean) / double(block.size());
  }
  end_block();
  return result;
}

Course means(Course const& samples, double width) {
  if (width <= 0.0) return samples;
  Course result;
  for (std::size_t i = 0; i < samples.times.size();) {
    double const end = samples.times[i] + width;
    double time = 0.0, value = 0.0;
    int count = 0;
    for (; i < samples.times.size() && samples.times[i] < end; ++i, ++count) {
      time += samples.times[i];
      value += samples.values[i];
    }
    result.times.push_back(time / count);
    result.values.push_back(value / count);
  }
  return result;
}

}  // namespace

double offset_of(RecordedColumn const& column) {
  return column.offset.empty() ? 0.0 : thermal::parse_value(column.offset, thermal::dimension_of(column.unit));
}

std::string unit_of_numbers(double factor, std::string const& unit) { return std::abs(factor) == 1.0 ? unit : ""; }

SampledInput sampled_input(RecordedColumn const& column, std::vector<double> times, std::vector<double> numbers) {
  SampledInput input;
  input.name = column.channel;
  input.unit = thermal::unit_of(thermal::dimension_of(column.unit));
  input.absolute_temperature = thermal::from_unit(0.0, column.unit) != 0.0;  // a scale with a 0 of its own
  input.interpolation = column.interpolation;
  input.times = std::move(times);
  input.values = std::move(numbers);
  for (double& value : input.values) value *= column.factor;
  thermal::from_unit(input.values, column.unit);
  for (double const offset = offset_of(column); double& value : input.values) value += offset;
  return input;
}

bool is_temperature(SampledInput const& input) {
  return input.absolute_temperature || (input.unit == "K" && input.name.ends_with("temperature"));
}

bool are_written_at_changes(std::vector<double> const& times, std::vector<std::size_t> const& changed) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  if (intervals.empty()) return false;
  double const usual = median(intervals);
  auto const at_another = std::count_if(changed.begin(), changed.end(), [&](std::size_t row) {
    return std::abs(intervals[row - 1] - usual) > regular * usual;
  });
  return 3 * std::size_t(at_another) > changed.size();
}

std::vector<double> recorded_times(SampledInput const& input) {
  std::vector<double> times;
  for (std::size_t i = 0; i < input.times.size(); ++i)
    if (std::isfinite(input.values[i])) times.push_back(input.times[i]);
  return times;
}

std::optional<HeldChanges> held_changes(SampledInput const& input) {
  if (recorded_times(input).empty()) return std::nullopt;
  Course const samples = finite_part(input);
  if (!is_held(input, samples.values)) return std::nullopt;
  if (is_stated(input)) return HeldChanges{changed_rows(samples.values).size()};
  return HeldChanges{changed_rows(blocks(samples).values).size(), tolerance_of(samples) > 0.0};
}

DrivenChannel driven_channel(SampledInput const& input) {
  Course samples = finite_part(input);
  bool const held = is_held(input, samples.values);
  if (held && !is_stated(input)) samples = blocks(samples);
  if (!held && !is_stated(input) && is_temperature(input))
    samples.values = without_noise(samples.times, samples.values);
  Course const course = held ? samples : means(samples, input.average);
  Interpolation const between = held ? Interpolation::step : Interpolation::linear;
  return {
      {input.name, input.unit, "measured"}, Signal(course.times, course.values, between), input.absolute_temperature};
}

}  // namespace thermotwin::scenarios
